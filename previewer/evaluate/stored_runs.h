// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "evaluate/preview_run.h"
#include "evaluate/stored_points.h"

namespace bounce {

struct EvaluateOptions;

// The runs of an evaluation by Bounce: those that an earlier evaluation has kept, where options.resume says
// so, and the others measured, each kept as soon as it is done.
class StoredRuns {
  public:
    // gltf: what is rendered; scratch: where pictures go that are not kept. The options must live as long.
    StoredRuns(const EvaluateOptions& options, std::filesystem::path gltf, const std::string& scene_hash,
               std::filesystem::path scratch);

    // How many are still to be measured.
    [[nodiscard]] size_t missing() const;

    // Measures what is missing; on_run sees a line for each with the time left. Throws what run_preview() and
    // keep_point() throw; what was measured until then is kept.
    [[nodiscard]] std::vector<PreviewResult> results(const std::function<void(const std::string&)>& on_run);

  private:
    // One run in one round; its place among all is round * runs + run.
    [[nodiscard]] PreviewResult measure(size_t index) const;
    [[nodiscard]] const PreviewRun& run_at(size_t index) const;

    const EvaluateOptions& options_;
    std::filesystem::path gltf_;
    std::filesystem::path scratch_;
    std::vector<PointKey> keys_;  // empty where nothing is kept
    std::vector<std::optional<PreviewResult>> results_;
};

// One run measured in several rounds: all times together and their median; pictures, start-up and driver of
// the first. Needs at least one. Says on stderr where a pixel differs in a bit between rounds, because then
// the renderer did not repeat itself. Throws input_error where a picture cannot be read.
[[nodiscard]] PreviewResult merge_rounds(const std::vector<PreviewResult>& rounds, const std::string& run);

}  // namespace bounce
