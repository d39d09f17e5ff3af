// SPDX-License-Identifier: Apache-2.0
#include "renderer/auto_choice.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include <fmt/format.h>

#include "renderer/auto_cost.h"
#include "renderer/auto_knobs.h"
#include "renderer/settings_check.h"

namespace bounce {
namespace {

// Times vary by as much from frame to frame: settings fill this part of a budget.
constexpr double k_budget_use = 0.95;

// Settings of one technique, a level for each knob that may be turned.
class Ladder {
  public:
    Ladder(const AutoScene& scene, const AutoRequest& request, Technique technique)
        : scene_(scene), settings_(request.base), floor_(least_error(scene, technique)) {
        settings_.technique = technique;
        for (KnobCurve& curve : knob_curves(scene, technique)) {
            if (!request.fixed.test(bit_of(curve.knob))) {
                curves_.push_back(std::move(curve));
            }
        }
        levels_.assign(curves_.size(), 0);
        apply();
    }

    [[nodiscard]] const Settings& settings() const { return settings_; }
    [[nodiscard]] double cost_ms() const { return frame_cost_ms(scene_, settings_); }
    [[nodiscard]] double error() const {
        double sum = floor_;
        for (size_t i = 0; i < curves_.size(); ++i) {
            sum += curves_[i].levels[levels_[i]].error;
        }
        return sum;
    }

    void take_standard() {
        for (size_t i = 0; i < curves_.size(); ++i) {
            const auto& levels = curves_[i].levels;
            const auto found = std::find_if(levels.begin(), levels.end(),
                                            [](const KnobLevel& level) { return level.standard; });
            levels_[i] = static_cast<size_t>(found - levels.begin());
        }
        apply();
    }

    // Goes down by the step that costs the least error a millisecond; false where no step saves time.
    bool step_down() {
        const double cost = cost_ms();
        double best = std::numeric_limits<double>::infinity();
        std::pair<size_t, size_t> step{curves_.size(), 0};
        for (size_t i = 0; i < curves_.size(); ++i) {
            for (size_t level = levels_[i] + 1; level < curves_[i].levels.size(); ++level) {
                const double saved = cost - cost_with(i, level);
                const double lost = curves_[i].levels[level].error - curves_[i].levels[levels_[i]].error;
                if (saved > 0.0 && lost / saved < best) {
                    best = lost / saved;
                    step = {i, level};
                }
            }
        }
        return take(step);
    }

    // Goes up by the step that takes away the most error among those within the limit; false where there is
    // none.
    bool step_up(double limit_ms) {
        double best = 0.0;
        std::pair<size_t, size_t> step{curves_.size(), 0};
        for (size_t i = 0; i < curves_.size(); ++i) {
            for (size_t level = 0; level < levels_[i]; ++level) {
                const double gained = curves_[i].levels[levels_[i]].error - curves_[i].levels[level].error;
                if (gained > best && cost_with(i, level) <= limit_ms) {
                    best = gained;
                    step = {i, level};
                }
            }
        }
        return take(step);
    }

    // The same for an error that may be as large as the limit: the step that saves the most time.
    bool step_down_to(double limit_error) {
        const double cost = cost_ms();
        double best = 0.0;
        std::pair<size_t, size_t> step{curves_.size(), 0};
        for (size_t i = 0; i < curves_.size(); ++i) {
            for (size_t level = levels_[i] + 1; level < curves_[i].levels.size(); ++level) {
                const double saved = cost - cost_with(i, level);
                const double lost = curves_[i].levels[level].error - curves_[i].levels[levels_[i]].error;
                if (saved > 0.0 && error() + lost <= limit_error && saved / std::max(lost, 1e-9) > best) {
                    best = saved / std::max(lost, 1e-9);
                    step = {i, level};
                }
            }
        }
        return take(step);
    }

    // What was given up and what was won against the standard, the largest errors first.
    [[nodiscard]] std::vector<std::pair<const KnobCurve*, size_t>> changes() const {
        std::vector<std::pair<const KnobCurve*, size_t>> out;
        for (size_t i = 0; i < curves_.size(); ++i) {
            if (!curves_[i].levels[levels_[i]].standard) {
                out.emplace_back(&curves_[i], levels_[i]);
            }
        }
        std::stable_sort(out.begin(), out.end(), [](const auto& a, const auto& b) {
            return a.first->levels[a.second].error > b.first->levels[b.second].error;
        });
        return out;
    }

  private:
    bool take(std::pair<size_t, size_t> step) {
        if (step.first == curves_.size()) {
            return false;
        }
        levels_[step.first] = step.second;
        apply();
        return true;
    }
    void apply() {
        for (size_t i = 0; i < curves_.size(); ++i) {
            set_knob(settings_, curves_[i].knob, curves_[i].levels[levels_[i]].value);
        }
    }
    [[nodiscard]] double cost_with(size_t curve, size_t level) const {
        Settings with = settings_;
        set_knob(with, curves_[curve].knob, curves_[curve].levels[level].value);
        return frame_cost_ms(scene_, with);
    }

    const AutoScene& scene_;
    Settings settings_;
    double floor_;
    std::vector<KnobCurve> curves_;
    std::vector<size_t> levels_;  // one a curve
};

// Whether light bounces at all; the reason why not otherwise.
const char* no_bounce(const AutoScene& scene) {
    if (scene.features.triangles == 0) {
        return "Nothing is there to light.";
    }
    if (!scene.lit()) {
        return "No light shines, so none bounces.";
    }
    if (!scene.features.reflects) {
        return "Every surface is black, so no light bounces off one.";
    }
    return nullptr;
}

std::vector<Technique> techniques(const AutoScene& scene, const AutoRequest& request) {
    if (request.fixed.test(bit_of(Knob::technique))) {
        return {request.base.technique};
    }
    if (no_bounce(scene) != nullptr) {
        return {Technique::direct};
    }
    std::vector<Technique> out{Technique::ism};
    if (request.base.bounces == 1 && scene.lights() > 0) {
        out.push_back(Technique::rsm);  // it has one bounce, of lights alone
    }
    out.push_back(Technique::direct);
    return out;
}

std::string percent(double share) {
    const double value = 100.0 * share;
    return value < 1.0 ? "less than 1 %" : fmt::format("{:.0f} %", value);
}

void say_technique(const AutoScene& scene, const AutoRequest& request, const Settings& settings,
                   AutoChoice& out) {
    const auto say = [&](std::string text) {
        out.reasons.push_back(
            {knob_option(Knob::technique, static_cast<int>(settings.technique)), std::move(text)});
    };
    if (request.fixed.test(bit_of(Knob::technique))) {
        return;
    }
    if (const char* reason = no_bounce(scene); reason != nullptr) {
        say(std::string(reason) + " Direct light is all there is to draw.");
    } else if (settings.technique == Technique::direct) {
        say("Bounced light is left out: nothing that draws it fits.");
    } else if (settings.technique == Technique::rsm) {
        say("Bounced light shines through things: shadows for it do not fit.");
    } else {
        say("Light bounces from surface to surface, so bounced light is drawn, with the shadows it throws.");
    }
}

void say_importance(const AutoScene& scene, const AutoRequest& request, const Settings& settings,
                    AutoChoice& out) {
    if (settings.technique != Technique::ism || scene.lights() == 0 ||
        request.fixed.test(bit_of(Knob::importance))) {
        return;
    }
    const bool little = scene.seen_share < k_little_seen;
    const bool by_view = settings.vpl_importance == Importance::view;
    const std::string option = knob_option(Knob::importance, static_cast<int>(settings.vpl_importance));
    const std::string share = percent(scene.seen_share);
    std::string text;
    if (by_view && little) {
        text = fmt::format(
            "Bounced light is judged by what the camera sees, because only {} of the lamps' light "
            "counts for it.",
            share);
    } else if (by_view) {
        text = fmt::format(
            "Bounced light is judged by what the camera sees: {} of the lamps' light counts for "
            "it, and looking costs little here.",
            share);
    } else if (little) {
        text = fmt::format(
            "Only {} of the lamps' light counts for what the camera sees; to judge bounced light by "
            "that would be better, but does not fit.",
            share);
    } else {
        text = fmt::format(
            "Bounced light starts wherever lamps shine: {} of their light counts for what the "
            "camera sees.",
            share);
    }
    out.reasons.push_back({option, std::move(text)});
}

void say_scene(const AutoScene& scene, AutoChoice& out) {
    if (scene.world()) {
        out.reasons.push_back({"", "The world shines, so it is drawn as lights of its own."});
    }
    if (scene.emitters) {
        out.reasons.push_back({"", "Surfaces glow, so they are drawn as lights of their own."});
    }
    if (const int sized = scene.sized_planar + scene.sized_cube; sized > 0) {
        out.reasons.push_back(
            {"", fmt::format("{} a size, so {} shadows are soft.",
                             sized == 1 ? "One lamp has" : fmt::format("{} lamps have", sized),
                             sized == 1 ? "its" : "their")});
    }
    if (scene.features.animated()) {
        out.reasons.push_back(
            {"", "All frames have the same settings, so that an animation does not flicker."});
    }
}

void say_changes(const Ladder& ladder, AutoChoice& out) {
    for (const auto& [curve, at] : ladder.changes()) {
        if (curve->knob == Knob::importance) {
            continue;  // has a sentence of its own
        }
        const auto standard = std::find_if(curve->levels.begin(), curve->levels.end(),
                                           [](const KnobLevel& level) { return level.standard; });
        const int value = curve->levels[at].value;
        const bool finer = curve->levels.begin() + static_cast<std::ptrdiff_t>(at) < standard;
        std::string words = knob_words(curve->knob, value);
        words.front() = static_cast<char>(std::toupper(static_cast<unsigned char>(words.front())));
        const bool world_instead =
            curve->knob == Knob::world_vpls && ladder.settings().technique == Technique::direct;
        out.reasons.push_back(
            {knob_option(curve->knob, value),
             world_instead ? words + ", and so makes up for some of the bounced light that is missing."
             : finer       ? fmt::format("{}: there is time for more than the usual.", words)
                     : fmt::format("{}: of what could be given up, this shows least for the time it saves.",
                                   words)});
    }
}

// The better of two by what was asked for.
bool better(const Ladder& a, const Ladder& b, double limit_ms) {
    const bool a_fits = a.cost_ms() <= limit_ms;
    const bool b_fits = b.cost_ms() <= limit_ms;
    if (a_fits != b_fits) {
        return a_fits;
    }
    return a_fits ? a.error() < b.error() : a.cost_ms() < b.cost_ms();
}

Ladder within_budget(const AutoScene& scene, const AutoRequest& request, double limit_ms) {
    std::optional<Ladder> best;
    for (const Technique technique : techniques(scene, request)) {
        Ladder ladder(scene, request, technique);
        while (ladder.cost_ms() > limit_ms && ladder.step_down()) {
        }
        while (ladder.step_up(limit_ms)) {
        }
        if (!best || better(ladder, *best, limit_ms)) {
            best.emplace(std::move(ladder));
        }
    }
    return std::move(*best);
}

Ladder within_error(const AutoScene& scene, const AutoRequest& request, double limit) {
    std::optional<Ladder> best;
    for (const Technique technique : techniques(scene, request)) {
        Ladder ladder(scene, request, technique);
        while (ladder.step_down_to(limit)) {
        }
        const bool reaches = ladder.error() <= limit;
        const bool best_reaches = best && best->error() <= limit;
        if (!best || (reaches && (!best_reaches || ladder.cost_ms() < best->cost_ms())) ||
            (!reaches && !best_reaches && ladder.error() < best->error())) {
            best.emplace(std::move(ladder));
        }
    }
    return std::move(*best);
}

std::string milliseconds(double ms) {
    return ms < 10.0 ? fmt::format("{:.1f}", ms) : fmt::format("{:.0f}", ms);
}

}  // namespace

AutoChoice choose_settings(const AutoScene& scene, const AutoRequest& request) {
    AutoChoice out;
    const double limit_ms =
        request.budget_ms ? k_budget_use * *request.budget_ms * request.machine_speed : 0.0;
    std::optional<Ladder> found;
    if (request.budget_ms) {
        found.emplace(within_budget(scene, request, limit_ms));
        out.fits = found->cost_ms() <= limit_ms;
    } else if (request.target_relmse) {
        found.emplace(within_error(scene, request, *request.target_relmse));
        out.fits = found->error() <= *request.target_relmse;
    } else {
        found.emplace(scene, request, techniques(scene, request).front());
        found->take_standard();
    }
    out.settings = found->settings();
    out.predicted_ms = found->cost_ms() / request.machine_speed;
    out.predicted_relmse = found->error();
    say_technique(scene, request, out.settings, out);
    say_importance(scene, request, out.settings, out);
    say_scene(scene, out);
    if (request.budget_ms || request.target_relmse) {
        say_changes(*found, out);
    }
    if (request.budget_ms) {
        out.reasons.push_back(
            {"", out.fits
                     ? fmt::format("A frame of {} x {} is expected to take {} of the {} ms there are.",
                                   out.settings.width, out.settings.height, milliseconds(out.predicted_ms),
                                   milliseconds(*request.budget_ms))
                     : fmt::format("Nothing fits into {} ms at {} x {}: even this, the cheapest there is, "
                                   "is expected to take {} ms. A smaller picture would fit.",
                                   milliseconds(*request.budget_ms), out.settings.width, out.settings.height,
                                   milliseconds(out.predicted_ms))});
    } else if (request.target_relmse) {
        out.reasons.push_back(
            {"", out.fits
                     ? fmt::format("By the curves of the example scenes a frame is then within a relMSE of "
                                   "{:.2g}, about {:.2g}.",
                                   *request.target_relmse, out.predicted_relmse)
                     : fmt::format("No frame by itself reaches a relMSE of {:.2g} by the curves of the "
                                   "example scenes: this, the best there is, has about {:.2g}. --converge "
                                   "goes on from there.",
                                   *request.target_relmse, out.predicted_relmse)});
    }
    return out;
}

double speed_class(double speed) {
    return std::exp2(std::round(4.0 * std::log2(std::max(speed, 1e-6))) / 4.0);
}

std::vector<std::string> explain(const AutoChoice& choice) {
    std::vector<std::string> lines;
    for (const AutoReason& reason : choice.reasons) {
        lines.push_back(reason.choice.empty() ? reason.text
                                              : fmt::format("{} ({})", reason.text, reason.choice));
    }
    return lines;
}

}  // namespace bounce
