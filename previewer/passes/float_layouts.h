// SPDX-License-Identifier: Apache-2.0
//
// Where floats are in what passes write, for FiniteCheck: the structs of shaders/shared/types.h that hold
// other things as well, and what shaders pack.
#pragma once

#include "frame_graph/frame_graph.h"
#include "gpu/shared_types.h"

namespace bounce::passes {

// GpuVpl: all but the place in the atlas, bitangent.w.
inline constexpr FloatWords k_vpl_floats{32, 0xffff7fffU};
static_assert(sizeof(gpu::GpuVpl) == 32 * sizeof(float));

// GpuAvgVoxel: all but `slab`.
inline constexpr FloatWords k_avg_voxel_floats{24, 0x000fffffU};
static_assert(sizeof(gpu::GpuAvgVoxel) == 24 * sizeof(float));

// shaders/lib/points.glsl: the position.
inline constexpr FloatWords k_point_floats{4, 0x7U};

// shaders/lib/bounced.glsl: three pairs of halves and a depth.
inline constexpr PackedFloats k_bounced_floats{.floats = 0x8U, .halves = 0x3fU};

// shaders/lib/rsm.glsl: a depth and three halves.
inline constexpr PackedFloats k_rsm_floats{.floats = 0x1U, .halves = 0x70U};

}  // namespace bounce::passes
