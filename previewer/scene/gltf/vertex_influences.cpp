// SPDX-License-Identifier: Apache-2.0
#include "scene/gltf/vertex_influences.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace bounce::scene::gltf {

void read_influences(Source& source, const VertexAttributes& attributes, Primitive& primitive) {
    // Sets of four: JOINTS_0, JOINTS_1, ...
    std::vector<std::vector<uint32_t>> joints;
    std::vector<std::vector<float>> weights;
    for (int set = 0;; ++set) {
        const std::string joints_name = fmt::format("JOINTS_{}", set);
        const std::string weights_name = fmt::format("WEIGHTS_{}", set);
        if (attributes.has(joints_name) != attributes.has(weights_name)) {
            throw refusal("{} has one of {} and {} without the other", attributes.whose(), joints_name,
                          weights_name);
        }
        if (!attributes.has(joints_name)) {
            break;
        }
        joints.push_back(attributes.integers(joints_name, 4));
        weights.push_back(attributes.floats(weights_name, 4));
    }
    if (joints.empty()) {
        return;
    }
    const size_t count = attributes.vertex_count();
    primitive.joints.resize(count);
    primitive.weights.resize(count);
    std::vector<std::pair<float, uint32_t>> influences;
    for (size_t v = 0; v < count; ++v) {
        influences.clear();
        for (size_t set = 0; set < joints.size(); ++set) {
            for (size_t k = 0; k < 4; ++k) {
                const float weight = weights[set][v * 4 + k];
                if (weight > 0.0F && std::isfinite(weight)) {
                    influences.emplace_back(weight, joints[set][v * 4 + k]);
                }
            }
        }
        if (influences.empty()) {
            // Not valid, but seen: such a vertex would fall into the origin.
            influences.emplace_back(1.0F, joints[0][v * 4]);
        }
        std::stable_sort(influences.begin(), influences.end(),
                         [](const auto& a, const auto& b) { return a.first > b.first; });
        if (influences.size() > 4) {
            source.warn("some vertices follow more than four joints; the four strongest are kept");
            influences.resize(4);
        }
        double sum = 0.0;
        for (const auto& [weight, joint] : influences) {
            sum += static_cast<double>(weight);
            if (joint >= k_max_joints) {
                throw refusal("{} refers to joint {}", attributes.whose(), joint);
            }
        }
        for (size_t k = 0; k < influences.size(); ++k) {
            const auto at = static_cast<glm::length_t>(k);
            primitive.joints[v][at] = static_cast<uint16_t>(influences[k].second);
            primitive.weights[v][at] = static_cast<float>(static_cast<double>(influences[k].first) / sum);
        }
    }
}

}  // namespace bounce::scene::gltf
