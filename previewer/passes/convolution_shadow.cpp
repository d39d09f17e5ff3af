// SPDX-License-Identifier: Apache-2.0
#include "passes/convolution_shadow.h"

#include <array>

namespace bounce::passes {
namespace {

// As shaders/lib/convolution.glsl counts them.
int basis_layers(int order) {
    return 2 * ((order + 1) / 2) + 1;
}

gl::Defines convolution_defines(const LightPass& light) {
    gl::Defines defines = soft_defines(light);
    defines["ORDER"] = std::to_string(light.soft.convolution_order);
    return defines;
}

// Nearest and farthest distance from the light in its map, as the bits of floats.
BufferHandle add_range(FrameGraph& graph, const PassContext& context, const LightPass& light,
                       TextureHandle maps) {
    BufferHandle range;
    graph.add_pass("convolution range: " + light.name, [&](PassBuilder& builder) {
        builder.read(maps);
        range = builder.create_buffer("convolution range", 2 * sizeof(GLuint));
        return [context, light, maps, range](const PassResources& resources) {
            constexpr std::array<GLuint, 2> nothing = {0xffffffffU, 0U};
            resources.buffer(range).update(std::span<const GLuint>(nothing));
            context.programs.compute("passes/convolution_range.comp", convolution_defines(light)).use();
            context.uniforms.bind(UBO_SHADOW_VIEWS, light.soft.chunks.front());
            resources.texture(maps).bind(TEX_SHADOW);
            resources.buffer(range).bind_storage(SSBO_DEPTH_RANGE);
            for (const SoftMaps::Face& face : light.soft.faces) {
                glUniform2i(0, face.layer, light.soft.size);
                dispatch_2d(light.soft.size, light.soft.size);
            }
            finish_writes();
        };
    });
    return range;
}

TextureHandle add_sums(FrameGraph& graph, const PassContext& context, const LightPass& light,
                       TextureHandle maps, BufferHandle range) {
    TextureHandle sums;
    graph.add_pass("convolution sums: " + light.name, [&](PassBuilder& builder) {
        builder.read(maps);
        builder.read(range);
        const int layers = basis_layers(light.soft.convolution_order);
        sums = builder.create_texture("convolution sums", {.format = GL_RGBA32F,
                                                           .width = light.soft.size + 1,
                                                           .height = light.soft.size + 1,
                                                           .layers = light.soft.layers * layers});
        return [context, light, maps, range, sums, layers](const PassResources& resources) {
            context.uniforms.bind(UBO_SHADOW_VIEWS, light.soft.chunks.front());
            resources.texture(maps).bind(TEX_SHADOW);
            resources.buffer(range).bind_storage(SSBO_DEPTH_RANGE);
            resources.texture(sums).bind_image(IMG_OUT, GL_READ_WRITE);
            const auto size = static_cast<GLuint>(light.soft.size);
            context.programs.compute("passes/convolution_rows.comp", convolution_defines(light)).use();
            for (const SoftMaps::Face& face : light.soft.faces) {
                glUniform2i(0, face.layer, light.soft.size);
                glDispatchCompute(size, static_cast<GLuint>(layers), 1);
            }
            finish_writes();
            context.programs.compute("passes/convolution_columns.comp").use();
            for (const SoftMaps::Face& face : light.soft.faces) {
                glUniform2i(0, face.layer * layers, light.soft.size);
                glDispatchCompute(size / GROUP_1D + 1, static_cast<GLuint>(layers), 1);
            }
            finish_writes();
        };
    });
    return sums;
}

}  // namespace

SoftShadow add_convolution_shadow(FrameGraph& graph, const PassContext& context, const GBuffer& gbuffer,
                                  const LightPass& light, TextureHandle maps) {
    const BufferHandle range = add_range(graph, context, light, maps);
    const TextureHandle sums = add_sums(graph, context, light, maps, range);
    SoftShadow out;
    graph.add_pass("convolution shadow: " + light.name, [&](PassBuilder& builder) {
        read_gbuffer(builder, gbuffer);
        builder.read(sums);
        builder.read(range);
        out.shares = builder.create_texture(
            "soft shadow", {.format = GL_RG32F, .width = context.width, .height = context.height});
        return [context, gbuffer, light, sums, range, out](const PassResources& resources) {
            context.programs.compute("passes/convolution_shadow.comp", convolution_defines(light)).use();
            context.uniforms.bind(UBO_FRAME, context.frame);
            context.uniforms.bind(UBO_LIGHT, light.uniforms);
            context.uniforms.bind(UBO_SHADOW_VIEWS, light.soft.chunks.front());
            bind_gbuffer(resources, gbuffer);
            resources.texture(sums).bind(TEX_SHADOW);
            resources.buffer(range).bind_storage(SSBO_DEPTH_RANGE);
            resources.texture(out.shares).bind_image(IMG_OUT, GL_WRITE_ONLY);
            dispatch_2d(context.width, context.height);
            finish_writes();
        };
    });
    return out;
}

}  // namespace bounce::passes
