// SPDX-License-Identifier: Apache-2.0
#include "passes/vpl_importance.h"

namespace bounce::passes {
namespace {

BufferHandle add_pixels(FrameGraph& graph, const PassContext& context, const ImportanceView& view) {
    BufferHandle pixels;
    graph.add_pass("importance pixels", [&](PassBuilder& builder) {
        read_gbuffer(builder, view.gbuffer);
        pixels = builder.create_buffer("importance pixels",
                                       static_cast<size_t>(view.pixels) * sizeof(gpu::GpuImportancePixel));
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
                                const std::optional<ImportanceView>& view, int lights) {
    const BufferHandle pixels = view ? add_pixels(graph, context, *view) : BufferHandle{};
    const size_t texels = texels_of(sources);
    BufferHandle importance;
    graph.add_pass("importance map", [&](PassBuilder& builder) {
        for (const MapSource& source : sources) {
            source.declare(builder);
        }
        if (view) builder.read(pixels);
        importance = builder.create_buffer("importance map", texels * sizeof(float));
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

void read_importance_map(gl::Defines& defines) {
    defines["IMPORTANCE_MAP"] = "1";
}

void bind_importance_map(const PassResources& resources, BufferHandle importance, int first_texel) {
    resources.buffer(importance).bind_storage(SSBO_IMPORTANCE);
    glUniform1i(UNIFORM_IMPORTANCE_FIRST, first_texel);
}

}  // namespace bounce::passes
