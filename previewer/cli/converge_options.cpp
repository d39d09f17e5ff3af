// SPDX-License-Identifier: Apache-2.0
#include "cli/converge_options.h"

#include <cmath>
#include <string>

#include <fmt/format.h>

#include "core/error.h"
#include "renderer/setting_names.h"

namespace bounce::cli {
namespace {

constexpr double k_default_seconds = 10.0;

// Seeds of passes are their numbers; more would take weeks.
constexpr int k_most_passes = 1'000'000;

// Not a number is not positive either.
CLI::Validator positive() {
    return {[](std::string& text) {
                double value = 0.0;
                return CLI::detail::lexical_cast(text, value) && value > 0.0 && std::isfinite(value)
                           ? std::string()
                           : fmt::format("{} is not a positive number", text);
            },
            "POSITIVE"};
}

}  // namespace

void ConvergeOptions::add_to(CLI::App& command) {
    const char* group = "Convergence";
    command
        .add_flag(
            "--converge", converge,
            "The mean of passes, each with other virtual point lights, points in shadow maps and places in "
            "the pixel, until a target below is met; says how far the picture is from that of endless passes")
        ->group(group);
    command
        .add_option(
            "--time-limit", seconds,
            "With --converge: seconds for a frame; a pass that would not end in time is not begun. 10 where "
            "no target is given")
        ->check(positive())
        ->group(group);
    command
        .add_option(
            "--target-relmse", relmse,
            "With --converge: enough is an estimated relMSE of this; with --time-limit whichever "
            "comes first. "
            "Alone it ends with a sentence where that would take more than an hour. Without --converge: "
            "preset auto takes the cheapest settings that reach it by its curves")
        ->check(positive())
        ->group(group);
    command
        .add_option(
            "--passes", passes,
            "With --converge: this many at most; alone, the picture does not depend on the machine's speed")
        ->check(CLI::Range(1, k_most_passes))
        ->group(group);
}

void ConvergeOptions::check(const Settings& settings) const {
    const char* target = seconds ? "--time-limit" : passes ? "--passes" : nullptr;
    if (!converge && target != nullptr) {
        throw usage_error(fmt::format("{} is a target of --converge; give both", target));
    }
    if (!converge) {
        return;
    }
    if (settings.technique == Technique::rsm) {
        throw usage_error(
            "--technique rsm takes the same samples in every pass, which --converge would not make better; "
            "give direct or "
            "ism");
    }
    if (settings.traces_first()) {
        throw usage_error(
            "--vpl-sampling avg sends the same rays in every pass, which --converge would not make better; "
            "give another");
    }
    if (const std::string refusal = converge_refusal(settings); !refusal.empty()) {
        throw usage_error("--converge: " + refusal);
    }
    if (settings.temporal_reuse) {
        throw usage_error(
            "--temporal-reuse takes light of the frame before, which --converge does not need; give one of "
            "both");
    }
    if (settings.samples > 1) {
        throw usage_error(
            "--converge looks at other places of the pixels in every pass; give no --samples beside it");
    }
    if (settings.show != Show::shaded && settings.show != Show::direct && settings.show != Show::indirect) {
        throw usage_error(
            fmt::format("--show {} is of a single frame; --converge takes shaded, direct or indirect",
                        name_of(settings.show)));
    }
}

ConvergeTarget ConvergeOptions::target() const {
    ConvergeTarget out{seconds.value_or(0.0), relmse.value_or(0.0), passes.value_or(0)};
    if (!seconds && !relmse && !passes) {
        out.seconds = k_default_seconds;
    }
    return out;
}

}  // namespace bounce::cli
