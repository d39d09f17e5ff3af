// SPDX-License-Identifier: Apache-2.0
//
// The smallest glTF file that shows something: a triangle, its corners in triangle.bin beside it.
#pragma once

#include <array>
#include <filesystem>
#include <fstream>

#include <glm/glm.hpp>
#include <nlohmann/json.hpp>

namespace bounce::test {

// Turned, off the origin and unlike its mirror pictures; metres, glTF's axes.
inline const std::array<glm::dvec3, 3> k_triangle{glm::dvec3(3, 1, -2), glm::dvec3(4, 1.2, -1.5),
                                                  glm::dvec3(3.2, 2.5, -2.3)};

inline std::filesystem::path write_triangle(const std::filesystem::path& path,
                                            const nlohmann::json& more = nlohmann::json::object()) {
    nlohmann::json gltf =
        nlohmann::json::parse(R"({"asset": {"version": "2.0"}, "scene": 0, "scenes": [{"nodes": [0]}],
        "nodes": [{"mesh": 0}],
        "meshes": [{"primitives": [{"attributes": {"POSITION": 0}, "material": 0}]}],
        "materials": [{"name": "grey", "doubleSided": true,
            "pbrMetallicRoughness": {"baseColorFactor": [0.1, 0.1, 0.1, 1], "metallicFactor": 0}}],
        "accessors": [{"bufferView": 0, "componentType": 5126, "count": 3, "type": "VEC3",
            "min": [3, 1, -2.3], "max": [4, 2.5, -1.5]}],
        "bufferViews": [{"buffer": 0, "byteLength": 36}],
        "buffers": [{"uri": "triangle.bin", "byteLength": 36}]})");
    gltf.update(more, true);
    std::ofstream(path) << gltf.dump();
    std::ofstream data(path.parent_path() / "triangle.bin", std::ios::binary);
    for (const glm::dvec3& corner : k_triangle) {
        const glm::vec3 single(corner);
        data.write(reinterpret_cast<const char*>(&single), sizeof single);
    }
    return path;
}

}  // namespace bounce::test
