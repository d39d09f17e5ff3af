// SPDX-License-Identifier: Apache-2.0
//
// Options of `bounce evaluate` about sweeps, given references and baselines, and what follows from them.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include <CLI/CLI.hpp>

#include "core/error.h"
#include "evaluate/evaluation.h"

namespace bounce::cli {

struct SweepOptions {
    std::vector<std::string> axes;
    bool resume = false;
    std::string reference;
    std::filesystem::path baseline;
    std::filesystem::path save_baseline;

    void add_to(CLI::App& command);
    // Puts runs, reference and the folder of kept points into the evaluation's options. Throws usage_error,
    // and input_error for a baseline that cannot be used.
    void apply(const CLI::App& command, const std::filesystem::path& output, EvaluateOptions& options) const;
    // Writes tuning.json and the baseline where asked for, prints the front and the budgets, and compares
    // with the baseline: above_threshold where an error has risen.
    [[nodiscard]] ExitCode finish(const Evaluation& evaluation, const std::filesystem::path& output) const;
};

}  // namespace bounce::cli
