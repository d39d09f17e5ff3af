// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "gpu/emitter_store.h"
#include "passes/ism.h"

namespace bounce::passes {

// Virtual point lights on the surfaces that emit, in proportion to what they send. `layout` says where their
// maps go and has as many maps as the store has lights; returns it with the buffer filled in. surfaces: what
// decides on where surfaces stand (PointStore::content()).
[[nodiscard]] VplSet add_emitter_lights(FrameGraph& graph, const PassContext& context,
                                        const gpu::EmitterStore& store, const ContentKey& surfaces,
                                        VplSet layout);

}  // namespace bounce::passes
