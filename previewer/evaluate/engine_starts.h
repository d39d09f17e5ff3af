// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>

#include "evaluate/evaluation.h"

namespace bounce {

// How long programs take to start with nothing to do, so that it can be told from loading a scene, which
// they do not tell apart themselves. 0: not needed, or not known.
struct EngineStarts {
    double display = 0.0;  // of the virtual display, where there is no other
    double blender = 0.0;
    double f3d = 0.0;
};

// Runs those that the evaluation has points of. blender may be empty where none was used. What cannot be
// measured is 0.
[[nodiscard]] EngineStarts measure_engine_starts(const std::filesystem::path& blender,
                                                 const Evaluation& evaluation);

}  // namespace bounce
