// SPDX-License-Identifier: Apache-2.0
#include "bench/walks.h"

namespace bounce::bench {
Image draw_shot(const BenchInputs& inputs, Renderer& renderer, const Shot& shot, const Settings& settings,
                const Moment* before) {
    inputs.interrupts.throw_if_interrupted("nothing is written");
    (void)renderer.render(shot.pose, shot.camera, settings, gl::TimingMode::off, before);
    return renderer.read_color();
}

Walk make_walk(const BenchInputs& inputs, Renderer& renderer, const Motion& motion, int frames,
               const Settings& reference) {
    Settings layer = reference;
    layer.show = Show::motion;
    Walk out;
    out.name = motion.name;
    for (int frame = 0; frame < frames; ++frame) {
        out.shots.push_back(motion.shot(frame));
        out.references.push_back(draw_shot(inputs, renderer, out.shots.back(), reference));
        if (frame == 0) {
            out.motions.emplace_back();
        } else {
            const Shot& before = out.shots[out.shots.size() - 2];
            const Moment moment{before.pose, before.camera};
            out.motions.push_back(draw_shot(inputs, renderer, out.shots.back(), layer, &moment));
        }
    }
    return out;
}

SequenceMetrics run_walk(const BenchInputs& inputs, Renderer& renderer, const Walk& walk,
                         const Settings& settings) {
    SequenceMeter meter(HdrFlip::leave_out);
    for (size_t i = 0; i < walk.shots.size(); ++i) {
        const Image image = draw_shot(inputs, renderer, walk.shots[i], settings);
        meter.add(static_cast<int>(i), image, &walk.references[i], i == 0 ? nullptr : &walk.motions[i]);
    }
    return meter.finish();
}

double mean_nrmse(const SequenceMetrics& metrics) {
    double sum = 0.0;
    for (const SequenceFrame& frame : metrics.frames) {
        sum += frame.error->nrmse;  // a walk has a reference in every frame
    }
    return sum / static_cast<double>(metrics.frames.size());
}

double mean_bias(const SequenceMetrics& metrics) {
    double sum = 0.0;
    for (const SequenceFrame& frame : metrics.frames) {
        sum += frame.error->bias;
    }
    return sum / static_cast<double>(metrics.frames.size());
}

}  // namespace bounce::bench
