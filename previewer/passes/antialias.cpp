// SPDX-License-Identifier: Apache-2.0
#include "passes/antialias.h"

namespace bounce::passes {
namespace {

TextureHandle add_depth_samples(FrameGraph& graph, const PassContext& context, const View& camera) {
    TextureHandle samples;
    graph.add_pass("depth samples", [&](PassBuilder& builder) {
        samples = builder.create_texture("depth samples", {.format = GL_DEPTH_COMPONENT32F,
                                                           .width = 2 * context.width,
                                                           .height = 2 * context.height});
        return [context, camera, samples](const PassResources& resources) {
            const gl::Framebuffer& target = resources.framebuffer({}, {&resources.texture(samples)});
            target.bind();
            const float far_depth = 0.0F;
            glClearNamedFramebufferfv(target.id(), GL_DEPTH, 0, &far_depth);
            draw_scene(context, camera, DrawKind::seen_depth, "passes/shadow_map.frag", {});
        };
    });
    return samples;
}

}  // namespace

void add_antialias(FrameGraph& graph, const PassContext& context, const GBuffer& gbuffer, const View& camera,
                   TextureHandle picture, TextureHandle target) {
    const TextureHandle samples = add_depth_samples(graph, context, camera);
    TextureHandle sources;
    graph.add_pass("sample sources", [&](PassBuilder& builder) {
        read_gbuffer(builder, gbuffer);
        builder.read(gbuffer.geometric_normal);
        builder.read(samples);
        sources = builder.create_texture(
            "sample sources", {.format = GL_R16UI, .width = context.width, .height = context.height});
        return [context, gbuffer, samples, sources](const PassResources& resources) {
            context.programs.compute("passes/sample_sources.comp").use();
            context.uniforms.bind(UBO_FRAME, context.frame);
            bind_gbuffer(resources, gbuffer);
            resources.texture(gbuffer.geometric_normal).bind(TEX_GEOMETRIC_NORMAL);
            resources.texture(samples).bind(TEX_DEPTH_SAMPLES);
            resources.texture(sources).bind_image(IMG_OUT, GL_WRITE_ONLY);
            dispatch_2d(context.width, context.height);
            finish_writes();
        };
    });
    graph.add_pass("antialias", [&](PassBuilder& builder) {
        builder.read(picture);
        builder.read(sources);
        const TextureHandle out = builder.write(target);
        return [context, picture, sources, out](const PassResources& resources) {
            context.programs.compute("passes/antialias.comp").use();
            context.uniforms.bind(UBO_FRAME, context.frame);
            resources.texture(picture).bind_image(IMG_IN, GL_READ_ONLY);
            resources.texture(sources).bind_image(IMG_SOURCES, GL_READ_ONLY);
            resources.texture(out).bind_image(IMG_OUT, GL_WRITE_ONLY);
            dispatch_2d(context.width, context.height);
            finish_writes();
        };
    });
}

}  // namespace bounce::passes
