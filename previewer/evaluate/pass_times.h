// SPDX-License-Identifier: Apache-2.0
//
// Where the time of a frame goes, and what the frame left out.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include <nlohmann/json_fwd.hpp>

#include "evaluate/preview_run.h"

namespace bounce {

struct PassSeconds {
    std::string name;
    double seconds = 0.0;  // median of the repeated renderings
    double seconds_least = 0.0;
    double seconds_most = 0.0;
};

// A pass or a step that a frame does without, and why.
struct LeftOutPass {
    std::string pass;
    std::string reason;
};

// One point of a curve, looked into at one frame.
struct PassTimes {
    std::string curve;
    std::string label;
    int frame = 1;
    std::vector<PassSeconds> passes;  // in the order in which they ran
    std::vector<LeftOutPass> left_out;
    std::vector<std::string> approximations;
};

// Renders one frame `repeat` times more with the passes timed one by one, in a process of its own: waiting
// for each pass would slow the frame that counts. Throws Error (failed).
[[nodiscard]] PassTimes measure_passes(const std::filesystem::path& bounce,
                                       const std::filesystem::path& scene, const PreviewRun& run, int frame,
                                       int width, int height, int repeat,
                                       const std::filesystem::path& folder);

// From what `bounce render --stats` wrote. Throws nlohmann::json::exception.
[[nodiscard]] PassTimes pass_times_of(const nlohmann::json& stats);

}  // namespace bounce
