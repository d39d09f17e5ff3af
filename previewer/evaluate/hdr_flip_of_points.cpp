// SPDX-License-Identifier: Apache-2.0
#include "evaluate/hdr_flip_of_points.h"

#include <algorithm>

#include <fmt/format.h>

#include "core/progress.h"
#include "evaluate/report.h"
#include "image/flip.h"

namespace bounce {
namespace {

// A picture and where its figure goes.
struct Task {
    const RenderedFrame* picture;
    FrameError* error;
};

size_t cost_of(const Reference& reference, size_t pictures) {
    const auto exposures = static_cast<size_t>(flip_exposures(reference.image).count);
    return (pictures + 1) * exposures * (reference.image.rgb.size() / 3);
}

std::vector<Task> tasks_of(Evaluation& evaluation, const std::vector<RenderedPoint>& points, int frame) {
    std::vector<Task> tasks;
    for (const RenderedPoint& drawn : points) {
        CurvePoint& point = evaluation.curves[drawn.curve].points[drawn.point];
        for (size_t i = 0; i < drawn.frames.size(); ++i) {
            if (drawn.frames[i].frame == frame && point.frames[i].not_finite == 0) {
                tasks.push_back({&drawn.frames[i], &point.frames[i]});
            }
        }
    }
    return tasks;
}

}  // namespace

void fill_hdr_flip(Evaluation& evaluation, const std::vector<RenderedPoint>& points, size_t most) {
    size_t cost = 0;
    for (const Reference& reference : evaluation.references) {
        cost += cost_of(reference, tasks_of(evaluation, points, reference.frame).size());
    }
    std::vector<RenderedPoint> wanted = points;
    if (cost > most) {
        const auto shown = shown_points(evaluation);
        std::erase_if(wanted, [&](const RenderedPoint& drawn) {
            const Curve& curve = evaluation.curves[drawn.curve];
            return std::find(shown.begin(), shown.end(),
                             std::pair{curve.name, curve.points[drawn.point].label}) == shown.end();
        });
    }
    Progress progress("HDR-FLIP", static_cast<int>(evaluation.references.size()));
    for (const Reference& reference : evaluation.references) {
        const HdrFlipReference target(reference.image);
        for (const Task& task : tasks_of(evaluation, wanted, reference.frame)) {
            task.error->flip_hdr = mean(target.error_of(task.picture->image()));
        }
        progress.step(fmt::format("frame {}", reference.frame));
    }
    for (const RenderedPoint& drawn : wanted) {
        CurvePoint& point = evaluation.curves[drawn.curve].points[drawn.point];
        point.flip_hdr = mean_of_frames(point.frames, &FrameError::flip_hdr);
    }
}

}  // namespace bounce
