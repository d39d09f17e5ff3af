// SPDX-License-Identifier: Apache-2.0
#include "evaluate/startup.h"

#include <algorithm>

#include <fmt/format.h>

namespace bounce {
namespace {

// The middle of the runs; start-up hardly depends on their settings, and one slow start is not the engine's.
double median(const std::vector<PreviewResult>& previews, double PreviewResult::*part) {
    std::vector<double> seconds;
    seconds.reserve(previews.size());
    for (const PreviewResult& preview : previews) {
        seconds.push_back(preview.*part);
    }
    std::sort(seconds.begin(), seconds.end());
    return 0.5 * (seconds[(seconds.size() - 1) / 2] + seconds[seconds.size() / 2]);
}

// Takes a part that was measured in another run off a whole: 0 and the whole where it does not fit, as on a
// machine that was busier then.
double take_off(double& whole, double part) {
    if (part <= 0.0 || part >= whole) {
        return 0.0;
    }
    whole -= part;
    return part;
}

StartUp of_blender(const char* engine, double together, double first_render, double display, double blender,
                   const char* first) {
    StartUp row;
    row.engine = engine;
    row.first_render_seconds = first_render;
    row.load_seconds = together;
    row.display_seconds = take_off(row.load_seconds, display);
    row.start_seconds = take_off(row.load_seconds, blender);
    row.note =
        row.start_seconds > 0.0
            ? "Start: of Blender with nothing to open, timed by itself. Load: from there to the open scene. "
            : "Load: Blender's start and opening the scene, which this run cannot tell apart. ";
    row.note += first;
    return row;
}

StartUp of_f3d(const CachedRender& render, const EngineStarts& starts) {
    StartUp row;
    row.engine = "f3d";
    row.export_seconds = render.export_seconds;
    row.first_render_seconds = render.first_render_seconds;
    row.load_seconds = render.startup_seconds - render.first_render_seconds;
    // The display starts before the window opens; without a time of the load apart it is in that.
    double& with_window = row.first_render_seconds > 0.0 ? row.first_render_seconds : row.load_seconds;
    row.display_seconds = take_off(with_window, starts.display);
    row.start_seconds = take_off(row.load_seconds, starts.f3d);
    const char* start = row.start_seconds > 0.0 ? "" : "the program's start, ";
    row.note = row.start_seconds > 0.0
                   ? "Start: of the program and its libraries (f3d --version), timed by itself. "
                   : "";
    row.note += row.first_render_seconds > 0.0
                    ? fmt::format(
                          "Load: {}the file (f3d --no-render). First render: window, shaders, a frame and "
                          "writing it.",
                          start)
                    : fmt::format(
                          "Load: {}window, file, shaders, a first frame and writing it, which this f3d "
                          "does not tell apart.",
                          start);
    return row;
}

}  // namespace

std::vector<StartUp> startups_of(const Evaluation& evaluation, const std::vector<PreviewResult>& previews,
                                 double export_seconds, const EngineStarts& starts) {
    std::vector<StartUp> rows;
    if (!previews.empty()) {
        rows.push_back(
            {"Bounce", export_seconds, 0.0, median(previews, &PreviewResult::start_seconds),
             median(previews, &PreviewResult::load_seconds),
             median(previews, &PreviewResult::first_frame_seconds),
             "Start: the process and its OpenGL context. Load: reading and decoding the glTF file, "
             "taking it to OpenGL. First render: with its shaders, from the driver's cache where it "
             "has them. Each the median of the runs."});
    }
    if (!evaluation.cycles.version.empty()) {
        rows.push_back(of_blender("Cycles", evaluation.cycles.startup_seconds,
                                  evaluation.cycles.first_render_seconds, 0.0, starts.blender,
                                  "First render: one sample."));
    }
    for (const PeerResult& peer : evaluation.peers) {
        if (peer.points.empty()) {
            continue;
        }
        const CachedRender& first = peer.points.front().frames.front().render;
        rows.push_back(peer.name == "f3d"
                           ? of_f3d(first, starts)
                           : of_blender(peer.name.c_str(), first.startup_seconds, first.first_render_seconds,
                                        starts.display, starts.blender, "First render: compiles shaders."));
    }
    return rows;
}

}  // namespace bounce
