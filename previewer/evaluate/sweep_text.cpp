// SPDX-License-Identifier: Apache-2.0
#include "evaluate/sweep_text.h"

#include <algorithm>

#include <fmt/format.h>
#include <fmt/ranges.h>

namespace bounce {

std::string front_text(const Evaluation& evaluation) {
    const FrontSummary& front = evaluation.front;
    if (front.compared == 0) {
        return fmt::format(
            "Bounce's own Pareto front has {} points; none of them has a time to equal error.\n",
            front.points);
    }
    return fmt::format(
        "Bounce's own Pareto front, {} points: Cycles takes {:.3g} times as long to equal error (geometric "
        "mean over "
        "{}; {} extrapolated, {} upper bounds), at worst {:.3g} times ({}, {}).\n",
        front.points, front.geometric_mean_ratio, front.compared, front.extrapolated, front.upper_bounds,
        front.least_ratio, front.least_curve, front.least_label);
}

std::string budgets_text(const Tuning& tuning) {
    std::string text;
    for (const double budget : k_budgets_ms) {
        const auto found = std::find_if(tuning.budgets.begin(), tuning.budgets.end(),
                                        [&](const TunedSettings& item) { return item.budget_ms == budget; });
        if (found == tuning.budgets.end()) {
            text += fmt::format("within {:>5.0f} ms: no point is as fast\n", budget);
        } else {
            text += fmt::format("within {:>5.0f} ms: relMSE {:.3g}, {:.1f} ms: {}\n", budget, found->relmse,
                                1000.0 * found->seconds, fmt::join(found->options, " "));
        }
    }
    return text;
}

}  // namespace bounce
