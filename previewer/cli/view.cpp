// SPDX-License-Identifier: Apache-2.0
#include <memory>
#include <optional>
#include <string>

#include "cli/commands.h"
#include "cli/render_options.h"
#include "viewer/viewer.h"

namespace bounce::cli {
namespace {

struct Arguments {
    std::string scene;
    std::optional<int> frame;
    RenderOptions render;
};

ExitCode view(const Arguments& arguments) {
    viewer::run_viewer({
        .scene = arguments.scene,
        .choose_settings = [&](const scene::Scene& scene) { return arguments.render.settings(scene); },
        .choose_animation = [&](const scene::Scene& scene) { return arguments.render.animation_index(scene); },
        .camera = arguments.render.camera,
        .frame = arguments.frame,
    });
    return ExitCode::done;
}

}  // namespace

void add_view(CLI::App& app, Run& run) {
    auto arguments = std::make_shared<Arguments>();
    CLI::App* command = app.add_subcommand("view", "Look at a scene in a window; F1 lists the keys");
    command->add_option("scene", arguments->scene, "Scene: .glb or .gltf")->required();
    command->add_option("--frame", arguments->frame, "Blender frame number to begin at; the first by default");
    arguments->render.add_to(*command);
    command->get_option("--size")->description("Size of the window, such as 1280x720; the scene's own by default");
    command->callback([arguments, &run] { run = [arguments] { return view(*arguments); }; });
}

}  // namespace bounce::cli
