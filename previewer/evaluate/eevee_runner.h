// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "evaluate/peers.h"

namespace bounce {

// Renders the frames with Eevee at 1, 16 and 64 samples (evaluate/eevee_render.py says what is set) in one
// Blender process. What is found in job.cache is not rendered again. Throws Error where there is no display
// or Blender fails; what was finished is in result then.
void run_eevee(const PeerJob& job, const PeerProgress& progress, PeerResult& result);

}  // namespace bounce
