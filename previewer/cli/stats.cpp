// SPDX-License-Identifier: Apache-2.0
#include "cli/stats.h"

#include <algorithm>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "core/atomic_file.h"
#include "core/process.h"
#include "gl/memory.h"
#include "renderer/setting_names.h"

namespace bounce::cli {
namespace {

using nlohmann::ordered_json;

double median(std::vector<double> values) {
    if (values.empty()) {
        return 0.0;
    }
    std::sort(values.begin(), values.end());
    const size_t middle = values.size() / 2;
    return values.size() % 2 == 1 ? values[middle] : 0.5 * (values[middle - 1] + values[middle]);
}

ordered_json left_out_json(const std::vector<LeftOut>& left_out) {
    ordered_json out = ordered_json::array();
    for (const LeftOut& item : left_out) {
        out.push_back({{"pass", item.pass}, {"reason", item.reason}});
    }
    return out;
}

const char* end_name(ConvergeEnd end) {
    switch (end) {
        case ConvergeEnd::relmse:
            return "relmse";
        case ConvergeEnd::seconds:
            return "time";
        case ConvergeEnd::passes:
            return "passes";
        case ConvergeEnd::out_of_reach:
            return "target out of reach";
        case ConvergeEnd::stopped:
            return "interrupted";
    }
    return "";
}

// Not known is null.
ordered_json state_json(const ConvergeState& state) {
    ordered_json out = {{"passes", state.passes}, {"seconds", state.seconds}};
    for (const auto& [name, value] :
         {std::pair("relmse", state.relmse), std::pair("relmse_low", state.relmse_low),
          std::pair("relmse_high", state.relmse_high)}) {
        out[name] = value >= 0.0 ? ordered_json(value) : ordered_json();
    }
    return out;
}

ordered_json converged_json(const Converged& converged) {
    ordered_json out = state_json(converged.state);
    out["ended_by"] = end_name(converged.end);
    out["history"] = ordered_json::array();
    for (const ConvergeState& state : converged.history) {
        out["history"].push_back(state_json(state));
    }
    return out;
}

ordered_json frame_json(const FrameStats& frame, int pixels) {
    ordered_json out = {{"frame", frame.frame},
                        {"time_s", frame.time_s},
                        {"wall_ms", frame.wall_ms()},
                        {"wall_ms_all", frame.all_wall_ms}};
    out["passes"] = ordered_json::array();
    const std::vector<gl::PassTime> none;
    const std::vector<gl::PassTime>& passes = frame.all_passes.empty() ? none : frame.all_passes.front();
    for (size_t i = 0; i < passes.size(); ++i) {
        // A frame is planned the same way each time it is drawn, so its passes are the same ones.
        std::vector<double> gpu_ms;
        std::vector<double> cpu_ms;
        for (const std::vector<gl::PassTime>& repetition : frame.all_passes) {
            gpu_ms.push_back(repetition.at(i).gpu_ms);
            cpu_ms.push_back(repetition.at(i).cpu_ms);
        }
        out["passes"].push_back({{"name", passes[i].name},
                                 {"gpu_ms", median(gpu_ms)},
                                 {"cpu_ms", median(cpu_ms)},
                                 {"gpu_ms_all", gpu_ms}});
    }
    out["executed"] = frame.report.executed;
    if (frame.report.gathered_pixels >= 0) {
        out["gathered_pixels"] = frame.report.gathered_pixels;
        out["gathered_share"] = static_cast<double>(frame.report.gathered_pixels) / pixels;
    }
    if (frame.converged) {
        out["converged"] = converged_json(*frame.converged);
    }
    if (frame.report.reuse) {
        const FrameReport::Reuse& reuse = *frame.report.reuse;
        out["temporal_reuse"] = {
            {"reused_share", reuse.share >= 0.0 ? ordered_json(reuse.share) : ordered_json(nullptr)},
            {"reset", reuse.reason.empty() ? ordered_json(nullptr) : ordered_json(reuse.reason)}};
    }
    if (frame.report.splat) {
        out["splat"] = {{"chosen", name_of(frame.report.splat->splat)},
                        {"reason", frame.report.splat->reason}};
    }
    if (frame.report.removed) {
        out["removed"] = {{"indirect_mean", frame.report.removed->indirect},
                          {"removed_mean", frame.report.removed->removed},
                          {"bias", frame.report.removed->bias()}};
    }
    return out;
}

// A float's shortest digits, not the nearest double's.
double short_digits(float value) {
    return std::stod(fmt::format("{}", value));
}

// How points are splatted into imperfect shadow maps.
void add_splats(const Settings& s, ordered_json& out) {
    out["points"] = s.ism_points > 0 ? ordered_json(s.ism_points) : ordered_json("auto");
    out["splat"] = name_of(s.splat);
    out["hull"] = s.drop_hull ? "drop" : "splat";
    if (s.splat == Splat::disks) {
        out["large_triangles"] = s.large_triangles;
        return;
    }
    out["pull_push"] = name_of(s.pull_push);
    out["pull_push_levels"] = s.pull_push_levels;
    out["pull_threshold"] = short_digits(s.pull_threshold);
    out["push_threshold"] = short_digits(s.push_threshold);
}

ordered_json settings_json(const Settings& s) {
    ordered_json out = {{"width", s.width},
                        {"height", s.height},
                        {"technique", name_of(s.technique)},
                        {"show", name_of(s.show)},
                        {"shadow_size", s.shadow_size},
                        {"antialias", s.antialias},
                        {"samples", s.samples},
                        {"world_vpls", s.world_vpls},
                        {"emitter_vpls", s.emitter_vpls},
                        {"emitter_panels", s.emitter_panels},
                        {"transparent_layers", s.transparent_layers}};
    if (s.forced != Forced::nothing) {
        out["forced"] = name_of(s.forced);
    }
    out["world_sampling"] = name_of(s.world_sampling);
    out["direct_shadows"] = name_of(s.direct_shadows);
    if (s.direct_shadows == DirectShadows::vpl || s.direct_shadows == DirectShadows::ism) {
        out["shadow_samples"] = s.used_shadow_samples();
        out["soft_shadow_size"] = s.used_soft_shadow_size();
    } else if (s.direct_shadows == DirectShadows::convolution) {
        out["soft_shadow_size"] = s.used_soft_shadow_size();
        out["convolution_order"] = s.convolution_order;
    }
    if (s.technique != Technique::direct) {
        out["rsm_size"] = s.used_rsm_size();
        out["bounce_places"] = s.bounce_places;
    }
    if (s.technique == Technique::rsm) {
        out["rsm_samples"] = s.rsm_full_sum ? ordered_json("all") : ordered_json(s.rsm_samples);
        out["rsm_pattern"] = name_of(s.rsm_pattern);
        out["rsm_interpolation"] = s.interpolate;
        out["rsm_lowres"] = s.lowres_step;
    }
    if (s.technique != Technique::ism) {
        if (s.direct_shadows == DirectShadows::ism) {
            add_splats(s, out);
        }
        return out;
    }
    out["vpls"] = s.vpls;
    out["bounces"] = s.bounces;
    if (s.bounces > 1) {
        out["bounce_vpls"] = s.bounce_vpls;
        out["bounce_source"] = name_of(s.bounce_source);
    }
    if (s.uses_avg()) {
        out["avg_size"] = s.avg_size;
        out["avg_hits"] = name_of(s.avg_hits);
        out["avg_paths"] = name_of(s.avg_paths);
    }
    out["interleave"] = s.interleave;
    out["temporal_reuse"] = s.temporal_reuse;
    out["near_field"] = s.near_field;
    out["glossy"] = s.glossy_bounces;
    out["vpl_sampling"] = name_of(s.vpl_sampling);
    out["vpl_importance"] = name_of(s.vpl_importance);
    if (s.vpl_importance == Importance::view) {
        out["importance_pixels"] = s.importance_pixels;
        out["importance_floor"] = s.importance_floor;
    }
    if (passes::is_chain(s.vpl_sampling)) {
        out["vpl_steps"] = s.vpl_steps;
    }
    out["shading"] = name_of(s.shading);
    if (s.simplifies()) {
        out["simplify"] = s.simplify.ratio > 0.0 ? ordered_json(s.simplify.ratio) : ordered_json("auto");
        out["simplify_error"] = s.simplify.error;
    }
    out["visibility"] = name_of(s.visibility);
    if (s.draws_triangle_maps()) {
        out["map_projection"] = name_of(s.map_projection);
    }
    if (s.visibility != Visibility::none) {
        out["ism_size"] = s.ism_size;
    }
    if (s.visibility == Visibility::ism || s.direct_shadows == DirectShadows::ism) {
        add_splats(s, out);
    }
    return out;
}

ordered_json counts_json(const FrameReport& report) {
    return {{"triangles", report.triangles},
            {"simplified_triangles", report.simplified_triangles},
            {"simplified_error_m", report.simplified_error_m},
            {"lights", report.lights},
            {"vpls", report.vpls},
            {"rsm_samples", report.rsm_samples},
            {"points", report.points},
            {"points_a_map", report.points_a_map},
            {"shadow_points_a_map", report.shadow_points_a_map},
            {"large_triangles", report.large_triangles},
            {"map_size", report.map_size},
            {"atlas", {report.atlas_width, report.atlas_height}}};
}

// What any frame says, once each: some of it is found out in the first frame alone.
template <typename Item>
std::vector<Item> said_by_any(const std::vector<FrameStats>& frames, std::vector<Item> FrameReport::*items) {
    std::vector<Item> all;
    for (const FrameStats& frame : frames) {
        for (const Item& item : frame.report.*items) {
            if (std::find(all.begin(), all.end(), item) == all.end()) {
                all.push_back(item);
            }
        }
    }
    return all;
}

}  // namespace

double FrameStats::wall_ms() const {
    return median(all_wall_ms);
}

void StatsFile::write(const std::filesystem::path& path) const {
    ordered_json out = {{"schema", "bounce.stats/1"}, {"scene", scene_}};
    out["gl"] = {{"vendor", device_.vendor},
                 {"renderer", device_.renderer},
                 {"version", device_.version},
                 {"timing", device_.software ? "finish" : "query"}};
    out["startup"] = {{"context_ms", start_.context_ms},
                      {"load_ms", start_.load_ms},
                      {"upload_ms", start_.upload_ms},
                      {"first_frame_ms", start_.first_frame_ms}};
    out["settings"] = settings_json(settings_);
    if (!automatic_.is_null()) {
        out["auto"] = automatic_;
    }
    out["frames"] = ordered_json::array();
    for (const FrameStats& frame : frames_) {
        out["frames"].push_back(frame_json(frame, settings_.width * settings_.height));
    }
    const FrameReport last = frames_.empty() ? FrameReport{} : frames_.back().report;
    out["left_out"] = left_out_json(last.left_out);
    out["approximations"] = last.approximations;
    out["notes"] = said_by_any(frames_, &FrameReport::notes);
    out["counts"] = counts_json(last);
    out["memory"] = {{"gl_peak_bytes", gl::peak_allocated_bytes()},
                     {"rss_peak_bytes", peak_resident_bytes()}};
    out["run_ms"] = run_.ms();
    // A file's name may be no UTF-8.
    write_text_file(path, out.dump(2, ' ', false, ordered_json::error_handler_t::replace) + "\n");
}

}  // namespace bounce::cli
