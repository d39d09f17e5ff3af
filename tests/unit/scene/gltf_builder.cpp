// SPDX-License-Identifier: Apache-2.0
#include "gltf_builder.h"

#include <atomic>
#include <fstream>

#include <fmt/format.h>
#include <unistd.h>

#include "core/error.h"

namespace bounce::scene::test {
namespace fs = std::filesystem;
namespace {

void append_u32(std::vector<uint8_t>& bytes, size_t value) {
    for (unsigned shift = 0; shift < 32; shift += 8) {
        bytes.push_back(static_cast<uint8_t>(value >> shift));
    }
}

size_t components_of(const std::string& type) {
    if (type == "SCALAR") {
        return 1;
    }
    if (type == "MAT4") {
        return 16;
    }
    return static_cast<size_t>(type.back() - '0');
}

}  // namespace

TemporaryFolder::TemporaryFolder() {
    static std::atomic<int> counter{0};
    path_ = fs::temp_directory_path() / fmt::format("bounce-test-{}-{}", getpid(), counter++);
    fs::create_directories(path_);
}

TemporaryFolder::~TemporaryFolder() {
    std::error_code ignored;
    fs::remove_all(path_, ignored);
}

fs::path TemporaryFolder::write(const std::string& name, const std::vector<uint8_t>& bytes) const {
    const fs::path file = path_ / name;
    std::ofstream out(file, std::ios::binary);
    out.write(reinterpret_cast<const char*>(bytes.data()), static_cast<std::streamsize>(bytes.size()));
    return file;
}

fs::path TemporaryFolder::write(const std::string& name, const std::string& text) const {
    return write(name, std::vector<uint8_t>(text.begin(), text.end()));
}

GltfBuilder::GltfBuilder()
    : root{{"asset", {{"version", "2.0"}}},
           {"scene", 0},
           {"scenes", {{{"nodes", nlohmann::json::array()}}}}} {}

int GltfBuilder::add(const std::string& list, nlohmann::json item) {
    root[list].push_back(std::move(item));
    return static_cast<int>(root[list].size()) - 1;
}

int GltfBuilder::view(const void* bytes, size_t size) {
    binary_.resize((binary_.size() + 3) / 4 * 4);
    const size_t offset = binary_.size();
    const auto* from = static_cast<const uint8_t*>(bytes);
    binary_.insert(binary_.end(), from, from + size);
    return add("bufferViews", {{"buffer", 0}, {"byteOffset", offset}, {"byteLength", size}});
}

int GltfBuilder::describe_accessor(int view, int type_of_component, size_t values, const std::string& type,
                                   bool normalized) {
    nlohmann::json description{{"bufferView", view},
                               {"componentType", type_of_component},
                               {"count", values / components_of(type)},
                               {"type", type}};
    if (normalized) {
        description["normalized"] = true;
    }
    return add("accessors", std::move(description));
}

int GltfBuilder::triangle_mesh() {
    const int positions = accessor<float>({0, 0, 0, 1, 0, 0, 0, 1, 0}, "VEC3");
    return add("meshes", {{"primitives", {{{"attributes", {{"POSITION", positions}}}}}}});
}

int GltfBuilder::node(nlohmann::json description, bool is_root) {
    const int index = add("nodes", std::move(description));
    if (is_root) {
        root["scenes"][0]["nodes"].push_back(index);
    }
    return index;
}

std::vector<uint8_t> GltfBuilder::glb() const {
    nlohmann::json document = root;
    if (!binary_.empty() && !document.contains("buffers")) {
        document["buffers"] = {{{"byteLength", binary_.size()}}};
    }
    std::string text = document.dump();
    text.resize((text.size() + 3) / 4 * 4, ' ');
    std::vector<uint8_t> padded = binary_;
    padded.resize((padded.size() + 3) / 4 * 4);
    std::vector<uint8_t> bytes{'g', 'l', 'T', 'F', 2, 0, 0, 0};
    append_u32(bytes, 12 + 8 + text.size() + (padded.empty() ? 0 : 8 + padded.size()));
    append_u32(bytes, text.size());
    bytes.insert(bytes.end(), {'J', 'S', 'O', 'N'});
    bytes.insert(bytes.end(), text.begin(), text.end());
    if (!padded.empty()) {
        append_u32(bytes, padded.size());
        bytes.insert(bytes.end(), {'B', 'I', 'N', 0});
        bytes.insert(bytes.end(), padded.begin(), padded.end());
    }
    return bytes;
}

std::string GltfBuilder::gltf() const {
    nlohmann::json document = root;
    document["buffers"] = {
        {{"byteLength", binary_.size()}, {"uri", "data:application/octet-stream;base64," + base64(binary_)}}};
    return document.dump();
}

LoadResult GltfBuilder::load() const {
    const TemporaryFolder folder;
    return load_gltf(folder.write("scene.glb", glb()));
}

std::string GltfBuilder::refusal() const {
    const TemporaryFolder folder;
    return refusal_of(folder.write("scene.glb", glb()));
}

std::string base64(const std::vector<uint8_t>& bytes) {
    const char* alphabet = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    std::string text;
    for (size_t i = 0; i < bytes.size(); i += 3) {
        uint32_t group = 0;
        for (size_t k = 0; k < 3; ++k) {
            group = (group << 8U) | (i + k < bytes.size() ? bytes[i + k] : 0U);
        }
        for (size_t k = 0; k < 4; ++k) {
            text += i + k <= bytes.size() ? alphabet[(group >> (18 - 6 * k)) & 63U] : '=';
        }
    }
    return text;
}

std::string refusal_of(const fs::path& path) {
    try {
        (void)load_gltf(path);
    } catch (const Error& error) {
        return error.code() == ExitCode::input_refused ? error.what()
                                                       : "wrong exit code: " + std::string(error.what());
    }
    return "";
}

bool says(const std::string& text, const std::string& part) {
    return text.find(part) != std::string::npos;
}

}  // namespace bounce::scene::test
