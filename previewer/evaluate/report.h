// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <string>

#include <nlohmann/json.hpp>

#include "evaluate/evaluation.h"

namespace bounce {

// results.json: {scene, reference{...}, curves[...], speedup_at_equal_error[...]} and what identifies the
// run. A number that is not finite becomes null.
[[nodiscard]] nlohmann::ordered_json results_json(const Evaluation& evaluation);

// results.csv: a row a curve, point and frame, and one a point with the means ("mean" for the frame).
[[nodiscard]] std::string results_csv(const Evaluation& evaluation);

// Error against time as text, for a terminal.
[[nodiscard]] std::string results_table(const Evaluation& evaluation);

// index.html: one page that needs no other file and no network.
[[nodiscard]] std::string results_html(const Evaluation& evaluation);

// Writes results.json, results.csv and index.html into the folder, and the pictures that the page shows
// as EXR into its folder frames/. Throws output_error.
void write_report(const Evaluation& evaluation, const std::filesystem::path& folder);

// For each curve the point that the report shows: the most exact one; of the reference engine the one
// whose time is nearest to the most exact point of all others, so that the eye compares equal times.
[[nodiscard]] std::vector<std::pair<std::string, std::string>> shown_points(const Evaluation& evaluation);

}  // namespace bounce
