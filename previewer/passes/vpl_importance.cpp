// SPDX-License-Identifier: Apache-2.0
#include "passes/vpl_importance.h"

#include <algorithm>

namespace bounce::passes {
namespace {

BufferHandle add_pixels(FrameGraph& graph, const PassContext& context, const ImportanceView& view,
                        const std::string& of) {
    BufferHandle pixels;
    graph.add_pass("importance pixels" + of, [&](PassBuilder& builder) {
        read_gbuffer(builder, view.gbuffer);
        pixels = builder.create_buffer("importance pixels",
                                       static_cast<size_t>(view.pixels) * sizeof(gpu::GpuImportancePixel),
                                       k_all_floats);
        builder.decided_by(ContentHash().add(camera_content(context)).add(view.pixels).add(view.seed).key());
        return [context, view, pixels](const PassResources& resources) {
            context.programs.compute("passes/importance_pixels.comp").use();
            context.uniforms.bind(UBO_FRAME, context.frame);
            bind_gbuffer(resources, view.gbuffer);
            resources.buffer(pixels).bind_storage(SSBO_IMPORTANCE_PIXELS);
            glUniform1i(0, view.pixels);
            glUniform1ui(1, view.seed);
            dispatch_1d(view.pixels);
            finish_writes();
        };
    });
    return pixels;
}

}  // namespace

BufferHandle add_vpl_importance(FrameGraph& graph, const PassContext& context,
                                const std::vector<MapSource>& sources,
                                const std::optional<ImportanceView>& view, int lights,
                                const std::string& of) {
    const BufferHandle pixels = view ? add_pixels(graph, context, *view, of) : BufferHandle{};
    const size_t texels = texels_of(sources);
    BufferHandle importance;
    graph.add_pass("importance map" + of, [&](PassBuilder& builder) {
        for (const MapSource& source : sources) {
            source.declare(builder);
        }
        if (view) builder.read(pixels);
        importance = builder.create_buffer("importance map", texels * sizeof(float), k_all_floats);
        ContentHash hash = hash_of(sources);
        hash.add(lights).add(view ? view->pixels : 0).add(view ? view->floor : -1.0F);
        builder.decided_by(hash.key());
        return [context, sources, view, pixels, importance, texels, lights](const PassResources& resources) {
            for_each_map(sources, [&](const MapSource& source, int, int first) {
                gl::Defines defines = source.defines;
                if (view) defines["VIEW"] = "1";
                context.programs.compute("passes/vpl_importance.comp", defines).use();
                source.bind(resources);
                if (view) resources.buffer(pixels).bind_storage(SSBO_IMPORTANCE_PIXELS);
                resources.buffer(importance).bind_storage(SSBO_IMPORTANCE);
                glUniform3i(0, first, source.texels(), view ? view->pixels : 0);
                glUniform2f(1, static_cast<float>(texels) / static_cast<float>(lights),
                            view ? view->floor : 0.0F);
                dispatch_1d(source.texels());
            });
            finish_writes();
        };
    });
    return importance;
}

ImportanceTables add_importance_sums(FrameGraph& graph, const PassContext& context,
                                     const std::vector<MapSource>& sources, BufferHandle importance,
                                     const std::string& of, bool even_rows) {
    ImportanceTables out{importance, {}, {}};
    graph.add_pass("vpl importance" + of, [&](PassBuilder& builder) {
        for (const MapSource& source : sources) {
            source.declare(builder);
        }
        if (importance.valid()) builder.read(importance);
        const int rows = rows_of(sources);
        const BufferHandle sums =
            builder.create_buffer("row sums", static_cast<size_t>(rows) * sizeof(float), k_all_floats);
        const BufferHandle texel_sums =
            builder.create_buffer("texel sums", texels_of(sources) * sizeof(float), k_all_floats);
        out.rows = sums;
        out.texels = texel_sums;
        builder.decided_by(hash_of(sources).add(importance.valid()).add(even_rows).key());
        return [context, sources, importance, rows, sums, texel_sums,
                even_rows](const PassResources& resources) {
            for_each_map(sources, [&](const MapSource& source, int row, int texel) {
                gl::Defines defines = source.defines;
                if (importance.valid()) read_importance_map(defines);
                context.programs.compute("passes/vpl_row_sums.comp", defines).use();
                source.bind(resources);
                if (importance.valid()) bind_importance_map(resources, importance, texel);
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
    return out;
}

void read_importance_map(gl::Defines& defines) {
    defines["IMPORTANCE_MAP"] = "1";
}

void bind_importance_map(const PassResources& resources, BufferHandle importance, int first_texel) {
    resources.buffer(importance).bind_storage(SSBO_IMPORTANCE);
    glUniform1i(UNIFORM_IMPORTANCE_FIRST, first_texel);
}

}  // namespace bounce::passes
