// SPDX-License-Identifier: Apache-2.0
#include "renderer/light_setup.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "renderer/penumbra.h"

namespace bounce {
namespace {

constexpr double pi = std::numbers::pi;

// Near plane of a light's perspective maps, render space (the scene's diagonal is 1). Depth is near/z in a
// float, whose digits are relative, so a near plane far below anything costs no precision, and a small light
// set-up under a dome of kilometres keeps its shadows. What is nearer still is clamped, not lost.
constexpr double k_near = 1e-9;

// A perspective map's texels grow towards its rim with 1/cos^3: wider cones than this are drawn as cubes.
constexpr double k_widest_planar_cone_rad = 120.0 * pi / 180.0;

// Cycles takes a narrower spread for this one.
constexpr float k_least_spread_rad = std::numbers::pi_v<float> / 180.0F;

struct Frame {
    glm::dvec3 position;
    glm::dvec3 tangent;
    glm::dvec3 bitangent;
    glm::dvec3 axis;
};

glm::dvec3 unit_or(const glm::dvec3& v, const glm::dvec3& fallback) {
    const double length = glm::length(v);
    return length > 0.0 && std::isfinite(length) ? v / length : fallback;
}

Frame light_frame(const glm::dmat4& world_from_light, const gpu::RenderSpace& space) {
    Frame frame{};
    frame.axis = -unit_or(glm::dvec3(world_from_light[2]), {0.0, 0.0, 1.0});
    glm::dvec3 x = unit_or(glm::dvec3(world_from_light[0]), {1.0, 0.0, 0.0});
    x -= frame.axis * glm::dot(x, frame.axis);
    // A singular transform leaves no X: any direction across the axis will do.
    const glm::dvec3 any =
        std::abs(frame.axis.x) < 0.9 ? glm::dvec3(1.0, 0.0, 0.0) : glm::dvec3(0.0, 1.0, 0.0);
    frame.tangent = unit_or(x, unit_or(any - frame.axis * glm::dot(any, frame.axis), {0.0, 1.0, 0.0}));
    frame.bitangent = glm::cross(frame.tangent, frame.axis);
    frame.position = space.point(glm::dvec3(world_from_light[3]));
    return frame;
}

glm::dmat4 light_from_render(const Frame& frame) {
    glm::dmat4 m(1.0);
    const glm::dvec3 axes[3] = {frame.tangent, frame.bitangent, frame.axis};
    for (int row = 0; row < 3; ++row) {
        for (int column = 0; column < 3; ++column) {
            m[column][row] = axes[row][column];
        }
        m[3][row] = -glm::dot(axes[row], frame.position);
    }
    return m;
}

// Depth in clip space is near/w: 1 at the near plane, 0 at infinity.
glm::dmat4 perspective(int x_axis, int y_axis, int depth_axis, double depth_sign, double tan_half) {
    glm::dmat4 m(0.0);
    m[x_axis][0] = 1.0 / tan_half;
    m[y_axis][1] = 1.0 / tan_half;
    m[3][2] = k_near;
    m[depth_axis][3] = depth_sign;
    return m;
}

void add_perspective_face(const Frame& frame, double tan_half, LightSetup& out) {
    out.faces.push_back({glm::mat4(perspective(0, 1, 2, 1.0, tan_half) * light_from_render(frame)), false});
}

// The same six faces, in the same order and orientation, as cube_face() in shaders/lib/light.glsl.
void add_cube_faces(const Frame& frame, LightSetup& out) {
    for (int face = 0; face < 6; ++face) {
        const int axis = face / 2;
        const double sign = face % 2 == 0 ? 1.0 : -1.0;
        out.faces.push_back({glm::mat4(perspective((axis + 1) % 3, (axis + 2) % 3, axis, sign, 1.0) *
                                       light_from_render(frame)),
                             sign < 0.0});
    }
}

// A box around the scene along the sun's axes.
void add_sun_face(Frame& frame, const scene::Bounds& bounds, const gpu::RenderSpace& space, LightSetup& out) {
    frame.position = glm::dvec3(0.0);
    const glm::dmat4 rotate = light_from_render(frame);
    glm::dvec3 low(std::numeric_limits<double>::max());
    glm::dvec3 high(-std::numeric_limits<double>::max());
    // A scene that shows nothing is a point.
    const glm::dvec3 from = bounds.empty() ? space.origin : bounds.low;
    const glm::dvec3 to = bounds.empty() ? space.origin : bounds.high;
    for (int corner = 0; corner < 8; ++corner) {
        const glm::dvec3 world((corner & 1) != 0 ? to.x : from.x, (corner & 2) != 0 ? to.y : from.y,
                               (corner & 4) != 0 ? to.z : from.z);
        const glm::dvec3 p(rotate * glm::dvec4(space.point(world), 1.0));
        low = glm::min(low, p);
        high = glm::max(high, p);
    }
    // Half a percent of room, so that rounding cuts nothing off; and a flat scene keeps a volume.
    const glm::dvec3 room = glm::max((high - low) * 0.005, glm::dvec3(1e-4));
    low -= room;
    high += room;
    const glm::dvec3 center = 0.5 * (low + high);
    frame.position = frame.tangent * center.x + frame.bitangent * center.y + frame.axis * low.z;
    const glm::dvec3 half = 0.5 * (high - low);
    const double range = high.z - low.z;
    glm::dmat4 project(1.0);
    project[0][0] = 1.0 / half.x;
    project[1][1] = 1.0 / half.y;
    project[2][2] = -1.0 / range;
    project[3][2] = 1.0;
    out.faces.push_back({glm::mat4(project * light_from_render(frame)), false});
    out.gpu.tangent.w = static_cast<float>(half.x);
    out.gpu.bitangent.w = static_cast<float>(half.y);
    out.gpu.map.z = static_cast<float>(range);
}

// The mean cosine on a surface that faces a sun of this angle, whose places are even over the disk at
// distance 1: what Cycles gives a disk of directions, down to none for half the sky.
double sun_facing(double angle_rad) {
    const double half = std::clamp(0.5 * angle_rad, 0.0, 0.5 * pi);
    const double squared = std::tan(half) * std::tan(half);
    // By its series where the difference would round.
    return squared < 1e-4 ? 1.0 - 0.25 * squared : 2.0 * (std::sqrt(1.0 + squared) - 1.0) / squared;
}

void set_up_spot(const scene::Light& light, gpu::GpuLight& gpu, int& profile) {
    const double half = std::clamp(0.5 * static_cast<double>(light.cone_angle_rad), 1e-4, 0.5 * pi);
    const double cos_half = std::cos(half);
    if (light.profile == scene::SpotProfile::khronos) {
        profile = PROFILE_SPOT_KHRONOS;
        // KHR_lights_punctual, "Inner and Outer Cone Angles".
        const double scale =
            1.0 / std::max(1e-3, std::cos(static_cast<double>(light.inner_cone_rad)) - cos_half);
        gpu.cone = glm::vec4(glm::dvec4(scale, -cos_half * scale, 0.0, 0.0));
        return;
    }
    profile = light.profile == scene::SpotProfile::cycles_4 ? PROFILE_SPOT_CYCLES_4 : PROFILE_SPOT_CYCLES_3;
    // Of the double angle's half: 1 - cos would lose the digits of a narrow cone.
    const double versine = 2.0 * std::sin(0.5 * half) * std::sin(0.5 * half);
    const double width = versine * static_cast<double>(light.blend);
    gpu.cone = glm::vec4(glm::dvec4(versine, width > 1e-9 ? 1.0 / width : 0.0, 0.0, 0.0));
}

// A soft box whose slats hide light beyond spread/2, its power kept: integral of cos (1 - tan a tan) over the
// hemisphere, a = (pi - spread)/2. Matches the measured profile in docs/lights.md.
void set_up_area(const scene::LightInstance& instance, const scene::Light& light,
                 const gpu::RenderSpace& space, gpu::GpuLight& gpu) {
    // In floats, as Cycles does it: the sum below nearly cancels for a narrow spread, and what Cycles' floats
    // lose there is light in its picture, 2.5 % at two degrees and a quarter at one.
    constexpr float half_turn = std::numbers::pi_v<float>;
    const float slats = 0.5F * (half_turn - std::clamp(light.spread_rad, k_least_spread_rad, half_turn));
    const float tangent = std::tan(slats);
    const float norm = slats > 1e-6F ? 2.0F / (2.0F + (2.0F * slats - half_turn) * tangent) : 1.0F;
    const double width = light.size_x_m * glm::length(glm::dvec3(instance.world_from_light[0])) * space.scale;
    const double height =
        light.size_y_m * glm::length(glm::dvec3(instance.world_from_light[1])) * space.scale;
    gpu.area = glm::vec4(glm::vec2(glm::dvec2(0.5 * width, 0.5 * height)), tangent, norm);
    gpu.map.w =
        light.shape == scene::AreaShape::disk || light.shape == scene::AreaShape::ellipse ? 1.0F : 0.0F;
}

}  // namespace

LightSetup set_up_light(const scene::LightInstance& instance, const scene::Light& light,
                        const scene::Bounds& bounds, const gpu::RenderSpace& space, int rsm_size,
                        int shadow_size) {
    LightSetup out;
    out.name = light.name;
    out.casts_shadow = light.cast_shadow;
    gpu::GpuLight& gpu = out.gpu;
    Frame frame = light_frame(instance.world_from_light, space);
    const double luminance = glm::dot(glm::dvec3(light.color), glm::dvec3(0.2126, 0.7152, 0.0722));
    const double squared_scale = space.scale * space.scale;
    double intensity = light.power_w / (4.0 * pi) * squared_scale;
    double radius = light.radius_m * space.scale;
    gpu.map = glm::vec4(static_cast<float>(rsm_size), static_cast<float>(shadow_size), k_near, 0.0F);

    switch (light.type) {
        case scene::LightType::sun:
            out.map_kind = MAP_ORTHOGRAPHIC;
            out.profile = PROFILE_UNIFORM;
            intensity = light.irradiance_w_m2 * sun_facing(static_cast<double>(light.angle_rad));
            radius = 0.0;
            gpu.cone.w = static_cast<float>(light_extent(instance, light));
            add_sun_face(frame, bounds, space, out);
            out.flux_w = luminance * intensity * 4.0 * static_cast<double>(gpu.tangent.w) *
                         static_cast<double>(gpu.bitangent.w) / squared_scale;
            break;
        case scene::LightType::spot: {
            set_up_spot(light, gpu, out.profile);
            const double cone = light.cone_angle_rad;
            out.flux_w = luminance * light.power_w * 0.5 * (1.0 - std::cos(0.5 * cone));
            if (cone <= k_widest_planar_cone_rad) {
                out.map_kind = MAP_PERSPECTIVE;
                const double tan_half = std::tan(0.5 * std::max(cone, 2e-4));
                gpu.axis.w = static_cast<float>(tan_half);
                add_perspective_face(frame, tan_half, out);
            } else {
                out.map_kind = MAP_CUBE;
            }
            break;
        }
        case scene::LightType::point:
            out.map_kind = MAP_CUBE;
            out.profile = PROFILE_UNIFORM;
            out.flux_w = luminance * light.power_w;
            break;
        case scene::LightType::area:
            out.map_kind = MAP_CUBE;
            out.profile = PROFILE_AREA;
            // L = P/(4A): the intensity along the axis is P/4.
            intensity = light.power_w / 4.0 * squared_scale;
            radius = 0.0;
            set_up_area(instance, light, space, gpu);
            out.flux_w = luminance * light.power_w * pi / 4.0;
            break;
    }
    gpu.cone.z = 1.0F;
    if (out.map_kind == MAP_CUBE) {
        add_cube_faces(frame, out);
        gpu.map.x = static_cast<float>(std::max(rsm_size / 2, 1));
        gpu.map.y = static_cast<float>(std::max(shadow_size / 2, 1));
    }
    const auto with_w = [](const glm::dvec3& v, float w) { return glm::vec4(glm::vec3(v), w); };
    gpu.position = with_w(frame.position, 0.0F);
    gpu.axis = with_w(frame.axis, gpu.axis.w);
    gpu.tangent = with_w(frame.tangent, gpu.tangent.w);
    gpu.bitangent = with_w(frame.bitangent, gpu.bitangent.w);
    gpu.intensity = with_w(glm::dvec3(light.color) * intensity, static_cast<float>(radius * radius));
    return out;
}

std::vector<int> share_samples(const std::vector<double>& fluxes, int total) {
    double sum = 0.0;
    for (const double flux : fluxes) {
        sum += flux;
    }
    std::vector<int> shares;
    const int least = std::max(total / (16 * std::max(static_cast<int>(fluxes.size()), 1)), 1);
    for (const double flux : fluxes) {
        const double part = sum > 0.0 ? flux / sum : 1.0 / static_cast<double>(fluxes.size());
        const double stepped = part > 0.0 ? std::exp2(0.5 * std::round(2.0 * std::log2(part))) : 0.0;
        shares.push_back(std::max(static_cast<int>(std::lround(stepped * total)), least));
    }
    return shares;
}

}  // namespace bounce
