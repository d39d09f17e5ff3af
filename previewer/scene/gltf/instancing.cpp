// SPDX-License-Identifier: Apache-2.0
#include "scene/gltf/instancing.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include <glm/gtc/quaternion.hpp>

#include "scene/transforms.h"

namespace bounce::scene::gltf {

std::vector<glm::dmat4> read_instances(const nlohmann::json& instancing, const Accessors& accessors,
                                       Source& source, size_t node) {
    const nlohmann::json& attributes = list(instancing, "attributes");
    std::optional<size_t> count;
    const auto numbers = [&](const char* key, int components) -> std::vector<float> {
        const nlohmann::json* accessor = member(attributes, key);
        if (accessor == nullptr) {
            return {};
        }
        const size_t here = accessors.count(accessor->get<int>());
        if (count && *count != here) {
            throw refusal("the instances of node {} have {} and {} attributes", node, *count, here);
        }
        if (!count) {
            count = here;
            Source::spend(source.spent.instances, here, k_max_total_instances, "instances");
        }
        std::vector<float> values = accessors.floats(accessor->get<int>(), components);
        if (!std::all_of(values.begin(), values.end(), [](float x) { return std::isfinite(x); })) {
            throw refusal("the instances of node {} have a {} that is not finite", node, key);
        }
        return values;
    };
    const std::vector<float> translations = numbers("TRANSLATION", 3);
    const std::vector<float> rotations = numbers("ROTATION", 4);
    const std::vector<float> scales = numbers("SCALE", 3);

    std::vector<glm::dmat4> instances(count.value_or(0));
    for (size_t i = 0; i < instances.size(); ++i) {
        Transform local;
        if (!translations.empty()) {
            local.translation = {translations[3 * i], translations[3 * i + 1], translations[3 * i + 2]};
        }
        if (!rotations.empty()) {
            const float* xyzw = &rotations[4 * i];
            local.rotation =
                normalized_rotation(glm::dquat(static_cast<double>(xyzw[3]), static_cast<double>(xyzw[0]),
                                               static_cast<double>(xyzw[1]), static_cast<double>(xyzw[2])));
        }
        if (!scales.empty()) {
            local.scale = {scales[3 * i], scales[3 * i + 1], scales[3 * i + 2]};
        }
        instances[i] = parent_from_local(local);
    }
    return instances;
}

}  // namespace bounce::scene::gltf
