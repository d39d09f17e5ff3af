// SPDX-License-Identifier: Apache-2.0
//
// Axes of settings that `bounce evaluate --sweep` goes along: a table, to which a new axis is added as data.
#pragma once

#include <string>
#include <vector>

#include "evaluate/preview_run.h"

namespace bounce {

struct SweepPoint {
    // Bounces: as many as the reference has (at most 4), one because the settings have no other, or, from 1
    // on, exactly so many and only where the reference has as many.
    static constexpr int k_as_reference = 0;
    static constexpr int k_one = -1;

    std::string label;
    std::vector<std::string> arguments;  // of `bounce render`, without --bounces
    int bounces = k_as_reference;
};

// One setting goes through its values; all others stay as preset auto has them.
struct SweepAxis {
    std::string name;   // on the command line
    std::string title;  // of its curve
    std::string varies;
    std::vector<SweepPoint> points;
    bool part_of_all = true;
};

// Every axis, in the order in which `all` runs them.
[[nodiscard]] const std::vector<SweepAxis>& sweep_axes();

// The axes' names, separated by commas.
[[nodiscard]] std::string sweep_axis_names();

// The runs of the named axes (or of "all", which leaves out `converge` and `guard`) against a reference of so
// many bounces, each axis once. The axis `bounces` compares all its points with that one reference, which has
// the most. Throws usage_error for an unknown axis, where bounces is 0, and for the axis `bounces` by name
// where the reference has one bounce; "all" leaves it out then.
[[nodiscard]] std::vector<PreviewRun> sweep_runs(const std::vector<std::string>& names, int bounces);

}  // namespace bounce
