// SPDX-License-Identifier: Apache-2.0
#include "cli/stats.h"

#include <algorithm>

#include <nlohmann/json.hpp>
#include <sys/resource.h>

#include "core/atomic_file.h"
#include "gl/memory.h"

namespace bounce::cli {
namespace {

using nlohmann::ordered_json;

size_t peak_resident_bytes() {
    rusage usage{};
    getrusage(RUSAGE_SELF, &usage);
    return static_cast<size_t>(usage.ru_maxrss) * 1024U;  // Linux counts kibibytes
}

ordered_json left_out_json(const std::vector<LeftOut>& left_out) {
    ordered_json out = ordered_json::array();
    for (const LeftOut& item : left_out) {
        out.push_back({{"pass", item.pass}, {"reason", item.reason}});
    }
    return out;
}

ordered_json frame_json(const FrameStats& frame, int pixels) {
    ordered_json out = {{"frame", frame.frame},
                        {"time_s", frame.time_s},
                        {"wall_ms", frame.wall_ms()},
                        {"wall_ms_all", frame.all_wall_ms}};
    out["passes"] = ordered_json::array();
    for (const gl::PassTime& pass : frame.report.passes) {
        out["passes"].push_back({{"name", pass.name}, {"gpu_ms", pass.gpu_ms}, {"cpu_ms", pass.cpu_ms}});
    }
    out["executed"] = frame.report.executed;
    if (frame.report.gathered_pixels >= 0) {
        out["gathered_pixels"] = frame.report.gathered_pixels;
        out["gathered_share"] = static_cast<double>(frame.report.gathered_pixels) / pixels;
    }
    return out;
}

}  // namespace

double FrameStats::wall_ms() const {
    if (all_wall_ms.empty()) {
        return 0.0;
    }
    std::vector<double> sorted = all_wall_ms;
    std::sort(sorted.begin(), sorted.end());
    const size_t middle = sorted.size() / 2;
    return sorted.size() % 2 == 1 ? sorted[middle] : 0.5 * (sorted[middle - 1] + sorted[middle]);
}

void StatsFile::write(const std::filesystem::path& path) const {
    ordered_json out = {{"schema", "bounce.stats/1"}, {"scene", scene_}};
    out["gl"] = {{"vendor", device_.vendor},
                 {"renderer", device_.renderer},
                 {"version", device_.version},
                 {"timing", device_.software ? "finish" : "query"}};
    out["settings"] = {{"width", settings_.width},
                       {"height", settings_.height},
                       {"technique", options_.technique},
                       {"show", options_.show},
                       {"rsm_samples", options_.samples},
                       {"rsm_pattern", options_.pattern},
                       {"rsm_interpolation", settings_.interpolate},
                       {"rsm_lowres", settings_.lowres_step},
                       {"rsm_size", settings_.rsm_size},
                       {"shadow_size", settings_.shadow_size}};
    out["frames"] = ordered_json::array();
    for (const FrameStats& frame : frames_) {
        out["frames"].push_back(frame_json(frame, settings_.width * settings_.height));
    }
    const FrameReport last = frames_.empty() ? FrameReport{} : frames_.back().report;
    out["left_out"] = left_out_json(last.left_out);
    out["approximations"] = last.approximations;
    out["counts"] = {
        {"triangles", last.triangles}, {"vpls", last.rsm_samples}, {"points", 0}, {"lights", last.lights}};
    out["memory"] = {{"gl_peak_bytes", gl::peak_allocated_bytes()},
                     {"rss_peak_bytes", peak_resident_bytes()}};
    write_text_file(path, out.dump(2) + "\n");
}

}  // namespace bounce::cli
