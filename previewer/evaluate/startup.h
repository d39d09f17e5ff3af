// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "evaluate/engine_starts.h"
#include "evaluate/evaluation.h"

namespace bounce {

// What comes before the frames that count, a row an engine, from what the runs have told; previews are
// Bounce's. export_seconds is of the glTF file that Bounce reads. The other engines tell start and loading in
// one figure, from which starts is taken off where it is less.
[[nodiscard]] std::vector<StartUp> startups_of(const Evaluation& evaluation,
                                               const std::vector<PreviewResult>& previews,
                                               double export_seconds, const EngineStarts& starts);

}  // namespace bounce
