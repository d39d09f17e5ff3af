// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "renderer/renderer.h"

namespace bounce {

// Settings whose frames stay within a limit of GPU memory.
struct MemoryFit {
    Settings settings;
    bool keeps = false;                // what does not change is kept between frames
    size_t peak_bytes = 0;             // as Renderer::plan() forecasts it
    std::vector<std::string> changes;  // what was given up, one sentence each; empty where all fitted
};

// The frames to be drawn, by their number among them.
using MomentAt = std::function<void(size_t, const std::function<void(const Moment&)>&)>;

// Where any of `count` frames needs more than `limit` bytes, gives up one thing after the other until they
// fit, what costs the picture least first; the picture's size and what was not asked for stay. keeps: whether
// more than one frame is drawn. The textures and buffers that we ask the driver for count, not its own
// overhead. Throws usage_error, saying how much is needed at least, where nothing helps.
[[nodiscard]] MemoryFit fit_to_memory(Renderer& renderer, size_t count, const MomentAt& at,
                                      const Settings& settings, bool keeps, size_t limit);

// The steps of that, in order. One changes the settings and returns the sentence, or an empty one where it
// has no more to give up. Pure.
[[nodiscard]] size_t give_up_steps();
[[nodiscard]] std::string give_up(size_t step, Settings& settings, bool& keeps);

}  // namespace bounce
