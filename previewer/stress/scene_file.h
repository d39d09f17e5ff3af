// SPDX-License-Identifier: Apache-2.0
//
// A glTF file made of numbers, with BOUNCE_scene: generated scenes take the way through the loader that files
// of users take.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include <glm/glm.hpp>
#include <nlohmann/json.hpp>

#include "stress/geometry.h"

namespace bounce::stress {

class SceneFile {
  public:
    nlohmann::json root;

    // Black world, Blender's frames 1 to 10 at 10 a second; nothing in it.
    SceneFile();

    // A Lambertian that is seen from both sides; `more` is merged into its description.
    int material(const glm::vec3& color, const nlohmann::json& more = nlohmann::json::object());
    // `more` is merged into the primitive's description.
    int mesh(const Geometry& geometry, int material, const nlohmann::json& more = nlohmann::json::object());
    // Returns the node, a root.
    int node(nlohmann::json description);
    int place(int mesh, const glm::dmat4& world_from_model = glm::dmat4(1.0));
    int place(const Geometry& geometry, int of_material) { return place(mesh(geometry, of_material)); }
    // A light of BOUNCE_scene; `description` has its type and what its type needs. It looks along its -Z.
    int light(nlohmann::json description, const glm::dmat4& world_from_light);
    void world(const glm::vec3& radiance);
    // Looks straight down from `height` above `over` at a frame `width` metres wide, orthographic: the
    // picture's right is +X, its top -Z.
    void camera_above(double width, double height, double aspect, const glm::dvec3& over = glm::dvec3(0.0));
    // Perspective, 60 degrees high.
    void camera(const glm::dvec3& from, const glm::dvec3& at, double near_m = 0.01);

    int accessor(const std::vector<float>& values, const std::string& type);
    int accessor(const std::vector<uint32_t>& values);
    int accessor(const std::vector<uint16_t>& values, const std::string& type);
    int add(const std::string& list, nlohmann::json item);

    // Writes a .glb. Throws output_error.
    void write(const std::filesystem::path& path) const;

  private:
    int view(const void* bytes, size_t size);
    int describe(int component_type, size_t count, const std::string& type, const void* bytes, size_t size);
    std::vector<uint8_t> binary_;
};

[[nodiscard]] nlohmann::json json_of(const glm::dmat4& matrix);
// world_from_node of what looks along its -Z from a place to another.
[[nodiscard]] glm::dmat4 looking(const glm::dvec3& from, const glm::dvec3& at);

}  // namespace bounce::stress
