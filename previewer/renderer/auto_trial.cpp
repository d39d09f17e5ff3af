// SPDX-License-Identifier: Apache-2.0
#include "renderer/auto_trial.h"

#include <algorithm>
#include <vector>

#include "core/stopwatch.h"
#include "gl/pass_timer.h"
#include "renderer/auto_cost.h"

namespace bounce {
namespace {

constexpr int k_rounds = 6;
constexpr int k_frames = 5;                // of a choice, after a warm-up
constexpr double k_long_frame_ms = 500.0;  // of these one is enough: what disturbs it is short against it

struct Tried {
    AutoChoice choice;
    double speed = 1.0;
    double ms = 0.0;
};

double time_frames(Renderer& renderer, std::span<const Moment> moments, const Settings& settings,
                   int& frames) {
    size_t next = 0;
    const auto once = [&] {
        const Moment& moment = moments[next++ % moments.size()];
        glFinish();
        const Stopwatch watch;
        (void)renderer.render(moment.pose, moment.camera, settings);
        glFinish();
        const double ms = watch.ms();
        if (moments.size() > 1) {
            renderer.keep_frame();
        }
        ++frames;
        return ms;
    };
    (void)once();
    std::vector<double> times{once()};
    while (times.front() < k_long_frame_ms && times.size() < k_frames) {
        times.push_back(once());
    }
    std::nth_element(times.begin(), times.begin() + static_cast<std::ptrdiff_t>(times.size() / 2),
                     times.end());
    return times[times.size() / 2];
}

}  // namespace

AutoTrial choose_on_trial(Renderer& renderer, std::span<const Moment> moments, const AutoScene& scene,
                          const AutoRequest& request) {
    AutoTrial out;
    std::vector<Tried> tried;
    double speed = speed_class(request.machine_speed);
    for (int round = 0; round < k_rounds; ++round) {
        AutoRequest at_speed = request;
        at_speed.machine_speed = speed;
        const AutoChoice choice = choose_settings(scene, at_speed);
        const double units_ms = frame_cost_ms(scene, choice.settings);
        const bool known = std::any_of(tried.begin(), tried.end(), [&](const Tried& before) {
            return frame_cost_ms(scene, before.choice.settings) == units_ms &&
                   before.choice.predicted_relmse == choice.predicted_relmse;
        });
        if (known) {
            break;
        }
        const double ms = time_frames(renderer, moments, choice.settings, out.frames);
        tried.push_back({choice, speed, ms});
        speed = speed_class(units_ms / std::max(ms, 1e-3));
    }
    renderer.forget_history();
    const auto fits = [&](const Tried& one) { return one.ms <= *request.budget_ms; };
    const auto best = std::min_element(tried.begin(), tried.end(), [&](const Tried& a, const Tried& b) {
        if (fits(a) != fits(b)) {
            return fits(a);
        }
        return fits(a) ? a.choice.predicted_relmse < b.choice.predicted_relmse : a.ms < b.ms;
    });
    out.choice = best->choice;
    out.machine_speed = best->speed;
    out.measured_ms = best->ms;
    return out;
}

}  // namespace bounce
