// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

namespace bounce::scene {

enum class Interpolation { step, linear, cubic_spline };

// What a channel moves. The index is a node, light, camera or material, by the property's prefix.
enum class Property {
    node_translation,
    node_rotation,
    node_scale,
    node_weights,
    node_visible,
    light_color,
    light_power_w,
    light_irradiance_w_m2,
    light_radius_m,
    light_angle_rad,
    light_cone_angle_rad,
    light_blend,
    light_inner_cone_rad,
    light_size_x_m,
    light_size_y_m,
    light_spread_rad,
    camera_yfov_rad,
    camera_focal_length_mm,
    camera_ortho_scale,
    camera_xmag,
    camera_ymag,
    camera_shift_x,
    camera_shift_y,
    material_base_color,
    material_metallic,
    material_roughness,
    material_emission,
    material_emission_strength,
    world_color,
    world_strength,
    world_rotation,
    view_exposure,
};

// Key frames. values holds `components` floats a key (three times as many for cubic_spline: in-tangent,
// value, out-tangent). Times are seconds, strictly ascending, at least one.
struct AnimationSampler {
    Interpolation interpolation = Interpolation::linear;
    int components = 1;
    std::vector<float> times;
    std::vector<float> values;
};

struct AnimationChannel {
    Property property{};
    int index = 0;
    int sampler = 0;
};

struct Animation {
    std::string name;
    std::vector<AnimationSampler> samplers;
    std::vector<AnimationChannel> channels;
    float duration_s = 0.0F;
};

// The sampler's value at time_s, `components` floats, clamped to the first and last key. Rotations are
// interpolated spherically and normalised. Cubic splines are Hermite, tangents scaled by the interval
// (glTF 2.0 specification, appendix C).
[[nodiscard]] std::vector<float> sample(const AnimationSampler& sampler, double time_s, bool is_rotation);

}  // namespace bounce::scene
