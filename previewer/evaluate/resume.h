// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "evaluate/preview_run.h"

namespace bounce {

// run_preview, but what a run that was killed has finished is taken from folder: its times are of this
// evaluation and of this program. Another program, scene, frame list or size is told by key, and rendered
// anew.
[[nodiscard]] PreviewResult run_or_resume_preview(const std::string& key, const std::filesystem::path& bounce,
                                                  const std::filesystem::path& scene, const PreviewRun& run,
                                                  const std::vector<int>& frames, int width, int height,
                                                  int repeat, const std::filesystem::path& folder);

}  // namespace bounce
