// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "passes/rsm_pattern.h"

namespace bounce {

enum class Technique { direct, rsm };

// What the colour target shows.
enum class Show {
    shaded,
    direct,
    indirect,
    rsm_depth,
    rsm_position,
    rsm_normal,
    rsm_flux,
    interpolation,  // red where the indirect light was evaluated in full
};

struct Settings {
    int width = 960;
    int height = 540;
    Technique technique = Technique::rsm;
    Show show = Show::shaded;
    int shown_light = 0;  // whose RSM the rsm_ layers show

    // Over all lights; each gets its part by the light it sends out. 224 is the middle of the paper's range.
    int rsm_samples = 224;
    passes::RsmPattern rsm_pattern = passes::RsmPattern::uniform_radius;
    bool rsm_full_sum = false;  // every texel: the reference, slow
    int rsm_size = 512;         // a cube's faces have half of it

    // Screen-space interpolation (section 4 of the paper).
    bool interpolate = true;
    int lowres_step = 4;  // one sample in step x step pixels
    // A low-resolution sample is suitable where its normal differs by less than this angle, ...
    float interpolation_angle_deg = 15.0F;
    // ... it lies within this part of a low-resolution cell's width of the pixel's tangent plane, ...
    float interpolation_plane = 0.25F;
    // ... and within this many cell widths of the pixel, as the cell stretches over the tilted surface.
    float interpolation_distance = 2.0F;

    int shadow_size = 2048;  // a cube's faces have half of it

    bool count_gathered_pixels = false;  // reads a counter back after the frame; costs a wait
};

}  // namespace bounce
