// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <string>

#include "renderer/settings.h"

namespace bounce {

// What a path costs is decided by.
struct SplatCounts {
    size_t triangles = 0;        // that the scene draws, instances counted
    size_t splats = 0;           // of all maps that are drawn so
    bool software = false;       // the driver runs shaders on the processor
    bool can_tessellate = true;  // the driver's stages read what tessellation needs (can_tessellate())
};

struct SplatChoice {
    Splat splat = Splat::compute;
    std::string reason;  // a phrase
};

// Splat::automatic: stored points drawn by compute shaders, or tessellation where the splats are more than
// the triangles that it has to go through for them (Barak, Bittner and Havran 2013, 6.4).
[[nodiscard]] SplatChoice choose_splat(const SplatCounts& counts);

}  // namespace bounce
