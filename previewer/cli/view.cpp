// SPDX-License-Identifier: Apache-2.0
#include <filesystem>
#include <memory>
#include <optional>
#include <string>

#include "cli/commands.h"
#include "cli/render_options.h"
#include "cli/scene_source.h"
#include "cli/tuned_options.h"
#include "scene/gltf_loader.h"
#include "viewer/viewer.h"

namespace bounce::cli {
namespace {

struct Arguments {
    std::filesystem::path scene;
    SceneSourceOptions source;
    std::optional<int> frame;
    RenderOptions render;
};

scene::LoadResult load(const Arguments& arguments) {
    scene::LoadResult loaded = scene::load_gltf(resolve_scene(arguments.scene, arguments.source).gltf);
    loaded.scene.name = arguments.scene.filename().string();  // an export is in the cache, by another name
    return loaded;
}

ExitCode view(const CLI::App& command, Arguments arguments) {
    arguments.render = with_tuning(command, arguments.render);
    arguments.render.check();
    if (arguments.render.show == "motion") {
        throw usage_error("--show motion is of a frame and the one before; bounce render writes it");
    }
    viewer::run_viewer({
        .scene = arguments.scene,
        .load = [&] { return load(arguments); },
        .choose_settings = [&](const scene::Scene& scene) { return arguments.render.settings(scene); },
        .choose_animation =
            [&](const scene::Scene& scene) { return arguments.render.animation_index(scene); },
        .camera = arguments.render.camera,
        .frame = arguments.frame,
    });
    return ExitCode::done;
}

}  // namespace

void add_view(CLI::App& app, Run& run) {
    auto arguments = std::make_shared<Arguments>();
    CLI::App* command = app.add_subcommand("view", "Look at a scene in a window; F1 lists the keys");
    command
        ->add_option("scene", arguments->scene,
                     "Scene: .glb, .gltf or .blend; shown again whenever it is saved")
        ->required();
    command->add_option("--frame", arguments->frame,
                        "Blender frame number to begin at; the first by default");
    arguments->render.add_to(*command);
    add_scene_source_options(*command, arguments->source);
    command->get_option("--size")->description(
        "Size of the window, such as 1280x720; the scene's own by default");
    command->callback(
        [command, arguments, &run] { run = [command, arguments] { return view(*command, *arguments); }; });
}

}  // namespace bounce::cli
