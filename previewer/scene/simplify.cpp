// SPDX-License-Identifier: Apache-2.0
#include "scene/simplify.h"

#include <algorithm>
#include <cmath>

#include <meshoptimizer.h>

namespace bounce::scene {
namespace {

// On a plane that is not square to the axes rounding lets a collapse turn a triangle over within the plane,
// which then lies on its neighbours: the area grows. A surface that is smoothed grows by less.
constexpr double k_most_growth = 0.005;

// Boxes and the like: a share of their triangles would be a wedge, and spares nothing.
constexpr size_t k_least_triangles = 64;

// A wish that went wrong is tried again half as bold, so many times.
constexpr int k_tries = 4;

constexpr size_t k_most_streams = 16;  // of meshopt_generateShadowIndexBufferMulti

glm::dvec3 across(const Primitive& primitive, const uint32_t* triangle) {
    const glm::dvec3 a(primitive.positions[triangle[0]]);
    const glm::dvec3 b(primitive.positions[triangle[1]]);
    const glm::dvec3 c(primitive.positions[triangle[2]]);
    return glm::cross(b - a, c - a);
}

double area(const Primitive& primitive, const std::vector<uint32_t>& indices) {
    double sum = 0.0;
    for (size_t i = 0; i + 2 < indices.size(); i += 3) {
        sum += 0.5 * glm::length(across(primitive, &indices[i]));
    }
    return sum;
}

// The triangles with one vertex for all that lie at one place: where normals or textures break, the surface
// does not. What deforms must be moved alike, too; where that is more than can be compared, nothing is
// joined.
std::vector<uint32_t> weld(const Primitive& primitive) {
    if (primitive.targets.size() + 3 > k_most_streams) {
        return primitive.indices;
    }
    // Compared byte by byte, where the two zeros differ.
    std::vector<std::vector<glm::vec3>> places = {primitive.positions};
    for (const MorphTarget& target : primitive.targets) {
        if (!target.positions.empty()) {
            places.push_back(target.positions);
        }
    }
    std::vector<meshopt_Stream> streams;
    for (std::vector<glm::vec3>& of : places) {
        for (glm::vec3& place : of) {
            place += 0.0F;  // -0 becomes 0
        }
        streams.push_back({of.data(), sizeof(glm::vec3), sizeof(glm::vec3)});
    }
    if (!primitive.joints.empty()) {
        streams.push_back({primitive.joints.data(), sizeof(glm::u16vec4), sizeof(glm::u16vec4)});
        streams.push_back({primitive.weights.data(), sizeof(glm::vec4), sizeof(glm::vec4)});
    }
    std::vector<uint32_t> out(primitive.indices.size());
    meshopt_generateShadowIndexBufferMulti(out.data(), primitive.indices.data(), primitive.indices.size(),
                                           primitive.positions.size(), streams.data(), streams.size());
    return out;
}

// The vertices that are in use, alone: the simplifier takes others in the same place for breaks in the
// surface, and does not touch these.
struct Compact {
    std::vector<glm::vec3> positions;
    std::vector<uint32_t> vertices;  // of the primitive
    std::vector<uint32_t> indices;
};
Compact compact(const Primitive& primitive, const std::vector<uint32_t>& indices) {
    constexpr uint32_t unused = ~0U;
    Compact out;
    std::vector<uint32_t> place(primitive.positions.size(), unused);
    for (const uint32_t index : indices) {
        if (place[index] == unused) {
            place[index] = static_cast<uint32_t>(out.vertices.size());
            out.vertices.push_back(index);
            out.positions.push_back(primitive.positions[index] + 0.0F);
        }
        out.indices.push_back(place[index]);
    }
    return out;
}

// Gives each corner that vertex of its place whose normal is most like the triangle's, so that edges that
// were sharp stay sharp where the triangles are shaded.
void split_corners(const Primitive& primitive, const std::vector<uint32_t>& welded,
                   std::vector<uint32_t>& indices) {
    std::vector<std::vector<uint32_t>> at_place(primitive.positions.size());
    for (size_t i = 0; i < welded.size(); ++i) {
        std::vector<uint32_t>& vertices = at_place[welded[i]];
        if (std::find(vertices.begin(), vertices.end(), primitive.indices[i]) == vertices.end()) {
            vertices.push_back(primitive.indices[i]);
        }
    }
    for (std::vector<uint32_t>& vertices : at_place) {
        std::sort(vertices.begin(), vertices.end());
    }
    for (size_t i = 0; i + 2 < indices.size(); i += 3) {
        const glm::dvec3 face = across(primitive, &indices[i]);
        for (size_t corner = 0; corner < 3; ++corner) {
            const std::vector<uint32_t>& vertices = at_place[indices[i + corner]];
            indices[i + corner] =
                *std::max_element(vertices.begin(), vertices.end(), [&](uint32_t a, uint32_t b) {
                    return glm::dot(glm::dvec3(primitive.normals[a]), face) <
                           glm::dot(glm::dvec3(primitive.normals[b]), face);
                });
        }
    }
}

size_t drawn_triangles(const Scene& scene) {
    size_t triangles = 0;
    for (const int index : scene.topological_order) {
        const Node& node = scene.nodes[static_cast<size_t>(index)];
        if (node.mesh == k_none) {
            continue;
        }
        const size_t copies = std::max<size_t>(node.instances.size(), 1);
        for (const Primitive& primitive : scene.meshes[static_cast<size_t>(node.mesh)].primitives) {
            triangles += copies * (primitive.indices.size() / 3);
        }
    }
    return triangles;
}

}  // namespace

double simplified_ratio(size_t triangles) {
    return triangles > k_simplified_triangles
               ? static_cast<double>(k_simplified_triangles) / static_cast<double>(triangles)
               : 1.0;
}

SimplifiedPrimitive simplify(const Primitive& primitive, double ratio, double error, bool lock_border) {
    const SimplifiedPrimitive unchanged{primitive.indices, 0.0};
    if (!(ratio < 1.0) || primitive.indices.size() / 3 < k_least_triangles) {
        return unchanged;
    }
    const std::vector<uint32_t> welded = weld(primitive);
    const Compact source = compact(primitive, welded);
    const double most_area = area(primitive, welded) * (1.0 + k_most_growth);
    const float* positions = &source.positions[0].x;
    const size_t vertices = source.positions.size();
    const unsigned options = lock_border ? unsigned{meshopt_SimplifyLockBorder} : 0U;
    for (int i = 0; i < k_tries; ++i) {
        const double bold = std::exp2(-i);
        const double kept = 1.0 - (1.0 - ratio) * bold;
        const auto target =
            std::max<size_t>(static_cast<size_t>(kept * static_cast<double>(welded.size() / 3)), 1) * 3;
        SimplifiedPrimitive out;
        out.indices.resize(welded.size());
        float moved = 0.0F;
        out.indices.resize(meshopt_simplify(out.indices.data(), source.indices.data(), source.indices.size(),
                                            positions, vertices, sizeof(glm::vec3), target,
                                            static_cast<float>(error * bold), options, &moved));
        out.error_model = double{moved} * meshopt_simplifyScale(positions, vertices, sizeof(glm::vec3));
        if (out.indices.size() >= primitive.indices.size() || !std::isfinite(out.error_model)) {
            return unchanged;
        }
        for (uint32_t& index : out.indices) {
            index = source.vertices[index];
        }
        if (!out.indices.empty() && area(primitive, out.indices) <= most_area) {
            split_corners(primitive, welded, out.indices);
            return out;
        }
    }
    return unchanged;
}

SimplifiedMeshes simplify_scene(const Scene& scene, const Simplification& settings) {
    const double ratio = settings.ratio > 0.0 ? settings.ratio : simplified_ratio(drawn_triangles(scene));
    SimplifiedMeshes out;
    for (const Mesh& mesh : scene.meshes) {
        std::vector<SimplifiedPrimitive>& primitives = out.emplace_back();
        for (const Primitive& primitive : mesh.primitives) {
            const bool cut_out =
                primitive.material != k_none &&
                scene.materials[static_cast<size_t>(primitive.material)].alpha_mode != AlphaMode::opaque;
            primitives.push_back(
                simplify(primitive, cut_out ? 1.0 : ratio, settings.error, mesh.primitives.size() > 1));
        }
    }
    return out;
}

}  // namespace bounce::scene
