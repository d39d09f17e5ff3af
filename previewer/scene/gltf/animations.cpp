// SPDX-License-Identifier: Apache-2.0
#include "scene/gltf/animations.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>
#include <tuple>

#include "scene/gltf/animation_pointer.h"

namespace bounce::scene::gltf {
namespace {

using nlohmann::json;

Interpolation interpolation_of(const std::string& name, const std::string& whose) {
    if (name == "STEP") {
        return Interpolation::step;
    }
    if (name == "LINEAR") {
        return Interpolation::linear;
    }
    if (name == "CUBICSPLINE") {
        return Interpolation::cubic_spline;
    }
    throw refusal("{} has the unknown interpolation {}", whose, name);
}

void require_finite(const std::vector<float>& numbers, const std::string& whose) {
    if (!std::all_of(numbers.begin(), numbers.end(), [](float x) { return std::isfinite(x); })) {
        throw refusal("{} has keys that are not finite", whose);
    }
}

// Exporters write several keys at the same time where a curve jumps: the first is where it comes from, the
// last where it goes on; those between are never seen.
void merge_equal_times(AnimationSampler& sampler) {
    const size_t width = sampler.values.size() / sampler.times.size();
    size_t kept = 0;
    for (size_t i = 0; i < sampler.times.size(); ++i) {
        if (kept > 1 && sampler.times[kept - 2] == sampler.times[i]) {
            --kept;
        }
        sampler.times[kept] = sampler.times[i];
        std::copy_n(sampler.values.begin() + static_cast<std::ptrdiff_t>(i * width), width,
                    sampler.values.begin() + static_cast<std::ptrdiff_t>(kept * width));
        ++kept;
    }
    sampler.times.resize(kept);
    sampler.values.resize(kept * width);
}

AnimationSampler read_sampler(Source& source, const Accessors& accessors, const json& description,
                              const ChannelTarget& target, const std::string& whose) {
    AnimationSampler sampler;
    sampler.interpolation = interpolation_of(string_or(description, "interpolation", "LINEAR"), whose);
    sampler.components = target.components;
    const int input = description["input"].get<int>();
    const int output = description["output"].get<int>();
    const size_t keys = accessors.count(input);
    const size_t values_a_key = static_cast<size_t>(target.components) *
                                (sampler.interpolation == Interpolation::cubic_spline ? 3 : 1);
    const size_t values = accessors.count(output) * static_cast<size_t>(accessors.components(output));
    if (values != keys * values_a_key) {
        throw refusal("{} has {} numbers for {} keys of {} each", whose, values, keys, values_a_key);
    }
    Source::spend(source.spent.animation_values, keys + values, k_max_total_animation_values,
                  "animated numbers");
    sampler.times = accessors.floats(input, 1);
    sampler.values = accessors.floats(output, 0);
    require_finite(sampler.times, whose);
    require_finite(sampler.values, whose);
    if (!std::is_sorted(sampler.times.begin(), sampler.times.end())) {
        throw refusal("{} has keys that go back in time", whose);
    }
    merge_equal_times(sampler);
    for (float& value : sampler.values) {
        value *= target.factor;
    }
    return sampler;
}

std::optional<ChannelTarget> target_of(Source& source, const Scene& scene, const std::vector<int>& khr_lights,
                                       const json& target) {
    if (const json* pointer = extension(target, "KHR_animation_pointer")) {
        return resolve_pointer(source, scene, khr_lights, (*pointer)["pointer"].get<std::string>());
    }
    const int node = int_or(target, "node", k_none);
    // glTF 2.0, 3.11: a channel without a node is to be passed over.
    return node == k_none ? std::nullopt
                          : resolve_path(source, scene, node, target["path"].get<std::string>());
}

Animation read_animation(Source& source, const Accessors& accessors, const std::vector<int>& khr_lights,
                         const Scene& scene, size_t index) {
    const json& description = source.json()["animations"][index];
    const json& samplers = description["samplers"];
    Animation animation;
    animation.name = string_or(description, "name", "");
    // One sampler of the file may move things that need different factors or widths.
    std::map<std::tuple<size_t, int, float>, int> known;
    for (const json& channel : description["channels"]) {
        const auto from = channel["sampler"].get<size_t>();
        if (from >= samplers.size()) {
            throw refusal("animation {} refers to sampler {} and has {}", index, from, samplers.size());
        }
        const auto target = target_of(source, scene, khr_lights, channel["target"]);
        if (!target) {
            continue;
        }
        const auto [found, is_new] = known.try_emplace({from, target->components, target->factor},
                                                       static_cast<int>(animation.samplers.size()));
        if (is_new) {
            animation.samplers.push_back(
                read_sampler(source, accessors, samplers[from], *target,
                             fmt::format("sampler {} of animation {}", from, index)));
            animation.duration_s = std::max(animation.duration_s, animation.samplers.back().times.back());
        }
        animation.channels.push_back({target->property, target->index, found->second});
    }
    return animation;
}

}  // namespace

void read_animations(Source& source, const Accessors& accessors, const std::vector<int>& khr_lights,
                     Scene& scene) {
    for (size_t i = 0; i < list(source.json(), "animations").size(); ++i) {
        scene.animations.push_back(read_animation(source, accessors, khr_lights, scene, i));
    }
}

}  // namespace bounce::scene::gltf
