// SPDX-License-Identifier: Apache-2.0
#include "evaluate/startup.h"

#include <algorithm>

namespace bounce {
namespace {

// The middle of a curve's points; start-up hardly depends on the point, and one slow start is not the
// engine's.
double median_startup(const Evaluation& evaluation, bool (*counts)(const Curve&)) {
    std::vector<double> seconds;
    for (const Curve& curve : evaluation.curves) {
        if (counts(curve)) {
            for (const CurvePoint& point : curve.points) {
                seconds.push_back(point.startup_seconds);
            }
        }
    }
    if (seconds.empty()) {
        return 0.0;
    }
    std::sort(seconds.begin(), seconds.end());
    return seconds[seconds.size() / 2];
}

}  // namespace

std::vector<StartUp> startups_of(const Evaluation& evaluation, double export_seconds) {
    std::vector<StartUp> rows;
    const bool has_own =
        std::any_of(evaluation.curves.begin(), evaluation.curves.end(),
                    [](const Curve& curve) { return !curve.reference_engine && !curve.peer; });
    if (has_own) {
        rows.push_back(
            {"Bounce", export_seconds,
             median_startup(evaluation,
                            [](const Curve& curve) { return !curve.reference_engine && !curve.peer; }),
             0.0, "Start, load, shaders, a first frame and writing files together; the median of the runs."});
    }
    if (!evaluation.cycles.version.empty()) {
        rows.push_back({"Cycles", 0.0, evaluation.cycles.startup_seconds,
                        evaluation.cycles.first_render_seconds,
                        "Blender's start and opening the scene; then a first render of one sample."});
    }
    for (const PeerResult& peer : evaluation.peers) {
        if (peer.points.empty()) {
            continue;
        }
        const CachedRender& first = peer.points.front().frames.front().render;
        const bool eevee = first.first_render_seconds > 0.0;
        rows.push_back(
            {peer.name, first.export_seconds, first.startup_seconds, first.first_render_seconds,
             eevee ? "The display's and Blender's start and opening the scene; then a first render, which "
                     "compiles shaders."
                   : "The display's start, start, load, shaders and writing the file together."});
    }
    return rows;
}

}  // namespace bounce
