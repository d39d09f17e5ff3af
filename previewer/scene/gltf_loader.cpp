// SPDX-License-Identifier: Apache-2.0
#include "scene/gltf_loader.h"

#include <new>
#include <stdexcept>

#include <fmt/format.h>

#include "core/error.h"
#include "core/json_fault.h"
#include "scene/gltf/accessors.h"
#include "scene/gltf/animations.h"
#include "scene/gltf/bounce_extension.h"
#include "scene/gltf/cameras.h"
#include "scene/gltf/lights.h"
#include "scene/gltf/materials.h"
#include "scene/gltf/meshes.h"
#include "scene/gltf/nodes.h"
#include "scene/primitive_bounds.h"

namespace bounce::scene {
namespace {

LoadResult load(const std::filesystem::path& path) {
    gltf::Source source = gltf::open_source(path);
    gltf::Buffers buffers(source);
    const gltf::Accessors accessors(source, buffers);

    Scene scene;
    scene.name = path.filename().string();
    gltf::read_materials(source, buffers, scene);
    scene.meshes = gltf::read_meshes(source, buffers, accessors, scene.materials);
    for (Mesh& mesh : scene.meshes) {
        for (Primitive& primitive : mesh.primitives) {
            primitive.bounds = primitive_bounds(primitive);
        }
    }
    gltf::read_cameras(source, scene);
    gltf::read_nodes(source, accessors, scene);
    gltf::read_skins(source, accessors, scene);
    const std::vector<int> khr_lights = gltf::read_lights(source, scene);
    gltf::read_animations(source, accessors, khr_lights, scene);
    gltf::read_scene_settings(source, buffers, scene);
    LoadResult result{std::move(scene), {}, std::move(source.warnings)};
    for (const nlohmann::json& name : gltf::list(source.json(), "extensionsUsed")) {
        result.extensions_used.push_back(name.get<std::string>());
    }
    return result;
}

}  // namespace

LoadResult load_gltf(const std::filesystem::path& path) {
    const auto refused = [&](const std::string& cause) {
        return input_error(fmt::format("{} cannot be loaded: {}", path.string(), cause));
    };
    try {
        return load(path);
    } catch (const gltf::Refusal& cause) {
        throw refused(cause.what());
    } catch (const nlohmann::json::exception& cause) {
        // A property that no rule of the structure check names, and that has an unexpected type.
        throw refused(fmt::format("its JSON is not what glTF asks for: {}", json_fault(cause)));
    } catch (const std::bad_alloc&) {
        throw refused("it needs more memory than there is");
    } catch (const std::length_error&) {
        throw refused("it needs more memory than there is");
    }
}

}  // namespace bounce::scene
