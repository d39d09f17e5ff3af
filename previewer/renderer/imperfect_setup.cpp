// SPDX-License-Identifier: Apache-2.0
#include "renderer/imperfect_setup.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>
#include <numbers>

#include "renderer/light_samples.h"
#include "renderer/penumbra.h"
#include "renderer/soft_setup.h"
#include "renderer/world_lights.h"

namespace bounce {
namespace {

constexpr double pi = std::numbers::pi;

// Maps are turned by the golden angle from place to place, so that the texels of no two line up and together
// they show an outline without steps.
constexpr double k_turn = pi * 0.7639320225002102;

// Disks have 1.4 times the radius that those of virtual point lights have, 1.6 times that of their point's
// area: a surface is left bare in exp(-1.6^2), 8 %, instead of 27 % of its texels before these are closed.
// Shadows of direct light are looked at themselves, and the umbra is the darker for it; outlines grow by less
// than a point's radius. docs/lights.md has the measurement.
constexpr double k_wider_disks = 1.4;

// Room around what is seen, texels.
constexpr double k_room_texels = 2.0;

// Nearer to a place's plane than this, render units, a receiver is beside the light.
constexpr double k_least_depth = 1e-7;

// Half of the least part of the disk, or of space, that a map shows.
constexpr double k_least_half = 1e-4;

struct Range {
    double low = std::numeric_limits<double>::max();
    double high = -std::numeric_limits<double>::max();
    void add(double x) {
        low = std::min(low, x);
        high = std::max(high, x);
    }
    [[nodiscard]] bool empty() const { return !(low <= high); }
    [[nodiscard]] double middle() const { return 0.5 * (low + high); }
    [[nodiscard]] double half() const { return 0.5 * (high - low); }
};

glm::dvec3 axis_of(const LightSetup& setup) {
    return glm::normalize(glm::dvec3(glm::vec3(setup.gpu.axis)));
}

glm::dvec3 middle_of(const LightSetup& setup) {
    return glm::dvec3(glm::vec3(setup.gpu.position));
}

bool shines_one_way(const LightSetup& setup, const scene::Light& light) {
    return light.type == scene::LightType::area || setup.map_kind == MAP_PERSPECTIVE;
}

// Where a light's hemispheres look: its own way, or towards the receivers.
glm::dvec3 way_of(const LightSetup& setup, const scene::Light& light, const std::vector<Region>& receivers) {
    if (shines_one_way(setup, light)) {
        return axis_of(setup);
    }
    glm::dvec3 sum(0.0);
    for (const Region& region : receivers) {
        for (const glm::dvec3& p : region) {
            const glm::dvec3 d = p - middle_of(setup);
            sum += d / std::max(glm::length(d), k_least_depth);
        }
    }
    return glm::length(sum) > 1e-6 ? glm::normalize(sum) : axis_of(setup);
}

// How far a place's coordinate along one axis of the disk reaches, over tangents x along that axis and y
// across it: x / (1 + sqrt(1 + x^2 + y^2)) grows with x, and lies the farther out the smaller |y| is.
double outermost(double x, const Range& across) {
    const double near =
        across.low <= 0.0 && across.high >= 0.0 ? 0.0 : std::min(std::abs(across.low), std::abs(across.high));
    return x / (1.0 + std::sqrt(1.0 + x * x + near * near));
}

double innermost(double x, const Range& across) {
    const double far = std::max(std::abs(across.low), std::abs(across.high));
    return x / (1.0 + std::sqrt(1.0 + x * x + far * far));
}

Range on_disk(const Range& along, const Range& across) {
    return {along.low < 0.0 ? outermost(along.low, across) : innermost(along.low, across),
            along.high > 0.0 ? outermost(along.high, across) : innermost(along.high, across)};
}

// The part of a hemisphere's disk that holds the receivers before it: middle and half side.
glm::dvec3 window_of(const glm::dvec3& x, const glm::dvec3& y, const glm::dvec3& z, const glm::dvec3& from,
                     const std::vector<Region>& receivers, double widest, int size) {
    Range s;
    Range t;
    const glm::dvec4 plane(z, -glm::dot(z, from) - k_least_depth);
    for (const Region& region : receivers) {
        for (const glm::dvec3& p : clipped(region, plane)) {
            const double depth = std::max(glm::dot(z, p - from), k_least_depth);
            s.add(std::clamp(glm::dot(x, p - from) / depth, -widest, widest));
            t.add(std::clamp(glm::dot(y, p - from) / depth, -widest, widest));
        }
    }
    if (s.empty()) {
        return {0.0, 0.0, 1.0};
    }
    const Range a = on_disk(s, t);
    const Range b = on_disk(t, s);
    const double half = std::max({a.half(), b.half(), k_least_half}) * (1.0 + 2.0 * k_room_texels / size);
    return {a.middle(), b.middle(), half};
}

// Tangents of the directions that a light sends anything along.
double widest_tangent(const LightSetup& setup, const scene::Light& light) {
    if (setup.map_kind == MAP_PERSPECTIVE) {
        return static_cast<double>(setup.gpu.axis.w) + 0.2;  // as in soft_setup.cpp
    }
    const auto spread = static_cast<double>(light.spread_rad);
    return light.type == scene::LightType::area && spread < pi ? std::tan(0.5 * spread)
                                                               : std::numeric_limits<double>::max();
}

// The least cube along a way that holds the receivers; what lies before it hides all in it
// (shaders/lib/ism.glsl).
DistantMaps cube_around(const std::vector<Region>& receivers, const glm::dvec3& x, const glm::dvec3& y,
                        const glm::dvec3& way, int size) {
    Range along[3];
    for (const Region& region : receivers) {
        for (const glm::dvec3& p : region) {
            along[0].add(glm::dot(x, p));
            along[1].add(glm::dot(y, p));
            along[2].add(glm::dot(way, p));
        }
    }
    if (along[0].empty()) {
        return {glm::vec3(0.0F), 1.0F};
    }
    const double half = std::max({along[0].half(), along[1].half(), along[2].half(), k_least_half});
    return {glm::vec3(x * along[0].middle() + y * along[1].middle() + way * along[2].middle()),
            static_cast<float>(half * (1.0 + 2.0 * k_room_texels / size))};
}

uint32_t origin_of(int map, const IsmLayout& layout) {
    const auto column = static_cast<uint32_t>(map % layout.columns * layout.map_size);
    const auto row = static_cast<uint32_t>(map / layout.columns * layout.map_size);
    return column | row << 16U;
}

std::vector<gpu::GpuVpl> sun_places(const LightSetup& setup, const scene::Light& light,
                                    const std::vector<Region>& receivers, int places,
                                    const IsmLayout& layout) {
    const double tangent = light_extent({}, light);
    const glm::dvec3 across(glm::vec3(setup.gpu.tangent));
    const glm::dvec3 up(glm::vec3(setup.gpu.bitangent));
    std::vector<gpu::GpuVpl> out;
    for (const glm::dvec3& p : light_samples(SampleShape::disk, places, setup.place_seed)) {
        const glm::dvec3 way = glm::normalize(axis_of(setup) + tangent * (p.x * across + p.y * up));
        const auto index = static_cast<int>(out.size());
        const glm::dvec3 x = turned_tangent(way, k_turn * index);
        out.push_back(distant_light(way, x, index, layout,
                                    cube_around(receivers, x, glm::cross(way, x), way, layout.map_size)));
    }
    return out;
}

}  // namespace

int imperfect_maps_a_place(const LightSetup& setup, const scene::Light& light,
                           const std::vector<Region>& receivers) {
    if (light.type == scene::LightType::sun || shines_one_way(setup, light)) {
        return 1;
    }
    const glm::dvec3 way = way_of(setup, light, receivers);
    const double radius = std::sqrt(static_cast<double>(setup.gpu.intensity.w));
    const bool all_before = std::all_of(receivers.begin(), receivers.end(), [&](const Region& region) {
        return std::all_of(region.begin(), region.end(), [&](const glm::dvec3& p) {
            return glm::dot(way, p - middle_of(setup)) > radius + k_least_depth;
        });
    });
    return all_before ? 1 : 2;
}

IsmLayout imperfect_layout(const Settings& settings, int maps, int points_a_map) {
    IsmLayout layout;
    layout.vpls = layout.subset = maps;
    layout.cell_columns = 1;
    layout.map_size = settings.used_soft_shadow_size();
    layout.columns = static_cast<int>(std::ceil(std::sqrt(maps)));
    layout.points_a_map = points_a_map;
    return layout;
}

gpu::IsmUniforms imperfect_uniforms(const IsmLayout& layout, const Settings& settings, size_t occluders,
                                    double mean_radius) {
    gpu::IsmUniforms out = ism_uniforms(layout, settings, occluders, mean_radius);
    if (settings.splat == Splat::disks) {
        out.splat.x *= static_cast<float>(k_wider_disks * k_wider_disks);
    }
    return out;
}

ImperfectSetup set_up_imperfect_shadow(const LightSetup& setup, const scene::Light& light,
                                       const std::vector<Region>& receivers, int places,
                                       const IsmLayout& layout) {
    ImperfectSetup out;
    if (light.type == scene::LightType::sun) {
        out.distant = true;
        out.maps = sun_places(setup, light, receivers, places, layout);
        return out;
    }
    out.both_sides = layout.vpls > places;
    const glm::dvec3 way = way_of(setup, light, receivers);
    const double widest = widest_tangent(setup, light);
    for (const glm::dvec3& offset : place_offsets(setup, light, places)) {
        const auto index = static_cast<int>(out.maps.size());
        const glm::dvec3 from = middle_of(setup) + offset;
        const glm::dvec3 x = turned_tangent(way, k_turn * index);
        const glm::dvec3 y = glm::cross(way, x);
        const glm::dvec3 window = out.both_sides
                                      ? glm::dvec3(0.0, 0.0, 1.0)
                                      : window_of(x, y, way, from, receivers, widest, layout.map_size);
        gpu::GpuVpl place{};
        place.position = glm::vec4(glm::vec3(from), 0.0F);
        place.normal = glm::vec4(glm::vec3(way), 0.0F);
        place.tangent = glm::vec4(glm::vec3(x), 0.0F);
        place.bitangent = glm::vec4(glm::vec3(y), std::bit_cast<float>(origin_of(index, layout)));
        place.incident =
            glm::vec4(glm::vec3(window), std::bit_cast<float>(origin_of(index + places, layout)));
        out.maps.push_back(place);
    }
    for (int i = 0; out.both_sides && i < places; ++i) {
        gpu::GpuVpl behind = out.maps[static_cast<size_t>(i)];
        behind.normal = -behind.normal;
        behind.bitangent.w = behind.incident.w;
        out.maps.push_back(behind);
    }
    return out;
}

}  // namespace bounce
