// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <functional>
#include <string>

#include "core/progress.h"
#include "evaluate/cycles_runner.h"
#include "evaluate/render_cache.h"

namespace bounce {

// Under what a picture of Cycles is kept; told apart by scene, frame, size, samples, seed, bounces, Blender's
// build, our scripts and the machine.
using CyclesKey = std::function<std::string(const CyclesRender&)>;

// run_cycles, but a picture that is in the cache is not rendered again, and each new one is kept as soon as
// it is done: a killed run goes on behind the last picture. Outputs of both kinds are written. With fresh
// nothing is taken from the cache. A picture that cannot be read does not end the job, so that later ones are
// kept; at its end it is an Error (failed), that of a full disk where there is no room for pictures.
[[nodiscard]] CyclesReport run_cycles_cached(
    const CyclesJob& job, const std::filesystem::path& blender, const RenderCache& cache,
    const CyclesKey& key, bool fresh,
    const std::function<void(const CyclesRender&, const CyclesReport&)>& on_render = {});

// Whether run_cycles_cached would have to render: a picture of the job is not in the cache, or fresh is set.
[[nodiscard]] bool cycles_cache_lacks_any(const CyclesJob& job, const RenderCache& cache,
                                          const CyclesKey& key, bool fresh);

// A step of the progress: "frame 1, 64 spp: 7.60 s", what was rendered by an earlier run as such. more:
// stands behind the samples.
void tell_cycles(Progress& progress, const CyclesRender& render, const std::string& more);

}  // namespace bounce
