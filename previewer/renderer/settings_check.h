// SPDX-License-Identifier: Apache-2.0
//
// Which settings can be drawn: arithmetic without OpenGL. Sentences name settings as the command line does.
#pragma once

#include <string>

#include "gl/context.h"
#include "renderer/settings.h"

namespace bounce {

// Ends of the ranges.
constexpr int k_most_vpls = 16384;
constexpr int k_most_emitter_panels = 64;   // each is a light with shadow maps of its own
constexpr int k_most_bounce_places = 16;    // more would not lie on an ellipse (bounce_places.cpp)
constexpr int k_most_points_a_map = 65536;  // a point's place in its map is kept in 16 bits
constexpr int k_least_ism_size = 32;
constexpr int k_most_ism_size = 256;
constexpr int k_most_triangle_map_size = 1024;  // as in Table I of Lv et al. 2009
constexpr int k_most_bounces = 4;
constexpr int k_most_vpl_steps = 1000;
constexpr float k_most_importance_pixels = 10.0F;  // per cent; every texel of a map looks at each
constexpr int k_least_avg_size = 32;
constexpr int k_most_avg_size = 256;
constexpr int k_most_rsm_samples = 1 << 15;  // llvmpipe ends a loop after 65,535 iterations
constexpr int k_most_samples = 4096;
constexpr int k_most_transparent_layers = 16;  // each costs a picture
constexpr int k_least_shadow_samples = 8;      // SHADOW_VIEW_CHUNK
constexpr int k_most_imperfect_samples = 512;  // as in Ritschel et al. 2008; a tile's pixels ask 8 each
constexpr int k_most_shadow_samples = 256;     // six layers each of the 2,048 that OpenGL 4.5 promises
// Of the series of a convolution; its maps hold order + 1 or 2 layers of four floats a texel.
constexpr int k_most_convolution_order = 16;
constexpr int k_most_convolution_size = 2048;  // sums of more texels are too coarse for a float
constexpr int k_least_map_size = 2;
constexpr int k_most_map_size = 16384;

// One sentence that names the first setting out of range, its value and its range; empty where there is none.
[[nodiscard]] std::string settings_refusal(const Settings& settings);

// The same for what the driver cannot hold: names the setting to lower.
[[nodiscard]] std::string limits_refusal(const Settings& settings, const gl::DeviceLimits& limits);

// Whether the driver's stages read as many storage buffers as Splat::tessellation needs.
[[nodiscard]] bool can_tessellate(const gl::DeviceLimits& limits);

// Why the layer that the settings ask for is not there under them; empty where it is.
[[nodiscard]] std::string layer_refusal(const Settings& settings);

}  // namespace bounce
