// SPDX-License-Identifier: Apache-2.0
//
// How virtual point lights and their shadow maps are counted and laid out: arithmetic without OpenGL.
#pragma once

#include "gpu/shared_types.h"
#include "renderer/settings.h"

namespace bounce {

// The lights of one bounce.
struct IsmLayout {
    int vpls = 0;          // asked for, rounded up to a multiple of the interleaved pixels n^2
    int interleave = 1;    // n
    int subset = 0;        // lights that one pixel gathers from: vpls / n^2
    int cell_columns = 0;  // of a subset's cells of the sampled square
    int map_size = 0;      // texels a side of each map
    int columns = 0;       // maps a row of the atlas
    int points_a_map = 0;
    int shadow_map_size = 0;  // of reflective maps: texels of the lights' shadow maps

    [[nodiscard]] int rows() const { return (vpls + columns - 1) / columns; }
    [[nodiscard]] int atlas_width() const { return columns * map_size; }
    [[nodiscard]] int atlas_height() const { return rows() * map_size; }
};

// bounce: from 1; later ones have Settings::bounce_vpls lights.
[[nodiscard]] IsmLayout ism_layout(const Settings& settings, int bounce, int points_a_map);

// Of the lights that stand for the world: Settings::world_vpls of them.
[[nodiscard]] IsmLayout world_layout(const Settings& settings, int points_a_map);

// Of the lights that stand for emissive surfaces: Settings::emitter_vpls of them.
[[nodiscard]] IsmLayout emitter_layout(const Settings& settings, int points_a_map);

// Points for one map: a quarter of the texels of a full parabolic map (Ritschel et al. 2008, 5.2), times the
// mean number of surfaces along a line through the scene where that is above one, and at least what keeps
// their disks small against the scene. depth_complexity: see depth_complexity().
[[nodiscard]] int automatic_points(int map_size, double depth_complexity);

// Mean number of intersections of a line with surfaces of a total area that lie inside a convex body with a
// surface: 2 area / surface (Crofton's formula).
[[nodiscard]] double depth_complexity(double area_m2, double hull_surface_m2);

// Points in the whole sequence that maps take their blocks from, each its own as far as memory goes.
[[nodiscard]] size_t points_in_all(const IsmLayout& layout);

// occluders: points in the sequence. mean_radius: of the disk that one of a map's points stands for, render
// units.
[[nodiscard]] gpu::IsmUniforms ism_uniforms(const IsmLayout& layout, const Settings& settings,
                                            size_t occluders, double mean_radius);

// The same for imperfect reflective shadow maps; their points, `reflectors`, stand behind `first` others.
// What hides those is looked up in the maps that mean_radius is of. dense_area: that one of all reflectors
// stands for where they are dense, render units; 0 where all stand for the same.
[[nodiscard]] gpu::IsmUniforms irsm_uniforms(const IsmLayout& layout, const Settings& settings,
                                             size_t reflectors, size_t first, double mean_radius,
                                             double dense_area = 0.0);

}  // namespace bounce
