// SPDX-License-Identifier: Apache-2.0
#include "bench/frame_bench.h"

#include <algorithm>
#include <chrono>

#include <fmt/format.h>

#include "core/error.h"
#include "scene/pose.h"

namespace bounce::bench {

std::string part_name(Part part) {
    switch (part) {
        case Part::direct:
            return "direct light";
        case Part::rsm:
            return "RSMs";
        case Part::vpls:
            return "choice of VPLs";
        case Part::maps:
            return "VPLs' shadow maps";
        case Part::gather:
            return "gather";
        case Part::finish:
            break;
    }
    return "near field, blur";
}

Part PassParts::part_of(const std::string& pass) const {
    if (direct_.contains(pass)) return Part::direct;
    if (!unoccluded_.contains(pass)) return Part::maps;
    if (pass.starts_with("rsm")) return Part::rsm;
    if (pass.starts_with("vpl gather")) return Part::gather;
    return pass.starts_with("vpl") ? Part::vpls : Part::finish;
}

Samples MeasuredFrame::sum(const std::function<bool(const MeasuredPass&)>& filter) const {
    Samples out;
    for (const MeasuredPass& pass : passes) {
        if (filter(pass)) {
            out.add(pass.time);
        }
    }
    return out;
}

Samples MeasuredFrame::part(Part part) const {
    return sum([&](const MeasuredPass& pass) { return pass.part == part; });
}

Samples MeasuredFrame::indirect() const {
    return sum([](const MeasuredPass& pass) { return pass.part != Part::direct; });
}

FrameBench::FrameBench(const scene::Scene& scene, double frame, std::string camera, gl::TimingMode timing,
                       const InterruptGuard& interrupts)
    : scene_(scene),
      pose_(scene::evaluate_pose(scene, scene::time_of_frame(scene.frames, frame),
                                 scene::default_animation(scene))),
      camera_(std::move(camera)),
      timing_(timing),
      interrupts_(interrupts),
      renderer_(scene) {}

FrameReport FrameBench::draw(const Settings& settings, gl::TimingMode timing, double* ms) {
    interrupts_.throw_if_interrupted("nothing is written");
    const CameraView camera = scene_camera(scene_, pose_, camera_, settings.width, settings.height);
    glFinish();
    const auto start = std::chrono::steady_clock::now();
    FrameReport report = renderer_.render(pose_, camera, settings, timing);
    glFinish();
    if (ms != nullptr) {
        *ms = std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - start).count();
    }
    return report;
}

void FrameBench::find_parts(const Settings& settings) {
    Settings direct = settings;
    direct.technique = Technique::direct;
    Settings unoccluded = settings;
    unoccluded.visibility = Visibility::none;
    parts_ = std::make_unique<PassParts>(draw(direct, gl::TimingMode::off).executed,
                                         draw(unoccluded, gl::TimingMode::off).executed);
}

MeasuredFrame FrameBench::measure(const Settings& settings, int repeat, Measure what) {
    if (!parts_) {
        find_parts(settings);
    }
    MeasuredFrame out;
    out.report = draw(settings, gl::TimingMode::off);
    const int lights = settings.technique == Technique::rsm ? out.report.rsm_samples : out.report.vpls;
    if (lights == 0) {
        throw input_error(
            fmt::format("{} has no bounced light in this frame: no light shines on a surface that reflects",
                        scene_.name));
    }
    if (settings.technique == Technique::ism && settings.visibility == Visibility::ism &&
        out.report.points_a_map == 0) {
        throw input_error(fmt::format(
            "{} has nothing that hides anything: its virtual point lights need no shadow maps", scene_.name));
    }
    if (what != Measure::passes) {
        for (int i = 0; i < repeat; ++i) {
            (void)draw(settings, gl::TimingMode::off, &out.frame.ms.emplace_back());
        }
    }
    for (int i = 0; i < repeat && what != Measure::frame; ++i) {
        const FrameReport report = draw(settings, timing_, &out.timed_frame.ms.emplace_back());
        for (const gl::PassTime& pass : report.passes) {
            const auto at = std::find_if(out.passes.begin(), out.passes.end(),
                                         [&](const MeasuredPass& known) { return known.name == pass.name; });
            MeasuredPass& entry =
                at != out.passes.end()
                    ? *at
                    : out.passes.emplace_back(MeasuredPass{pass.name, parts_->part_of(pass.name), {}});
            entry.time.ms.resize(static_cast<size_t>(i) + 1, 0.0);
            entry.time.ms.back() += pass.gpu_ms;
        }
    }
    return out;
}

Image FrameBench::picture(const Settings& settings, FrameReport* report) {
    FrameReport drawn = draw(settings, gl::TimingMode::off);
    if (report != nullptr) {
        *report = std::move(drawn);
    }
    return renderer_.read_color();
}

}  // namespace bounce::bench
