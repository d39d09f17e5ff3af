// SPDX-License-Identifier: Apache-2.0
#include "passes/vpl_choice.h"

namespace bounce::passes {
namespace {

int sampler_of(VplSampling sampling) {
    switch (sampling) {
        case VplSampling::inverse2:
            return SAMPLER_INVERSE2;
        case VplSampling::inverse3:
            return SAMPLER_INVERSE3;
        case VplSampling::metropolis:
            return SAMPLER_METROPOLIS;
        case VplSampling::metropolis_single:
            return SAMPLER_SINGLE;
        case VplSampling::metropolis_unreduced:
            return SAMPLER_UNREDUCED;
        case VplSampling::resampled:
            return SAMPLER_RESAMPLED;
        case VplSampling::uniform3:
        case VplSampling::inverse_transform:
        case VplSampling::uniform:
        case VplSampling::avg:
            break;
    }
    return SAMPLER_UNIFORM;
}

bool reads_rows(VplSampling sampling) {
    return sampling == VplSampling::inverse2 || sampling == VplSampling::inverse3 || is_chain(sampling);
}

bool reads_texels(VplSampling sampling) {
    return sampling == VplSampling::inverse2 || sampling == VplSampling::inverse3;
}

}  // namespace

BufferHandle add_vpl_choice(FrameGraph& graph, const PassContext& context,
                            const std::vector<MapSource>& sources, const ImportanceTables& tables,
                            const Choosing& choosing, const std::string& of) {
    std::vector<glm::uvec4> table;
    for_each_map(sources, [&](const MapSource& source, int row, int texel) {
        table.emplace_back(texel, source.texels(), row, source.rows);
    });
    BufferHandle choices;
    graph.add_pass("vpl choice" + of, [&](PassBuilder& builder) {
        builder.read(tables.importance);
        if (reads_rows(choosing.sampling)) builder.read(tables.rows);
        if (reads_texels(choosing.sampling)) builder.read(tables.texels);
        const BufferHandle listed = builder.create_buffer("vpl sources", table.size() * sizeof(glm::uvec4));
        choices =
            builder.create_buffer("vpl choices", static_cast<size_t>(choosing.lights) * sizeof(glm::uvec4));
        builder.decided_by(hash_of(sources)
                               .add_all(std::span<const glm::uvec4>(table))
                               .add(choosing.sampling)
                               .add(choosing.lights)
                               .add(choosing.steps)
                               .add(choosing.seed)
                               .key());
        return [context, tables, choosing, table, rows = rows_of(sources), listed,
                choices](const PassResources& resources) {
            resources.buffer(listed).update(std::span<const glm::uvec4>(table));
            context.programs
                .compute("passes/vpl_choose.comp",
                         {{"SAMPLER", std::to_string(sampler_of(choosing.sampling))}})
                .use();
            resources.buffer(listed).bind_storage(SSBO_VPL_SOURCES);
            resources.buffer(tables.importance).bind_storage(SSBO_IMPORTANCE);
            if (reads_rows(choosing.sampling)) resources.buffer(tables.rows).bind_storage(SSBO_ROW_SUMS);
            if (reads_texels(choosing.sampling))
                resources.buffer(tables.texels).bind_storage(SSBO_TEXEL_SUMS);
            resources.buffer(choices).bind_storage(SSBO_VPL_CHOICES);
            glUniform4i(0, choosing.lights, static_cast<GLint>(table.size()), rows, choosing.steps);
            glUniform1ui(1, choosing.seed);
            dispatch_1d(choosing.lights);
            finish_writes();
        };
    });
    return choices;
}

}  // namespace bounce::passes
