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

void add_importance_view(FrameGraph& graph, const PassContext& context, const std::vector<VplSource>& sources,
                         size_t shown, const VplImportance& importance, TextureHandle target) {
    glm::ivec4 map(0, sources[shown].light.rsm_size, 0, importance.row_count);
    for (size_t i = 0; i < sources.size(); ++i) {
        const LightPass& light = sources[i].light;
        const int texels = light.rsm_size * light.rsm_size * static_cast<int>(light.faces.size());
        map.x += i < shown ? texels : 0;
        map.z += texels;
    }
    graph.add_pass("importance view", [&](PassBuilder& builder) {
        builder.read(importance.map);
        builder.read(importance.rows);
        const TextureHandle out = builder.write(target);
        return [context, light = sources[shown].light, map, importance, out](const PassResources& resources) {
            context.programs.compute("passes/importance_view.comp", light_defines(light)).use();
            context.uniforms.bind(UBO_FRAME, context.frame);
            context.uniforms.bind(UBO_LIGHT, light.uniforms);
            resources.buffer(importance.map).bind_storage(SSBO_IMPORTANCE);
            resources.buffer(importance.rows).bind_storage(SSBO_ROW_SUMS);
            resources.texture(out).bind_image(IMG_OUT, GL_WRITE_ONLY);
            glUniform4i(0, map.x, map.y, map.z, map.w);
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
