// SPDX-License-Identifier: Apache-2.0
#include "scene/gltf/source.h"

#include <algorithm>

#include "scene/gltf/check.h"
#include "scene/gltf/extensions.h"

namespace bounce::scene::gltf {
namespace {

using nlohmann::json;

// What tinygltf is given: the lists that it reads without loss.
json typed_part(const json& root) {
    json part = json::object();
    for (const char* key : {"asset", "scene"}) {
        if (const json* value = member(root, key)) {
            part[key] = *value;
        }
    }
    for (const char* key : {"scenes", "nodes", "meshes", "accessors", "bufferViews", "textures", "samplers",
                            "materials", "cameras", "skins"}) {
        json& items = part[key] = list(root, key);
        for (json& item : items) {
            item.erase("extras");
            item.erase("extensions");
        }
    }
    // Indices that Draco holds have an accessor without a buffer view, which tinygltf takes for an error.
    for (json& mesh : part["meshes"]) {
        for (json& primitive : mesh["primitives"]) {
            primitive.erase("indices");
            primitive.erase("extras");
            primitive.erase("extensions");
        }
    }
    return part;
}

tinygltf::Model typed_model(const json& root) {
    const std::string text = typed_part(root).dump();
    tinygltf::TinyGLTF reader;
    tinygltf::Model model;
    std::string error;
    std::string warning;
    if (!reader.LoadASCIIFromString(&model, &error, &warning, text.c_str(),
                                    static_cast<unsigned int>(text.size()), "")) {
        error = error.substr(0, error.find('\n'));
        throw refusal("its JSON is not valid glTF: {}", error);
    }
    const auto require_same_size = [&](const char* key, size_t size) {
        if (list(root, key).size() != size) {
            throw refusal("its {} are not valid glTF", key);
        }
    };
    require_same_size("nodes", model.nodes.size());
    require_same_size("meshes", model.meshes.size());
    require_same_size("accessors", model.accessors.size());
    require_same_size("bufferViews", model.bufferViews.size());
    require_same_size("textures", model.textures.size());
    require_same_size("samplers", model.samplers.size());
    require_same_size("materials", model.materials.size());
    require_same_size("cameras", model.cameras.size());
    require_same_size("skins", model.skins.size());
    return model;
}

}  // namespace

void Source::warn(std::string sentence) {
    if (std::find(warnings.begin(), warnings.end(), sentence) == warnings.end()) {
        warnings.push_back(std::move(sentence));
    }
}

void Source::spend(uint64_t& total, uint64_t amount, uint64_t most, std::string_view what) {
    if (amount > most || total > most - amount) {
        throw refusal("it has more than the {} {} allowed", most, what);
    }
    total += amount;
}

Source open_source(const std::filesystem::path& path) {
    Source source;
    source.document = read_document(path);
    check_structure(source.document.json);
    check_extensions(source);
    source.model = typed_model(source.json());
    return source;
}

const json* member(const json& object, std::string_view key) {
    if (!object.is_object()) {
        return nullptr;
    }
    const auto found = object.find(key);
    return found == object.end() ? nullptr : &*found;
}

const json* extension(const json& object, std::string_view name) {
    const json* extensions = member(object, "extensions");
    return extensions == nullptr ? nullptr : member(*extensions, name);
}

const json& list(const json& object, std::string_view key) {
    static const json empty = json::array();
    const json* found = member(object, key);
    return found == nullptr ? empty : *found;
}

float number_or(const json& object, std::string_view key, float otherwise) {
    const json* value = member(object, key);
    return value == nullptr ? otherwise : value->get<float>();
}

std::string string_or(const json& object, std::string_view key, std::string_view otherwise) {
    const json* value = member(object, key);
    return value == nullptr ? std::string(otherwise) : value->get<std::string>();
}

int int_or(const json& object, std::string_view key, int otherwise) {
    const json* value = member(object, key);
    return value == nullptr ? otherwise : value->get<int>();
}

}  // namespace bounce::scene::gltf
