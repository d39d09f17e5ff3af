// SPDX-License-Identifier: Apache-2.0
#include "scene/gltf/meshes.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

#include "scene/geometry_tools.h"
#include "scene/gltf/triangles.h"
#include "scene/gltf/vertex_attributes.h"
#include "scene/gltf/vertex_influences.h"

namespace bounce::scene::gltf {
namespace {

template <typename Vector>
std::vector<Vector> as_vectors(const std::vector<float>& numbers) {
    constexpr size_t components = sizeof(Vector) / sizeof(float);
    std::vector<Vector> result(numbers.size() / components);
    std::copy(numbers.begin(), numbers.end(), reinterpret_cast<float*>(result.data()));
    return result;
}

bool all_finite(const std::vector<float>& numbers) {
    return std::all_of(numbers.begin(), numbers.end(), [](float x) { return std::isfinite(x); });
}

// NaN in normals or texture coordinates comes from degenerate faces; only positions are worth refusing.
std::vector<float> repaired(Source& source, std::vector<float> numbers, const std::string& whose) {
    if (!all_finite(numbers)) {
        std::replace_if(
            numbers.begin(), numbers.end(), [](float x) { return !std::isfinite(x); }, 0.0F);
        source.warn(fmt::format("{} has vertex data that is not finite; zero is used instead", whose));
    }
    return numbers;
}

std::vector<float> finite_positions(const VertexAttributes& attributes) {
    std::vector<float> positions = attributes.floats("POSITION", 3);
    if (!all_finite(positions)) {
        throw refusal("{} has positions that are not finite", attributes.whose());
    }
    return positions;
}

std::vector<glm::vec4> read_colors(Source& source, const VertexAttributes& attributes) {
    if (!attributes.has("COLOR_0")) {
        return {};
    }
    if (attributes.components("COLOR_0") == 4) {
        return as_vectors<glm::vec4>(repaired(source, attributes.floats("COLOR_0", 4), attributes.whose()));
    }
    std::vector<glm::vec4> colors;
    for (const glm::vec3& rgb :
         as_vectors<glm::vec3>(repaired(source, attributes.floats("COLOR_0", 3), attributes.whose()))) {
        colors.emplace_back(rgb, 1.0F);
    }
    return colors;
}

std::vector<glm::vec3> read_normals(Source& source, const VertexAttributes& attributes) {
    auto normals =
        as_vectors<glm::vec3>(repaired(source, attributes.floats("NORMAL", 3), attributes.whose()));
    for (glm::vec3& normal : normals) {
        const float length = glm::length(normal);
        // Quantised normals are a little off unit length.
        normal = length > 1e-6F ? normal / length : glm::vec3(0, 1, 0);
    }
    return normals;
}

std::vector<glm::vec3> read_deltas(const Accessors& accessors, const VertexAttributes& attributes,
                                   const std::map<std::string, int>& target, const char* name) {
    const auto found = target.find(name);
    if (found == target.end()) {
        return {};
    }
    if (accessors.count(found->second) != attributes.vertex_count()) {
        throw refusal("a morph target of {} has {} vertices where {} belong", attributes.whose(),
                      accessors.count(found->second), attributes.vertex_count());
    }
    const std::vector<float> numbers = accessors.floats(found->second, 3);
    if (!all_finite(numbers)) {
        throw refusal("a morph target of {} is not finite", attributes.whose());
    }
    return as_vectors<glm::vec3>(numbers);
}

// nullopt where there is nothing to show.
std::optional<Primitive> read_primitive(Source& source, Buffers& buffers, const Accessors& accessors,
                                        const std::vector<Material>& materials, size_t mesh_index,
                                        size_t primitive_index) {
    const tinygltf::Primitive& typed = source.model.meshes[mesh_index].primitives[primitive_index];
    if (typed.mode < TINYGLTF_MODE_TRIANGLES) {
        source.warn("points and lines are not shown");
        return std::nullopt;
    }
    const VertexAttributes attributes(source, buffers, accessors, mesh_index, primitive_index);
    if (!attributes.has("POSITION")) {
        source.warn(fmt::format("{} has no positions and is not shown", attributes.whose()));
        return std::nullopt;
    }
    const size_t count = attributes.vertex_count();
    Source::spend(source.spent.vertices, count, k_max_total_vertices, "vertices");
    Source::spend(source.spent.morph_vertices, count * typed.targets.size(), k_max_total_morph_vertices,
                  "morphed vertices");

    Primitive primitive;
    primitive.material = typed.material;
    primitive.positions = as_vectors<glm::vec3>(finite_positions(attributes));
    primitive.normals = read_normals(source, attributes);
    primitive.tangents =
        as_vectors<glm::vec4>(repaired(source, attributes.floats("TANGENT", 4), attributes.whose()));
    primitive.uv0 =
        as_vectors<glm::vec2>(repaired(source, attributes.floats("TEXCOORD_0", 2), attributes.whose()));
    primitive.uv1 =
        as_vectors<glm::vec2>(repaired(source, attributes.floats("TEXCOORD_1", 2), attributes.whose()));
    primitive.colors = read_colors(source, attributes);
    read_influences(source, attributes, primitive);
    for (const auto& target : typed.targets) {
        primitive.targets.push_back({read_deltas(accessors, attributes, target, "POSITION"),
                                     read_deltas(accessors, attributes, target, "NORMAL"),
                                     read_deltas(accessors, attributes, target, "TANGENT")});
    }

    primitive.indices =
        triangle_list(attributes.indices(), attributes.compressed() ? TINYGLTF_MODE_TRIANGLES : typed.mode);
    Source::spend(source.spent.indices, primitive.indices.size(), k_max_total_indices, "indices");
    for (const uint32_t index : primitive.indices) {
        if (index >= count) {
            throw refusal("{} refers to vertex {} and has {}", attributes.whose(), index, count);
        }
    }
    if (primitive.indices.empty()) {
        return std::nullopt;
    }

    drop_unused_vertices(primitive);
    if (primitive.normals.empty()) {
        Source::spend(source.spent.vertices, primitive.indices.size(), k_max_total_vertices, "vertices");
        make_flat_normals(primitive);
    }
    if (primitive.tangents.empty() && primitive.material != k_none) {
        const TextureRef& map = materials[static_cast<size_t>(primitive.material)].normal_texture;
        const auto& uv = map.uv_set == 1 ? primitive.uv1 : primitive.uv0;
        if (map.present() && !uv.empty()) {
            make_tangents(primitive, map.uv_set);
        }
    }
    return primitive;
}

}  // namespace

std::vector<Mesh> read_meshes(Source& source, Buffers& buffers, const Accessors& accessors,
                              const std::vector<Material>& materials) {
    std::vector<Mesh> meshes(source.model.meshes.size());
    for (size_t m = 0; m < meshes.size(); ++m) {
        const tinygltf::Mesh& typed = source.model.meshes[m];
        meshes[m].name = typed.name;
        for (const tinygltf::Primitive& primitive : typed.primitives) {
            if (primitive.targets.size() != typed.primitives[0].targets.size()) {
                throw refusal("the primitives of mesh {} have different numbers of morph targets", m);
            }
        }
        const size_t targets = typed.primitives.empty() ? 0 : typed.primitives[0].targets.size();
        if (targets > k_max_morph_targets) {
            throw refusal("mesh {} has {} morph targets, more than the {} allowed", m, targets,
                          k_max_morph_targets);
        }
        if (!typed.weights.empty() && typed.weights.size() != targets) {
            throw refusal("mesh {} has {} weights for {} morph targets", m, typed.weights.size(), targets);
        }
        meshes[m].weights.assign(targets, 0.0F);
        std::transform(typed.weights.begin(), typed.weights.end(), meshes[m].weights.begin(),
                       [](double weight) { return static_cast<float>(weight); });
        for (size_t p = 0; p < typed.primitives.size(); ++p) {
            if (auto primitive = read_primitive(source, buffers, accessors, materials, m, p)) {
                meshes[m].primitives.push_back(std::move(*primitive));
            }
        }
    }
    return meshes;
}

}  // namespace bounce::scene::gltf
