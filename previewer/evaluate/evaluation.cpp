// SPDX-License-Identifier: Apache-2.0
#include "evaluate/evaluation.h"

#include <algorithm>
#include <cmath>
#include <ctime>
#include <map>

#include <fmt/chrono.h>
#include <fmt/format.h>

#include "core/error.h"
#include "core/log.h"
#include "core/progress.h"
#include "evaluate/cache.h"
#include "evaluate/given_reference.h"
#include "evaluate/scene_files.h"
#include "evaluate/scratch_folder.h"
#include "evaluate/sha256.h"
#include "evaluate/stored_runs.h"
#include "image/image_io.h"
#include "image/metrics.h"

namespace bounce {
namespace fs = std::filesystem;
namespace {

// Seeds of the reference's halves; the ladder takes another, so that no error is shared with them.
constexpr int k_seed_half1 = 1;
constexpr int k_seed_half2 = 2;
constexpr int k_seed_ladder = 3;
// Renders of few samples are over in a fraction of a second; the median of three steadies them.
constexpr int k_quick_spp = 4;
constexpr int k_quick_repeat = 3;

FrameError measure(int frame, double seconds, const Image& image, const Image& reference) {
    const Metrics metrics = compare(image, reference, HdrFlip::leave_out);
    if (metrics.nan + metrics.inf > 0) {
        log::warning("frame {}: {} values are NaN and {} infinite, so its errors are not numbers", frame,
                     metrics.nan, metrics.inf);
    }
    FrameError error;
    error.frame = frame;
    error.seconds = seconds;
    error.relmse = metrics.relmse;
    error.relmse_exposed = metrics.relmse_exposed;
    error.flip_ldr = metrics.flip_ldr;
    error.ssim = metrics.ssim;
    error.psnr_db = metrics.psnr_db;
    error.bias = metrics.bias;
    error.not_finite = metrics.nan + metrics.inf;
    return error;
}

class Evaluator {
  public:
    explicit Evaluator(const EvaluateOptions& options)
        : options_(options),
          gltf_(resolve_scene(options.scene, options.source).gltf),
          scene_hash_(sha256_of_file(options.scene)) {
        result_.scene_sha256 = sha256_of_gltf(gltf_);
        if (needs_cycles()) {
            blender_ = find_blender(options.source.blender);
            result_.blender = blender_version(blender_);
        }
        load_references();
    }

    Evaluation run() {
        const auto missing = static_cast<size_t>(std::count_if(
            references_.begin(), references_.end(), [](const auto& item) { return !item.second; }));
        const size_t ladder = options_.cycles_spp.size() * options_.frames.size();
        StoredRuns runs(options_, gltf_, result_.scene_sha256, scratch_.path());
        Progress progress("evaluate", static_cast<int>(runs.missing() + 2 * missing + ladder));
        // The quick half first: what is wrong with it shows before Cycles starts its minutes.
        previews_ = runs.results([&](const std::string& note) { progress.step(note); });
        if (needs_cycles()) {
            render_with_cycles(progress);
        }
        collect_references();
        measure_cycles();
        measure_previews();
        describe();
        return std::move(result_);
    }

  private:
    [[nodiscard]] bool needs_cycles() const {
        return options_.given_reference.empty() || !options_.cycles_spp.empty();
    }

    [[nodiscard]] ReferenceKey key_of(int frame) const {
        return {
            scene_hash_,      frame,           options_.width,       options_.height, options_.reference_spp,
            options_.bounces, result_.blender, cycles_scripts_hash()};
    }

    void load_references() {
        for (const int frame : options_.frames) {
            references_[frame] = options_.given_reference.empty()
                                     ? load_reference(cache_folder() / "references", key_of(frame))
                                     : load_given_reference(options_.given_reference, frame, options_.width,
                                                            options_.height, options_.bounces);
        }
    }

    void render_with_cycles(Progress& progress) {
        CyclesJob job;
        job.scene = options_.scene;
        job.width = options_.width;
        job.height = options_.height;
        job.bounces = options_.bounces;
        const auto add = [&](int frame, int spp, int seed) {
            job.renders.push_back({frame, spp, seed, spp <= k_quick_spp ? k_quick_repeat : 1,
                                   scratch_ / fmt::format("cycles_{}_{}_{}.exr", frame, spp, seed), 0.0,
                                   0.0});
        };
        for (const int frame : options_.frames) {
            for (const int spp : options_.cycles_spp) {
                add(frame, spp, k_seed_ladder);
            }
            if (!references_[frame]) {
                add(frame, options_.reference_spp / 2, k_seed_half1);
                add(frame, options_.reference_spp / 2, k_seed_half2);
            }
        }
        result_.cycles = run_cycles(job, blender_, [&](const CyclesRender& render) {
            progress.step(
                fmt::format("Cycles, frame {}, {} spp: {:.2f} s", render.frame, render.spp, render.seconds));
        });
    }

    void collect_references() {
        for (const int frame : options_.frames) {
            if (!references_[frame]) {
                references_[frame] = reference_from_halves(frame);
            }
            result_.references.push_back(*references_[frame]);
        }
    }

    Reference reference_from_halves(int frame) {
        const CyclesRender& half1 = find_render(frame, options_.reference_spp / 2, k_seed_half1);
        const CyclesRender& half2 = find_render(frame, options_.reference_spp / 2, k_seed_half2);
        Reference reference = make_reference(read_image(half1.output), read_image(half2.output));
        if (!std::isfinite(reference.noise_floor)) {
            throw input_error(
                fmt::format("Cycles' reference of frame {} of {} has values that are not numbers", frame,
                            options_.scene.string()));
        }
        reference.frame = frame;
        reference.seconds = half1.seconds + half2.seconds;
        store_reference(cache_folder() / "references", key_of(frame), reference, result_.cycles.files);
        return reference;
    }

    [[nodiscard]] const CyclesRender& find_render(int frame, int spp, int seed) const {
        return *std::find_if(result_.cycles.renders.begin(), result_.cycles.renders.end(),
                             [&](const auto& render) {
                                 return render.frame == frame && render.spp == spp && render.seed == seed;
                             });
    }

    void measure_cycles() {
        if (options_.cycles_spp.empty()) {
            return;
        }
        Curve curve{"Cycles", true, {}};
        for (const int spp : options_.cycles_spp) {
            std::vector<FrameError> frames;
            double setup = 0.0;
            const std::string label = fmt::format("{} spp", spp);
            for (const int frame : options_.frames) {
                const CyclesRender& render = find_render(frame, spp, k_seed_ladder);
                Image image = read_image(render.output);
                frames.push_back(measure(frame, render.seconds, image, references_[frame]->image));
                setup += render.setup_seconds / static_cast<double>(options_.frames.size());
                result_.pictures.push_back({curve.name, label, frame, std::move(image)});
            }
            curve.points.push_back(make_point(label, std::move(frames)));
            curve.points.back().setup_seconds = setup;
            curve.points.back().startup_seconds = result_.cycles.startup_seconds;
        }
        result_.curves.push_back(std::move(curve));
    }

    void measure_previews() {
        for (size_t i = 0; i < options_.runs.size(); ++i) {
            const PreviewRun& run = options_.runs[i];
            std::vector<FrameError> frames;
            for (const PreviewFrame& frame : previews_[i].frames) {
                Image image = read_image(frame.image);
                frames.push_back(measure(frame.frame, frame.seconds, image, references_[frame.frame]->image));
                if (!frame.all_seconds.empty()) {
                    const auto [least, most] =
                        std::minmax_element(frame.all_seconds.begin(), frame.all_seconds.end());
                    frames.back().seconds_least = *least;
                    frames.back().seconds_most = *most;
                }
                result_.pictures.push_back({run.name, run.label, frame.frame, std::move(image)});
            }
            if (result_.curves.empty() || result_.curves.back().name != run.name) {
                result_.curves.push_back({run.name, false, {}});
            }
            result_.curves.back().points.push_back(make_point(run.label, std::move(frames)));
            result_.curves.back().points.back().startup_seconds = previews_[i].startup_seconds;
            result_.curves.back().points.back().options = run.render_arguments;
        }
        mark_pareto(result_.curves);
        result_.speedups = speedups_at_equal_error(result_.curves);
        result_.front = summarize_front(result_.curves, result_.speedups);
    }

    void describe() {
        result_.scene = options_.scene.filename().string();
        result_.command = options_.command;
        result_.date = fmt::format("{:%Y-%m-%dT%H:%M:%SZ}", fmt::gmtime(std::time(nullptr)));
        result_.width = options_.width;
        result_.height = options_.height;
        result_.given_reference = options_.given_reference;
        result_.reference_spp = options_.given_reference.empty()
                                    ? options_.reference_spp
                                    : given_reference_spp(options_.given_reference, options_.frames.front());
        result_.bounces = options_.bounces;
        result_.frames = options_.frames;
        result_.machine = this_machine();
        if (!previews_.empty()) {
            result_.gl_vendor = previews_.front().gl_vendor;
            result_.gl_renderer = previews_.front().gl_renderer;
            result_.gl_version = previews_.front().gl_version;
        }
    }

    const EvaluateOptions& options_;
    ScratchFolder scratch_;
    fs::path gltf_;
    fs::path blender_;
    std::string scene_hash_;
    std::map<int, std::optional<Reference>> references_;
    std::vector<PreviewResult> previews_;
    Evaluation result_;
};

}  // namespace

Evaluation evaluate(const EvaluateOptions& options) {
    return Evaluator(options).run();
}

}  // namespace bounce
