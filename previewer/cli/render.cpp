// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>
#include <functional>
#include <memory>
#include <optional>

#include <fmt/format.h>

#include "cli/auto_options.h"
#include "cli/commands.h"
#include "cli/converge_options.h"
#include "cli/frame_list.h"
#include "cli/frame_writer.h"
#include "cli/render_options.h"
#include "cli/scene_source.h"
#include "cli/stats.h"
#include "cli/tuned_options.h"
#include "cli/view_options.h"
#include "core/atomic_file.h"
#include "core/interrupt.h"
#include "core/log.h"
#include "core/progress.h"
#include "core/stopwatch.h"
#include "gl/context.h"
#include "gl/memory.h"
#include "image/image_io.h"
#include "renderer/memory_fit.h"
#include "renderer/renderer.h"
#include "renderer/sampled_picture.h"
#include "renderer/setting_names.h"
#include "scene/pose.h"

namespace bounce::cli {
namespace {

struct Arguments {
    std::string scene;
    std::vector<std::string> outputs;
    std::string frames;
    std::string stats;
    int repeat = 1;
    bool pass_times = true;
    bool removed = false;
    bool check_finite = false;
    SceneSourceOptions source;
    RenderOptions render;
    ViewOptions view;
    ConvergeOptions converge;
};

std::vector<int> choose_frames(const Arguments& arguments, const scene::Scene& scene) {
    const bool sequence = std::all_of(arguments.outputs.begin(), arguments.outputs.end(), has_frame_field);
    std::vector<int> frames;
    if (!arguments.frames.empty()) {
        frames = parse_frames(arguments.frames);
    } else if (sequence) {
        frames = parse_frames(
            fmt::format("{}-{}", scene.frames.start, std::max(scene.frames.start, scene.frames.end)));
    } else {
        frames = {scene.frames.start};
    }
    if (frames.size() > 1 && !sequence) {
        throw usage_error(fmt::format(
            "{} frames would overwrite one file; put #### where the frame number belongs", frames.size()));
    }
    return frames;
}

// What the exporter could not say of the Blender scene: the picture will differ there.
void warn_of_unsupported(const scene::Scene& scene) {
    constexpr size_t k_named = 4;
    std::string named;
    for (size_t i = 0; i < std::min(scene.unsupported.size(), k_named); ++i) {
        const scene::Unsupported& item = scene.unsupported[i];
        named += fmt::format("{}{}: {}", i == 0 ? "" : "; ", item.object, item.what);
    }
    if (scene.unsupported.size() > k_named) {
        named += fmt::format("; and {} more, which bounce info lists", scene.unsupported.size() - k_named);
    }
    if (!named.empty()) {
        log::warning("Blender's scene has what the file has no words for: {}", named);
    }
}

// Refuses names of the view that are not there, and options of it that no file would show.
void check_view(const Arguments& arguments, const scene::ViewSettings& view, const Settings& settings) {
    if (!arguments.view.any()) {
        return;
    }
    if (std::all_of(arguments.outputs.begin(), arguments.outputs.end(),
                    [](const std::string& output) { return is_scene_linear(output); })) {
        throw usage_error(
            "options of the view transform have no effect on scene-linear files: give an output such as "
            ".png");
    }
    if (!shows_light(settings.show)) {
        throw usage_error(fmt::format(
            "options of the view transform have no effect with --show {}, which is data and no light",
            name_of(settings.show)));
    }
    (void)arguments.view.checked_over(
        {view.display_device, view.view_transform, view.look, view.exposure, view.gamma});
}

// A picture with holes is written all the same, for compare to find, but not silently.
void warn_of_not_finite(const Image& image, int frame) {
    size_t faulty = 0;
    for (size_t i = 0; i < image.rgb.size(); i += 3) {
        faulty += std::isfinite(image.rgb[i] + image.rgb[i + 1] + image.rgb[i + 2]) ? 0 : 1;
    }
    if (faulty > 0) {
        log::warning("frame {}: {} pixels are not finite; --check-finite says in which pass they begin",
                     frame, faulty);
    }
}

// Renders `repeat` times after a warm-up where asked for, so that compiled shaders and pools are in place.
// before: the frame before, where the layer needs it. first_ms: of the very first rendering, where this is
// the first frame. picture: the frame as it was drawn last.
FrameStats measure_frame(Renderer& renderer, const Moment& now, const Moment* before,
                         const Settings& settings, const Arguments& arguments, const gl::DeviceInfo& device,
                         double* first_ms, PictureMean& picture) {
    const bool first = first_ms != nullptr;
    FrameStats stats;
    const auto once = [&](gl::TimingMode mode, const Settings& with) {
        glFinish();
        const Stopwatch rendering;
        picture = {};
        if (arguments.converge.converge) {
            Converged converged = converge(renderer, now, with, arguments.converge.target(), mode,
                                           [] { return InterruptGuard::interrupted(); });
            FrameReport report = converged.report;
            stats.converged = std::move(converged);
            return std::pair(std::move(report), rendering.ms());
        }
        FrameReport report = with.samples > 1 ? render_samples(renderer, now, with, mode, picture)
                                              : renderer.render(now.pose, now.camera, with, mode, before);
        glFinish();
        return std::pair(std::move(report), rendering.ms());
    };
    // What is missing from the picture is found out once, by reading back, which no timed rendering does.
    Settings finding = settings;
    finding.find_unlit = first;
    // Times are of steady state: shaders are compiled and textures made by a rendering that is not counted.
    const bool warm_up = arguments.repeat > 1 || (first && !arguments.stats.empty());
    FrameReport found;
    if (warm_up && arguments.converge.converge) {
        // Two passes have all shaders.
        const Stopwatch rendering;
        found = converge(renderer, now, finding, {.passes = 2}, gl::TimingMode::off, nullptr).report;
        if (first) {
            *first_ms = rendering.ms();
        }
    } else if (warm_up) {
        auto [report, ms] = once(gl::TimingMode::off, finding);
        found = std::move(report);
        if (first) {
            *first_ms = ms;
        }
    }
    for (int i = 0; i < arguments.repeat; ++i) {
        auto [report, ms] = once(gl::TimingMode::off, warm_up ? settings : finding);
        stats.report = std::move(report);
        stats.all_wall_ms.push_back(ms);
    }
    if (!warm_up) {
        found = stats.report;
    }
    if (!arguments.stats.empty() && arguments.pass_times && !arguments.converge.converge) {
        // Passes are timed in renderings of their own, so that waiting for each does not slow the frame's
        // time.
        Settings counting = settings;
        counting.count_gathered_pixels = true;
        counting.measure_removed = arguments.removed;
        const auto mode = device.software ? gl::TimingMode::finish : gl::TimingMode::query;
        for (int i = 0; i < arguments.repeat; ++i) {
            stats.report = once(mode, counting).first;
            stats.all_passes.push_back(stats.report.passes);
        }
    }
    if (first) {
        stats.report.notes = found.notes;
        stats.report.left_out = found.left_out;
    }
    if (std::all_of(arguments.outputs.begin(), arguments.outputs.end(),
                    [](const std::string& output) { return is_scene_linear(output); })) {
        stats.report.left_out.push_back({"view transform", "every output is scene-linear"});
    }
    stats.report.left_out.push_back({"metrics", "nothing is compared (bounce compare, bounce evaluate)"});
    return stats;
}

// The settings with which every frame fits into --memory-limit.
Settings fitted(Renderer& renderer, const scene::Scene& scene, const Arguments& arguments,
                const std::vector<int>& frames, int animation, const Settings& settings) {
    const auto at = [&](size_t i, const std::function<void(const Moment&)>& visit) {
        const scene::Pose pose =
            scene::evaluate_pose(scene, scene::time_of_frame(scene.frames, frames[i]), animation);
        visit({pose, scene_camera(scene, pose, arguments.render.camera, settings.width, settings.height)});
    };
    const auto limit = static_cast<size_t>(*arguments.render.memory_limit_mib * gl::k_mebibyte);
    const MemoryFit fit = fit_to_memory(renderer, frames.size(), at, settings, frames.size() > 1, limit);
    for (const std::string& change : fit.changes) {
        log::info("note: to stay within {:g} MiB: {}", *arguments.render.memory_limit_mib, change);
    }
    return fit.settings;
}

// Why a frame is black, where nothing else says so.
std::string why_black(const FrameReport& report) {
    for (const char* kind : {"light: ", "bounced light"}) {
        const auto found = std::find_if(report.left_out.begin(), report.left_out.end(),
                                        [&](const LeftOut& item) { return item.pass.starts_with(kind); });
        if (found != report.left_out.end()) {
            return fmt::format("{}: {}", found->pass, found->reason);
        }
    }
    return "no light reaches what the camera sees";
}

ExitCode render(const CLI::App& command, Arguments arguments) {
    const Stopwatch run;
    arguments.render = with_tuning(command, arguments.render);
    arguments.render.check();
    if (arguments.removed && (arguments.stats.empty() || !arguments.pass_times)) {
        throw usage_error(
            "--measure-removed writes to --stats, with pass times: give --stats and no --no-pass-times");
    }
    StartTimes start;
    const scene::LoadResult loaded = load_scene(arguments.scene, arguments.source, &start.load_ms);
    for (const std::string& warning : loaded.warnings) {
        log::warning("{}", warning);
    }
    const scene::Scene& scene = loaded.scene;
    warn_of_unsupported(scene);
    AutoUse automatic = choose_automatically(arguments.render, scene, arguments.converge.frame_target());
    Settings settings = automatic.used ? automatic.choice.settings : arguments.render.settings(scene);
    note_other_conditions(arguments.render, settings);
    if (arguments.removed && settings.technique != Technique::ism) {
        throw usage_error(
            "--measure-removed needs --technique ism: only kernels of virtual point lights are bounded");
    }
    check_view(arguments, scene.view, settings);
    arguments.converge.check(settings);
    check_targets(arguments.render, arguments.converge);
    if (arguments.converge.converge && arguments.removed) {
        throw usage_error("--measure-removed is of a single frame; give no --converge beside it");
    }
    const int animation = arguments.render.animation_index(scene);
    const std::vector<int> frames = choose_frames(arguments, scene);
    for (const std::string& output : arguments.outputs) {
        require_writable(frame_path(output, frames.front()));
    }
    if (!arguments.stats.empty()) {
        require_writable(arguments.stats);
    }

    const Stopwatch opening;
    const gl::HeadlessContext context;
    const gl::DeviceInfo device = gl::initialise_current_context();
    start.context_ms = opening.ms();
    log::debug("OpenGL {} on {}", device.version, device.renderer);
    require_within(device.limits, settings);
    const Stopwatch uploading;
    Renderer renderer(scene);
    glFinish();
    start.upload_ms = uploading.ms();
    renderer.expect_frames(frames.size() > 1);
    if (automatic.needs_trial()) {
        try_automatic(renderer, scene, arguments.render, animation, frames, automatic);
        settings = automatic.choice.settings;
        require_within(device.limits, settings);
    }
    if (arguments.render.explain) {
        print_choice(automatic);
    }
    if (arguments.render.memory_limit_mib) {
        settings = fitted(renderer, scene, arguments, frames, animation, settings);
    }
    settings.check_finite = arguments.check_finite;  // whatever auto chose on trial
    const FrameWriter writer(scene, settings, arguments.view);
    StatsFile stats(arguments.scene, device, settings);
    if (automatic.used) {
        stats.chosen(automatic_json(automatic));
    }
    Progress progress("render", static_cast<int>(frames.size()));
    const InterruptGuard interrupts;
    int written = 0;
    int frame_before = frames.front() - 1;
    for (const int frame : frames) {
        interrupts.throw_if_interrupted(fmt::format("{} of {} frames are written", written, frames.size()));
        const double time_s = scene::time_of_frame(scene.frames, frame);
        const scene::Pose pose = scene::evaluate_pose(scene, time_s, animation);
        const CameraView camera =
            scene_camera(scene, pose, arguments.render.camera, settings.width, settings.height);
        std::optional<scene::Pose> pose_before;
        std::optional<Moment> before;
        if (settings.show == Show::motion) {
            pose_before =
                scene::evaluate_pose(scene, scene::time_of_frame(scene.frames, frame - 1), animation);
            before.emplace(Moment{*pose_before, scene_camera(scene, *pose_before, arguments.render.camera,
                                                             settings.width, settings.height)});
        }
        if (frame != frame_before + 1) {
            renderer.forget_history();
        }
        PictureMean picture;
        FrameStats measured =
            measure_frame(renderer, {pose, camera}, before ? &*before : nullptr, settings, arguments, device,
                          frame == frames.front() ? &start.first_frame_ms : nullptr, picture);
        renderer.keep_frame();
        frame_before = frame;
        measured.frame = frame;
        measured.time_s = time_s;
        const Image image = measured.converged     ? std::exchange(measured.converged->picture, Image{})
                            : settings.samples > 1 ? picture.mean()
                                                   : renderer.read_color();
        const size_t faulty =
            measured.converged ? measured.converged->faulty_pixels : picture.faulty_pixels();
        if (faulty == 0) {
            warn_of_not_finite(image, frame);
        } else {
            log::warning("frame {}: {} pixels are not finite, since one of their {} samples is not", frame,
                         faulty, measured.converged ? measured.converged->state.passes : settings.samples);
        }
        for (const std::string& output : arguments.outputs) {
            writer.write(frame_path(output, frame), image, pose.view, frame);
        }
        ++written;
        progress.step(measured.converged
                          ? fmt::format("frame {}, {}", frame,
                                        describe(*measured.converged, arguments.converge.target()))
                          : fmt::format("frame {}, {:.0f} ms", frame, measured.wall_ms()));
        if (frame != frames.front() && shows_light(settings.show) && measured.report.notes.empty() &&
            is_black(image)) {
            measured.report.notes.push_back(
                fmt::format("frame {} is black: {}", frame, why_black(measured.report)));
            log::info("note: {}", measured.report.notes.back());
        }
        if (frame == frames.front()) {
            for (const std::string& note : measured.report.notes) {
                log::info("note: {}", note);
            }
            for (const std::string& approximation : measured.report.approximations) {
                log::info("note: {}", approximation);
            }
        }
        const bool cut_short = measured.converged && measured.converged->end == ConvergeEnd::stopped;
        stats.add(std::move(measured));
        if (cut_short) {
            if (!arguments.stats.empty()) {
                stats.start(start, run);
                stats.write(arguments.stats);
            }
            interrupts.throw_if_interrupted(
                fmt::format("frame {} is written as far as it had come, {} of {} frames in all", frame,
                            written, frames.size()));
        }
    }
    if (!arguments.stats.empty()) {
        stats.start(start, run);
        stats.write(arguments.stats);
    }
    return ExitCode::done;
}

}  // namespace

void add_render(CLI::App& app, Run& run) {
    auto arguments = std::make_shared<Arguments>();
    CLI::App* command =
        app.add_subcommand("render", "Render frames to EXR (scene-linear), PNG and other files");
    command->add_option("scene", arguments->scene, "Scene: .glb, .gltf or .blend")->required();
    command
        ->add_option(
            "-o,--output", arguments->outputs,
            "Output file; #### stands for the frame number, .exr is scene-linear; may be given several times")
        ->required();
    command->add_option("--frames", arguments->frames,
                        "Blender frame numbers: 1-48, 1,24 or 1-48x4; the scene's range by default");
    command->add_option("--stats", arguments->stats,
                        "Write times, passes and what was left out to this JSON file");
    command
        ->add_option("--repeat", arguments->repeat,
                     "Render each frame N times after a warm-up; stats hold the median")
        ->check(CLI::Range(1, 10000));
    command->add_flag("!--no-pass-times", arguments->pass_times,
                      "With --stats: do not time the passes one by one");
    command->add_flag(
        "--measure-removed", arguments->removed,
        "With --stats: also how much of the indirect light bounding the lights' kernels takes away");
    command->add_flag(
        "--check-finite", arguments->check_finite,
        "Search what each pass writes for NaN and infinities; where there are any, end with the "
        "pass and the pixel instead of writing the frame");
    add_scene_source_options(*command, arguments->source);
    arguments->render.add_to(*command);
    arguments->render.add_still_to(*command);
    arguments->converge.add_to(*command);
    arguments->view.add_to(*command);
    command->callback(
        [command, arguments, &run] { run = [command, arguments] { return render(*command, *arguments); }; });
}

}  // namespace bounce::cli
