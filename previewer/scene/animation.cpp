// SPDX-License-Identifier: Apache-2.0
#include "scene/animation.h"

#include <algorithm>
#include <cmath>

namespace bounce::scene {
namespace {

using Values = std::vector<float>;

// The value of key k; part 0, 1, 2 of a cubic spline is in-tangent, value, out-tangent.
const float* key_part(const AnimationSampler& sampler, size_t key, size_t part) {
    const auto width = static_cast<size_t>(sampler.components);
    const size_t parts = sampler.interpolation == Interpolation::cubic_spline ? 3 : 1;
    return &sampler.values[(key * parts + part) * width];
}

const float* key_value(const AnimationSampler& sampler, size_t key) {
    return key_part(sampler, key, sampler.interpolation == Interpolation::cubic_spline ? 1 : 0);
}

Values copied(const AnimationSampler& sampler, size_t key) {
    const float* value = key_value(sampler, key);
    return {value, value + sampler.components};
}

void normalize(Values& values) {
    double squared = 0.0;
    for (const float value : values) {
        squared += static_cast<double>(value) * static_cast<double>(value);
    }
    if (squared == 0.0) {
        // No direction left (opposite tangents): the identity is as good as any.
        std::fill(values.begin(), values.end(), 0.0F);
        values.back() = 1.0F;
        return;
    }
    for (float& value : values) {
        value = static_cast<float>(static_cast<double>(value) / std::sqrt(squared));
    }
}

// Shoemake, "Animating Rotation with Quaternion Curves", 1985, along the shorter arc.
Values slerp(const AnimationSampler& sampler, size_t key, double u) {
    Values a = copied(sampler, key);
    Values b = copied(sampler, key + 1);
    normalize(a);
    normalize(b);
    double cosine = 0.0;
    for (size_t i = 0; i < a.size(); ++i) {
        cosine += static_cast<double>(a[i]) * static_cast<double>(b[i]);
    }
    const double sign = cosine < 0.0 ? -1.0 : 1.0;
    cosine = std::min(std::abs(cosine), 1.0);
    double weight_a = 1.0 - u;
    double weight_b = u;
    // Below this angle the sines lose their digits and the chord is the arc.
    if (cosine < 1.0 - 1e-9) {
        const double angle = std::acos(cosine);
        weight_a = std::sin((1.0 - u) * angle) / std::sin(angle);
        weight_b = std::sin(u * angle) / std::sin(angle);
    }
    for (size_t i = 0; i < a.size(); ++i) {
        a[i] = static_cast<float>(weight_a * static_cast<double>(a[i]) +
                                  sign * weight_b * static_cast<double>(b[i]));
    }
    normalize(a);
    return a;
}

Values linear(const AnimationSampler& sampler, size_t key, double u) {
    Values result = copied(sampler, key);
    const float* next = key_value(sampler, key + 1);
    for (size_t i = 0; i < result.size(); ++i) {
        result[i] =
            static_cast<float>((1.0 - u) * static_cast<double>(result[i]) + u * static_cast<double>(next[i]));
    }
    return result;
}

// glTF 2.0, appendix C.5: Hermite with tangents a second, scaled by the interval.
Values cubic(const AnimationSampler& sampler, size_t key, double u, double interval_s) {
    const float* p0 = key_part(sampler, key, 1);
    const float* m0 = key_part(sampler, key, 2);
    const float* m1 = key_part(sampler, key + 1, 0);
    const float* p1 = key_part(sampler, key + 1, 1);
    const double u2 = u * u;
    const double u3 = u2 * u;
    Values result(static_cast<size_t>(sampler.components));
    for (size_t i = 0; i < result.size(); ++i) {
        result[i] = static_cast<float>((2.0 * u3 - 3.0 * u2 + 1.0) * static_cast<double>(p0[i]) +
                                       interval_s * (u3 - 2.0 * u2 + u) * static_cast<double>(m0[i]) +
                                       (3.0 * u2 - 2.0 * u3) * static_cast<double>(p1[i]) +
                                       interval_s * (u3 - u2) * static_cast<double>(m1[i]));
    }
    return result;
}

}  // namespace

std::vector<float> sample(const AnimationSampler& sampler, double time_s, bool is_rotation) {
    // Files hold times as floats: a key that stands on a frame is the frame's time rounded, now and then
    // upwards, and must count from that frame on.
    const auto as_in_file = static_cast<float>(time_s);
    const auto after = std::upper_bound(sampler.times.begin(), sampler.times.end(), as_in_file);
    Values result;
    if (after == sampler.times.begin()) {
        result = copied(sampler, 0);
    } else {
        const auto key = static_cast<size_t>(after - sampler.times.begin()) - 1;
        const bool between = after != sampler.times.end() && sampler.interpolation != Interpolation::step;
        if (!between) {
            result = copied(sampler, key);
        } else {
            const auto start = static_cast<double>(sampler.times[key]);
            const double interval_s = static_cast<double>(*after) - start;
            const double u = std::clamp((time_s - start) / interval_s, 0.0, 1.0);
            if (sampler.interpolation == Interpolation::cubic_spline) {
                result = cubic(sampler, key, u, interval_s);
            } else {
                result = is_rotation ? slerp(sampler, key, u) : linear(sampler, key, u);
            }
        }
    }
    if (is_rotation) {
        normalize(result);
    }
    return result;
}

}  // namespace bounce::scene
