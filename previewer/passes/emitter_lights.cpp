// SPDX-License-Identifier: Apache-2.0
#include "passes/emitter_lights.h"

#include "passes/float_layouts.h"

namespace bounce::passes {

VplSet add_emitter_lights(FrameGraph& graph, const PassContext& context, const gpu::EmitterStore& store,
                          const ContentKey& surfaces, VplSet layout) {
    VplSet out = layout;
    graph.add_pass("emitter lights", [&](PassBuilder& builder) {
        const BufferHandle vpls = builder.create_buffer(
            "emitter lights", static_cast<size_t>(layout.maps) * sizeof(gpu::GpuVpl), k_vpl_floats);
        out.vpls = vpls;
        builder.decided_by(
            ContentHash().add(content(context, layout)).add(store.content()).add(surfaces).key());
        return [context, &store, layout, vpls](const PassResources& resources) {
            context.programs.compute("passes/emitter_lights.comp").use();
            store.bind_for_update();
            resources.buffer(vpls).bind_storage(SSBO_VPLS_OUT);
            glUniform3i(0, layout.maps, layout.map_size, layout.columns);
            glDispatchCompute((static_cast<GLuint>(layout.maps) + GROUP_1D - 1) / GROUP_1D, 1, 1);
            finish_writes();
        };
    });
    return out;
}

}  // namespace bounce::passes
