// SPDX-License-Identifier: Apache-2.0
#include "passes/vpl_sampling.h"

#include <algorithm>

#include "passes/float_layouts.h"
#include "passes/vpl_choice.h"
#include "passes/vpl_map_source.h"

namespace bounce::passes {
namespace {

// What lights are drawn by.
struct Tables {
    ImportanceTables buffers;  // importance is invalid where texels' flux is
    BufferHandle choices;      // invalid where lights are not chosen first
};

// The lights themselves.
BufferHandle add_draw(FrameGraph& graph, const PassContext& context, const std::vector<MapSource>& sources,
                      const Tables& tables, const VplSet& layout, const std::string& of,
                      VplSampling sampling) {
    const bool uniform = sampling == VplSampling::uniform;
    const bool chosen = tables.choices.valid();
    BufferHandle vpls;
    graph.add_pass("vpls" + of, [&](PassBuilder& builder) {
        const BufferHandle importance = tables.buffers.importance;
        const bool mapped = importance.valid() && !chosen && !uniform;
        for (const MapSource& source : sources) {
            source.declare(builder);
        }
        if (chosen) {
            builder.read(tables.choices);
        } else if (!uniform) {
            builder.read(tables.buffers.rows);
            builder.read(tables.buffers.texels);
            if (mapped) builder.read(importance);
        }
        vpls = builder.create_buffer("vpls", static_cast<size_t>(layout.maps) * sizeof(gpu::GpuVpl),
                                     k_vpl_floats);
        builder.decided_by(
            hash_of(sources).add(content(context, layout)).add(sampling).add(mapped).add(chosen).key());
        return [context, sources, layout, rows = rows_of(sources), tables, vpls, uniform, chosen, mapped,
                importance](const PassResources& resources) {
            GLuint number = 0;
            for_each_map(sources, [&](const MapSource& source, int row, int texel) {
                gl::Defines defines = source.defines;
                if (uniform) defines["HALTON"] = "1";
                if (chosen) defines["CHOSEN"] = "1";
                if (mapped) read_importance_map(defines);
                if (layout.seed != 0) defines["SEEDED"] = "1";
                if (layout.seed != 0 && layout.middle) defines["MIDDLE"] = "1";
                context.programs.compute("passes/vpl_draw.comp", defines).use();
                source.bind(resources);
                if (chosen) {
                    resources.buffer(tables.choices).bind_storage(SSBO_VPL_CHOICES);
                    glUniform1ui(3, number);
                } else if (uniform) {
                    glUniform2f(3, source.share.x, source.share.y);
                } else {
                    resources.buffer(tables.buffers.rows).bind_storage(SSBO_ROW_SUMS);
                    resources.buffer(tables.buffers.texels).bind_storage(SSBO_TEXEL_SUMS);
                    if (mapped) bind_importance_map(resources, importance, texel);
                }
                resources.buffer(vpls).bind_storage(SSBO_VPLS_OUT);
                if (layout.seed != 0) {
                    glUniform1ui(4, layout.seed);
                    glUniform1f(5, layout.extent);
                }
                glUniform4i(0, row, source.rows, rows, texel);
                glUniform3i(1, layout.interleave, layout.subset, layout.cell_columns);
                glUniform3i(2, layout.maps, layout.map_size, layout.columns);
                dispatch_1d(layout.maps);
                ++number;
            });
            finish_writes();
        };
    });
    return vpls;
}

// VplImportance::even_part.
float even_part(const Drawing& drawing) {
    if (is_chain(drawing.sampling)) {
        return 1.0F / static_cast<float>(drawing.steps);
    }
    return drawing.sampling == VplSampling::uniform || drawing.sampling == VplSampling::uniform3 ? 1.0F
                                                                                                 : 0.0F;
}

// Texels that each light stands for, where lights are drawn evenly.
std::vector<float> even_texels(const std::vector<MapSource>& sources, int lights, VplSampling sampling) {
    std::vector<float> out;
    for (const MapSource& source : sources) {
        const float share = sampling == VplSampling::uniform ? source.share.y - source.share.x
                                                             : 1.0F / static_cast<float>(sources.size());
        out.push_back(static_cast<float>(source.texels()) / (static_cast<float>(lights) * share));
    }
    return out;
}

DrawnVpls add_vpls(FrameGraph& graph, const PassContext& context, const std::vector<MapSource>& sources,
                   const VplSet& layout, const std::string& of, bool even_rows, const Drawing& drawing) {
    const bool chosen = is_chosen(drawing.sampling);
    BufferHandle importance;
    if (drawing.view || drawing.map || chosen) {
        importance = add_vpl_importance(graph, context, sources, drawing.view, layout.maps, of);
    }
    Tables tables{add_importance_sums(graph, context, sources, importance, of, even_rows), {}};
    if (chosen) {
        tables.choices = add_vpl_choice(graph, context, sources, tables.buffers,
                                        {drawing.sampling, layout.maps, drawing.steps, layout.seed}, of);
    }
    DrawnVpls out{layout,
                  {tables.buffers.rows, rows_of(sources), importance,
                   even_texels(sources, layout.maps, drawing.sampling), even_part(drawing)}};
    out.set.vpls = add_draw(graph, context, sources, tables, layout, of, drawing.sampling);
    return out;
}

// Lights that one is compared with to find how densely they lie.
constexpr int k_most_compared = 256;

// traced: AvgUniforms, where the lights come from rays through that grid.
BufferHandle add_spacing(FrameGraph& graph, const PassContext& context, const VplSet& set,
                         const gpu::UniformArena::Slot* traced) {
    BufferHandle out;
    graph.add_pass("vpl spacing", [&](PassBuilder& builder) {
        out = builder.write(set.vpls);
        ContentHash hash;
        hash.add(content(context, set));
        if (traced != nullptr) hash.add(content(context, *traced));
        builder.decided_by(hash.key());
        return [context, set, out, grid = traced == nullptr ? gpu::UniformArena::Slot{} : *traced,
                traced = traced != nullptr](const PassResources& resources) {
            gl::Defines defines;
            if (traced) defines["TRACED"] = "1";
            context.programs.compute("passes/vpl_spacing.comp", defines).use();
            if (traced) context.uniforms.bind(UBO_AVG, grid);
            context.uniforms.bind(UBO_ISM, set.uniforms);
            resources.buffer(out).bind_storage(SSBO_VPLS_OUT);
            glUniform1i(0, std::max(set.maps / k_most_compared, 1));
            glUniform1f(1, set.extent);
            dispatch_1d(set.maps);
            finish_writes();
        };
    });
    return out;
}

}  // namespace

BufferHandle add_traced_spacing(FrameGraph& graph, const PassContext& context, const VplSet& set,
                                gpu::UniformArena::Slot grid) {
    return add_spacing(graph, context, set, &grid);
}

DrawnVpls add_vpls_from_rsms(FrameGraph& graph, const PassContext& context,
                             const std::vector<VplSource>& sources, VplSet layout, const Drawing& drawing) {
    std::vector<MapSource> all;
    double flux = 0.0;
    for (const VplSource& source : sources) {
        flux += source.light.flux_w;
    }
    double before = 0.0;
    for (const VplSource& source : sources) {
        const LightPass& light = source.light;
        const bool last = &source == &sources.back();
        const double after = last ? flux : before + light.flux_w;
        const glm::vec2 share(glm::dvec2(before, after) / flux);
        before = after;
        all.push_back({with_lobes(light_defines(light), context, drawing.glossy), light.rsm_size,
                       light.rsm_size * static_cast<int>(light.faces.size()), share,
                       [source](PassBuilder& builder) { builder.read(source.rsm); },
                       content(context, light.uniforms),
                       [context, source](const PassResources& resources) {
                           context.uniforms.bind(UBO_LIGHT, source.light.uniforms);
                           resources.texture(source.rsm).bind(TEX_RSM);
                       }});
    }
    return add_vpls(graph, context, all, layout, "", false, drawing);
}

DrawnVpls add_vpls_from_irsms(FrameGraph& graph, const PassContext& context, const IrsmSource& source,
                              VplSet layout, bool glossy) {
    gl::Defines defines{{"FROM_IRSM", "1"}};
    if (source.set.distant) defines["DISTANT"] = "1";
    const bool splatted = source.irsm.valid();
    const TextureHandle map = splatted ? source.irsm : source.atlas;
    if (splatted) {
        defines["SPLATTED"] = "1";
    } else if (map.valid()) {
        defines["VISIBILITY"] = "1";
        if (source.slope_bias) defines["SLOPE_BIAS"] = "1";
    }
    const MapSource only{with_lobes(defines, context, glossy),
                         splatted ? source.set.map_size : source.set.maps,
                         splatted ? source.set.map_size * source.set.maps : source.set.points_a_map,
                         glm::vec2(0.0F, 1.0F),
                         [source, map](PassBuilder& builder) {
                             if (map.valid()) builder.read(map);
                             builder.read(source.set.vpls);
                             builder.read(source.scene.points);
                         },
                         ContentHash()
                             .add(content(context, source.set))
                             .add(context.scene.content())
                             .add(source.store->content())
                             .key(),
                         [context, source, map, splatted](const PassResources& resources) {
                             context.uniforms.bind(UBO_ISM, source.set.uniforms);
                             context.scene.bind_materials();
                             source.store->bind_materials();
                             resources.buffer(source.scene.points).bind_storage(SSBO_POINTS);
                             resources.buffer(source.set.vpls).bind_storage(SSBO_VPLS);
                             if (map.valid()) {
                                 resources.texture(map).bind_image(splatted ? IMG_IN : IMG_ISM, GL_READ_ONLY);
                             }
                         }};
    DrawnVpls drawn =
        add_vpls(graph, context, {only}, layout, ", next bounce", !splatted, {.glossy = glossy, .view = {}});
    if (splatted) {
        drawn.set.vpls = add_spacing(graph, context, drawn.set, nullptr);
    }
    return drawn;
}

}  // namespace bounce::passes
