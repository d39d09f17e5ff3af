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

constexpr int k_frames = 24;
constexpr int k_quick_frames = 4;
constexpr int k_reference_vpls = 4096;
constexpr double k_step = 0.004;  // of the scene's diagonal, that what moves moves by in a frame

// One way to draw a motion: its renderer, figures and times.
class Run {
  public:
    Run(const scene::Scene& scene, const BenchInputs& inputs, Settings settings)
        : inputs_(inputs), settings_(settings), renderer_(scene) {}

    // reference: of this frame; null for the reference's own run.
    Image draw(int frame, const Shot& shot, int vpls, const Image* reference) {
        inputs_.interrupts.throw_if_interrupted("nothing is written");
        Settings settings = settings_;
        settings.vpls = vpls;
        settings.count_gathered_pixels = settings.temporal_reuse;
        const FrameReport report = renderer_.render(
            shot.pose, shot.camera, settings, reference != nullptr ? inputs_.timing : gl::TimingMode::off);
        renderer_.keep_history();
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

// relMSE over the second half of the frames, when a mean has as many as it may.
double settled_error(const SequenceMetrics& metrics) {
    double sum = 0.0;
    double count = 0.0;
    for (size_t i = metrics.frames.size() / 2; i < metrics.frames.size(); ++i) {
        sum += metrics.frames[i].error ? metrics.frames[i].error->relmse : 0.0;
        count += 1.0;
    }
    return sum / count;
}

}  // namespace

void measure_temporal_reuse(const BenchInputs& inputs, BenchReport& report) {
    Settings settings = inputs.settings();
    settings.show = Show::indirect;
    Settings reuse = settings;
    reuse.temporal_reuse = true;
    const int frames = inputs.options.quick ? k_quick_frames : k_frames;
    const int block = settings.interleave * settings.interleave;
    Table table{
        .title = "Error and flicker of bounced light, frame by frame and with light of the frames before",
        .note = "",
        .columns = {{"what moves", ""},
                    {"lights", ""},
                    {"relMSE", ""},
                    {"with reuse", ""},
                    {"over it", "times"},
                    {"FLIP a step", ""},
                    {"FLIP with reuse", ""},
                    {"reference's", ""},
                    {"reused", "%"},
                    {"reuse", "ms"},
                    {"frame without", "ms"}},
        .rows = {}};
    const std::vector<Motion> all = scene_motions(inputs, settings, k_step, report);
    Progress progress("bench temporal-reuse", static_cast<int>(2 * all.size()));
    for (const Motion& motion : all) {
        for (const bool fresh : {false, true}) {
            Run reference(inputs.scene, inputs, settings);
            Run alone(inputs.scene, inputs, settings);
            Run with(inputs.scene, inputs, reuse);
            for (int frame = 0; frame < frames; ++frame) {
                const Shot shot = motion.shot(frame);
                // Another number of lights is another choice of them.
                const int vpls = settings.vpls + (fresh ? block * (frame % 16) : 0);
                const Image exact = reference.draw(frame, shot, k_reference_vpls, nullptr);
                (void)alone.draw(frame, shot, vpls, &exact);
                (void)with.draw(frame, shot, vpls, &exact);
            }
            const SequenceMetrics own = alone.finish();
            const SequenceMetrics reused = with.finish();
            table.rows.push_back({motion.name, fresh ? "others in each frame" : "the same sequence",
                                  settled_error(own), settled_error(reused),
                                  settled_error(own) / settled_error(reused), own.flip_step_mean,
                                  reused.flip_step_mean, own.flip_step_reference_mean, 100.0 * with.reused(),
                                  with.own_ms(), with.other_ms()});
            progress.step(fmt::format("{} moves: relMSE {:.2g} and {:.2g}", motion.name, settled_error(own),
                                      settled_error(reused)));
        }
    }
    table.note = fmt::format(
        "{} frames, indirect light alone; the camera moves aside, object and light by {:g} % of the scene's "
        "diagonal a frame (a sun turns by that part of a radian). Against the same with {} VPLs; relMSE over "
        "the second half of the frames, FLIP "
        "between consecutive frames (docs/metrics.md). Others: {} to {} VPLs in turn, since each number has "
        "another sequence.",
        frames, 100.0 * k_step, k_reference_vpls, settings.vpls, settings.vpls + 15 * block);
    report.tables.push_back(std::move(table));
    report.notes.emplace_back("a light that moves ends all reuse: what is left is the cost of keeping light");
}

}  // namespace bounce::bench
