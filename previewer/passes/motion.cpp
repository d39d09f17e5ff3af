// SPDX-License-Identifier: Apache-2.0
#include "passes/motion.h"

#include <array>

namespace bounce::passes {
namespace {

constexpr float k_far_depth = 0.0F;

}  // namespace

void add_previous_depth(FrameGraph& graph, const PassContext& context, const View& camera,
                        TextureHandle depth) {
    graph.add_pass("previous depth", [&](PassBuilder& builder) {
        const TextureHandle out = builder.write(depth);
        return [context, camera, out](const PassResources& resources) {
            const gl::Framebuffer& target = resources.framebuffer({}, {&resources.texture(out)});
            target.bind();
            glClearNamedFramebufferfv(target.id(), GL_DEPTH, 0, &k_far_depth);
            draw_scene(context, camera, DrawKind::seen_depth, "passes/shadow_map.frag", {});
        };
    });
}

namespace {

// target: invalid for a new texture.
TextureHandle add_motion_pass(FrameGraph& graph, const PassContext& context, const View& camera,
                              const PreviousFrame& previous, TextureHandle target) {
    const TextureHandle before = graph.import_texture("previous depth", *previous.depth);
    TextureHandle out;
    graph.add_pass("motion", [&](PassBuilder& builder) {
        builder.read(before);
        const TextureHandle depth = builder.create_texture(
            "depth", {.format = GL_DEPTH_COMPONENT32F, .width = context.width, .height = context.height});
        out = target.valid()
                  ? builder.write(target)
                  : builder.create_texture(
                        "motion", {.format = GL_RGBA32F, .width = context.width, .height = context.height});
        return [context, camera, previous, before, depth, out](const PassResources& resources) {
            const gl::Framebuffer& framebuffer =
                resources.framebuffer({{&resources.texture(out)}}, {&resources.texture(depth)});
            framebuffer.bind();
            constexpr std::array<float, 4> none{0.0F, 0.0F, 0.0F, 1.0F};
            glClearNamedFramebufferfv(framebuffer.id(), GL_COLOR, 0, none.data());
            glClearNamedFramebufferfv(framebuffer.id(), GL_DEPTH, 0, &k_far_depth);
            context.uniforms.bind(UBO_MOTION, previous.uniforms);
            previous.pose->bind();
            resources.texture(before).bind(TEX_PREVIOUS_DEPTH);
            draw_scene(context, camera, DrawKind::seen_depth, "passes/motion.frag", {{"MOTION", "1"}});
        };
    });
    return out;
}

}  // namespace

void add_motion(FrameGraph& graph, const PassContext& context, const View& camera,
                const PreviousFrame& previous, TextureHandle target) {
    (void)add_motion_pass(graph, context, camera, previous, target);
}

TextureHandle add_motion_vectors(FrameGraph& graph, const PassContext& context, const View& camera,
                                 const PreviousFrame& previous) {
    return add_motion_pass(graph, context, camera, previous, {});
}

}  // namespace bounce::passes
