// SPDX-License-Identifier: Apache-2.0
#include "passes/peel.h"

#include <array>

#include <fmt/format.h>

#include "gl/sample_query.h"

namespace bounce::passes {
namespace {

gl::TextureDesc picture_desc(const PassContext& context, GLenum format) {
    return {.format = format, .width = context.width, .height = context.height};
}

void clear_depth(const gl::Framebuffer& framebuffer, float depth) {
    glClearNamedFramebufferfv(framebuffer.id(), GL_DEPTH, 0, &depth);
}

}  // namespace

PeeledLayer add_peeled_layer(FrameGraph& graph, const PassContext& context, const View& camera,
                             const GBuffer& solid, TextureHandle before, int number) {
    PeeledLayer out;
    out.any = std::make_shared<bool>(false);
    graph.add_pass(fmt::format("gbuffer, layer {}", number), [&](PassBuilder& builder) {
        const auto target = [&](const char* name, GLenum format) {
            return builder.create_texture(name, picture_desc(context, format));
        };
        builder.read(solid.depth);
        const bool first = !before.valid();
        TextureHandle behind = before;
        if (first) {
            behind = target("nothing peeled", GL_DEPTH_COMPONENT32F);
        } else {
            builder.read(behind);
        }
        GBuffer& gbuffer = out.gbuffer;
        gbuffer.depth = target("layer depth", GL_DEPTH_COMPONENT32F);
        gbuffer.base_color_roughness = target("layer base colour, roughness", GL_RGBA16F);
        gbuffer.normal_metallic_specular = target("layer normal, metallic, specular", GL_RGBA16);
        gbuffer.geometric_normal = target("layer geometric normal, alpha", GL_RGBA16);
        if (context.scene.has_emission()) {
            gbuffer.emission = target("layer emission", GL_RGBA32F);
        }
        return [context, camera, solid, behind, first, out](const PassResources& resources) {
            if (first) {
                clear_depth(resources.framebuffer({}, {&resources.texture(behind)}), 1.0F);
            }
            const gl::Attachment color{&resources.texture(out.gbuffer.base_color_roughness)};
            const gl::Attachment normal{&resources.texture(out.gbuffer.normal_metallic_specular)};
            const gl::Attachment geometric{&resources.texture(out.gbuffer.geometric_normal)};
            const gl::Attachment depth{&resources.texture(out.gbuffer.depth)};
            const bool emission = out.gbuffer.emission.valid();
            const gl::Framebuffer& framebuffer =
                emission ? resources.framebuffer(
                               {color, normal, geometric, {&resources.texture(out.gbuffer.emission)}}, depth)
                         : resources.framebuffer({color, normal, geometric}, depth);
            framebuffer.bind();
            context.uniforms.bind(UBO_FRAME, context.frame);
            clear_depth(framebuffer, 0.0F);
            constexpr std::array<float, 4> nothing{};
            for (int i = 0; i < (emission ? 4 : 3); ++i) {
                glClearNamedFramebufferfv(framebuffer.id(), GL_COLOR, i, nothing.data());
            }
            resources.texture(solid.depth).bind(TEX_DEPTH);
            resources.texture(behind).bind(TEX_PEELED_DEPTH);
            *out.any =
                gl::count_samples(GL_ANY_SAMPLES_PASSED, [&] {
                    draw_scene(context, camera,
                               emission ? DrawKind::peeled_surface_with_emission : DrawKind::peeled_surface,
                               "passes/gbuffer.frag", {});
                }) != 0;
        };
    });
    return out;
}

void count_unpeeled(FrameGraph& graph, const PassContext& context, const View& camera, const GBuffer& solid,
                    const GBuffer& last, int* result) {
    graph.add_pass("layers left out", [&](PassBuilder& builder) {
        builder.read(solid.depth);
        builder.read(last.depth);
        builder.side_effect();
        const TextureHandle depth =
            builder.create_texture("depth left out", picture_desc(context, GL_DEPTH_COMPONENT32F));
        return [context, camera, solid, last, depth, result](const PassResources& resources) {
            const gl::Framebuffer& framebuffer = resources.framebuffer({}, {&resources.texture(depth)});
            framebuffer.bind();
            resources.texture(solid.depth).bind(TEX_DEPTH);
            resources.texture(last.depth).bind(TEX_PEELED_DEPTH);
            clear_depth(framebuffer, 0.0F);
            const auto draw = [&] {
                draw_scene(context, camera, DrawKind::peeled_depth, "passes/shadow_map.frag", {});
            };
            // Once to find the nearest of them, then how many pixels show one.
            draw();
            *result = static_cast<int>(gl::count_samples(GL_SAMPLES_PASSED, [&] {
                glDepthFunc(GL_EQUAL);
                draw();
                glDepthFunc(GL_GREATER);
            }));
        };
    });
}

TextureHandle add_over(FrameGraph& graph, const PassContext& context, TextureHandle layer,
                       TextureHandle picture, int number) {
    TextureHandle out;
    graph.add_pass(fmt::format("over, layer {}", number), [&](PassBuilder& builder) {
        builder.read(layer);
        out = builder.write(picture);
        return [context, layer, out](const PassResources& resources) {
            context.programs.compute("passes/over.comp").use();
            context.uniforms.bind(UBO_FRAME, context.frame);
            resources.texture(layer).bind_image(IMG_IN, GL_READ_ONLY);
            resources.texture(out).bind_image(IMG_OUT, GL_READ_WRITE);
            dispatch_2d(context.width, context.height);
            finish_writes();
        };
    });
    return out;
}

}  // namespace bounce::passes
