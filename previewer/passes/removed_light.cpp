// SPDX-License-Identifier: Apache-2.0
#include "passes/removed_light.h"

#include <numeric>
#include <vector>

namespace bounce::passes {

void add_removed_light(FrameGraph& graph, const PassContext& context, const GBuffer& gbuffer,
                       TextureHandle indirect, TextureHandle removed, RemovedLight* result) {
    graph.add_pass("removed light", [&](PassBuilder& builder) {
        read_gbuffer(builder, gbuffer);
        builder.read(indirect);
        if (removed.valid()) builder.read(removed);
        const size_t groups = static_cast<size_t>((context.width + GROUP_2D - 1) / GROUP_2D) *
                              static_cast<size_t>((context.height + GROUP_2D - 1) / GROUP_2D);
        const BufferHandle sums =
            builder.create_buffer("reflected light of tiles", groups * sizeof(float), k_all_floats);
        builder.side_effect();
        return [context, gbuffer, indirect, removed, groups, sums, result](const PassResources& resources) {
            const auto mean = [&](TextureHandle light) {
                context.programs.compute("passes/removed_light.comp").use();
                context.uniforms.bind(UBO_FRAME, context.frame);
                bind_gbuffer(resources, gbuffer);
                resources.texture(light).bind_image(IMG_IN, GL_READ_ONLY);
                resources.buffer(sums).bind_storage(SSBO_ROW_SUMS);
                dispatch_2d(context.width, context.height);
                finish_writes();
                const std::vector<float> tiles = resources.buffer(sums).read<float>(groups);
                return std::accumulate(tiles.begin(), tiles.end(), 0.0) /
                       (3.0 * context.width * context.height);
            };
            *result = {mean(indirect), removed.valid() ? mean(removed) : 0.0};
        };
    });
}

}  // namespace bounce::passes
