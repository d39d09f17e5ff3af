// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "scene/gltf/accessors.h"
#include "scene/gltf/draco_decoder.h"

namespace bounce::scene::gltf {

// The vertex attributes and indices of one primitive, be they in accessors or in Draco data.
class VertexAttributes {
  public:
    VertexAttributes(const Source& source, Buffers& buffers, const Accessors& accessors, size_t mesh,
                     size_t primitive);

    [[nodiscard]] const std::string& whose() const { return whose_; }
    [[nodiscard]] bool compressed() const { return draco_.has_value(); }
    [[nodiscard]] bool has(const std::string& name) const { return typed_.attributes.contains(name); }
    [[nodiscard]] size_t vertex_count() const { return vertex_count_; }
    [[nodiscard]] int components(const std::string& name) const;

    // One element a vertex; throws Refusal where the count differs from POSITION's. Empty where absent.
    [[nodiscard]] std::vector<float> floats(const std::string& name, int components) const;
    [[nodiscard]] std::vector<uint32_t> integers(const std::string& name, int components) const;
    // As stored: of a strip or fan where not compressed. 0, 1, 2, ... where the file has none.
    [[nodiscard]] std::vector<uint32_t> indices() const;

  private:
    [[nodiscard]] std::optional<uint32_t> draco_id(const std::string& name) const;
    [[nodiscard]] int accessor(const std::string& name) const { return typed_.attributes.at(name); }
    void require_count(const std::string& name) const;

    const Source& source_;
    const Accessors& accessors_;
    const tinygltf::Primitive& typed_;
    const nlohmann::json& json_;
    std::string whose_;
    std::optional<DracoMesh> draco_;
    size_t vertex_count_ = 0;
};

}  // namespace bounce::scene::gltf
