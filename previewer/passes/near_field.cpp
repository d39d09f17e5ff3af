// SPDX-License-Identifier: Apache-2.0
#include "passes/near_field.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace bounce::passes {
namespace {

// Sets of samples that are averaged at least: the blur does it over a block of pixels, where blocks are as
// large.
constexpr int k_least_blend = 16;

// Turns of the samples' radii and angles, in [0, 1): those of successive seeds are spread evenly (Roberts
// 2018, "The Unreasonable Effectiveness of Quasirandom Sequences").
glm::vec2 seeded_turns(uint32_t seed) {
    const auto fraction = [&](double step) {
        const double turned = step * seed;
        return static_cast<float>(turned - std::floor(turned));
    };
    return {fraction(0.7548776662466927), fraction(0.5698402909980532)};
}

}  // namespace

TextureHandle add_near_field(FrameGraph& graph, const PassContext& context, const NearFieldInputs& inputs,
                             const GatheredLight& light) {
    const int tiles_x = (context.width + GROUP_2D - 1) / GROUP_2D;
    const int tiles_y = (context.height + GROUP_2D - 1) / GROUP_2D;
    const int tiles = tiles_x * tiles_y;
    BufferHandle list;
    BufferHandle counts;
    graph.add_pass("near tiles", [&](PassBuilder& builder) {
        builder.read(light.reach);
        list = builder.create_buffer("near tiles", static_cast<size_t>(tiles) * 2 * sizeof(GLuint));
        counts = builder.create_buffer("near tiles dispatch", 4 * sizeof(GLuint));
        return [context, interleave = inputs.interleave, light, tiles, list,
                counts](const PassResources& resources) {
            constexpr std::array<GLuint, 4> none = {0, 0, 1, 0};
            resources.buffer(counts).update(std::span<const GLuint>(none));
            context.programs.compute("passes/near_tiles.comp").use();
            context.uniforms.bind(UBO_FRAME, context.frame);
            resources.texture(light.reach).bind_image(IMG_IN, GL_READ_ONLY);
            resources.buffer(list).bind_storage(SSBO_PIXEL_LIST);
            resources.buffer(counts).bind_storage(SSBO_DISPATCH);
            glUniform1i(0, interleave);
            glDispatchCompute((static_cast<GLuint>(tiles) + GROUP_1D - 1) / GROUP_1D, 1, 1);
            finish_writes();
        };
    });
    TextureHandle out;
    graph.add_pass("near field", [&](PassBuilder& builder) {
        read_gbuffer(builder, inputs.gbuffer);
        for (const VplSource& source : inputs.sources) {
            builder.read(source.rsm);
        }
        builder.read(inputs.importance.rows);
        if (inputs.importance.map.valid()) builder.read(inputs.importance.map);
        builder.read(list);
        builder.read(counts);
        out = builder.write(light.bounced);
        return [context, inputs, list, counts, out](const PassResources& resources) {
            context.uniforms.bind(UBO_FRAME, context.frame);
            context.uniforms.bind(UBO_ISM, inputs.uniforms);
            bind_gbuffer(resources, inputs.gbuffer);
            resources.buffer(list).bind_storage(SSBO_PIXEL_LIST);
            resources.buffer(counts).bind_storage(SSBO_NEAR_COUNT);
            resources.buffer(inputs.importance.rows).bind_storage(SSBO_ROW_SUMS);
            resources.texture(out).bind_image(IMG_OUT, GL_READ_WRITE);
            glBindBuffer(GL_DISPATCH_INDIRECT_BUFFER, resources.buffer(counts).id());
            const int rounds = std::max(k_least_blend / (inputs.interleave * inputs.interleave), 1);
            size_t number = 0;
            int first_texel = 0;
            for (const VplSource& source : inputs.sources) {
                gl::Defines defines = light_defines(source.light);
                if (inputs.glossy) defines["GLOSSY"] = "1";
                if (context.scene.has_disney_diffuse()) defines["DISNEY"] = "1";
                const bool mapped = inputs.importance.map.valid() && inputs.importance.even_part < 1.0F;
                if (mapped) read_importance_map(defines);
                context.programs.compute("passes/near_field.comp", defines).use();
                if (mapped) bind_importance_map(resources, inputs.importance.map, first_texel);
                context.uniforms.bind(UBO_LIGHT, source.light.uniforms);
                resources.texture(source.rsm).bind_image(IMG_RSM, GL_READ_ONLY);
                glUniform1i(0, inputs.importance.row_count);
                const glm::vec2 turns = seeded_turns(inputs.seed);
                glUniform3f(2, turns.x, turns.y, inputs.extent);
                glUniform2f(3, inputs.importance.even.empty() ? 0.0F : inputs.importance.even[number],
                            inputs.importance.even_part);
                for (int round = 0; round < rounds; ++round) {
                    glUniform2i(1, round, rounds);
                    glDispatchComputeIndirect(0);
                    finish_writes();
                }
                ++number;
                first_texel += source.light.rsm_size * source.light.rsm_size *
                               static_cast<int>(source.light.faces.size());
            }
        };
    });
    return out;
}

}  // namespace bounce::passes
