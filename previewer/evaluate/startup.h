// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "evaluate/evaluation.h"

namespace bounce {

// What comes before the frames that count, a row an engine, from what the runs have told. export_seconds is
// of the glTF file that Bounce reads.
[[nodiscard]] std::vector<StartUp> startups_of(const Evaluation& evaluation, double export_seconds);

}  // namespace bounce
