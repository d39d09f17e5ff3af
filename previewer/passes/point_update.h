// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "gpu/point_store.h"
#include "passes/pass_context.h"

namespace bounce::passes {

struct ScenePoints {
    BufferHandle points;     // shaders/lib/points.glsl
    BufferHandle triangles;  // three vec4 a large triangle
};

// The scene's points at this pose; no pass where nothing moved.
[[nodiscard]] ScenePoints add_point_update(FrameGraph& graph, const PassContext& context,
                                           gpu::PointStore& store);

}  // namespace bounce::passes
