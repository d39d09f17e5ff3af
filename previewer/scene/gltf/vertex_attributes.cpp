// SPDX-License-Identifier: Apache-2.0
#include "scene/gltf/vertex_attributes.h"

#include <numeric>

namespace bounce::scene::gltf {
namespace {

// What a normalised integer is multiplied by.
float scale_of(const tinygltf::Accessor& accessor) {
    if (!accessor.normalized) {
        return 1.0F;
    }
    switch (accessor.componentType) {
        case TINYGLTF_COMPONENT_TYPE_BYTE:
            return 1.0F / 127.0F;
        case TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE:
            return 1.0F / 255.0F;
        case TINYGLTF_COMPONENT_TYPE_SHORT:
            return 1.0F / 32767.0F;
        case TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT:
            return 1.0F / 65535.0F;
        default:
            return 1.0F;
    }
}

}  // namespace

VertexAttributes::VertexAttributes(const Source& source, Buffers& buffers, const Accessors& accessors,
                                   size_t mesh, size_t primitive)
    : source_(source),
      accessors_(accessors),
      typed_(source.model.meshes[mesh].primitives[primitive]),
      json_(source.json()["meshes"][mesh]["primitives"][primitive]),
      whose_(fmt::format("primitive {} of mesh {}", primitive, mesh)) {
    if (!has("POSITION")) {
        return;
    }
    if (const nlohmann::json* packed = extension(json_, "KHR_draco_mesh_compression")) {
        draco_.emplace(buffers.view((*packed)["bufferView"].get<int>()), whose_);
    }
    vertex_count_ = draco_id("POSITION") ? draco_->vertex_count() : accessors_.count(accessor("POSITION"));
}

int VertexAttributes::components(const std::string& name) const {
    return accessors_.components(accessor(name));
}

std::optional<uint32_t> VertexAttributes::draco_id(const std::string& name) const {
    if (!draco_) {
        return std::nullopt;
    }
    const nlohmann::json* id = member((*extension(json_, "KHR_draco_mesh_compression"))["attributes"], name);
    return id == nullptr ? std::nullopt : std::optional<uint32_t>(id->get<uint32_t>());
}

void VertexAttributes::require_count(const std::string& name) const {
    const size_t count = draco_id(name) ? draco_->vertex_count() : accessors_.count(accessor(name));
    if (count != vertex_count_) {
        throw refusal("{} has {} vertices, but {} of {}", whose_, vertex_count_, count, name);
    }
}

std::vector<float> VertexAttributes::floats(const std::string& name, int components) const {
    if (!has(name)) {
        return {};
    }
    require_count(name);
    if (const auto id = draco_id(name)) {
        return draco_->floats(*id, components,
                              scale_of(source_.model.accessors[static_cast<size_t>(accessor(name))]));
    }
    return accessors_.floats(accessor(name), components);
}

std::vector<uint32_t> VertexAttributes::integers(const std::string& name, int components) const {
    if (!has(name)) {
        return {};
    }
    require_count(name);
    if (const auto id = draco_id(name)) {
        return draco_->integers(*id, components);
    }
    return accessors_.integers(accessor(name), components);
}

std::vector<uint32_t> VertexAttributes::indices() const {
    if (draco_) {
        return draco_->indices();
    }
    if (const nlohmann::json* index = member(json_, "indices")) {
        return accessors_.integers(index->get<int>(), 1);
    }
    std::vector<uint32_t> all(vertex_count_);
    std::iota(all.begin(), all.end(), 0U);
    return all;
}

}  // namespace bounce::scene::gltf
