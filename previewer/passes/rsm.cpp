// SPDX-License-Identifier: Apache-2.0
#include "passes/rsm.h"

#include <array>

#include "passes/float_layouts.h"

namespace bounce::passes {

TextureHandle add_rsm(FrameGraph& graph, const PassContext& context, const LightPass& light) {
    TextureHandle map;
    graph.add_pass("rsm: " + light.name, [&](PassBuilder& builder) {
        gl::TextureDesc desc{.format = GL_RGBA32UI,
                             .width = light.rsm_size,
                             .height = light.rsm_size,
                             .layers = static_cast<int>(light.faces.size())};
        map = builder.create_texture("rsm", desc, k_rsm_floats);
        desc.format = GL_DEPTH_COMPONENT32F;
        desc.layers = 0;
        const TextureHandle depth = builder.create_texture("rsm depth", desc);
        ContentHash hash;
        hash.add(content(context, light.uniforms)).add(content(light_defines(light)));
        for (const View& face : light.faces) {
            hash.add(drawn_content(context, &face, DrawKind::light_surface));
        }
        builder.decided_by(hash.key());
        return [context, light, map, depth](const PassResources& resources) {
            constexpr std::array<GLuint, 4> empty{};
            const float far_depth = 0.0F;
            context.uniforms.bind(UBO_LIGHT, light.uniforms);
            for (size_t face = 0; face < light.faces.size(); ++face) {
                const gl::Framebuffer& target = resources.framebuffer(
                    {{&resources.texture(map), static_cast<int>(face)}}, {&resources.texture(depth)});
                target.bind();
                glClearNamedFramebufferuiv(target.id(), GL_COLOR, 0, empty.data());
                glClearNamedFramebufferfv(target.id(), GL_DEPTH, 0, &far_depth);
                draw_scene(context, light.faces[face], DrawKind::light_surface, "passes/rsm.frag",
                           light_defines(light));
            }
        };
    });
    return map;
}

}  // namespace bounce::passes
