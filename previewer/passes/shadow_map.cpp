// SPDX-License-Identifier: Apache-2.0
#include "passes/shadow_map.h"

namespace bounce::passes {

TextureHandle add_shadow_map(FrameGraph& graph, const PassContext& context, const LightPass& light) {
    TextureHandle map;
    graph.add_pass("shadow map: " + light.name, [&](PassBuilder& builder) {
        map = builder.create_texture("shadow map", {.format = GL_DEPTH_COMPONENT32F,
                                                    .width = light.shadow_size,
                                                    .height = light.shadow_size,
                                                    .layers = static_cast<int>(light.faces.size())});
        const DrawKind kind = light.soft.blended_only ? DrawKind::solid_depth : DrawKind::depth;
        ContentHash hash;
        for (const View& face : light.faces) {
            hash.add(drawn_content(context, &face, kind));
        }
        builder.decided_by(hash.key());
        return [context, light, map, kind](const PassResources& resources) {
            const float far_depth = 0.0F;
            for (size_t face = 0; face < light.faces.size(); ++face) {
                const gl::Framebuffer& target =
                    resources.framebuffer({}, {&resources.texture(map), static_cast<int>(face)});
                target.bind();
                glClearNamedFramebufferfv(target.id(), GL_DEPTH, 0, &far_depth);
                draw_scene(context, light.faces[face], kind, "passes/shadow_map.frag", {});
            }
        };
    });
    return map;
}

}  // namespace bounce::passes
