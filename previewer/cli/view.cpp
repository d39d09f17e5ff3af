// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "cli/auto_options.h"
#include "cli/commands.h"
#include "cli/render_options.h"
#include "cli/scene_source.h"
#include "cli/tuned_options.h"
#include "gl/context.h"
#include "renderer/renderer.h"
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

// How fast this machine draws the scene, told in a context of its own: the window's is not there yet.
double machine_speed(const RenderOptions& options, const scene::Scene& scene, AutoUse& use) {
    const gl::HeadlessContext context;
    (void)gl::initialise_current_context();
    Renderer renderer(scene);
    renderer.expect_frames(true);
    std::vector<int> frames;
    for (int frame = scene.frames.start; frame <= std::max(scene.frames.end, scene.frames.start); ++frame) {
        frames.push_back(frame);
    }
    try_automatic(renderer, scene, options, options.animation_index(scene), frames, use);
    return *use.speed;
}

// Settings for the scene at its own size or the one that was asked for, or for a window of another size. The
// first time the machine's speed is measured where a budget needs it.
Settings choose(RenderOptions& options, const scene::Scene& scene, std::optional<glm::ivec2> size) {
    RenderOptions sized = options;
    if (size) {
        sized.size = fmt::format("{}x{}", size->x, size->y);
    }
    AutoUse use = choose_automatically(sized, scene, std::nullopt);
    if (!use.used) {
        return sized.settings(scene);
    }
    if (use.needs_trial()) {
        options.machine_speed = machine_speed(sized, scene, use);
    }
    if (options.explain && !size) {
        print_choice(use);
    }
    return use.choice.settings;
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
        .choose_settings =
            [&](const scene::Scene& scene, std::optional<glm::ivec2> size) {
                return choose(arguments.render, scene, size);
            },
        .size_matters = arguments.render.budget_ms.has_value() && arguments.render.automatic(),
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
