// SPDX-License-Identifier: Apache-2.0
#include "passes/direct_light.h"

namespace bounce::passes {

TextureHandle add_direct_light(FrameGraph& graph, const PassContext& context, const GBuffer& gbuffer,
                               const LightPass& light, TextureHandle shadow_map, const SoftShadow& soft,
                               TextureHandle sum) {
    TextureHandle out;
    graph.add_pass("direct light: " + light.name, [&](PassBuilder& builder) {
        read_gbuffer(builder, gbuffer);
        const bool first = !sum.valid();
        out = first ? builder.create_texture(
                          "direct", {.format = GL_RGBA32F, .width = context.width, .height = context.height})
                    : builder.write(sum);
        gl::Defines defines = light_defines(light);
        if (first) defines["FIRST_LIGHT"] = "1";
        if (context.scene.has_disney_diffuse()) defines["DISNEY"] = "1";
        if (context.scene.has_specular() && light.glossy) defines["SPECULAR"] = "1";
        if (light.sized) defines["SIZED"] = "1";
        if (light.lobes != nullptr) defines["LOBES"] = "1";
        if (shadow_map.valid()) {
            builder.read(shadow_map);
            builder.read(gbuffer.geometric_normal);
            defines["SHADOW"] = "1";
        }
        if (soft.shares.valid()) {
            builder.read(soft.shares);
            defines["SOFT_SHADOW"] = "1";
            if (!light.tints.empty()) defines["TINTED"] = "1";
        }
        if (soft.flags.valid()) {
            builder.read(soft.flags);
            defines["SOFT_TILES"] = "1";
        }
        return [context, gbuffer, light, shadow_map, soft, out, defines](const PassResources& resources) {
            context.programs.compute("passes/direct_light.comp", defines).use();
            context.uniforms.bind(UBO_FRAME, context.frame);
            context.uniforms.bind(UBO_LIGHT, light.uniforms);
            bind_gbuffer(resources, gbuffer);
            if (shadow_map.valid()) {
                resources.texture(shadow_map).bind(TEX_SHADOW);
                resources.texture(gbuffer.geometric_normal).bind(TEX_GEOMETRIC_NORMAL);
            }
            if (light.lobes != nullptr) {
                light.lobes->bind();
            }
            if (soft.shares.valid()) {
                resources.texture(soft.shares).bind_image(IMG_IN, GL_READ_ONLY);
            }
            if (soft.flags.valid()) {
                resources.buffer(soft.flags).bind_storage(SSBO_TILE_FLAGS);
            }
            resources.texture(out).bind_image(IMG_OUT, GL_READ_WRITE);
            dispatch_2d(context.width, context.height);
            finish_writes();
        };
    });
    return out;
}

}  // namespace bounce::passes
