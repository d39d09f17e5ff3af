// SPDX-License-Identifier: Apache-2.0
#include "cli/info_plan.h"

#include <fmt/format.h>

#include "cli/auto_options.h"
#include "gl/context.h"
#include "gl/memory.h"

namespace bounce::cli {
namespace {

double mebibytes(size_t bytes) {
    return static_cast<double>(bytes) / gl::k_mebibyte;
}

}  // namespace

InfoPlan info_plan(const scene::Scene& scene, const RenderOptions& options) {
    options.check();
    InfoPlan out;
    AutoUse automatic = choose_automatically(options, scene, std::nullopt);
    out.settings = automatic.used ? automatic.choice.settings : options.settings(scene);
    out.frame = scene.frames.start;
    const gl::HeadlessContext context;
    const gl::DeviceInfo device = gl::initialise_current_context();
    require_within(device.limits, out.settings);
    Renderer renderer(scene);
    const int animation = options.animation_index(scene);
    if (automatic.needs_trial()) {
        try_automatic(renderer, scene, options, animation, {out.frame}, automatic);
        out.settings = automatic.choice.settings;
    }
    if (automatic.used) {
        out.choices = choice_lines(automatic);
    }
    const scene::Pose pose =
        scene::evaluate_pose(scene, scene::time_of_frame(scene.frames, out.frame), animation);
    const CameraView camera =
        scene_camera(scene, pose, options.camera, out.settings.width, out.settings.height);
    out.report = renderer.plan(pose, camera, out.settings);
    return out;
}

nlohmann::json plan_json(const InfoPlan& plan) {
    const FrameReport::Memory memory = plan.report.memory.value();
    nlohmann::json out = {{"frame", plan.frame},
                          {"width", plan.settings.width},
                          {"height", plan.settings.height},
                          {"passes", plan.report.executed},
                          {"left_out", nlohmann::json::array()},
                          {"choices", plan.choices},
                          {"approximations", plan.report.approximations},
                          {"memory",
                           {{"lasting_bytes", memory.lasting},
                            {"passes_bytes", memory.passes},
                            {"peak_bytes", memory.peak()}}}};
    for (const LeftOut& item : plan.report.left_out) {
        out["left_out"].push_back({{"pass", item.pass}, {"reason", item.reason}});
    }
    return out;
}

void print_plan(const InfoPlan& plan) {
    const FrameReport::Memory memory = plan.report.memory.value();
    fmt::print("settings    {}\n", plan.choices.empty() ? "as asked for" : "chosen by preset auto");
    for (const std::string& choice : plan.choices) {
        fmt::print("  {}\n", choice);
    }
    fmt::print("plan        frame {}, {} x {} pixels, {} passes\n", plan.frame, plan.settings.width,
               plan.settings.height, plan.report.executed.size());
    for (const std::string& pass : plan.report.executed) {
        fmt::print("  {}\n", pass);
    }
    fmt::print("left out    {}\n", plan.report.left_out.size());
    for (const LeftOut& item : plan.report.left_out) {
        fmt::print("  {:<32} {}\n", item.pass, item.reason);
    }
    fmt::print(
        "GPU memory  {:.1f} MiB at most: {:.1f} of the scene and what lasts, {:.1f} of the frame's passes\n",
        mebibytes(memory.peak()), mebibytes(memory.lasting), mebibytes(memory.passes));
}

}  // namespace bounce::cli
