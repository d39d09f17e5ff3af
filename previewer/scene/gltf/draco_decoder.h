// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <vector>

namespace draco {
class Mesh;
class PointAttribute;
}  // namespace draco

namespace bounce::scene::gltf {

// KHR_draco_mesh_compression: a triangle list and its vertex attributes, which glTF names by Draco's
// unique ids. Throws Refusal for anything that Draco cannot decode.
class DracoMesh {
  public:
    DracoMesh(std::span<const uint8_t> bytes, const std::string& whose);
    ~DracoMesh();
    DracoMesh(DracoMesh&&) noexcept;
    DracoMesh& operator=(DracoMesh&&) noexcept;

    [[nodiscard]] size_t vertex_count() const;
    [[nodiscard]] std::vector<uint32_t> indices() const;
    // Numbers in order of vertices. Integers are multiplied by scale (1 / 255 where the accessor says
    // that bytes are normalised).
    [[nodiscard]] std::vector<float> floats(uint32_t id, int components, float scale) const;
    [[nodiscard]] std::vector<uint32_t> integers(uint32_t id, int components) const;

  private:
    [[nodiscard]] const draco::PointAttribute& attribute(uint32_t id, int components) const;

    std::unique_ptr<draco::Mesh> mesh_;
    std::string whose_;
};

}  // namespace bounce::scene::gltf
