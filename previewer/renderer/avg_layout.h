// SPDX-License-Identifier: Apache-2.0
//
// Where the voxels of the approximate visibility grid stand: arithmetic without OpenGL.
#pragma once

#include "gpu/render_space.h"
#include "gpu/shared_types.h"
#include "scene/pose.h"

namespace bounce {

// A grid of cubic voxels around what the pose shows. `size` of them stand along the longest side of `first`,
// the bounds where the animation begins (both in world space), and their lattice stays where it is while
// things move; where the pose reaches farther than that, voxels are doubled until `size` are enough again.
// Walls on the scene's bounds lie in the middle of their voxels. block_bytes: the largest buffer that a
// shader reads, which limits how many surfaces the grid holds; size.w is at least 1.
[[nodiscard]] gpu::AvgUniforms avg_layout(const scene::Bounds& first, const scene::Bounds& pose,
                                          const gpu::RenderSpace& space, int size, long long block_bytes);

// How many surfaces a grid of `size` voxels a side has room for, where the driver lets it: 32 faces of the
// grid. The walls of a box are six.
[[nodiscard]] long long avg_surfaces(int size);

// The largest grid of which such a buffer holds at least the walls of a box.
[[nodiscard]] int most_avg_size(long long block_bytes);

}  // namespace bounce
