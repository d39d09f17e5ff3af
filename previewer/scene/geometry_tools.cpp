// SPDX-License-Identifier: Apache-2.0
#include "scene/geometry_tools.h"

#include <cmath>
#include <limits>
#include <numeric>

namespace bounce::scene {
namespace {

constexpr uint32_t k_unseen = std::numeric_limits<uint32_t>::max();

template <typename T>
std::vector<T> picked(const std::vector<T>& from, std::span<const uint32_t> old_vertex) {
    if (from.empty()) {
        return {};
    }
    std::vector<T> result;
    result.reserve(old_vertex.size());
    for (const uint32_t old : old_vertex) {
        result.push_back(from[old]);
    }
    return result;
}

glm::vec3 normalized_or(const glm::vec3& vector, const glm::vec3& otherwise) {
    // In double: the squared length of a 1e-20 m triangle's normal is no float.
    const glm::dvec3 exact(vector);
    const double length = glm::length(exact);
    return length > 0.0 && std::isfinite(length) ? glm::vec3(exact / length) : otherwise;
}

glm::vec3 any_perpendicular(const glm::vec3& normal) {
    const glm::vec3 axis = std::abs(normal.x) < 0.7F ? glm::vec3(1, 0, 0) : glm::vec3(0, 1, 0);
    return glm::normalize(glm::cross(axis, normal));
}

// Direction in which u grows on a triangle, and which way round its texture coordinates run. Zero where
// the coordinates are degenerate.
struct UvFrame {
    glm::dvec3 along_u{0.0};
    bool mirrored = false;
};

UvFrame uv_frame(const Primitive& primitive, const std::vector<glm::vec2>& uv, size_t corner) {
    const uint32_t a = primitive.indices[corner];
    const uint32_t b = primitive.indices[corner + 1];
    const uint32_t c = primitive.indices[corner + 2];
    const glm::dvec3 edge_1 = glm::dvec3(primitive.positions[b]) - glm::dvec3(primitive.positions[a]);
    const glm::dvec3 edge_2 = glm::dvec3(primitive.positions[c]) - glm::dvec3(primitive.positions[a]);
    const glm::dvec2 uv_1 = glm::dvec2(uv[b]) - glm::dvec2(uv[a]);
    const glm::dvec2 uv_2 = glm::dvec2(uv[c]) - glm::dvec2(uv[a]);
    const double determinant = uv_1.x * uv_2.y - uv_2.x * uv_1.y;
    if (determinant == 0.0 || !std::isfinite(determinant)) {
        return {};
    }
    // Not divided by the determinant: large faces weigh more, slivers in uv less.
    const double sign = determinant < 0.0 ? -1.0 : 1.0;
    // glTF's v runs down the image and its bitangent cross(n, t) * w up: a picture that is the right way
    // round on its face has a negative determinant, and w = 1.
    return {(edge_1 * uv_2.y - edge_2 * uv_1.y) * sign, determinant > 0.0};
}

}  // namespace

Primitive gather_vertices(const Primitive& primitive, std::span<const uint32_t> old_vertex) {
    Primitive result;
    result.positions = picked(primitive.positions, old_vertex);
    result.normals = picked(primitive.normals, old_vertex);
    result.tangents = picked(primitive.tangents, old_vertex);
    result.uv0 = picked(primitive.uv0, old_vertex);
    result.uv1 = picked(primitive.uv1, old_vertex);
    result.colors = picked(primitive.colors, old_vertex);
    result.joints = picked(primitive.joints, old_vertex);
    result.weights = picked(primitive.weights, old_vertex);
    for (const MorphTarget& target : primitive.targets) {
        result.targets.push_back({picked(target.positions, old_vertex), picked(target.normals, old_vertex),
                                  picked(target.tangents, old_vertex)});
    }
    result.indices = primitive.indices;
    result.material = primitive.material;
    return result;
}

void drop_unused_vertices(Primitive& primitive) {
    std::vector<uint32_t> new_vertex(primitive.positions.size(), k_unseen);
    std::vector<uint32_t> old_vertex;
    for (const uint32_t index : primitive.indices) {
        if (new_vertex[index] == k_unseen) {
            new_vertex[index] = 0;
            old_vertex.push_back(0);  // counted; filled below in the file's order
        }
    }
    if (old_vertex.size() == primitive.positions.size()) {
        return;
    }
    uint32_t next = 0;
    for (uint32_t i = 0; i < new_vertex.size(); ++i) {
        if (new_vertex[i] != k_unseen) {
            old_vertex[next] = i;
            new_vertex[i] = next++;
        }
    }
    primitive = gather_vertices(primitive, old_vertex);
    for (uint32_t& index : primitive.indices) {
        index = new_vertex[index];
    }
}

void make_flat_normals(Primitive& primitive) {
    primitive = gather_vertices(primitive, primitive.indices);
    std::iota(primitive.indices.begin(), primitive.indices.end(), 0U);
    primitive.tangents.clear();  // they belonged to other normals
    primitive.normals.resize(primitive.positions.size());
    for (size_t i = 0; i + 2 < primitive.positions.size(); i += 3) {
        const glm::dvec3 a(primitive.positions[i]);
        const glm::dvec3 cross = glm::cross(glm::dvec3(primitive.positions[i + 1]) - a,
                                            glm::dvec3(primitive.positions[i + 2]) - a);
        const double length = glm::length(cross);
        const glm::vec3 normal = length > 0.0 ? glm::vec3(cross / length) : glm::vec3(0, 1, 0);
        primitive.normals[i] = primitive.normals[i + 1] = primitive.normals[i + 2] = normal;
    }
}

void make_tangents(Primitive& primitive, int uv_set) {
    // Split: the copy for mirrored faces of vertices that both kinds of face use.
    const auto& shared_uv = uv_set == 1 ? primitive.uv1 : primitive.uv0;
    enum : uint8_t { plain = 1, mirrored = 2 };
    std::vector<uint8_t> used(primitive.positions.size());
    for (size_t corner = 0; corner < primitive.indices.size(); corner += 3) {
        const uint8_t kind = uv_frame(primitive, shared_uv, corner).mirrored ? mirrored : plain;
        for (size_t k = corner; k < corner + 3; ++k) {
            used[primitive.indices[k]] = static_cast<uint8_t>(used[primitive.indices[k]] | kind);
        }
    }
    std::vector<uint32_t> old_vertex(primitive.positions.size());
    std::iota(old_vertex.begin(), old_vertex.end(), 0U);
    std::vector<uint32_t> mirrored_copy = old_vertex;
    for (uint32_t i = 0; i < used.size(); ++i) {
        if (used[i] == (plain | mirrored)) {
            mirrored_copy[i] = static_cast<uint32_t>(old_vertex.size());
            old_vertex.push_back(i);
        }
    }
    if (old_vertex.size() > primitive.positions.size()) {
        for (size_t corner = 0; corner < primitive.indices.size(); corner += 3) {
            if (uv_frame(primitive, shared_uv, corner).mirrored) {
                for (size_t k = corner; k < corner + 3; ++k) {
                    primitive.indices[k] = mirrored_copy[primitive.indices[k]];
                }
            }
        }
        primitive = gather_vertices(primitive, old_vertex);
    }

    const auto& uv = uv_set == 1 ? primitive.uv1 : primitive.uv0;
    std::vector<glm::dvec3> along_u(primitive.positions.size(), glm::dvec3(0.0));
    std::vector<float> sign(primitive.positions.size(), 1.0F);
    for (size_t corner = 0; corner < primitive.indices.size(); corner += 3) {
        const UvFrame frame = uv_frame(primitive, uv, corner);
        for (size_t k = corner; k < corner + 3; ++k) {
            along_u[primitive.indices[k]] += frame.along_u;
            if (frame.mirrored) {
                sign[primitive.indices[k]] = -1.0F;
            }
        }
    }
    primitive.tangents.resize(primitive.positions.size());
    for (size_t i = 0; i < primitive.positions.size(); ++i) {
        const glm::dvec3 normal(primitive.normals[i]);
        const glm::vec3 tangent(along_u[i] - normal * glm::dot(normal, along_u[i]));
        primitive.tangents[i] =
            glm::vec4(normalized_or(tangent, any_perpendicular(primitive.normals[i])), sign[i]);
    }
}

}  // namespace bounce::scene
