// SPDX-License-Identifier: Apache-2.0
#include "evaluate/evaluation.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#include <fmt/format.h>

#include "core/error.h"
#include "core/log.h"
#include "core/progress.h"
#include "evaluate/cache.h"
#include "evaluate/cycles_cache.h"
#include "evaluate/draco_check.h"
#include "evaluate/engine_starts.h"
#include "evaluate/hdr_flip_of_points.h"
#include "evaluate/motion_layers.h"
#include "evaluate/point_meter.h"
#include "evaluate/reference_set.h"
#include "evaluate/report.h"
#include "evaluate/scene_defaults.h"
#include "evaluate/scene_files.h"
#include "evaluate/scratch_folder.h"
#include "evaluate/sha256.h"
#include "evaluate/startup.h"
#include "evaluate/stored_runs.h"
#include "image/image_io.h"
#include "image/metrics.h"
#include "image/sequence_metrics.h"

namespace bounce {
namespace fs = std::filesystem;
namespace {

// Renders of few samples are over in a fraction of a second; the median of three steadies them.
constexpr int k_quick_spp = 16;
constexpr int k_quick_repeat = 3;
// Runs up to which each one's passes are timed: a process more a run.
constexpr size_t k_most_pass_runs = 16;
// Each is a rendering with and one without the passes timed.
constexpr int k_most_pass_repeats = 3;

// Of the scene's content: the file with those that a glTF refers to. Those of a .blend Blender tells, and the
// caches keep their hashes.
std::string hash_of_content(const fs::path& scene) {
    const bool alone = is_blend(scene) || gltf_external_files(scene).empty();
    return alone ? sha256_of_file(scene) : sha256_of_gltf(scene);
}

// What Blender's renders depend on beside frame and size, which every key has: the content, and how Bounce
// shows it where it says nothing.
std::string hash_for_renders(const fs::path& scene) {
    const std::string content = hash_of_content(scene);
    const auto defaults = scene_defaults(scene, {1}, 16, 9);
    return defaults.is_null() ? content : sha256_of_text(content + defaults.dump());
}

class Evaluator {
  public:
    explicit Evaluator(const EvaluateOptions& options)
        : options_(options),
          resolved_(resolve_scene(options.scene, options.source)),
          gltf_(resolved_.gltf),
          scene_hash_(hash_of_content(options.scene)),
          render_hash_(hash_for_renders(options.scene)),
          render_cache_(cache_folder() / "renders", options.width, options.height) {
        result_.scene_sha256 = sha256_of_gltf(gltf_);
        if (needs_cycles() || !options.peers.empty()) {
            blender_ = find_blender(options.source.blender);
            result_.blender = blender_version(blender_);
        }
        references_.emplace(reference_source(), cache_folder() / "references", render_cache_, ladder_key());
        if (options.final_render) {
            ReferenceSet::Source source = reference_source();
            source.given.clear();
            source.bounces = k_own_light_paths;
            final_renders_.emplace(source, cache_folder() / "references", render_cache_,
                                   key_with(k_own_light_paths));
        }
        refuse_what_blender_cannot();
        not_exported_ = gltf_not_exported(gltf_);
        for (const std::string& line : not_exported_) {
            log::warning("{}", line);
        }
    }

    Evaluation run() {
        StoredRuns runs(options_, gltf_, result_.scene_sha256, scratch_.path());
        // The quick parts first: what is wrong with them shows before Cycles starts its minutes, and how
        // exact the reference has to be follows from their errors.
        {
            Progress progress("evaluate", static_cast<int>(runs.missing()));
            previews_ = runs.results([&](const std::string& note) { progress.step(note); });
        }
        run_peers();
        if (!options_.cycles_spp.empty()) {
            render_ladder();
        }
        render_references();
        render_final();
        motion_.emplace(options_.bounce, gltf_, options_.frames, options_.width, options_.height,
                        scratch_ / "motion");
        measure_cycles();
        measure_peers();
        measure_previews();
        fill_hdr_flip(result_, drawn_);
        keep_shown_pictures();
        measure_pass_times();
        describe();
        return std::move(result_);
    }

  private:
    [[nodiscard]] bool needs_cycles() const {
        return options_.given_reference.empty() || !options_.cycles_spp.empty() || options_.final_render;
    }

    [[nodiscard]] ReferenceSet::Source reference_source() const {
        return {options_.scene,  scene_hash_,      options_.frames,    options_.width,
                options_.height, options_.bounces, options_.reference, options_.given_reference,
                blender_,        result_.blender,  render_hash_};
    }

    void render_references() {
        const auto report = references_->render(
            [this](int frame, const Image& reference) { return smallest_error(frame, reference); });
        if (report && options_.cycles_spp.empty()) {
            result_.cycles = *report;
        }
        result_.references = references_->all();
    }

    void render_final() {
        if (!final_renders_) {
            return;
        }
        log::info("the scene by its own light paths:");
        (void)final_renders_->render(
            [this](int frame, const Image& target) { return smallest_error(frame, target); });
        FinalRender final;
        final.references = final_renders_->all();
        std::vector<RenderedFrame> matched;
        for (const Reference& reference : result_.references) {
            matched.push_back({reference.frame, reference.seconds, {}, &reference.image, {}});
        }
        final.matched = errors_against(matched, final_image());
        result_.final_render = std::move(final);
    }

    [[nodiscard]] ReferenceImage final_image() const {
        return [this](int frame) -> const Image& { return final_renders_->at(frame).image; };
    }

    // The least relMSE of all that was rendered of a frame, whoever rendered it.
    [[nodiscard]] double smallest_error(int frame, const Image& reference) const {
        double least = std::numeric_limits<double>::infinity();
        const auto take = [&](const Image& image) {
            const double error = relmse(image, reference);
            least = std::isfinite(error) ? std::min(least, error) : least;
        };
        for (const PreviewResult& run : previews_) {
            for (const PreviewFrame& item : run.frames) {
                if (item.frame == frame) take(read_image(item.image));
            }
        }
        for (const CyclesRender& render : result_.cycles.renders) {
            if (render.frame == frame && render.seed == k_seed_ladder) take(read_image(render.output));
        }
        for (const PeerResult& peer : result_.peers) {
            for (const PeerPoint& point : peer.points) {
                for (const PeerFrame& item : point.frames) {
                    if (item.frame == frame) take(item.render.image);
                }
            }
        }
        return least;
    }

    // Before Bounce's own points take their minutes. Where all of Cycles' pictures are kept, nothing is
    // refused.
    void refuse_what_blender_cannot() const {
        try {
            require_draco_library(options_.scene, blender_);
            require_camera();
        } catch (const Error&) {
            if (references_->lacks_any() || lacks_cycles_points() ||
                (final_renders_ && final_renders_->lacks_any())) {
                throw;
            }
        }
    }

    // Bounce frames a scene without a camera by itself; of a .blend Blender renders what it has.
    void require_camera() const {
        if (is_blend(options_.scene) && !gltf_names_camera(gltf_)) {
            throw input_error(
                fmt::format("{} has no active camera that Bounce and Cycles could both look through: set a "
                            "perspective or orthographic one",
                            options_.scene.string()));
        }
    }

    [[nodiscard]] CyclesKey key_with(int bounces) const {
        return [this, bounces](const CyclesRender& render) { return cycles_key(render, bounces); };
    }

    [[nodiscard]] CyclesKey ladder_key() const { return key_with(options_.bounces); }

    [[nodiscard]] bool lacks_cycles_points() const {
        return cycles_cache_lacks_any(ladder_job(), render_cache_, ladder_key(), options_.fresh);
    }

    // Cycles' own points; without one where there are none.
    [[nodiscard]] CyclesJob ladder_job() const {
        CyclesJob job;
        job.scene = options_.scene;
        job.width = options_.width;
        job.height = options_.height;
        job.bounces = options_.bounces;
        for (const int frame : options_.frames) {
            for (const int spp : options_.cycles_spp) {
                CyclesRender render;
                render.frame = frame;
                render.spp = spp;
                render.seed = k_seed_ladder;
                render.repeat = spp <= k_quick_spp ? k_quick_repeat : 1;
                render.output = scratch_ / fmt::format("cycles_{}_{}.exr", frame, spp);
                job.renders.push_back(render);
            }
        }
        return job;
    }

    void render_ladder() {
        const CyclesJob job = ladder_job();
        Progress progress("Cycles", static_cast<int>(job.renders.size()));
        result_.cycles = run_cycles_cached(
            job, blender_, render_cache_, ladder_key(), options_.fresh,
            [&](const CyclesRender& render, const CyclesReport&) { tell_cycles(progress, render, ""); });
    }

    [[nodiscard]] std::string cycles_key(const CyclesRender& render, int bounces) const {
        return peer_key(
            peer_job(), render.frame,
            fmt::format("Cycles, {} spp, seed {}, {}, median of {}\n{}", render.spp, render.seed,
                        bounces_text(bounces), render.repeat, cycles_scripts_hash(options_.scene)));
    }

    [[nodiscard]] const CyclesRender& find_render(int frame, int spp) const {
        return *std::find_if(result_.cycles.renders.begin(), result_.cycles.renders.end(),
                             [&](const auto& render) { return render.frame == frame && render.spp == spp; });
    }

    // A point of the last curve.
    CurvePoint& add_point(const std::string& label, std::vector<RenderedFrame> frames) {
        Curve& curve = result_.curves.back();
        const ReferenceImage reference = [this](int frame) -> const Image& {
            return references_->at(frame).image;
        };
        curve.points.push_back(measure_point(label, frames, reference, *motion_));
        if (final_renders_) {
            curve.points.back().final_errors = errors_against(frames, final_image());
        }
        drawn_.push_back({result_.curves.size() - 1, curve.points.size() - 1, std::move(frames)});
        return curve.points.back();
    }

    // Of a sweep of an animation all of them would not fit into memory.
    void keep_shown_pictures() {
        const auto shown = shown_points(result_);
        for (const RenderedPoint& drawn : drawn_) {
            const Curve& curve = result_.curves[drawn.curve];
            const std::string& label = curve.points[drawn.point].label;
            if (std::find(shown.begin(), shown.end(), std::pair{curve.name, label}) != shown.end()) {
                for (const RenderedFrame& frame : drawn.frames) {
                    result_.pictures.push_back({curve.name, label, frame.frame, frame.image()});
                }
            }
        }
    }

    void measure_cycles() {
        if (options_.cycles_spp.empty()) {
            return;
        }
        result_.curves.push_back({"Cycles", true, {}});
        for (const int spp : options_.cycles_spp) {
            std::vector<RenderedFrame> frames;
            double setup = 0.0;
            size_t memory = 0;
            std::string measured;
            for (const int frame : options_.frames) {
                const CyclesRender& render = find_render(frame, spp);
                frames.push_back({frame, render.seconds, render.output, nullptr, render.all_seconds});
                memory = std::max(memory, render.rss_peak_bytes);
                measured = render.measured.empty() ? measured : render.measured;
                setup += render.setup_seconds / static_cast<double>(options_.frames.size());
            }
            CurvePoint& point = add_point(fmt::format("{} spp", spp), std::move(frames));
            point.setup_seconds = setup;
            point.startup_seconds = result_.cycles.startup_seconds;
            point.rss_peak_bytes = memory;
            point.measured = measured;
        }
    }

    void measure_previews() {
        for (size_t i = 0; i < options_.runs.size(); ++i) {
            const PreviewRun& run = options_.runs[i];
            std::vector<RenderedFrame> frames;
            for (const PreviewFrame& frame : previews_[i].frames) {
                frames.push_back({frame.frame, frame.seconds, frame.image, nullptr, frame.all_seconds});
            }
            if (result_.curves.empty() || result_.curves.back().name != run.name) {
                result_.curves.push_back({run.name, false, {}});
            }
            CurvePoint& point = add_point(run.label, std::move(frames));
            point.startup_seconds = previews_[i].startup_seconds;
            point.rss_peak_bytes = previews_[i].rss_peak_bytes;
            point.gl_peak_bytes = previews_[i].gl_peak_bytes;
            point.options = run.render_arguments;
        }
        mark_pareto(result_.curves);
        result_.speedups = speedups_at_equal_error(result_.curves);
        result_.front = summarize_front(result_.curves, result_.speedups);
    }

    [[nodiscard]] PeerJob peer_job() const {
        return {options_.scene,  render_hash_,
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
                std::vector<RenderedFrame> frames;
                CurvePoint values;
                for (const PeerFrame& frame : point.frames) {
                    const CachedRender& render = frame.render;
                    frames.push_back({frame.frame, render.seconds, {}, &render.image, render.all_seconds});
                    values.startup_seconds = render.startup_seconds;
                    values.rss_peak_bytes = std::max(values.rss_peak_bytes, render.rss_peak_bytes);
                    values.measured = frame.cached ? render.date : values.measured;
                }
                if (result_.curves.empty() || result_.curves.back().name != point.curve) {
                    result_.curves.push_back({point.curve, false, {}, true});
                }
                CurvePoint& measured = add_point(point.label, std::move(frames));
                measured.startup_seconds = values.startup_seconds;
                measured.rss_peak_bytes = values.rss_peak_bytes;
                measured.measured = values.measured;
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
            // Passes of a mean of frames are those of its frames.
            const bool converges = std::find(run.render_arguments.begin(), run.render_arguments.end(),
                                             "--converge") != run.render_arguments.end();
            if (wanted && !converges) {
                result_.passes.push_back(measure_passes(
                    options_.bounce, gltf_, run, options_.frames.front(), options_.width, options_.height,
                    std::min(options_.repeat, k_most_pass_repeats), scratch_ / fmt::format("passes{}", i)));
            }
        }
    }

    void describe() {
        result_.startups = startups_of(result_, previews_, resolved_.export_seconds,
                                       measure_engine_starts(blender_, result_));
        result_.scene = options_.scene.filename().string();
        result_.cycles.notes.insert(result_.cycles.notes.begin(), not_exported_.begin(), not_exported_.end());
        result_.command = options_.command;
        result_.date = utc_now();
        result_.width = options_.width;
        result_.height = options_.height;
        result_.scene_hash = scene_hash_;
        result_.given_reference = options_.given_reference;
        result_.bounces = options_.bounces;
        result_.frames = options_.frames;
        result_.sequence_step = even_step(options_.frames);
        result_.motion = motion_->known();
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
    std::vector<std::string> not_exported_;
    std::string scene_hash_;   // of the content
    std::string render_hash_;  // of what Blender's renders depend on
    RenderCache render_cache_;
    std::optional<ReferenceSet> references_;
    std::optional<ReferenceSet> final_renders_;  // by the scene's own light paths
    std::vector<PreviewResult> previews_;
    std::optional<MotionLayers> motion_;
    std::vector<RenderedPoint> drawn_;
    Evaluation result_;
};

}  // namespace

Evaluation evaluate(const EvaluateOptions& options) {
    remove_abandoned_scratch_folders();
    return Evaluator(options).run();
}

}  // namespace bounce
