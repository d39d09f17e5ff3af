// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "evaluate/evaluation.h"
#include "evaluate/tuning.h"

namespace bounce {

// For a terminal: the front of Bounce's own points against Cycles in a sentence, and the settings that win
// within each budget, a line each.
[[nodiscard]] std::string front_text(const Evaluation& evaluation);
[[nodiscard]] std::string budgets_text(const Tuning& tuning);

}  // namespace bounce
