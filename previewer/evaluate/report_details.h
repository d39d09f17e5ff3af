// SPDX-License-Identifier: Apache-2.0
//
// The parts of results.json beside errors and times: other engines, start-up, passes.
#pragma once

#include <nlohmann/json.hpp>

#include "evaluate/evaluation.h"

namespace bounce {

// [{name, settings, left_out[], notes[]}]
[[nodiscard]] nlohmann::ordered_json peers_json(const Evaluation& evaluation);

// {step, motion}; null where the frames are no sequence.
[[nodiscard]] nlohmann::ordered_json sequence_json(const Evaluation& evaluation);

// [{engine, export_seconds, load_seconds, first_render_seconds, note}]; null where there is no such step.
[[nodiscard]] nlohmann::ordered_json startup_json(const Evaluation& evaluation);

// [{curve, label, frame, passes[{name, seconds, seconds_least, seconds_most}], left_out[{pass, reason}],
// approximations[]}]
[[nodiscard]] nlohmann::ordered_json passes_json(const Evaluation& evaluation);

// [{budget_ms, curve, label, options[], seconds, relmse, flip_ldr, bias}]; only budget_ms where no point is
// as fast.
[[nodiscard]] nlohmann::ordered_json budgets_json(const Evaluation& evaluation);

}  // namespace bounce
