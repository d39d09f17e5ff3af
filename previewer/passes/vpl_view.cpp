// SPDX-License-Identifier: Apache-2.0
#include "passes/vpl_view.h"

#include <algorithm>
#include <array>

namespace bounce::passes {
namespace {

constexpr std::array<std::array<float, 3>, 4> k_bounce_colors = {
    {{1.0F, 0.35F, 0.02F}, {0.05F, 0.45F, 1.0F}, {1.0F, 0.1F, 0.6F}, {0.15F, 1.0F, 0.2F}}};

// Pixels: large enough to tell rim from middle, small enough to leave 1,024 of them apart.
float dot_radius(int height) {
    return std::clamp(static_cast<float>(height) / 120.0F, 2.5F, 8.0F);
}

}  // namespace

TextureHandle add_dimmed(FrameGraph& graph, const PassContext& context, TextureHandle target) {
    TextureHandle out;
    graph.add_pass("vpl view, dimmed", [&](PassBuilder& builder) {
        out = builder.write(target);
        return [context, out](const PassResources& resources) {
            context.programs.compute("passes/vpl_view_dim.comp").use();
            context.uniforms.bind(UBO_FRAME, context.frame);
            resources.texture(out).bind_image(IMG_OUT, GL_READ_WRITE);
            dispatch_2d(context.width, context.height);
            finish_writes();
        };
    });
    return out;
}

TextureHandle add_vpl_dots(FrameGraph& graph, const PassContext& context, const GBuffer& gbuffer,
                           const View& camera, const std::vector<VplDots>& dots, TextureHandle target) {
    TextureHandle out;
    graph.add_pass("vpl view", [&](PassBuilder& builder) {
        read_gbuffer(builder, gbuffer);
        for (const VplDots& bounce : dots) {
            builder.read(bounce.set.vpls);
        }
        out = builder.write(target);
        return [context, gbuffer, camera, dots, out](const PassResources& resources) {
            resources.framebuffer({{&resources.texture(out)}}).bind();
            context.programs.raster("passes/vpl_view.vert", "passes/vpl_view.frag", {}).use();
            context.uniforms.bind(UBO_FRAME, context.frame);
            context.uniforms.bind(UBO_VIEW, camera.uniforms);
            bind_gbuffer(resources, gbuffer);
            context.scene.bind_vertex_array();  // nothing is read from it, but a core profile wants one
            glUniform1f(1, dot_radius(context.height));
            glEnable(GL_PROGRAM_POINT_SIZE);
            // What is hidden first, so that no dot that is seen lies under one that is not.
            for (const int seen : {0, 1}) {
                glUniform1i(2, seen);
                for (const VplDots& bounce : dots) {
                    context.uniforms.bind(UBO_ISM, bounce.set.uniforms);
                    resources.buffer(bounce.set.vpls).bind_storage(SSBO_VPLS);
                    const auto place = static_cast<size_t>(bounce.bounce - 1) % k_bounce_colors.size();
                    glUniform3fv(0, 1, k_bounce_colors[place].data());
                    glDrawArrays(GL_POINTS, std::max(bounce.only, 0), bounce.only >= 0 ? 1 : bounce.set.maps);
                }
            }
            glDisable(GL_PROGRAM_POINT_SIZE);
            finish_writes();
        };
    });
    return out;
}

TextureHandle add_ism_view(FrameGraph& graph, const PassContext& context, const VplSet& set,
                           TextureHandle atlas, int only, TextureHandle target) {
    TextureHandle out;
    graph.add_pass("ism view", [&](PassBuilder& builder) {
        builder.read(atlas);
        out = builder.write(target);
        return [context, set, atlas, only, out](const PassResources& resources) {
            context.programs.compute("passes/ism_view.comp").use();
            context.uniforms.bind(UBO_FRAME, context.frame);
            context.uniforms.bind(UBO_ISM, set.uniforms);
            resources.texture(atlas).bind_image(IMG_IN, GL_READ_ONLY);
            resources.texture(out).bind_image(IMG_OUT, GL_WRITE_ONLY);
            glUniform1i(0, std::min(only, set.maps - 1));
            dispatch_2d(context.width, context.height);
            finish_writes();
        };
    });
    return out;
}

TextureHandle add_vpl_visibility_view(FrameGraph& graph, const PassContext& context, const GBuffer& gbuffer,
                                      const VplSet& set, bool slope_bias, int light, TextureHandle target) {
    TextureHandle out;
    graph.add_pass("vpl visibility view", [&](PassBuilder& builder) {
        read_gbuffer(builder, gbuffer);
        builder.read(set.vpls);
        if (set.atlas.valid()) builder.read(set.atlas);
        out = builder.write(target);
        return [context, gbuffer, set, slope_bias, light, out](const PassResources& resources) {
            gl::Defines defines;
            if (set.atlas.valid()) defines["VISIBILITY"] = "1";
            if (slope_bias) defines["SLOPE_BIAS"] = "1";
            context.programs.compute("passes/vpl_visibility_view.comp", defines).use();
            context.uniforms.bind(UBO_FRAME, context.frame);
            context.uniforms.bind(UBO_ISM, set.uniforms);
            bind_gbuffer(resources, gbuffer);
            resources.buffer(set.vpls).bind_storage(SSBO_VPLS);
            if (set.atlas.valid()) resources.texture(set.atlas).bind_image(IMG_ISM, GL_READ_ONLY);
            resources.texture(out).bind_image(IMG_OUT, GL_WRITE_ONLY);
            glUniform1i(0, std::min(light, set.maps - 1));
            dispatch_2d(context.width, context.height);
            finish_writes();
        };
    });
    return out;
}

}  // namespace bounce::passes
