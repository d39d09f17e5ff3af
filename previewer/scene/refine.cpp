// SPDX-License-Identifier: Apache-2.0
#include "scene/refine.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <map>
#include <utility>

#include "scene/primitive_bounds.h"

namespace bounce::scene {
namespace {

constexpr size_t k_influences = 4;

// A new vertex: old ones and their weights, which sum to 1.
struct Mix {
    std::array<uint32_t, 3> vertices{};
    std::array<double, 3> weights{};
};

template <typename T>
auto mean(const std::vector<T>& stream, const Mix& mix) {
    glm::vec<T::length(), double> sum(0.0);
    for (size_t i = 0; i < 3; ++i) {
        sum += mix.weights[i] * glm::vec<T::length(), double>(stream[mix.vertices[i]]);
    }
    return sum;
}

template <typename T>
void append_mean(std::vector<T>& stream, const Mix& mix) {
    if (!stream.empty()) {
        stream.push_back(T(mean(stream, mix)));
    }
}

// The mean direction; opposite ones have none, and then the first stays.
glm::dvec3 unit(const glm::dvec3& sum, const glm::dvec3& otherwise) {
    const double length = glm::length(sum);
    return length > 1e-12 ? sum / length : otherwise;
}

void append_directions(Primitive& out, const Mix& mix) {
    const uint32_t first = mix.vertices[0];
    if (!out.normals.empty()) {
        out.normals.emplace_back(unit(mean(out.normals, mix), glm::dvec3(out.normals[first])));
    }
    if (!out.tangents.empty()) {
        const glm::vec4 own = out.tangents[first];
        const glm::dvec3 sum(mean(out.tangents, mix));
        // Corners of one triangle share the bitangent's sign.
        out.tangents.emplace_back(glm::vec3(unit(sum, glm::dvec3(glm::vec3(own)))), own.w);
    }
}

void append_influences(Primitive& out, const Mix& mix) {
    if (out.joints.empty()) {
        return;
    }
    std::map<uint16_t, double> merged;
    for (size_t i = 0; i < 3; ++i) {
        for (int k = 0; k < 4; ++k) {
            merged[out.joints[mix.vertices[i]][k]] +=
                mix.weights[i] * static_cast<double>(out.weights[mix.vertices[i]][k]);
        }
    }
    std::vector<std::pair<double, uint16_t>> largest;
    for (const auto& [joint, weight] : merged) {
        largest.emplace_back(weight, joint);
    }
    std::stable_sort(largest.begin(), largest.end(), [](auto a, auto b) { return a.first > b.first; });
    largest.resize(k_influences);  // padded with weight 0 of joint 0
    double kept = 0.0;
    for (const auto& [weight, joint] : largest) {
        kept += weight;
    }
    glm::u16vec4 joints(0);
    glm::vec4 weights(0.0F);
    for (int k = 0; k < 4; ++k) {
        joints[k] = largest[static_cast<size_t>(k)].second;
        weights[k] = kept > 0.0 ? static_cast<float>(largest[static_cast<size_t>(k)].first / kept) : 0.0F;
    }
    out.joints.push_back(joints);
    out.weights.push_back(weights);
}

uint32_t append(Primitive& out, const Mix& mix) {
    append_directions(out, mix);
    append_mean(out.uv0, mix);
    append_mean(out.uv1, mix);
    append_mean(out.colors, mix);
    append_influences(out, mix);
    for (MorphTarget& target : out.targets) {
        append_mean(target.positions, mix);
        append_mean(target.normals, mix);
        append_mean(target.tangents, mix);
    }
    append_mean(out.positions, mix);
    return static_cast<uint32_t>(out.positions.size() - 1);
}

// How many of the whole splits fall to item k, where each item has a share of one.
size_t share_of(size_t k, double share) {
    return static_cast<size_t>(std::floor(static_cast<double>(k + 1) * share)) -
           static_cast<size_t>(std::floor(static_cast<double>(k) * share));
}

class Refiner {
  public:
    Refiner(const Primitive& primitive, const Refinement& refinement)
        : out_(primitive), segments_(refinement.segments), centre_splits_(refinement.centre_splits) {
        out_.indices.clear();
    }

    void split(const std::array<uint32_t, 3>& corners, size_t number) {
        std::vector<std::array<uint32_t, 3>> parts;
        const auto at = [&](int i, int j) { return vertex(corners, i, j); };
        fill_interior(corners);
        for (int i = 0; i < segments_; ++i) {
            for (int j = 0; i + j < segments_; ++j) {
                parts.push_back({at(i, j), at(i + 1, j), at(i, j + 1)});
                if (i + j + 1 < segments_) {
                    parts.push_back({at(i + 1, j), at(i + 1, j + 1), at(i, j + 1)});
                }
            }
        }
        const auto splits = static_cast<double>(share_of(number, centre_splits_));
        for (size_t k = 0; k < parts.size(); ++k) {
            if (share_of(k, splits / static_cast<double>(parts.size())) > 0) {
                split_at_centre(parts[k]);
            } else {
                out_.indices.insert(out_.indices.end(), parts[k].begin(), parts[k].end());
            }
        }
    }

    Primitive take() {
        out_.bounds = primitive_bounds(out_);
        return std::move(out_);
    }

  private:
    void split_at_centre(const std::array<uint32_t, 3>& part) {
        const uint32_t centre = append(out_, {part, {1.0 / 3.0, 1.0 / 3.0, 1.0 / 3.0}});
        for (size_t k = 0; k < 3; ++k) {
            out_.indices.insert(out_.indices.end(), {part[k], part[(k + 1) % 3], centre});
        }
    }

    void fill_interior(const std::array<uint32_t, 3>& corners) {
        interior_.clear();
        const auto n = static_cast<double>(segments_);
        for (int i = 1; i < segments_; ++i) {
            for (int j = 1; i + j < segments_; ++j) {
                interior_[{i, j}] = append(out_, {corners, {(segments_ - i - j) / n, i / n, j / n}});
            }
        }
    }

    // The vertex i steps towards the second corner and j towards the third.
    uint32_t vertex(const std::array<uint32_t, 3>& corners, int i, int j) {
        const int rest = segments_ - i - j;
        if (i == 0 && j == 0) return corners[0];
        if (rest == 0 && j == 0) return corners[1];
        if (rest == 0 && i == 0) return corners[2];
        if (j == 0) return on_edge(corners[0], corners[1], i);
        if (i == 0) return on_edge(corners[0], corners[2], j);
        if (rest == 0) return on_edge(corners[1], corners[2], j);
        return interior_.at({i, j});
    }

    // Neighbours share it. Where they have vertices of their own on the edge (a hard edge, a seam) its place
    // is the same to the bit, so that no crack opens.
    uint32_t on_edge(uint32_t from, uint32_t to, int step) {
        if (from > to) {
            std::swap(from, to);
            step = segments_ - step;
        }
        auto [found, added] = edges_.try_emplace({from, to}, 0U);
        if (added) {
            const auto n = static_cast<double>(segments_);
            found->second = static_cast<uint32_t>(out_.positions.size());
            for (int k = 1; k < segments_; ++k) {
                (void)append(out_, {{from, to, to}, {(segments_ - k) / n, k / n, 0.0}});
            }
        }
        return found->second + static_cast<uint32_t>(step - 1);
    }

    Primitive out_;
    int segments_;
    double centre_splits_;
    std::map<std::pair<uint32_t, uint32_t>, uint32_t> edges_;  // first of the vertices on it
    std::map<std::pair<int, int>, uint32_t> interior_;
};

}  // namespace

Refinement refinement_by(double factor) {
    assert(std::isfinite(factor) && factor >= 1.0);
    auto segments = static_cast<int>(std::floor(std::sqrt(factor) + 1e-9));
    double splits = std::max(0.0, 0.5 * (factor - segments * segments));
    if (splits > segments * segments) {  // only between 3 and 4: a triangle is split at its centre once
        ++segments;
        splits = 0.0;
    }
    return {segments, splits};
}

Primitive refine(const Primitive& primitive, const Refinement& refinement, size_t first_triangle) {
    Refiner refiner(primitive, refinement);
    for (size_t i = 0; i + 2 < primitive.indices.size(); i += 3) {
        refiner.split({primitive.indices[i], primitive.indices[i + 1], primitive.indices[i + 2]},
                      first_triangle + i / 3);
    }
    return refiner.take();
}

void refine_scene(Scene& scene, const Refinement& refinement) {
    size_t triangles = 0;
    for (Mesh& mesh : scene.meshes) {
        for (Primitive& primitive : mesh.primitives) {
            const size_t own = primitive.indices.size() / 3;
            primitive = refine(primitive, refinement, triangles);
            triangles += own;
        }
    }
}

}  // namespace bounce::scene
