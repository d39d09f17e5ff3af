// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <glm/glm.hpp>

namespace bounce::gpu {
using glm::ivec4;
using glm::mat4;
using glm::uvec4;
using glm::vec4;

#include "shared/types.h"

static_assert(sizeof(FrameUniforms) == 64 + 6 * 16);
static_assert(sizeof(ViewUniforms) == 64 + 16);
static_assert(sizeof(GpuLight) == 8 * 16);
static_assert(sizeof(GpuMaterial) == 12 * 16);
static_assert(sizeof(GpuDraw) == 7 * 16);
static_assert(sizeof(DeformJob) == 3 * 16);

}  // namespace bounce::gpu

#include "shared/bindings.h"
