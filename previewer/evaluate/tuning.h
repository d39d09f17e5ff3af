// SPDX-License-Identifier: Apache-2.0
//
// The settings that win within a time a frame: found by an evaluation, read by `bounce render --budget-ms`.
#pragma once

#include <array>
#include <filesystem>
#include <string>
#include <vector>

#include <nlohmann/json.hpp>

#include "evaluate/evaluation.h"

namespace bounce {

// Budgets that an evaluation looks for, in milliseconds: a frame at 60 and at 30 a second, and what one waits
// for.
constexpr std::array<double, 6> k_budgets_ms{16, 33, 100, 250, 1000, 10000};

struct TunedSettings {
    double budget_ms = 0.0;
    double seconds = 0.0;  // a frame, as measured
    double relmse = 0.0;
    double flip_ldr = 0.0;
    double bias = 0.0;
    std::string curve, label;          // of the point that won
    std::vector<std::string> options;  // of `bounce render`
};

struct Tuning {
    std::string scene;
    int width = 0;
    int height = 0;
    int bounces = 1;
    std::string cpu;
    int threads = 0;
    std::string gl_renderer;
    std::vector<TunedSettings> budgets;  // rising
};

// For each budget the point of Bounce's with the smallest relMSE among those that take at most so long; of
// equal errors the fastest. A budget within which no point lies is left out. Points whose time or error is
// not a number never win, nor do those without options, which Bounce did not draw.
[[nodiscard]] std::vector<TunedSettings> budget_winners(const std::vector<Curve>& curves,
                                                        const std::vector<double>& budgets_ms);

[[nodiscard]] Tuning tuning_of(const Evaluation& evaluation);

// The file tuning.json, schema "bounce.tuning/1".
[[nodiscard]] nlohmann::ordered_json tuning_json(const Tuning& tuning);

// Throws input_error, one sentence, where the file cannot be read, is of another schema or lacks something.
[[nodiscard]] Tuning read_tuning(const std::filesystem::path& path);

// The settings of the largest budget that is at most so long; null where all are longer.
[[nodiscard]] const TunedSettings* settings_within(const Tuning& tuning, double budget_ms);

}  // namespace bounce
