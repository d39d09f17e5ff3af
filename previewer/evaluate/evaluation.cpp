// SPDX-License-Identifier: Apache-2.0
#include "evaluate/evaluation.h"

#include <algorithm>
#include <cmath>
#include <map>

#include <fmt/format.h>

#include "core/error.h"
#include "core/log.h"
#include "core/progress.h"
#include "evaluate/cache.h"
#include "evaluate/cycles_cache.h"
#include "evaluate/given_reference.h"
#include "evaluate/report.h"
#include "evaluate/scene_files.h"
#include "evaluate/scratch_folder.h"
#include "evaluate/sha256.h"
#include "evaluate/startup.h"
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
// Runs up to which each one's passes are timed: a process more a run.
constexpr size_t k_most_pass_runs = 16;

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
          resolved_(resolve_scene(options.scene, options.source)),
          gltf_(resolved_.gltf),
          scene_hash_(sha256_of_file(options.scene)),
          render_cache_(cache_folder() / "renders", options.width, options.height) {
        result_.scene_sha256 = sha256_of_gltf(gltf_);
        if (needs_cycles() || !options.peers.empty()) {
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
        run_peers();
        if (needs_cycles()) {
            render_with_cycles(progress);
        }
        collect_references();
        measure_cycles();
        measure_peers();
        measure_previews();
        measure_pass_times();
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
                                                            options_.height, options_.bounces, scene_hash_);
        }
    }

    void render_with_cycles(Progress& progress) {
        CyclesJob job;
        job.scene = options_.scene;
        job.width = options_.width;
        job.height = options_.height;
        job.bounces = options_.bounces;
        const auto add = [&](int frame, int spp, int seed) {
            job.renders.push_back({frame,
                                   spp,
                                   seed,
                                   spp <= k_quick_spp ? k_quick_repeat : 1,
                                   scratch_ / fmt::format("cycles_{}_{}_{}.exr", frame, spp, seed),
                                   0.0,
                                   0.0,
                                   0,
                                   {}});
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
        result_.cycles = run_cycles_cached(
            job, blender_, render_cache_, [&](const CyclesRender& render) { return cycles_key(render); },
            options_.fresh,
            [&](const CyclesRender& render) {
                progress.step(fmt::format("Cycles, frame {}, {} spp: {:.2f} s{}", render.frame, render.spp,
                                          render.seconds,
                                          render.measured.empty() ? "" : " (from an earlier run)"));
            });
    }

    [[nodiscard]] std::string cycles_key(const CyclesRender& render) const {
        return peer_key(peer_job(), render.frame,
                        fmt::format("Cycles, {} spp, seed {}, {} bounces, median of {}\n{}", render.spp,
                                    render.seed, options_.bounces, render.repeat, cycles_scripts_hash()));
    }

    void collect_references() {
        for (const int frame : options_.frames) {
            if (!references_[frame]) {
                references_[frame] = reference_from_halves(frame);
            }
            result_.references.push_back(*references_[frame]);
        }
        for (const CyclesRender& render : result_.cycles.renders) {
            if (render.seed != k_seed_ladder) {
                render_cache_.remove(cycles_key(render));  // half of a reference, which holds it now
            }
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
            size_t memory = 0;
            std::string measured;
            const std::string label = fmt::format("{} spp", spp);
            for (const int frame : options_.frames) {
                const CyclesRender& render = find_render(frame, spp, k_seed_ladder);
                Image image = read_image(render.output);
                frames.push_back(measure(frame, render.seconds, image, references_[frame]->image));
                memory = std::max(memory, render.rss_peak_bytes);
                measured = render.measured.empty() ? measured : render.measured;
                setup += render.setup_seconds / static_cast<double>(options_.frames.size());
                result_.pictures.push_back({curve.name, label, frame, std::move(image)});
            }
            curve.points.push_back(make_point(label, std::move(frames)));
            curve.points.back().setup_seconds = setup;
            curve.points.back().startup_seconds = result_.cycles.startup_seconds;
            curve.points.back().rss_peak_bytes = memory;
            curve.points.back().measured = measured;
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
            result_.curves.back().points.back().rss_peak_bytes = previews_[i].rss_peak_bytes;
            result_.curves.back().points.back().gl_peak_bytes = previews_[i].gl_peak_bytes;
            result_.curves.back().points.back().options = run.render_arguments;
        }
        mark_pareto(result_.curves);
        result_.speedups = speedups_at_equal_error(result_.curves);
        result_.front = summarize_front(result_.curves, result_.speedups);
    }

    [[nodiscard]] PeerJob peer_job() const {
        return {options_.scene,  scene_hash_,
                blender_,        result_.blender,
                options_.frames, options_.width,
                options_.height, options_.peer_limit_seconds,
                options_.fresh,  cache_folder() / "renders"};
    }

    void run_peers() {
        for (const std::string& name : options_.peers) {
            result_.peers.push_back(
                run_peer(name, peer_job(), [](const std::string& line) { log::info("{}", line); }));
        }
    }

    void measure_peers() {
        for (const PeerResult& peer : result_.peers) {
            for (const PeerPoint& point : peer.points) {
                std::vector<FrameError> frames;
                CurvePoint values;
                for (const PeerFrame& frame : point.frames) {
                    const CachedRender& render = frame.render;
                    frames.push_back(
                        measure(frame.frame, render.seconds, render.image, references_[frame.frame]->image));
                    values.startup_seconds = render.startup_seconds;
                    values.rss_peak_bytes = std::max(values.rss_peak_bytes, render.rss_peak_bytes);
                    values.measured = frame.cached ? render.date : values.measured;
                    result_.pictures.push_back({point.curve, point.label, frame.frame, render.image});
                }
                if (result_.curves.empty() || result_.curves.back().name != point.curve) {
                    result_.curves.push_back({point.curve, false, {}, true});
                }
                CurvePoint measured = make_point(point.label, std::move(frames));
                measured.startup_seconds = values.startup_seconds;
                measured.rss_peak_bytes = values.rss_peak_bytes;
                measured.measured = values.measured;
                result_.curves.back().points.push_back(std::move(measured));
            }
        }
    }

    // Of all runs; where they are many, or held against a given reference alone, of those whose pictures the
    // report shows.
    void measure_pass_times() {
        const auto shown = shown_points(result_);
        for (size_t i = 0; i < options_.runs.size(); ++i) {
            const PreviewRun& run = options_.runs[i];
            const bool wanted =
                (needs_cycles() && options_.runs.size() <= k_most_pass_runs) ||
                std::find(shown.begin(), shown.end(), std::pair{run.name, run.label}) != shown.end();
            if (wanted) {
                result_.passes.push_back(measure_passes(options_.bounce, gltf_, run, options_.frames.front(),
                                                        options_.width, options_.height,
                                                        scratch_ / fmt::format("passes{}", i)));
            }
        }
    }

    void describe() {
        result_.startups = startups_of(result_, resolved_.export_seconds);
        result_.scene = options_.scene.filename().string();
        result_.command = options_.command;
        result_.date = utc_now();
        result_.width = options_.width;
        result_.height = options_.height;
        result_.scene_hash = scene_hash_;
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
    ResolvedScene resolved_;
    fs::path gltf_;
    fs::path blender_;
    std::string scene_hash_;
    RenderCache render_cache_;
    std::map<int, std::optional<Reference>> references_;
    std::vector<PreviewResult> previews_;
    Evaluation result_;
};

}  // namespace

Evaluation evaluate(const EvaluateOptions& options) {
    return Evaluator(options).run();
}

}  // namespace bounce
