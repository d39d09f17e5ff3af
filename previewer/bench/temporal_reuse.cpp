// SPDX-License-Identifier: Apache-2.0
//
// What light of the frames before does to the error and the flicker of bounced light, and what it costs,
// while the camera, an object or a light moves.
#include <fmt/format.h>

#include "bench/experiments.h"
#include "bench/motions.h"
#include "image/sequence_metrics.h"

namespace bounce::bench {
namespace {

constexpr int k_frames = 16;
constexpr int k_quick_frames = 4;
constexpr int k_reference_vpls = 4096;
// Of the picture, without --size: the reference's lights are what takes time.
constexpr int k_width = 320;
constexpr int k_height = 180;
constexpr double k_step = 0.004;  // of the scene's diagonal, that what moves moves by in a frame

// One way to draw a motion: its renderer, figures and times.
class Run {
  public:
    Run(const scene::Scene& scene, const BenchInputs& inputs, Settings settings)
        : inputs_(inputs), settings_(settings), renderer_(scene) {
        settings_.count_gathered_pixels = settings.temporal_reuse;
    }

    // reference: of this frame; null for the reference's own run.
    Image draw(int frame, const Shot& shot, const Image* reference) {
        inputs_.interrupts.throw_if_interrupted("nothing is written");
        const FrameReport report = renderer_.render(
            shot.pose, shot.camera, settings_, reference != nullptr ? inputs_.timing : gl::TimingMode::off);
        renderer_.keep_frame();
        Image image = renderer_.read_color();
        if (reference != nullptr) {
            meter_.add(frame, image, reference, nullptr);
            if (frame > 0) {  // the first compiles shaders and has nothing before it
                for (const gl::PassTime& pass : report.passes) {
                    const bool own =
                        pass.name == "temporal reuse" || pass.name == "light spread" || pass.name == "motion";
                    (own ? own_ms_ : other_ms_) += pass.gpu_ms;
                }
                reused_ += report.reuse ? report.reuse->share : 0.0;
                ++timed_;
            }
        }
        return image;
    }
    SequenceMetrics finish() { return meter_.finish(); }
    [[nodiscard]] double own_ms() const { return own_ms_ / timed_; }
    [[nodiscard]] double other_ms() const { return other_ms_ / timed_; }
    [[nodiscard]] double reused() const { return reused_ / timed_; }

  private:
    const BenchInputs& inputs_;
    Settings settings_;
    Renderer renderer_;
    SequenceMeter meter_{HdrFlip::leave_out};
    double own_ms_ = 0.0;
    double other_ms_ = 0.0;
    double reused_ = 0.0;
    int timed_ = 0;
};

// Means over the second half of the frames, when light of those before has come to count.
struct Settled {
    double relmse = 0.0;
    double flip_step = 0.0;
    double flip_step_reference = 0.0;
};

Settled settled(const SequenceMetrics& metrics) {
    Settled out;
    const size_t first = metrics.frames.size() / 2;
    const auto count = static_cast<double>(metrics.frames.size() - first);
    for (size_t i = first; i < metrics.frames.size(); ++i) {
        const SequenceFrame& frame = metrics.frames[i];
        out.relmse += frame.error.value().relmse / count;
        out.flip_step += frame.flip_step / count;
        out.flip_step_reference += frame.flip_step_reference / count;
    }
    return out;
}

}  // namespace

void measure_temporal_reuse(const BenchInputs& inputs, BenchReport& report) {
    Settings settings = inputs.settings();
    if (!inputs.options.width && !inputs.options.quick) {
        settings.width = k_width;
        settings.height = k_height;
    }
    settings.show = Show::indirect;
    Settings reuse = settings;
    reuse.temporal_reuse = true;
    Settings exact = settings;
    exact.vpls = k_reference_vpls;
    const int frames = inputs.options.quick ? k_quick_frames : k_frames;
    Table table{
        .title = "Error and flicker of bounced light, frame by frame and with light of the frames before",
        .note = "",
        .columns = {{"what moves", ""},
                    {"relMSE", ""},
                    {"with reuse", ""},
                    {"over it", "times"},
                    {"FLIP a step", ""},
                    {"FLIP with reuse", ""},
                    {"reference's", ""},
                    {"reused", "%"},
                    {"frame", "ms"},
                    {"frame with reuse", "ms"},
                    {"reuse", "ms"}},
        .rows = {}};
    const std::vector<Motion> all = scene_motions(inputs, settings, k_step, report);
    Progress progress("bench temporal-reuse", static_cast<int>(all.size()));
    for (const Motion& motion : all) {
        Run reference(inputs.scene, inputs, exact);
        Run alone(inputs.scene, inputs, settings);
        Run with(inputs.scene, inputs, reuse);
        Image truth;
        for (int frame = 0; frame < frames; ++frame) {
            const Shot shot = motion.shot(frame);
            if (frame == 0 || !motion.still) {
                truth = reference.draw(frame, shot, nullptr);
            }
            (void)alone.draw(frame, shot, &truth);
            (void)with.draw(frame, shot, &truth);
        }
        const Settled own = settled(alone.finish());
        const Settled reused = settled(with.finish());
        table.rows.push_back({motion.name, own.relmse, reused.relmse, own.relmse / reused.relmse,
                              own.flip_step, reused.flip_step, own.flip_step_reference, 100.0 * with.reused(),
                              alone.other_ms(), with.own_ms() + with.other_ms(), with.own_ms()});
        progress.step(
            fmt::format("{} moves: relMSE {:.2g} and {:.2g}", motion.name, own.relmse, reused.relmse));
    }
    table.note = fmt::format(
        "{} frames, {}x{}, indirect light alone; the camera moves aside, object and light by {:g} % of the "
        "scene's diagonal a frame (a sun turns by that part of a radian). Against the same with {} VPLs; "
        "relMSE, and FLIP between consecutive "
        "frames (docs/metrics.md), over the second half of the frames.",
        frames, settings.width, settings.height, 100.0 * k_step, k_reference_vpls);
    report.tables.push_back(std::move(table));
    report.notes.emplace_back("a light that moves ends all reuse: what is left is the cost of keeping light");
}

}  // namespace bounce::bench
