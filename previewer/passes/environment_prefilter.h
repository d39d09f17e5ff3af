// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "gl/program.h"
#include "gpu/environment_maps.h"

namespace bounce::passes {

// Draws the levels of maps.glossy from maps.image. Once for an image: nothing of it depends on how it is
// turned.
void run_environment_prefilter(gl::ProgramCache& programs, const gpu::EnvironmentMaps& maps);

}  // namespace bounce::passes
