// SPDX-License-Identifier: Apache-2.0
#include "passes/gbuffer.h"

#include <array>

#include "gl/sample_query.h"

namespace bounce::passes {
namespace {

GBuffer add(FrameGraph& graph, const PassContext& context, const View& camera, gpu::Geometry geometry,
            bool* anything_seen) {
    GBuffer out;
    const bool whole = geometry == gpu::Geometry::whole;
    graph.add_pass(whole ? "gbuffer" : "gbuffer, simplified", [&](PassBuilder& builder) {
        const auto target = [&](const char* name, GLenum format) {
            return builder.create_texture(
                name, {.format = format, .width = context.width, .height = context.height});
        };
        out.depth = target("depth", GL_DEPTH_COMPONENT32F);
        out.base_color_roughness = target("base colour, roughness", GL_RGBA16F);
        out.normal_metallic_specular = target("normal, metallic, specular", GL_RGBA16);
        out.geometric_normal = target("geometric normal", GL_RG16);
        if (whole && context.scene.has_emission()) {
            out.emission = target("emission", GL_RGBA32F);
        }
        // What counts something runs for that.
        const DrawKind kind = out.emission.valid() ? DrawKind::surface_with_emission : DrawKind::surface;
        if (anything_seen == nullptr) {
            builder.decided_by(ContentHash()
                                   .add(camera_content(context))
                                   .add(drawn_content(context, &camera, kind, geometry))
                                   .key());
        }
        return [context, camera, geometry, out, anything_seen](const PassResources& resources) {
            const gl::Attachment color{&resources.texture(out.base_color_roughness)};
            const gl::Attachment normal{&resources.texture(out.normal_metallic_specular)};
            const gl::Attachment geometric{&resources.texture(out.geometric_normal)};
            const gl::Attachment depth{&resources.texture(out.depth)};
            const bool emission = out.emission.valid();
            const gl::Framebuffer& framebuffer =
                emission ? resources.framebuffer(
                               {color, normal, geometric, {&resources.texture(out.emission)}}, depth)
                         : resources.framebuffer({color, normal, geometric}, depth);
            framebuffer.bind();
            context.uniforms.bind(UBO_FRAME, context.frame);
            constexpr std::array<float, 4> black{};
            const float far_depth = 0.0F;
            glClearNamedFramebufferfv(framebuffer.id(), GL_DEPTH, 0, &far_depth);
            if (emission) {
                glClearNamedFramebufferfv(framebuffer.id(), GL_COLOR, 3, black.data());
            }
            const auto draw = [&] {
                draw_scene(context, camera, emission ? DrawKind::surface_with_emission : DrawKind::surface,
                           "passes/gbuffer.frag", {}, geometry);
            };
            if (anything_seen != nullptr) {
                *anything_seen = gl::count_samples(GL_ANY_SAMPLES_PASSED, draw) != 0;
            } else {
                draw();
            }
        };
    });
    return out;
}

}  // namespace

GBuffer add_gbuffer(FrameGraph& graph, const PassContext& context, const View& camera, bool* anything_seen) {
    return add(graph, context, camera, gpu::Geometry::whole, anything_seen);
}

GBuffer add_simplified_gbuffer(FrameGraph& graph, const PassContext& context, const View& camera) {
    return add(graph, context, camera, gpu::Geometry::simplified, nullptr);
}

void read_gbuffer(PassBuilder& builder, const GBuffer& gbuffer) {
    builder.read(gbuffer.depth);
    builder.read(gbuffer.base_color_roughness);
    builder.read(gbuffer.normal_metallic_specular);
}

void bind_gbuffer(const PassResources& resources, const GBuffer& gbuffer) {
    resources.texture(gbuffer.depth).bind(TEX_DEPTH);
    resources.texture(gbuffer.base_color_roughness).bind(TEX_GBUFFER0);
    resources.texture(gbuffer.normal_metallic_specular).bind(TEX_GBUFFER1);
}

}  // namespace bounce::passes
