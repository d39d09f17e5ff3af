// SPDX-License-Identifier: Apache-2.0
#include "passes/composite.h"

namespace bounce::passes {

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
