// SPDX-License-Identifier: Apache-2.0
#include "renderer/soft_setup.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <utility>

#include <glm/gtc/matrix_transform.hpp>

#include "renderer/light_samples.h"
#include "renderer/light_tints.h"
#include "renderer/penumbra.h"

namespace bounce {
namespace {

constexpr double pi = std::numbers::pi;

// Tangents that one perspective picture holds at most: beyond some 63 degrees its texels are five times as
// long as in the middle, and a cube's are finer.
constexpr double k_widest_tangent = 2.0;

// Room around what is seen, texels: offsets within a pixel and a texel must stay inside.
constexpr double k_room_texels = 2.0;

// A map that is filtered holds more than what is seen: what filters reach, but at most this part of it.
constexpr double k_most_reach = 0.25;

// Nearer to the light's plane than this, render units, a receiver is beside the light.
constexpr double k_least_depth = 1e-7;

constexpr double k_endless = std::numeric_limits<double>::max();

struct Basis {
    glm::dvec3 x;
    glm::dvec3 y;
    glm::dvec3 z;  // where the maps look; x and y are turned about it as a picture's are
};

struct Window {
    glm::dvec2 low{std::numeric_limits<double>::max()};
    glm::dvec2 high{-std::numeric_limits<double>::max()};
    void add(const glm::dvec2& p) {
        low = glm::min(low, p);
        high = glm::max(high, p);
    }
    void widen(const glm::dvec2& reach) {
        const glm::dvec2 by = glm::min(reach, (high - low) * k_most_reach);
        low -= by;
        high += by;
    }
    [[nodiscard]] bool empty() const { return !(low.x <= high.x); }
    // A window of nothing is as good as any.
    [[nodiscard]] Window with_room(int size, double least) const {
        if (empty()) {
            return {glm::dvec2(-least), glm::dvec2(least)};
        }
        const glm::dvec2 room = glm::max((high - low) * (k_room_texels / size), glm::dvec2(least));
        return {low - room, high + room};
    }
};

Basis light_basis(const LightSetup& setup) {
    return {glm::dvec3(glm::vec3(setup.gpu.tangent)), glm::dvec3(glm::vec3(setup.gpu.bitangent)),
            glm::dvec3(glm::vec3(setup.gpu.axis))};
}

Basis basis_towards(const glm::dvec3& direction) {
    Basis out;
    out.z = glm::normalize(direction);
    const glm::dvec3 any = std::abs(out.z.x) < 0.7 ? glm::dvec3(1.0, 0.0, 0.0) : glm::dvec3(0.0, 1.0, 0.0);
    out.x = glm::normalize(any - out.z * glm::dot(any, out.z));
    out.y = glm::cross(out.x, out.z);
    return out;
}

glm::dvec2 seen_at(const Basis& basis, const glm::dvec3& d) {
    const double depth = std::max(glm::dot(d, basis.z), k_least_depth);
    return {glm::dot(d, basis.x) / depth, glm::dot(d, basis.y) / depth};
}

Window seen_from(const Basis& basis, const glm::dvec3& origin, const std::vector<Region>& receivers,
                 double widest) {
    Window out;
    for (const Region& region : receivers) {
        for (const glm::dvec3& p : region) {
            out.add(glm::clamp(seen_at(basis, p - origin), -widest, widest));
        }
    }
    return out;
}

// What of the regions lies before a plane across the view.
std::vector<Region> before(const Basis& basis, const glm::dvec3& origin,
                           const std::vector<Region>& receivers) {
    std::vector<Region> out;
    const glm::dvec4 plane(basis.z, -glm::dot(basis.z, origin) - k_least_depth);
    for (const Region& region : receivers) {
        Region part = clipped(region, plane);
        if (!part.empty()) {
            out.push_back(std::move(part));
        }
    }
    return out;
}

glm::vec4 row(const glm::dvec3& v, double w) {
    return {glm::vec3(v), static_cast<float>(w)};
}

void set_offset(gpu::GpuShadowView& view, const glm::dvec2& pixels, int size) {
    view.to_s.w = static_cast<float>(pixels.x);
    view.to_t.w = static_cast<float>(pixels.y);
    view.forward.w = static_cast<float>(size);
}

// Clip coordinates are linear in the place relative to the origin.
LightFace face_of(const gpu::GpuShadowView& view, bool perspective) {
    glm::dmat4 rows(0.0);
    const double near = static_cast<double>(view.origin.w);
    rows[0] = glm::dvec4(glm::dvec3(glm::vec3(view.to_s)), 0.0);
    rows[1] = glm::dvec4(glm::dvec3(glm::vec3(view.to_t)), 0.0);
    const glm::dvec4 depth(glm::dvec3(glm::vec3(view.to_depth)), 0.0);
    rows[2] = perspective ? glm::dvec4(0.0, 0.0, 0.0, near) : glm::dvec4(0.0, 0.0, 0.0, 1.0) - depth / near;
    rows[3] = perspective ? depth : glm::dvec4(0.0, 0.0, 0.0, 1.0);
    const glm::dmat4 from_origin = glm::translate(glm::dmat4(1.0), -glm::dvec3(glm::vec3(view.origin)));
    return {glm::mat4(glm::transpose(rows) * from_origin), false};
}

gpu::GpuShadowView perspective_view(const Basis& basis, const glm::dvec3& origin, const Window& window,
                                    double near) {
    const glm::dvec2 half = 0.5 * (window.high - window.low);
    const glm::dvec2 middle = 0.5 * (window.high + window.low);
    gpu::GpuShadowView view{};
    view.origin = row(origin, near);
    view.to_s = row((basis.x - middle.x * basis.z) / half.x, 0.0);
    view.to_t = row((basis.y - middle.y * basis.z) / half.y, 0.0);
    view.to_depth = row(basis.z, 0.0);
    view.right = row(basis.x * half.x, 0.0);
    view.up = row(basis.y * half.y, 0.0);
    view.forward = row(basis.z + middle.x * basis.x + middle.y * basis.y, 0.0);
    return view;
}

// Along basis.z + slant.x basis.x + slant.y basis.y; near: the depth at which the map begins, of all the
// scene the least; most: what of that plane it may show, along the basis.
gpu::GpuShadowView slanted_view(const Basis& basis, const glm::dvec2& slant, double near, double range,
                                const std::vector<Region>& receivers, int size, double reach,
                                const Window& most = {glm::dvec2(-k_endless), glm::dvec2(k_endless)}) {
    const glm::dvec3 across_x = basis.x - slant.x * basis.z;
    const glm::dvec3 across_y = basis.y - slant.y * basis.z;
    const glm::dvec3 begin = near * basis.z;
    Window window;
    for (const Region& region : receivers) {
        for (const glm::dvec3& p : region) {
            window.add({glm::dot(across_x, p - begin), glm::dot(across_y, p - begin)});
        }
    }
    if (!window.empty()) {
        window.widen(glm::dvec2(reach));
        window.low = glm::clamp(window.low, most.low, most.high);
        window.high = glm::clamp(window.high, most.low, most.high);
    }
    window = window.with_room(size, 1e-5);
    const glm::dvec2 half = 0.5 * (window.high - window.low);
    const glm::dvec2 middle = 0.5 * (window.high + window.low);
    gpu::GpuShadowView view{};
    view.origin = row(begin + middle.x * basis.x + middle.y * basis.y, range);
    view.to_s = row(across_x / half.x, 0.0);
    view.to_t = row(across_y / half.y, 0.0);
    view.to_depth = row(basis.z, 0.0);
    view.right = row(basis.x * half.x, 0.0);
    view.up = row(basis.y * half.y, 0.0);
    view.forward = row(basis.z + slant.x * basis.x + slant.y * basis.y, 0.0);
    return view;
}

// The least and the largest depth of a box along a direction.
std::pair<double, double> depths_along(const glm::dvec3& direction, const gpu::DrawBox& all) {
    double near = k_endless;
    double far = -k_endless;
    for (int corner = 0; corner < 8; ++corner) {
        const glm::dvec3 p((corner & 1) != 0 ? all.high.x : all.low.x,
                           (corner & 2) != 0 ? all.high.y : all.low.y,
                           (corner & 4) != 0 ? all.high.z : all.low.z);
        near = std::min(near, glm::dot(p, direction));
        far = std::max(far, glm::dot(p, direction));
    }
    return {near, far};
}

void set_up_sun(const LightSetup& setup, double tangent, const std::vector<Region>& receivers,
                const gpu::DrawBox& all, int samples, SoftSetup& out) {
    out.map_kind = MAP_ORTHOGRAPHIC;
    const Basis basis = light_basis(setup);
    const auto [near, far] = depths_along(basis.z, all);
    // As for the hard shadow's map: rounding cuts nothing off, and a flat scene keeps a volume.
    const double room = std::max(0.005 * (far - near), 1e-4);
    const double range = far - near + 2.0 * room;
    if (samples == 1) {
        out.views.push_back(
            slanted_view(basis, glm::dvec2(0.0), near - room, range, receivers, out.size, tangent * range));
        return;
    }
    for (const glm::dvec3& p : light_samples(SampleShape::disk, samples, setup.place_seed)) {
        out.views.push_back(
            slanted_view(basis, tangent * glm::dvec2(p), near - room, range, receivers, out.size, 0.0));
    }
}

// How far before the light's plane anything of the scene lies.
double reach_of(const LightSetup& setup, const gpu::DrawBox& all) {
    const Basis basis = light_basis(setup);
    const glm::dvec3 middle(glm::vec3(setup.gpu.position));
    return std::max(depths_along(basis.z, all).second - glm::dot(middle, basis.z), 0.0);
}

// Whether an area light's spread is so narrow that a receiver sees but a small part of the light anywhere: of
// the places on it next to none. An image over the light is told by places, not by directions.
bool is_beam(const LightSetup& setup, const scene::Light& light, const gpu::DrawBox& all, int samples) {
    const auto spread = static_cast<double>(light.spread_rad);
    return light.type == scene::LightType::area && samples > 1 && spread < 0.5 * pi &&
           light.pattern.width == 0 &&
           std::tan(0.5 * spread) * reach_of(setup, all) <=
               static_cast<double>(std::min(setup.gpu.area.x, setup.gpu.area.y));
}

// The directions of the spread, each with an orthographic map of what lies before the light's plane. They are
// exact at every receiver but for the light's own edge, beyond which some begin.
void set_up_beam(const LightSetup& setup, const scene::Light& light, const std::vector<Region>& receivers,
                 const gpu::DrawBox& all, int samples, SoftSetup& out) {
    out.map_kind = MAP_ORTHOGRAPHIC;
    out.begins_near = true;
    const Basis basis = light_basis(setup);
    const glm::dvec3 middle(glm::vec3(setup.gpu.position));
    const double range = 1.01 * reach_of(setup, all) + k_least_depth;
    // Cycles' least spread is a degree.
    const double tangent = std::tan(0.5 * std::max(static_cast<double>(light.spread_rad), pi / 180.0));
    // Rays begin on the light: no map need show more of its plane.
    const glm::dvec2 here(glm::dot(basis.x, middle), glm::dot(basis.y, middle));
    const glm::dvec2 half(setup.gpu.area.x, setup.gpu.area.y);
    const Window whole{here - half, here + half};
    const std::vector<Region> lit = before(basis, middle, receivers);
    for (const glm::dvec3& p : light_samples(SampleShape::disk, samples, setup.place_seed)) {
        out.views.push_back(slanted_view(basis, tangent * glm::dvec2(p), glm::dot(middle, basis.z), range,
                                         lit, out.size, 0.0, whole));
    }
}

// Whether one picture holds all receivers; its axes, and how wide it may be at most.
bool fits_picture(const LightSetup& setup, const scene::Light& light, const std::vector<Region>& receivers,
                  Basis& basis, double& widest) {
    const glm::dvec3 middle(glm::vec3(setup.gpu.position));
    basis = light_basis(setup);
    widest = std::numeric_limits<double>::max();
    if (setup.map_kind == MAP_PERSPECTIVE) {
        // The cone is that of the light's middle. From its rim a receiver five radii away, or more, lies
        // within this.
        widest = static_cast<double>(setup.gpu.axis.w) + 0.2;
        return true;
    }
    if (light.type == scene::LightType::area && static_cast<double>(light.spread_rad) < pi) {
        widest = std::tan(0.5 * static_cast<double>(light.spread_rad));
    }
    const auto fits = [&] {
        const Window window = seen_from(basis, middle, before(basis, middle, receivers), widest);
        return window.empty() ||
               glm::all(glm::lessThan(glm::max(-window.low, window.high), glm::dvec2(k_widest_tangent)));
    };
    if (light.type == scene::LightType::area) {
        return fits();
    }
    // A point light looks where the receivers are.
    glm::dvec3 sum(0.0);
    for (const Region& region : receivers) {
        for (const glm::dvec3& p : region) {
            sum += (p - middle) / std::max(glm::length(p - middle), k_least_depth);
        }
    }
    if (!(glm::length(sum) > 0.0)) {
        return receivers.empty();
    }
    basis = basis_towards(sum);
    const bool all_before = std::all_of(receivers.begin(), receivers.end(), [&](const Region& region) {
        return std::all_of(region.begin(), region.end(), [&](const glm::dvec3& p) {
            return glm::dot(basis.z, p - middle) > k_least_depth;
        });
    });
    return all_before && fits();
}

bool sees(const glm::mat4& clip_from_render, const std::vector<Region>& receivers) {
    return std::any_of(receivers.begin(), receivers.end(), [&](const Region& region) {
        bool beyond[4] = {true, true, true, true};
        for (const glm::dvec3& p : region) {
            const glm::dvec4 clip = glm::dmat4(clip_from_render) * glm::dvec4(p, 1.0);
            // Offsets within a pixel and a texel reach a little beyond a region.
            const double side = 1.02 * clip.w;
            for (int axis = 0; axis < 2; ++axis) {
                beyond[2 * axis] &= clip[axis] > side;
                beyond[2 * axis + 1] &= -clip[axis] > side;
            }
        }
        return !(beyond[0] || beyond[1] || beyond[2] || beyond[3]);
    });
}

}  // namespace

std::vector<glm::dvec3> place_offsets(const LightSetup& setup, const scene::Light& light, int samples) {
    if (samples == 1) {
        return {glm::dvec3(0.0)};
    }
    const bool area = light.type == scene::LightType::area;
    const bool round = setup.gpu.map.w > 0.5F;
    const SampleShape shape = !area ? SampleShape::ball : round ? SampleShape::disk : SampleShape::square;
    std::vector<glm::dvec3> out = light_samples(shape, samples, setup.place_seed);
    const Basis basis = light_basis(setup);
    const double radius = std::sqrt(static_cast<double>(setup.gpu.intensity.w));
    for (glm::dvec3& p : out) {
        p = area ? basis.x * (p.x * static_cast<double>(setup.gpu.area.x)) +
                       basis.y * (p.y * static_cast<double>(setup.gpu.area.y))
                 : p * radius;
    }
    return out;
}

std::vector<glm::vec3> place_tints(const LightSetup& setup, const scene::Light& light, int samples) {
    const bool round = setup.gpu.map.w > 0.5F;
    const std::vector<glm::dvec3> samples_of =
        light_samples(round ? SampleShape::disk : SampleShape::square, samples, setup.place_seed);
    const std::vector<glm::dvec2> places(samples_of.begin(), samples_of.end());
    return light_tints(light.pattern, places, round);
}

SoftSetup set_up_soft_shadow(const LightSetup& setup, const scene::Light& light,
                             const std::vector<Region>& receivers, const gpu::DrawBox& all, int samples,
                             int size) {
    SoftSetup out;
    out.size = size;
    Basis basis{};
    double widest = 0.0;
    const glm::dvec3 middle(glm::vec3(setup.gpu.position));
    const double near = static_cast<double>(setup.gpu.map.z);
    if (light.type == scene::LightType::sun) {
        set_up_sun(setup, light_extent({}, light), receivers, all, samples, out);
    } else if (is_beam(setup, light, all, samples)) {
        set_up_beam(setup, light, receivers, all, samples, out);
    } else if (fits_picture(setup, light, receivers, basis, widest)) {
        out.map_kind = MAP_PERSPECTIVE;
        const std::vector<Region> lit = before(basis, middle, receivers);
        for (const glm::dvec3& offset : place_offsets(setup, light, samples)) {
            const glm::dvec3 origin = middle + offset;
            Window window = seen_from(basis, origin, lit, std::min(widest, 2.0 * k_widest_tangent));
            if (samples == 1 && !window.empty()) {
                window.widen(window.high - window.low);
            }
            out.views.push_back(perspective_view(basis, origin, window.with_room(size, 1e-4), near));
        }
    } else {
        out.map_kind = MAP_CUBE;
        out.size = std::max(size / 2, 1);
        // An area light has a back that is dark.
        const std::vector<Region> lit =
            light.type == scene::LightType::area ? before(light_basis(setup), middle, receivers) : receivers;
        for (const glm::dvec3& offset : place_offsets(setup, light, samples)) {
            gpu::GpuShadowView view{};
            view.origin = row(middle + offset, near);
            for (size_t i = 0; i < setup.faces.size(); ++i) {
                const glm::mat4 clip(glm::dmat4(setup.faces[i].clip_from_render) *
                                     glm::translate(glm::dmat4(1.0), -offset));
                if (sees(clip, lit)) {
                    out.faces.push_back({static_cast<int>(out.views.size() * setup.faces.size() + i),
                                         {clip, setup.faces[i].mirrored}});
                }
            }
            out.views.push_back(view);
        }
    }
    const std::vector<glm::dvec2> receiver =
        samples == 1 ? std::vector<glm::dvec2>{glm::dvec2(0.0)} : receiver_offsets(samples);
    for (size_t i = 0; i < out.views.size(); ++i) {
        set_offset(out.views[i], receiver[i], out.size);
        if (out.map_kind != MAP_CUBE) {
            out.faces.push_back(
                {static_cast<int>(i), face_of(out.views[i], out.map_kind != MAP_ORTHOGRAPHIC)});
        }
    }
    out.layers = samples * (out.map_kind == MAP_CUBE ? static_cast<int>(setup.faces.size()) : 1);
    return out;
}

}  // namespace bounce
