// SPDX-License-Identifier: Apache-2.0
#include "passes/layer_view.h"

namespace bounce::passes {

void add_rsm_layer_view(FrameGraph& graph, const PassContext& context, const RsmSource& source, Layer layer,
                        TextureHandle target) {
    graph.add_pass("rsm layer view", [&](PassBuilder& builder) {
        builder.read(source.rsm);
        const TextureHandle out = builder.write(target);
        return [context, source, layer, out](const PassResources& resources) {
            gl::Defines defines = light_defines(source.light);
            defines["LAYER"] = std::to_string(static_cast<int>(layer));
            context.programs.compute("passes/rsm_layer_view.comp", defines).use();
            context.uniforms.bind(UBO_FRAME, context.frame);
            context.uniforms.bind(UBO_LIGHT, source.light.uniforms);
            resources.texture(source.rsm).bind(TEX_RSM);
            resources.texture(out).bind_image(IMG_OUT, GL_WRITE_ONLY);
            dispatch_2d(context.width, context.height);
            finish_writes();
        };
    });
}

void add_interpolation_view(FrameGraph& graph, const PassContext& context, const GBuffer& gbuffer,
                            TextureHandle irradiance, TextureHandle target) {
    graph.add_pass("interpolation view", [&](PassBuilder& builder) {
        read_gbuffer(builder, gbuffer);
        builder.read(irradiance);
        const TextureHandle out = builder.write(target);
        return [context, gbuffer, irradiance, out](const PassResources& resources) {
            context.programs.compute("passes/interpolation_view.comp").use();
            context.uniforms.bind(UBO_FRAME, context.frame);
            bind_gbuffer(resources, gbuffer);
            resources.texture(irradiance).bind(TEX_INDIRECT);
            resources.texture(out).bind_image(IMG_OUT, GL_WRITE_ONLY);
            dispatch_2d(context.width, context.height);
            finish_writes();
        };
    });
}

}  // namespace bounce::passes
