// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "gl/program.h"
#include "gpu/gpu_scene.h"

namespace bounce::passes {

// Skinning and morphing of this pose into the vertex streams that every raster pass reads. Runs before the
// graph's passes: its result outlives the frame in the vertex store.
void run_deform(gl::ProgramCache& programs, gpu::GpuScene& scene);

}  // namespace bounce::passes
