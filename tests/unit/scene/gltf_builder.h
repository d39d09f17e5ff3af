// SPDX-License-Identifier: Apache-2.0
//
// Puts small glTF files together in tests: JSON by hand, binary data appended here.
#pragma once

#include <cstdint>
#include <cstring>
#include <filesystem>
#include <string>
#include <vector>

#include <nlohmann/json.hpp>

#include "scene/gltf_loader.h"

namespace bounce::scene::test {

constexpr int k_byte = 5120;
constexpr int k_unsigned_byte = 5121;
constexpr int k_short = 5122;
constexpr int k_unsigned_short = 5123;
constexpr int k_unsigned_int = 5125;
constexpr int k_float = 5126;

template <typename T>
constexpr int component_type() {
    if constexpr (std::is_same_v<T, int8_t>) {
        return k_byte;
    } else if constexpr (std::is_same_v<T, uint8_t>) {
        return k_unsigned_byte;
    } else if constexpr (std::is_same_v<T, int16_t>) {
        return k_short;
    } else if constexpr (std::is_same_v<T, uint16_t>) {
        return k_unsigned_short;
    } else if constexpr (std::is_same_v<T, uint32_t>) {
        return k_unsigned_int;
    } else {
        return k_float;
    }
}

// A folder of its own that is removed with everything in it.
class TemporaryFolder {
  public:
    TemporaryFolder();
    ~TemporaryFolder();
    TemporaryFolder(const TemporaryFolder&) = delete;
    TemporaryFolder& operator=(const TemporaryFolder&) = delete;

    [[nodiscard]] const std::filesystem::path& path() const { return path_; }
    // Writes a file into the folder and returns its path.
    std::filesystem::path write(const std::string& name, const std::vector<uint8_t>& bytes) const;
    std::filesystem::path write(const std::string& name, const std::string& text) const;

  private:
    std::filesystem::path path_;
};

class GltfBuilder {
  public:
    nlohmann::json root;

    GltfBuilder();

    // Appends bytes, aligned to four, and returns the new buffer view.
    int view(const void* bytes, size_t size);

    // type is "VEC3" and so on; the count follows from the values.
    template <typename T>
    int accessor(const std::vector<T>& values, const std::string& type, bool normalized = false) {
        const int at = view(values.data(), values.size() * sizeof(T));
        return describe_accessor(at, component_type<T>(), values.size(), type, normalized);
    }

    // A mesh of one triangle (0,0,0) (1,0,0) (0,1,0), without normals or indices. Returns the mesh.
    int triangle_mesh();
    // A node; returns its index. Nodes added so are roots of scene 0 unless told otherwise.
    int node(nlohmann::json description, bool is_root = true);
    // A node with a triangle mesh.
    int triangle_node() { return node({{"mesh", triangle_mesh()}}); }
    // Appends to a list of the root object and returns the index.
    int add(const std::string& list, nlohmann::json item);
    void use_extension(const std::string& name) { root["extensionsUsed"].push_back(name); }

    [[nodiscard]] std::vector<uint8_t> glb() const;
    // With the buffer as a data URI.
    [[nodiscard]] std::string gltf() const;
    [[nodiscard]] const std::vector<uint8_t>& binary() const { return binary_; }

    // Writes a .glb and loads it.
    [[nodiscard]] LoadResult load() const;
    // The message with which loading is refused; empty where it is not.
    [[nodiscard]] std::string refusal() const;

  private:
    int describe_accessor(int view, int type_of_component, size_t values, const std::string& type,
                          bool normalized);

    std::vector<uint8_t> binary_;
};

[[nodiscard]] std::string base64(const std::vector<uint8_t>& bytes);
// What load_gltf says of a file it refuses; empty where it loads.
[[nodiscard]] std::string refusal_of(const std::filesystem::path& path);
// True if text holds part.
[[nodiscard]] bool says(const std::string& text, const std::string& part);

}  // namespace bounce::scene::test
