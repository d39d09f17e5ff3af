// SPDX-License-Identifier: Apache-2.0
#include "passes/rsm_gather.h"

#include <algorithm>
#include <array>

namespace bounce::passes {
namespace {

enum class Mode { full, low_resolution, list };

void declare(PassBuilder& builder, const GatherInputs& inputs) {
    read_gbuffer(builder, inputs.gbuffer);
    for (const RsmSource& source : inputs.sources) {
        builder.read(source.rsm);
    }
}

// Texels a dispatch of the full sum visits at most, for each pixel.
constexpr int k_texels_a_dispatch = 1 << 15;

// One dispatch for each band of the map's rows; the first overwrites where FIRST_LIGHT is set.
void dispatch_full_sum(const PassContext& context, const LightPass& light, gl::Defines defines,
                       const gl::Texture& target) {
    const int rows = std::max(k_texels_a_dispatch / light.rsm_size, 1);
    for (int layer = 0; layer < static_cast<int>(light.faces.size()); ++layer) {
        for (int row = 0; row < light.rsm_size; row += rows) {
            context.programs.compute("passes/rsm_gather.comp", defines).use();
            glUniform3i(0, layer, row, std::min(row + rows, light.rsm_size));
            dispatch_2d(target.desc().width, target.desc().height);
            finish_writes();
            defines.erase("FIRST_LIGHT");
        }
    }
}

// Gathers from every light in turn into `target`.
void gather(const PassContext& context, const PassResources& resources, const GatherInputs& inputs, Mode mode,
            const gl::Texture& target) {
    bind_gbuffer(resources, inputs.gbuffer);
    target.bind_image(IMG_OUT, GL_READ_WRITE);
    bool first = mode != Mode::list;  // listed pixels were set to zero by the interpolation
    for (const RsmSource& source : inputs.sources) {
        gl::Defines defines = light_defines(source.light);
        if (first || (mode == Mode::list && &source == &inputs.sources.front())) defines["FIRST_LIGHT"] = "1";
        if (context.scene.has_disney_diffuse()) defines["DISNEY"] = "1";
        if (inputs.full_sum) defines["FULL_SUM"] = "1";
        if (mode == Mode::low_resolution) defines["LOW_RESOLUTION"] = "1";
        if (mode == Mode::list) defines["LIST"] = "1";
        context.uniforms.bind(UBO_FRAME, source.frame);
        context.uniforms.bind(UBO_LIGHT, source.light.uniforms);
        source.pattern->bind_storage(SSBO_PATTERN);
        resources.texture(source.rsm).bind(TEX_RSM);
        if (inputs.full_sum) {
            dispatch_full_sum(context, source.light, defines, target);
            first = false;
            continue;
        }
        context.programs.compute("passes/rsm_gather.comp", defines).use();
        if (mode == Mode::list) {
            glDispatchComputeIndirect(0);
        } else {
            dispatch_2d(target.desc().width, target.desc().height);
        }
        finish_writes();
        first = false;
    }
}

}  // namespace

TextureHandle add_rsm_gather(FrameGraph& graph, const PassContext& context, const GatherInputs& inputs) {
    TextureHandle out;
    graph.add_pass("rsm gather", [&](PassBuilder& builder) {
        declare(builder, inputs);
        out = builder.create_texture(
            "irradiance", {.format = GL_RGBA32F, .width = context.width, .height = context.height});
        return [context, inputs, out](const PassResources& resources) {
            gather(context, resources, inputs, Mode::full, resources.texture(out));
        };
    });
    return out;
}

InterpolatedGather add_rsm_gather_interpolated(FrameGraph& graph, const PassContext& context,
                                               const GatherInputs& inputs, int step) {
    TextureHandle low;
    graph.add_pass("rsm gather, low resolution", [&](PassBuilder& builder) {
        declare(builder, inputs);
        low = builder.create_texture("low-resolution irradiance",
                                     {.format = GL_RGBA32F,
                                      .width = (context.width + step - 1) / step,
                                      .height = (context.height + step - 1) / step});
        return [context, inputs, low](const PassResources& resources) {
            gather(context, resources, inputs, Mode::low_resolution, resources.texture(low));
        };
    });

    TextureHandle interpolated;
    BufferHandle list;
    BufferHandle counts;
    graph.add_pass("rsm interpolate", [&](PassBuilder& builder) {
        read_gbuffer(builder, inputs.gbuffer);
        builder.read(low);
        interpolated = builder.create_texture(
            "irradiance", {.format = GL_RGBA32F, .width = context.width, .height = context.height});
        const auto pixels = static_cast<size_t>(context.width) * static_cast<size_t>(context.height);
        list = builder.create_buffer("pixel list", pixels * sizeof(GLuint));
        counts = builder.create_buffer("pixel list dispatch", 4 * sizeof(GLuint));
        return [context, inputs, low, interpolated, list, counts](const PassResources& resources) {
            context.programs.compute("passes/rsm_interpolate.comp").use();
            context.uniforms.bind(UBO_FRAME, context.frame);
            bind_gbuffer(resources, inputs.gbuffer);
            resources.texture(low).bind(TEX_LOWRES);
            resources.texture(interpolated).bind_image(IMG_OUT, GL_WRITE_ONLY);
            constexpr std::array<GLuint, 4> none = {0, 1, 1, 0};
            resources.buffer(counts).update(std::span<const GLuint>(none));
            resources.buffer(list).bind_storage(SSBO_PIXEL_LIST);
            resources.buffer(counts).bind_storage(SSBO_DISPATCH);
            dispatch_2d(context.width, context.height);
            finish_writes();
        };
    });

    TextureHandle complete;
    graph.add_pass("rsm gather, rest", [&](PassBuilder& builder) {
        declare(builder, inputs);
        builder.read(list);
        builder.read(counts);
        complete = builder.write(interpolated);
        return [context, inputs, complete, list, counts](const PassResources& resources) {
            resources.buffer(list).bind_storage(SSBO_PIXEL_LIST);
            resources.buffer(counts).bind_storage(SSBO_DISPATCH);
            glBindBuffer(GL_DISPATCH_INDIRECT_BUFFER, resources.buffer(counts).id());
            gather(context, resources, inputs, Mode::list, resources.texture(complete));
        };
    });
    return {complete, counts};
}

}  // namespace bounce::passes
