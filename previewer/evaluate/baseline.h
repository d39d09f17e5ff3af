// SPDX-License-Identifier: Apache-2.0
//
// Regression guard: an evaluation's errors against those of an earlier one. Times are never compared.
#pragma once

#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include <nlohmann/json.hpp>

#include "evaluate/evaluation.h"

namespace bounce {

// An error may rise to old * (1 + relative) + absolute.
struct Tolerance {
    double relative = 0.0;
    double absolute = 0.0;
    std::string reason;
};

struct BaselinePoint {
    std::string curve, label;
    double relmse = 0.0;
    double flip_ldr = 0.0;
    double bias = 0.0;
};

// What has to be the same for two runs' errors to be comparable.
struct BaselineConditions {
    std::string scene;  // file name
    int width = 0;
    int height = 0;
    int bounces = 1;
    std::vector<int> frames;
};

struct Baseline {
    BaselineConditions conditions;
    std::string scene_sha256;
    std::map<std::string, Tolerance> tolerances;  // of relmse, flip_ldr and bias, each of them
    std::vector<BaselinePoint> points;
};

// Where a baseline has none of its own.
[[nodiscard]] const std::map<std::string, Tolerance>& default_tolerances();

// Errors and conditions alone, no times and no machine: small, and the same on every machine that draws the
// same. Schema "bounce.baseline/1".
[[nodiscard]] nlohmann::ordered_json baseline_json(const Evaluation& evaluation);

// Reads what baseline_json() or results_json() wrote. Throws input_error: unreadable, of another schema, an
// error that is not a number, a tolerance without a reason or one that is negative or of an unknown error.
[[nodiscard]] Baseline read_baseline(const std::filesystem::path& path);

// Throws input_error where the run has other conditions than the baseline: to be known before anything is
// rendered.
void require_same_conditions(const Baseline& baseline, const BaselineConditions& run);

struct BaselineReport {
    std::vector<std::string> regressions;  // a sentence each
    std::vector<std::string> missing;      // "curve, label": in the baseline, not in the run
    std::vector<std::string> added;        // in the run, not in the baseline
    size_t compared = 0;                   // points in both

    // A point that is missing is as bad as a risen error: nobody knows what it would have been.
    [[nodiscard]] bool passed() const { return regressions.empty() && missing.empty(); }
};

// Compares relMSE, FLIP and the magnitude of the bias of every point that is in both. A point with a value
// that is not a number has always become worse. Throws input_error where the two were not made under the same
// conditions (size, frames, bounces) or have no point in common.
[[nodiscard]] BaselineReport compare_with_baseline(const Baseline& baseline, const Evaluation& evaluation);

}  // namespace bounce
