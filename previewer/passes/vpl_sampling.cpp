// SPDX-License-Identifier: Apache-2.0
#include "passes/vpl_sampling.h"

#include <algorithm>
#include <functional>

namespace bounce::passes {
namespace {

// One map, or maps of one kind, as the two shaders see it.
struct Source {
    gl::Defines defines;
    int size = 0;  // texels a row
    int rows = 0;
    glm::vec2 share{0.0F, 1.0F};  // uniform: which part of the sequence's first coordinate is this source's
    std::function<void(PassBuilder&)> declare;
    std::function<void(const PassResources&)> bind;
};

gl::Defines with_lobes(gl::Defines defines, const PassContext& context, bool glossy) {
    if (glossy) defines["GLOSSY"] = "1";
    if (context.scene.has_disney_diffuse()) defines["DISNEY"] = "1";
    return defines;
}

DrawnVpls add_vpls(FrameGraph& graph, const PassContext& context, const std::vector<Source>& sources,
                   const VplSet& layout, const std::string& of, bool even_rows,
                   VplSampling sampling = VplSampling::inverse_transform) {
    const bool uniform = sampling == VplSampling::uniform;
    int rows = 0;
    size_t texels = 0;
    for (const Source& source : sources) {
        rows += source.rows;
        texels += static_cast<size_t>(source.rows) * static_cast<size_t>(source.size);
    }
    // Calls visit(source, its first row, its first texel).
    const auto for_each = [sources](const auto& visit) {
        int row = 0;
        int texel = 0;
        for (const Source& source : sources) {
            visit(source, row, texel);
            row += source.rows;
            texel += source.rows * source.size;
        }
    };
    BufferHandle sums;
    BufferHandle texel_sums;
    graph.add_pass("vpl importance" + of, [&](PassBuilder& builder) {
        for (const Source& source : sources) {
            source.declare(builder);
        }
        sums = builder.create_buffer("row sums", static_cast<size_t>(rows) * sizeof(float));
        texel_sums = builder.create_buffer("texel sums", texels * sizeof(float));
        return [context, for_each, rows, sums, texel_sums, even_rows](const PassResources& resources) {
            for_each([&](const Source& source, int row, int texel) {
                context.programs.compute("passes/vpl_row_sums.comp", source.defines).use();
                source.bind(resources);
                resources.buffer(sums).bind_storage(SSBO_ROW_SUMS);
                resources.buffer(texel_sums).bind_storage(SSBO_TEXEL_SUMS);
                glUniform3i(0, row, texel, source.rows);
                glDispatchCompute(static_cast<GLuint>(std::min(source.rows, MOST_GROUPS)),
                                  static_cast<GLuint>((source.rows + MOST_GROUPS - 1) / MOST_GROUPS), 1);
            });
            finish_writes();
            gl::Defines defines;
            if (even_rows) defines["EVEN"] = "1";
            context.programs.compute("passes/vpl_scan.comp", defines).use();
            resources.buffer(sums).bind_storage(SSBO_ROW_SUMS);
            glUniform1i(0, rows);
            glDispatchCompute(1, 1, 1);
            finish_writes();
        };
    });
    DrawnVpls out{layout, {sums, rows}};
    graph.add_pass("vpls" + of, [&](PassBuilder& builder) {
        for (const Source& source : sources) {
            source.declare(builder);
        }
        if (!uniform) {
            builder.read(sums);
            builder.read(texel_sums);
        }
        const BufferHandle vpls =
            builder.create_buffer("vpls", static_cast<size_t>(layout.maps) * sizeof(gpu::GpuVpl));
        out.set.vpls = vpls;
        return [context, for_each, layout, rows, sums, texel_sums, vpls,
                uniform](const PassResources& resources) {
            for_each([&](const Source& source, int row, int texel) {
                gl::Defines defines = source.defines;
                if (uniform) defines["HALTON"] = "1";
                if (layout.seed != 0) defines["SEEDED"] = "1";
                if (layout.seed != 0 && layout.middle) defines["MIDDLE"] = "1";
                context.programs.compute("passes/vpl_draw.comp", defines).use();
                source.bind(resources);
                if (uniform) {
                    glUniform2f(3, source.share.x, source.share.y);
                } else {
                    resources.buffer(sums).bind_storage(SSBO_ROW_SUMS);
                    resources.buffer(texel_sums).bind_storage(SSBO_TEXEL_SUMS);
                }
                resources.buffer(vpls).bind_storage(SSBO_VPLS_OUT);
                if (layout.seed != 0) {
                    glUniform1ui(4, layout.seed);
                    glUniform1f(5, layout.extent);
                }
                glUniform4i(0, row, source.rows, rows, texel);
                glUniform3i(1, layout.interleave, layout.subset, layout.cell_columns);
                glUniform3i(2, layout.maps, layout.map_size, layout.columns);
                glDispatchCompute((static_cast<GLuint>(layout.maps) + GROUP_1D - 1) / GROUP_1D, 1, 1);
            });
            finish_writes();
        };
    });
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
            glDispatchCompute((static_cast<GLuint>(set.maps) + GROUP_1D - 1) / GROUP_1D, 1, 1);
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
                             const std::vector<VplSource>& sources, VplSet layout, bool glossy,
                             VplSampling sampling) {
    std::vector<Source> all;
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
        all.push_back({with_lobes(light_defines(light), context, glossy), light.rsm_size,
                       light.rsm_size * static_cast<int>(light.faces.size()), share,
                       [source](PassBuilder& builder) { builder.read(source.rsm); },
                       [context, source](const PassResources& resources) {
                           context.uniforms.bind(UBO_LIGHT, source.light.uniforms);
                           resources.texture(source.rsm).bind(TEX_RSM);
                       }});
    }
    return add_vpls(graph, context, all, layout, "", false, sampling);
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
    const Source only{with_lobes(defines, context, glossy),
                      splatted ? source.set.map_size : source.set.maps,
                      splatted ? source.set.map_size * source.set.maps : source.set.points_a_map,
                      glm::vec2(0.0F, 1.0F),
                      [source, map](PassBuilder& builder) {
                          if (map.valid()) builder.read(map);
                          builder.read(source.set.vpls);
                          builder.read(source.scene.points);
                      },
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
    DrawnVpls drawn = add_vpls(graph, context, {only}, layout, ", next bounce", !splatted);
    if (splatted) {
        drawn.set.vpls = add_spacing(graph, context, drawn.set, nullptr);
    }
    return drawn;
}

}  // namespace bounce::passes
