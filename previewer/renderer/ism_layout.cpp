// SPDX-License-Identifier: Apache-2.0
#include "renderer/ism_layout.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace bounce {
namespace {

// Below this the disks of a small scene's objects are as large as the objects' features, whatever the maps
// hold.
constexpr int k_least_points = 512;
constexpr int k_most_points = 1 << 16;

// 64 MiB of points: half of what OpenGL promises of a storage block (128 MiB). Beyond it maps share blocks.
constexpr size_t k_most_in_all = (size_t{64} << 20U) / sizeof(glm::uvec4);

// Side of a disk over that of its point's area, so that neighbours overlap and no ray slips between them: of
// points spread at random a share of exp(-overlap^2) of a surface is left bare, and more than this makes
// outlines grow. docs/papers/imperfect_shadow_maps.md has the measurement.
constexpr double k_disk_overlap = 1.15;

// The same where reflected light is collected: a texel left bare is light lost, 2 % of them at this overlap,
// and an outline that is too wide only moves a little of it.
constexpr double k_reflector_overlap = 2.0;

// How far a disk is moved back behind its plane, in its radii: where a surface curves, its points' disks
// stand out of it by up to half their squared radius times the curvature, and must not hide the surface
// itself.
constexpr double k_disk_set_back = 0.5;

// Paths with one depth a splat: the receiver is moved towards the light by this many radii, and by this many
// texel widths times the slope of its surface against the ray: a texel's corner lies 0.71 widths from its
// centre, where a splat's one depth is true at best.
constexpr double k_flat_bias = 0.5;
constexpr double k_slope_bias = 0.75;

}  // namespace

IsmLayout ism_layout(const Settings& settings, int bounce, int points_a_map) {
    IsmLayout layout;
    layout.interleave = settings.interleave;
    const int subsets = settings.interleave * settings.interleave;
    const int wanted = bounce == 1 ? settings.vpls : settings.bounce_vpls;
    layout.subset = std::max((wanted + subsets - 1) / subsets, 1);
    layout.vpls = layout.subset * subsets;
    // Cells of the first bounce are about square, as its maps are. Splatted maps of a further one are cut
    // into strips; where rows are patches of surface (shaders/lib/irsm.glsl), cells are runs of whole rows.
    layout.cell_columns = bounce == 1 ? static_cast<int>(std::sqrt(layout.subset)) : 1;
    while (layout.subset % layout.cell_columns != 0) {
        --layout.cell_columns;
    }
    layout.map_size = settings.ism_size;
    layout.columns = static_cast<int>(std::ceil(std::sqrt(layout.vpls)));
    layout.points_a_map = points_a_map;
    return layout;
}

IsmLayout world_layout(const Settings& settings, int points_a_map) {
    Settings of = settings;
    of.vpls = settings.world_vpls;
    return ism_layout(of, 1, points_a_map);
}

IsmLayout emitter_layout(const Settings& settings, int points_a_map) {
    Settings of = settings;
    of.vpls = settings.emitter_vpls;
    return ism_layout(of, 1, points_a_map);
}

double depth_complexity(double area_m2, double hull_surface_m2) {
    return hull_surface_m2 > 0.0 ? 2.0 * area_m2 / hull_surface_m2 : 0.0;
}

int automatic_points(int map_size, double depth_complexity) {
    const double texels = std::numbers::pi / 4.0 * map_size * map_size;
    const double points = 0.25 * texels * std::max(1.0, depth_complexity);
    // Clamped before it becomes an int: leaves by the million in a small box are more than one holds.
    return static_cast<int>(std::ceil(std::clamp<double>(points, k_least_points, k_most_points)));
}

size_t points_in_all(const IsmLayout& layout) {
    const auto own = static_cast<size_t>(layout.points_a_map) * static_cast<size_t>(layout.vpls);
    return std::max(std::min(own, k_most_in_all), static_cast<size_t>(layout.points_a_map));
}

namespace {

gpu::IsmUniforms layout_uniforms(const IsmLayout& layout, size_t points, size_t first) {
    gpu::IsmUniforms out{};
    out.atlas = {layout.map_size, layout.columns, layout.vpls, layout.points_a_map};
    out.points = {static_cast<int>(points), static_cast<int>(first), layout.shadow_map_size, 0};
    out.gather = {layout.interleave, layout.subset, layout.cell_columns, 0};
    return out;
}

}  // namespace

gpu::IsmUniforms irsm_uniforms(const IsmLayout& layout, const Settings& settings, size_t reflectors,
                               size_t first, double mean_radius, double dense_area) {
    gpu::IsmUniforms out = layout_uniforms(layout, reflectors, first);
    const double density = static_cast<double>(reflectors) / layout.points_a_map;
    const double overlap = settings.bounce_source == BounceSource::irsm ? k_reflector_overlap : 1.0;
    out.splat = glm::vec4(glm::dvec4(density * overlap * overlap, dense_area * density,
                                     k_flat_bias * mean_radius, k_slope_bias));
    return out;
}

gpu::IsmUniforms ism_uniforms(const IsmLayout& layout, const Settings& settings, size_t occluders,
                              double mean_radius) {
    gpu::IsmUniforms out = layout_uniforms(layout, occluders, 0);
    // A point's radius is that of its share of the whole sequence; a map has only a block of it.
    const double density = static_cast<double>(occluders) / layout.points_a_map;
    if (settings.splat == Splat::disks) {
        out.splat =
            glm::vec4(glm::dvec4(density * k_disk_overlap * k_disk_overlap, k_disk_set_back, 0.0, 0.0));
    } else if (settings.splat == Splat::tessellation) {
        // Its points are made for a map, with the radius that they have there.
        out.splat = glm::vec4(glm::dvec4(1.0, 0.0, k_flat_bias * mean_radius, k_slope_bias));
    } else {
        out.splat = glm::vec4(glm::dvec4(density, 0.0, k_flat_bias * mean_radius, k_slope_bias));
    }
    return out;
}

}  // namespace bounce
