// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>

#include <glm/glm.hpp>

namespace bounce::gpu {
using glm::ivec4;
using glm::mat4;
using glm::uvec4;
using glm::vec4;

#include "shared/types.h"

constexpr std::size_t k_row = sizeof(vec4);  // a mat4 has four
static_assert(sizeof(FrameUniforms) == (4 + 6) * k_row);
static_assert(sizeof(WorldUniforms) == 4 * k_row);
static_assert(sizeof(ViewUniforms) == (4 + 1) * k_row);
static_assert(sizeof(GpuLight) == 8 * k_row);
static_assert(sizeof(GpuShadowView) == 7 * k_row);
static_assert(sizeof(ShadowViews) == SHADOW_VIEW_CHUNK * 7 * k_row);
static_assert(sizeof(GpuMaterial) == 12 * k_row);
static_assert(sizeof(GpuDraw) == 7 * k_row);
static_assert(sizeof(MotionUniforms) == (2 * 4 + 3) * k_row);
static_assert(sizeof(GpuPreviousDraw) == 4 * k_row);
static_assert(sizeof(GpuVpl) == 8 * k_row);
static_assert(sizeof(IsmUniforms) == 4 * k_row);
static_assert(sizeof(GpuPointSource) == 2 * k_row);
static_assert(sizeof(GpuEmitterSource) == 3 * k_row);
static_assert(sizeof(GpuPointSurface) == 4 * k_row);
static_assert(sizeof(GpuPatchPiece) == 2 * k_row);
static_assert(sizeof(GpuPieceCommand) == k_row);
static_assert(sizeof(AvgUniforms) == 3 * k_row);
static_assert(sizeof(GpuAvgVoxel) == 6 * k_row);
static_assert(sizeof(GpuAvgRay) == 4 * k_row);
static_assert(sizeof(DeformJob) == 3 * k_row);

}  // namespace bounce::gpu

#include "shared/bindings.h"
