// SPDX-License-Identifier: Apache-2.0
#include "passes/composite.h"

namespace bounce::passes {

TextureHandle add_reflected(FrameGraph& graph, const PassContext& context, const GBuffer& gbuffer,
                            TextureHandle bounced) {
    TextureHandle out;
    graph.add_pass("reflected light", [&](PassBuilder& builder) {
        read_gbuffer(builder, gbuffer);
        builder.read(bounced);
        out = builder.create_texture(
            "reflected light", {.format = GL_RGBA32F, .width = context.width, .height = context.height});
        return [context, gbuffer, bounced, out](const PassResources& resources) {
            context.programs.compute("passes/composite.comp", {{"BOUNCED", "1"}, {"REFLECTED", "1"}}).use();
            context.uniforms.bind(UBO_FRAME, context.frame);
            bind_gbuffer(resources, gbuffer);
            resources.texture(bounced).bind_image(IMG_IN, GL_READ_ONLY);
            resources.texture(out).bind_image(IMG_OUT, GL_WRITE_ONLY);
            dispatch_2d(context.width, context.height);
            finish_writes();
        };
    });
    return out;
}

TextureHandle add_composite(FrameGraph& graph, const PassContext& context, const CompositeInputs& inputs,
                            TextureHandle target) {
    TextureHandle out;
    graph.add_pass("composite", [&](PassBuilder& builder) {
        read_gbuffer(builder, inputs.gbuffer);
        gl::Defines defines;
        if (inputs.direct.valid()) {
            builder.read(inputs.direct);
            defines["DIRECT"] = "1";
        }
        if (inputs.irradiance.valid()) {
            builder.read(inputs.irradiance);
            defines["INDIRECT"] = "1";
        }
        if (inputs.bounced.valid()) {
            builder.read(inputs.bounced);
            defines["BOUNCED"] = "1";
        }
        if (inputs.image.maps != nullptr) defines["ENVIRONMENT"] = "1";
        if (inputs.image.maps != nullptr && inputs.lobes.valid()) {
            builder.read(inputs.lobes);
            defines["ENVIRONMENT_GLOSSY"] = "1";
        }
        if (inputs.radiance.valid()) {
            builder.read(inputs.radiance);
            defines["RADIANCE"] = "1";
        }
        if (inputs.world_light) defines["WORLD"] = "1";
        if (inputs.layer) {
            builder.read(inputs.gbuffer.geometric_normal);
            defines["LAYER"] = "1";
        }
        const bool emission = inputs.emission && inputs.gbuffer.emission.valid();
        if (emission) {
            builder.read(inputs.gbuffer.emission);
            defines["EMISSION"] = "1";
        }
        out = target.valid()
                  ? builder.write(target)
                  : builder.create_texture(
                        "picture", {.format = GL_RGBA32F, .width = context.width, .height = context.height});
        return [context, inputs, emission, out, defines](const PassResources& resources) {
            context.programs.compute("passes/composite.comp", defines).use();
            context.uniforms.bind(UBO_FRAME, context.frame);
            bind_gbuffer(resources, inputs.gbuffer);
            if (inputs.direct.valid()) resources.texture(inputs.direct).bind(TEX_DIRECT);
            if (inputs.irradiance.valid()) resources.texture(inputs.irradiance).bind(TEX_INDIRECT);
            if (inputs.bounced.valid()) resources.texture(inputs.bounced).bind_image(IMG_IN, GL_READ_ONLY);
            if (inputs.image.maps != nullptr) {
                context.uniforms.bind(UBO_WORLD, inputs.image.uniforms);
                inputs.image.maps->image.bind(TEX_ENVIRONMENT);
                inputs.image.maps->glossy.bind(TEX_ENVIRONMENT_GLOSSY);
                inputs.image.maps->brdf.bind(TEX_ENVIRONMENT_BRDF);
            }
            if (inputs.lobes.valid()) resources.texture(inputs.lobes).bind_image(IMG_LOBES, GL_READ_ONLY);
            if (inputs.radiance.valid()) resources.texture(inputs.radiance).bind(TEX_RSM);
            if (inputs.layer) {
                resources.texture(inputs.gbuffer.geometric_normal).bind(TEX_GEOMETRIC_NORMAL);
            }
            if (emission) resources.texture(inputs.gbuffer.emission).bind(TEX_GBUFFER2);
            resources.texture(out).bind_image(IMG_OUT, GL_WRITE_ONLY);
            dispatch_2d(context.width, context.height);
            finish_writes();
        };
    });
    return out;
}

}  // namespace bounce::passes
