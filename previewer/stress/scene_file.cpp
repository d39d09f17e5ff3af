// SPDX-License-Identifier: Apache-2.0
#include "stress/scene_file.h"

#include <algorithm>
#include <cmath>
#include <fstream>
#include <numbers>

#include <fmt/format.h>
#include <glm/gtc/matrix_transform.hpp>

#include "core/error.h"

namespace bounce::stress {
namespace {

using nlohmann::json;

constexpr int k_unsigned_short = 5123;
constexpr int k_unsigned_int = 5125;
constexpr int k_float = 5126;

std::vector<float> flat(const std::vector<glm::vec3>& vectors) {
    std::vector<float> out;
    out.reserve(3 * vectors.size());
    for (const glm::vec3& v : vectors) {
        out.insert(out.end(), {v.x, v.y, v.z});
    }
    return out;
}

size_t components(const std::string& type) {
    return type == "SCALAR" ? 1 : type == "MAT4" ? 16 : static_cast<size_t>(type.back() - '0');
}

void put(std::ofstream& out, size_t value) {
    for (unsigned shift = 0; shift < 32; shift += 8) {
        out.put(static_cast<char>(value >> shift & 0xffU));
    }
}

}  // namespace

json json_of(const glm::dmat4& matrix) {
    json out = json::array();
    for (int column = 0; column < 4; ++column) {
        for (int row = 0; row < 4; ++row) {
            out.push_back(matrix[column][row]);
        }
    }
    return out;
}

glm::dmat4 looking(const glm::dvec3& from, const glm::dvec3& at) {
    const glm::dvec3 way = glm::normalize(at - from);
    const glm::dvec3 up = std::abs(way.y) > 0.9 ? glm::dvec3(0.0, 0.0, -1.0) : glm::dvec3(0.0, 1.0, 0.0);
    return glm::inverse(glm::lookAt(from, at, up));
}

SceneFile::SceneFile()
    : root{{"asset", {{"version", "2.0"}}},
           {"scene", 0},
           {"scenes", {{{"nodes", json::array()}}}},
           {"extensionsUsed", {"BOUNCE_scene"}}} {
    root["extensions"]["BOUNCE_scene"] = {
        {"version", 1},
        {"generator", {{"blender", {3, 4, 1}}, {"addon", "0.1.0"}}},
        {"frames", {{"start", 1}, {"end", 10}, {"fps", 10}}},
        {"render",
         {{"width", 48}, {"height", 32}, {"pixel_aspect_x", 1}, {"pixel_aspect_y", 1}, {"film_exposure", 1}}},
        {"view",
         {{"display_device", "sRGB"},
          {"view_transform", "Standard"},
          {"look", "None"},
          {"exposure", 0},
          {"gamma", 1}}},
        {"lights", json::array()},
        {"unsupported", json::array()}};
}

int SceneFile::add(const std::string& list, json item) {
    root[list].push_back(std::move(item));
    return static_cast<int>(root[list].size()) - 1;
}

int SceneFile::material(const glm::vec3& color, const json& more) {
    json description = {{"pbrMetallicRoughness",
                         {{"baseColorFactor", {color.r, color.g, color.b, 1.0}},
                          {"metallicFactor", 0},
                          {"roughnessFactor", 1}}},
                        {"doubleSided", true},
                        {"extensions", {{"BOUNCE_scene", {{"diffuse", "lambert"}, {"specular", 0}}}}}};
    description.merge_patch(more);
    return add("materials", description);
}

int SceneFile::mesh(const Geometry& geometry, int of_material, const json& more) {
    json primitive = {{"attributes", {{"POSITION", accessor(flat(geometry.positions), "VEC3")}}},
                      {"indices", accessor(geometry.indices)},
                      {"material", of_material}};
    if (!geometry.normals.empty()) {
        primitive["attributes"]["NORMAL"] = accessor(flat(geometry.normals), "VEC3");
    }
    primitive.merge_patch(more);
    return add("meshes", {{"primitives", {primitive}}});
}

int SceneFile::node(json description) {
    const int index = add("nodes", std::move(description));
    root["scenes"][0]["nodes"].push_back(index);
    return index;
}

int SceneFile::place(int of_mesh, const glm::dmat4& world_from_model) {
    return node({{"mesh", of_mesh}, {"matrix", json_of(world_from_model)}});
}

int SceneFile::light(json description, const glm::dmat4& world_from_light) {
    json& lights = root["extensions"]["BOUNCE_scene"]["lights"];
    json whole = {
        {"name", fmt::format("Light {}", lights.size())}, {"color", {1, 1, 1}}, {"cast_shadow", true}};
    whole.update(description);
    lights.push_back(whole);
    return node({{"matrix", json_of(world_from_light)},
                 {"extensions", {{"BOUNCE_scene", {{"light", lights.size() - 1}}}}}});
}

void SceneFile::world(const glm::vec3& radiance) {
    root["extensions"]["BOUNCE_scene"]["world"] = {{"color", {radiance.r, radiance.g, radiance.b}},
                                                   {"strength", 1}};
}

void SceneFile::camera_above(double width, double height, double aspect, const glm::dvec3& over) {
    const int lens = add("cameras", {{"type", "orthographic"},
                                     {"orthographic",
                                      {{"xmag", 0.5 * width},
                                       {"ymag", 0.5 * width / aspect},
                                       {"znear", 1e-3 * height},
                                       {"zfar", 2.0 * height}}}});
    const glm::dvec3 from = over + glm::dvec3(0.0, height, 0.0);
    root["extensions"]["BOUNCE_scene"]["camera"] =
        node({{"camera", lens}, {"matrix", json_of(looking(from, over))}});
}

void SceneFile::camera(const glm::dvec3& from, const glm::dvec3& at, double near_m) {
    const int lens = add("cameras", {{"type", "perspective"},
                                     {"perspective", {{"yfov", std::numbers::pi / 3.0}, {"znear", near_m}}}});
    root["extensions"]["BOUNCE_scene"]["camera"] =
        node({{"camera", lens}, {"matrix", json_of(looking(from, at))}});
}

int SceneFile::view(const void* bytes, size_t size) {
    binary_.resize((binary_.size() + 3) / 4 * 4);
    const size_t offset = binary_.size();
    const auto* from = static_cast<const uint8_t*>(bytes);
    binary_.insert(binary_.end(), from, from + size);
    return add("bufferViews", {{"buffer", 0}, {"byteOffset", offset}, {"byteLength", size}});
}

int SceneFile::describe(int component_type, size_t count, const std::string& type, const void* bytes,
                        size_t size) {
    return add("accessors", {{"bufferView", view(bytes, size)},
                             {"componentType", component_type},
                             {"count", count},
                             {"type", type}});
}

int SceneFile::accessor(const std::vector<float>& values, const std::string& type) {
    const size_t width = components(type);
    const int index =
        describe(k_float, values.size() / width, type, values.data(), values.size() * sizeof(float));
    if (type == "VEC3" || type == "SCALAR") {
        json low = json::array();
        json high = json::array();
        for (size_t i = 0; i < width && i < values.size(); ++i) {
            float least = values[i];
            float most = values[i];
            for (size_t k = i; k < values.size(); k += width) {
                least = std::min(least, values[k]);
                most = std::max(most, values[k]);
            }
            low.push_back(least);
            high.push_back(most);
        }
        root["accessors"].back()["min"] = low;
        root["accessors"].back()["max"] = high;
    }
    return index;
}

int SceneFile::accessor(const std::vector<uint32_t>& values) {
    return describe(k_unsigned_int, values.size(), "SCALAR", values.data(), values.size() * sizeof(uint32_t));
}

int SceneFile::accessor(const std::vector<uint16_t>& values, const std::string& type) {
    return describe(k_unsigned_short, values.size() / components(type), type, values.data(),
                    values.size() * sizeof(uint16_t));
}

void SceneFile::write(const std::filesystem::path& path) const {
    json whole = root;
    if (!binary_.empty()) {
        whole["buffers"] = {{{"byteLength", binary_.size()}}};
    }
    std::string text = whole.dump();
    text.resize((text.size() + 3) / 4 * 4, ' ');
    const size_t padded = (binary_.size() + 3) / 4 * 4;
    std::ofstream out(path, std::ios::binary);
    put(out, 0x46546c67U);
    put(out, 2);
    put(out, 12 + 8 + text.size() + (padded > 0 ? 8 + padded : 0));
    put(out, text.size());
    put(out, 0x4e4f534aU);
    out << text;
    if (padded > 0) {
        put(out, padded);
        put(out, 0x004e4942U);
        out.write(reinterpret_cast<const char*>(binary_.data()),  // NOLINT: bytes
                  static_cast<std::streamsize>(binary_.size()));
        for (size_t i = binary_.size(); i < padded; ++i) {
            out.put(0);
        }
    }
    if (!out.flush()) {
        throw output_error(fmt::format("cannot write {}", path.string()));
    }
}

}  // namespace bounce::stress
