// SPDX-License-Identifier: Apache-2.0
#include <chrono>
#include <cmath>
#include <filesystem>
#include <limits>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "cli/commands.h"
#include "cli/info_plan.h"
#include "cli/render_options.h"
#include "cli/scene_source.h"
#include "cli/tuned_options.h"
#include "core/error.h"
#include "scene/gltf_loader.h"
#include "scene/pose.h"
#include "scene/scene_features.h"

namespace bounce::cli {
namespace {

using nlohmann::json;
using scene::k_none;

struct InfoArguments {
    std::filesystem::path scene;
    SceneSourceOptions source;
    bool json = false;
    bool plan = false;
    RenderOptions render;
    size_t own_options = 0;  // of the command; those after them are of `render`
};

// Everything `info` says, gathered once and printed in either form.
struct Summary {
    const scene::LoadResult& loaded;
    scene::SceneFeatures features;
    scene::Bounds bounds;      // at the first frame
    std::uintmax_t bytes = 0;  // of the file; buffers and images beside it are not in it
    double load_ms = 0.0;      // reading, decompressing and checking it
};

const char* type_name(scene::LightType type) {
    switch (type) {
        case scene::LightType::point:
            return "point";
        case scene::LightType::spot:
            return "spot";
        case scene::LightType::sun:
            return "sun";
        case scene::LightType::area:
            return "area";
    }
    return "";
}

const char* shape_name(scene::AreaShape shape) {
    switch (shape) {
        case scene::AreaShape::square:
            return "square";
        case scene::AreaShape::rectangle:
            return "rectangle";
        case scene::AreaShape::disk:
            return "disk";
        case scene::AreaShape::ellipse:
            return "ellipse";
    }
    return "";
}

std::string node_name(const scene::Scene& scene, int index) {
    const std::string& name = scene.nodes[static_cast<size_t>(index)].name;
    return name.empty() ? fmt::format("node {}", index) : name;
}

json vector_json(const glm::dvec3& v) {
    return {v.x, v.y, v.z};
}

// What gives a light its penumbrae and its beam, angles in degrees.
json extent_json(const scene::Light& light) {
    const auto degrees = [](float radians) { return glm::degrees(static_cast<double>(radians)); };
    switch (light.type) {
        case scene::LightType::sun:
            return {{"angle_deg", degrees(light.angle_rad)}};
        case scene::LightType::area:
            return {{"shape", shape_name(light.shape)},
                    {"size_m", {light.size_x_m, light.size_y_m}},
                    {"spread_deg", degrees(light.spread_rad)}};
        case scene::LightType::spot:
            return {{"radius_m", light.radius_m},
                    {"cone_deg", degrees(light.cone_angle_rad)},
                    {"blend", light.blend}};
        case scene::LightType::point:
            return {{"radius_m", light.radius_m}};
    }
    return {};
}

json lights_json(const scene::Scene& scene) {
    json lights = json::array();
    for (const int index : scene.topological_order) {
        const scene::Node& node = scene.nodes[static_cast<size_t>(index)];
        if (node.light == k_none) {
            continue;
        }
        const scene::Light& light = scene.lights[static_cast<size_t>(node.light)];
        json entry{{"name", node_name(scene, index)},
                   {"type", type_name(light.type)},
                   {"color", vector_json(glm::dvec3(light.color))},
                   {"cast_shadow", light.cast_shadow}};
        if (light.type == scene::LightType::sun) {
            entry["irradiance_w_m2"] = light.irradiance_w_m2;
        } else {
            entry["power_w"] = light.power_w;
        }
        entry.update(extent_json(light));
        lights.push_back(std::move(entry));
    }
    return lights;
}

json world_json(const scene::Scene& scene) {
    json world{{"color", vector_json(glm::dvec3(scene.world.color))},
               {"strength", scene.world.strength},
               {"image", nullptr}};
    if (scene.environment) {
        world["image"] = {{"name", scene.environment->name},
                          {"width", scene.environment->width},
                          {"height", scene.environment->height}};
    }
    return world;
}

json cameras_json(const scene::Scene& scene) {
    json cameras = json::array();
    for (const int index : scene.topological_order) {
        const scene::Node& node = scene.nodes[static_cast<size_t>(index)];
        if (node.camera == k_none) {
            continue;
        }
        const scene::Camera& camera = scene.cameras[static_cast<size_t>(node.camera)];
        json entry{{"name", node_name(scene, index)},
                   {"type", camera.perspective ? "perspective" : "orthographic"},
                   {"active", index == scene.active_camera_node}};
        if (camera.perspective) {
            entry["yfov_rad"] = camera.yfov_rad;
        }
        cameras.push_back(std::move(entry));
    }
    return cameras;
}

json animations_json(const scene::Scene& scene) {
    json animations = json::array();
    for (const scene::Animation& animation : scene.animations) {
        animations.push_back({{"name", animation.name},
                              {"duration_s", animation.duration_s},
                              {"channels", animation.channels.size()}});
    }
    return animations;
}

json features_json(const scene::SceneFeatures& features) {
    return {{"skinned", features.skinned},
            {"morphed", features.morphed},
            {"textured", features.textured()},
            {"vertex_colors", features.vertex_colors},
            {"alpha_mask", features.alpha_mask},
            {"alpha_blend", features.alpha_blend},
            {"emissive", features.emissive},
            {"glossy", features.glossy},
            {"unlit", features.unlit},
            {"world_not_black", features.world_not_black},
            {"animated_camera", features.animated_camera},
            {"animated_lights", features.animated_lights},
            {"animated_geometry", features.animated_geometry},
            {"animated_materials", features.animated_materials},
            {"animated_world", features.animated_world}};
}

json summary_json(const Summary& summary) {
    const scene::Scene& scene = summary.loaded.scene;
    json result{
        {"schema", "bounce.info/1"},
        {"scene", scene.name},
        {"from_blender", scene.from_blender},
        {"blender_version", scene.blender_version},
        {"counts",
         {{"nodes", scene.nodes.size()},
          {"meshes", scene.meshes.size()},
          {"draws", summary.features.draws},
          {"triangles", summary.features.triangles},
          {"vertices", summary.features.vertices},
          {"materials", scene.materials.size()},
          {"textures", scene.textures.size()},
          {"images", scene.images.size()},
          {"skins", scene.skins.size()}}},
        {"frames", {{"start", scene.frames.start}, {"end", scene.frames.end}, {"fps", scene.frames.fps}}},
        {"render", {{"width", scene.render.width}, {"height", scene.render.height}}},
        {"view", {{"view_transform", scene.view.view_transform}, {"exposure", scene.view.exposure}}},
        {"world", world_json(scene)},
        {"lights", lights_json(scene)},
        {"cameras", cameras_json(scene)},
        {"animations", animations_json(scene)},
        {"features", features_json(summary.features)},
        {"extensions", summary.loaded.extensions_used},
        {"warnings", summary.loaded.warnings},
        {"unsupported", json::array()}};
    result["file"] = {{"bytes", summary.bytes}, {"load_ms", summary.load_ms}};
    result["bounds"] = nullptr;
    if (!summary.bounds.empty()) {
        result["bounds"] = {{"low", vector_json(summary.bounds.low)},
                            {"high", vector_json(summary.bounds.high)}};
    }
    for (const scene::Unsupported& item : scene.unsupported) {
        result["unsupported"].push_back({{"object", item.object}, {"what", item.what}});
    }
    return result;
}

std::string version_text(const std::vector<int>& version) {
    return version.empty() ? "unknown" : fmt::format("{}", fmt::join(version, "."));
}

// Of an entry of lights_json: ", radius 0.1 m" and the like; nothing for what is 0.
std::string extent_text(const json& light) {
    std::string text;
    if (light.contains("shape")) {
        text += fmt::format(", {} of {:.4g} x {:.4g} m", light["shape"].get<std::string>(),
                            light["size_m"][0].get<double>(), light["size_m"][1].get<double>());
        if (light["spread_deg"].get<double>() < 179.99) {
            text += fmt::format(", spread {:.4g} deg", light["spread_deg"].get<double>());
        }
    }
    if (light.contains("cone_deg")) {
        text += fmt::format(", cone {:.4g} deg", light["cone_deg"].get<double>());
    }
    if (light.value("radius_m", 0.0) > 0.0) {
        text += fmt::format(", radius {:.4g} m", light["radius_m"].get<double>());
    }
    if (light.value("angle_deg", 0.0) > 0.0) {
        text += fmt::format(", angle {:.4g} deg", light["angle_deg"].get<double>());
    }
    return text;
}

void print_lights(const scene::Scene& scene, int count) {
    fmt::print("lights      {}\n", count);
    for (const json& light : lights_json(scene)) {
        const bool sun = light.contains("irradiance_w_m2");
        fmt::print("  {:<20} {:<5} {:.6g} {}{}{}\n", light["name"].get<std::string>(),
                   light["type"].get<std::string>(),
                   sun ? light["irradiance_w_m2"].get<double>() : light["power_w"].get<double>(),
                   sun ? "W/m2" : "W", extent_text(light),
                   light["cast_shadow"].get<bool>() ? "" : ", casts no shadow");
    }
    const glm::vec3 radiance = scene.world.color * scene.world.strength;
    const std::string source = scene.environment
                                   ? fmt::format(" in the mean, image {} ({} x {})", scene.environment->name,
                                                 scene.environment->width, scene.environment->height)
                                   : std::string(scene.from_blender ? "" : " (a default)");
    fmt::print("world       {:.4g} {:.4g} {:.4g} W/(m2 sr){}\n", radiance.r, radiance.g, radiance.b, source);
}

void print_cameras(const scene::Scene& scene) {
    const json cameras = cameras_json(scene);
    fmt::print("cameras     {}\n",
               cameras.empty() ? "none; the whole scene is framed" : fmt::format("{}", cameras.size()));
    for (const json& camera : cameras) {
        fmt::print("  {:<20} {}{}\n", camera["name"].get<std::string>(), camera["type"].get<std::string>(),
                   camera["active"].get<bool>() ? ", active" : "");
    }
}

void print_summary(const Summary& summary) {
    const scene::Scene& scene = summary.loaded.scene;
    const scene::SceneFeatures& features = summary.features;
    fmt::print(
        "{}{}\n", scene.name,
        scene.from_blender ? fmt::format(", from Blender {}", version_text(scene.blender_version)) : "");
    fmt::print("file        {:.1f} KiB, loaded in {:.0f} ms\n", static_cast<double>(summary.bytes) / 1024.0,
               summary.load_ms);
    fmt::print("geometry    {} triangles, {} vertices in {} draws of {} meshes\n", features.triangles,
               features.vertices, features.draws, scene.meshes.size());
    if (!summary.bounds.empty()) {
        const glm::dvec3 size = summary.bounds.high - summary.bounds.low;
        const glm::dvec3 center = summary.bounds.center();
        fmt::print("extent      {:.4g} x {:.4g} x {:.4g} m around ({:.4g}, {:.4g}, {:.4g})\n", size.x, size.y,
                   size.z, center.x, center.y, center.z);
    }
    fmt::print("materials   {}, with {} textures\n", scene.materials.size(), scene.textures.size());
    fmt::print("frames      {} to {} at {:.6g} a second\n", scene.frames.start, scene.frames.end,
               scene.frames.fps);
    print_lights(scene, features.lights());
    print_cameras(scene);
    fmt::print("animations  {}\n", scene.animations.size());
    for (const scene::Animation& animation : scene.animations) {
        fmt::print("  {:<20} {:.3f} s, {} channels\n", animation.name, animation.duration_s,
                   animation.channels.size());
    }
    if (!summary.loaded.extensions_used.empty()) {
        fmt::print("extensions  {}\n", fmt::join(summary.loaded.extensions_used, ", "));
    }
    for (const scene::Unsupported& item : scene.unsupported) {
        fmt::print("not exported: {}: {}\n", item.object, item.what);
    }
    for (const std::string& warning : summary.loaded.warnings) {
        fmt::print("warning: {}\n", warning);
    }
}

// Options of how frames are drawn say nothing without a plan.
void require_plan(const CLI::App& command, size_t own_options) {
    const std::vector<const CLI::Option*> options = command.get_options();
    for (size_t i = own_options; i < options.size(); ++i) {
        const CLI::Option* option = options[i];
        if (option->count() > 0) {
            throw usage_error(
                fmt::format("{} says how frames are drawn: give --plan beside it", option->get_name()));
        }
    }
}

ExitCode run_info(const CLI::App& command, const InfoArguments& arguments) {
    if (!arguments.plan) {
        require_plan(command, arguments.own_options);
    }
    const std::filesystem::path file = resolve_scene(arguments.scene, arguments.source).gltf;
    const auto start = std::chrono::steady_clock::now();
    const scene::LoadResult loaded = scene::load_gltf(file);
    const double load_ms =
        std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - start).count();
    const int animation = scene::default_animation(loaded.scene);
    const scene::Pose pose = scene::evaluate_pose(loaded.scene, 0.0, animation);
    const Summary summary{loaded, scene::scene_features(loaded.scene, animation),
                          scene::world_bounds(loaded.scene, pose), std::filesystem::file_size(file), load_ms};
    std::optional<InfoPlan> plan;
    if (arguments.plan) {
        plan = info_plan(loaded.scene, with_tuning(command, arguments.render));
    }
    if (arguments.json) {
        json all = summary_json(summary);
        if (plan) {
            all["plan"] = plan_json(*plan);
        }
        fmt::print("{}\n", all.dump(2, ' ', false, json::error_handler_t::replace));
    } else {
        print_summary(summary);
        if (plan) {
            print_plan(*plan);
        }
    }
    return ExitCode::done;
}

}  // namespace

void add_info(CLI::App& app, Run& run) {
    auto arguments = std::make_shared<InfoArguments>();
    CLI::App* command = app.add_subcommand("info", "Say what is in a scene");
    command->add_option("SCENE", arguments->scene, "The scene: .glb, .gltf or .blend")->required();
    add_scene_source_options(*command, arguments->source);
    command->add_flag("--json", arguments->json, "Print JSON (schema bounce.info/1)");
    command->add_flag(
        "--plan", arguments->plan,
        "Also the passes of the first frame, what is left out and why, and the GPU memory it takes");
    arguments->own_options = command->get_options().size();
    arguments->render.add_to(*command);
    command->callback([&run, command, arguments] {
        run = [command, arguments] { return run_info(*command, *arguments); };
    });
}

}  // namespace bounce::cli
