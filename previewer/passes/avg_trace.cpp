// SPDX-License-Identifier: Apache-2.0
#include "passes/avg_trace.h"

#include <cmath>

#include "passes/float_layouts.h"
#include "passes/vpl_sampling.h"

namespace bounce::passes {
namespace {

GLuint groups_of(int count) {
    return (static_cast<GLuint>(count) + GROUP_1D - 1) / GROUP_1D;
}

// Steps along four axes whose multiples stay far apart (Roberts 2018, "The Unreasonable Effectiveness of
// Quasirandom Sequences").
glm::vec4 turn_of(int bounce) {
    glm::vec4 turn;
    for (int i = 0; i < 4; ++i) {
        const double step = std::pow(1.0 / 1.1673039782614187, i + 1);
        turn[i] = static_cast<float>(step * bounce - std::floor(step * bounce));
    }
    return turn;
}

// More than there are bounces, so that no two seeds share a turn.
constexpr int k_bounces_a_seed = 16;

// before: the lights that rays start at; null where they are those of `rays`.
VplSet add_trace(FrameGraph& graph, const PassContext& context, const AvgTraceInputs& inputs,
                 const VplSet& layout, const gl::Buffer* rays, const VplSet* before) {
    BufferHandle sums;
    if (before != nullptr) {
        graph.add_pass("avg flux", [&](PassBuilder& builder) {
            builder.read(before->vpls);
            sums = builder.create_buffer("avg flux", static_cast<size_t>(before->maps) * sizeof(float),
                                         k_all_floats);
            builder.decided_by(content(context, *before));
            return [context, before = *before, sums](const PassResources& resources) {
                gl::Defines defines;
                if (before.distant) defines["DISTANT"] = "1";
                context.programs.compute("passes/avg_flux.comp", defines).use();
                context.uniforms.bind(UBO_ISM, before.uniforms);
                resources.buffer(before.vpls).bind_storage(SSBO_VPLS);
                resources.buffer(sums).bind_storage(SSBO_ROW_SUMS);
                glDispatchCompute(groups_of(before.maps), 1, 1);
                finish_writes();
                context.programs.compute("passes/vpl_scan.comp").use();
                resources.buffer(sums).bind_storage(SSBO_ROW_SUMS);
                glUniform1i(0, before.maps);
                glDispatchCompute(1, 1, 1);
                finish_writes();
            };
        });
    }
    VplSet out = layout;
    graph.add_pass(before == nullptr ? "avg trace" : "avg trace, next bounce", [&](PassBuilder& builder) {
        builder.read(inputs.grid.cells);
        builder.read(inputs.grid.surfaces);
        if (before != nullptr) {
            builder.read(before->vpls);
            builder.read(sums);
        }
        out.vpls = builder.create_buffer("vpls", static_cast<size_t>(layout.maps) * sizeof(gpu::GpuVpl),
                                         k_vpl_floats);
        ContentHash hash;
        hash.add(content(context, inputs.grid.uniforms)).add(content(context, layout));
        hash.add(inputs.hits).add(inputs.paths).add(inputs.sequences).add(inputs.bounce).add(inputs.glossy);
        hash.add(context.scene.has_disney_diffuse()).add(inputs.numbers->bytes());
        if (before != nullptr) {
            hash.add(content(context, *before));
        } else {
            hash.add(inputs.rays);
        }
        builder.decided_by(hash.key());
        return [context, inputs, out, rays, sums, first = before == nullptr,
                before = before == nullptr ? VplSet{} : *before](const PassResources& resources) {
            gl::Defines defines;
            if (first) defines["FROM_LIGHTS"] = "1";
            if (before.distant) defines["DISTANT"] = "1";
            if (inputs.hits == AvgHits::voxels) defines["WHOLE_VOXELS"] = "1";
            if (inputs.paths == AvgPaths::roulette) defines["ROULETTE"] = "1";
            if (inputs.glossy) defines["GLOSSY"] = "1";
            if (context.scene.has_disney_diffuse()) defines["DISNEY"] = "1";
            context.programs.compute("passes/avg_trace.comp", defines).use();
            context.uniforms.bind(UBO_AVG, inputs.grid.uniforms);
            resources.texture(inputs.grid.cells).bind_image(IMG_AVG_CELLS, GL_READ_ONLY);
            resources.buffer(inputs.grid.surfaces).bind_storage(SSBO_AVG_VOXELS);
            inputs.numbers->bind_storage(SSBO_AVG_NUMBERS);
            if (first) {
                rays->bind_storage(SSBO_AVG_RAYS);
            } else {
                context.uniforms.bind(UBO_ISM, before.uniforms);
                resources.buffer(before.vpls).bind_storage(SSBO_VPLS);
                resources.buffer(sums).bind_storage(SSBO_ROW_SUMS);
            }
            resources.buffer(out.vpls).bind_storage(SSBO_VPLS_OUT);
            const glm::vec4 turn =
                turn_of(inputs.bounce / inputs.sequences + static_cast<int>(out.seed) * k_bounces_a_seed);
            const auto numbers =
                static_cast<int>(inputs.numbers->bytes() / sizeof(glm::vec4)) / inputs.sequences;
            glUniform3i(0, out.maps, out.map_size, out.columns);
            glUniform3i(1, before.maps, out.interleave, out.subset);
            glUniform4f(2, turn.x, turn.y, turn.z, turn.w);
            glUniform1i(3, inputs.bounce % inputs.sequences * numbers);
            glDispatchCompute(groups_of(out.maps), 1, 1);
            finish_writes();
        };
    });
    out.vpls = add_traced_spacing(graph, context, out, inputs.grid.uniforms);
    return out;
}

}  // namespace

VplSet add_vpls_from_rays(FrameGraph& graph, const PassContext& context, const AvgTraceInputs& inputs,
                          const gl::Buffer& rays, VplSet layout) {
    return add_trace(graph, context, inputs, layout, &rays, nullptr);
}

VplSet add_vpls_from_avg(FrameGraph& graph, const PassContext& context, const AvgTraceInputs& inputs,
                         const VplSet& before, VplSet layout) {
    return add_trace(graph, context, inputs, layout, nullptr, &before);
}

}  // namespace bounce::passes
