// SPDX-License-Identifier: Apache-2.0
#include "passes/avg_grid.h"

#include <algorithm>
#include <array>

#include "passes/float_layouts.h"

namespace bounce::passes {
namespace {

enum class Stage { mark, sum, bound };  // STAGE in shaders/lib/avg_triangle.glsl

struct TileList {
    TextureHandle tiles;
    TextureHandle counts;
};

gl::Defines batch_defines(const gpu::DrawFeatures& features, Stage stage) {
    gl::Defines defines{{"STAGE", std::to_string(static_cast<int>(stage))}};
    const auto define_if = [&](bool condition, const char* name) {
        if (condition) defines[name] = "1";
    };
    define_if(features.alpha_test, "ALPHA_TEST");
    const bool material = stage == Stage::sum;
    if (material || features.alpha_test) {
        define_if(features.blend, "BLEND");
        define_if(features.base_color_texture, "BASE_COLOR_TEXTURE");
        define_if(features.base_color_encoded, "BASE_COLOR_ENCODED");
        define_if(features.vertex_color, "VERTEX_COLOR");
    }
    if (material) {
        define_if(features.metallic_roughness_texture, "METALLIC_ROUGHNESS_TEXTURE");
        define_if(features.metallic_roughness_encoded, "METALLIC_ROUGHNESS_ENCODED");
    }
    return defines;
}

void clear_count(const gl::Texture& counts) {
    const GLuint zero = 0;
    glClearTexImage(counts.id(), 0, GL_RED_INTEGER, GL_UNSIGNED_INT, &zero);
}

void bind_batch(const gpu::DrawBatch& batch) {
    glUniform4ui(0, batch.first_index, batch.index_count / 3, static_cast<GLuint>(batch.base_vertex),
                 batch.first_draw);
    glUniform1ui(1, batch.draw_count);
}

// All triangles through one stage, batch by batch, because each has its own textures.
void run_stage(const PassContext& context, const PassResources& resources, const TileList& list,
               Stage stage) {
    context.scene.bind();
    context.scene.vertices().bind_for_grid();
    resources.texture(list.tiles).bind_image(IMG_AVG_TILES, GL_READ_WRITE);
    resources.texture(list.counts).bind_image(IMG_AVG_COUNTS, GL_READ_WRITE);
    for (const gpu::DrawBatch& batch : context.scene.batches()) {
        const uint64_t triangles = uint64_t{batch.index_count / 3} * batch.draw_count;
        if (triangles == 0) {
            continue;
        }
        const gl::Defines defines = batch_defines(batch.features, stage);
        context.scene.bind_material(batch);
        clear_count(resources.texture(list.counts));
        context.programs.compute("passes/avg_triangles.comp", defines).use();
        bind_batch(batch);
        const auto groups = static_cast<GLuint>((triangles + GROUP_1D - 1) / GROUP_1D);
        glDispatchCompute(std::min<GLuint>(groups, MOST_GROUPS), (groups + MOST_GROUPS - 1) / MOST_GROUPS, 1);
        glMemoryBarrier(GL_SHADER_IMAGE_ACCESS_BARRIER_BIT);
        context.programs.compute("passes/avg_tiles.comp", defines).use();
        bind_batch(batch);
        glDispatchCompute(AVG_TILE_GROUPS, 1, 1);
        // The list and its count are the next batch's.
        glMemoryBarrier(GL_SHADER_IMAGE_ACCESS_BARRIER_BIT | GL_TEXTURE_UPDATE_BARRIER_BIT);
    }
    finish_writes();
}

}  // namespace

AvgGrid add_avg_grid(FrameGraph& graph, const PassContext& context, AvgGrid grid) {
    const glm::ivec4 size = grid.layout.size;
    const auto capacity = static_cast<size_t>(size.w);
    const ContentKey decides =
        ContentHash().add(content(context, grid.uniforms)).add(context.scene.content()).key();
    TileList list;
    graph.add_pass("avg cells", [&](PassBuilder& builder) {
        grid.cells = builder.create_texture(
            "avg cells", {.format = GL_R32UI, .width = size.x, .height = size.y, .layers = size.z});
        list.tiles = builder.create_texture(
            "avg tiles",
            {.format = GL_R32UI, .width = 2 * AVG_TILE_ROW, .height = AVG_MOST_TILES / AVG_TILE_ROW});
        list.counts = builder.create_texture("avg counts", {.format = GL_R32UI, .width = 1, .height = 1});
        builder.decided_by(decides);
        return [context, grid, list](const PassResources& resources) {
            const GLuint zero = 0;
            const gl::Texture& cells = resources.texture(grid.cells);
            glClearTexImage(cells.id(), 0, GL_RED_INTEGER, GL_UNSIGNED_INT, &zero);
            context.uniforms.bind(UBO_AVG, grid.uniforms);
            cells.bind_image(IMG_AVG_CELLS, GL_READ_WRITE);
            run_stage(context, resources, list, Stage::mark);
        };
    });
    const int rows = size.y * size.z;
    BufferHandle sums;
    graph.add_pass("avg voxels", [&](PassBuilder& builder) {
        grid.cells = builder.write(grid.cells);
        list.tiles = builder.write(list.tiles);
        list.counts = builder.write(list.counts);
        grid.rows =
            builder.create_buffer("avg rows", static_cast<size_t>(rows) * sizeof(float), k_all_floats);
        sums = builder.create_buffer("avg sums", capacity * AVG_SUM_WORDS * sizeof(GLuint));
        grid.surfaces =
            builder.create_buffer("avg surfaces", capacity * sizeof(gpu::GpuAvgVoxel), k_avg_voxel_floats);
        builder.decided_by(decides);
        return [context, grid, list, sums, size, rows](const PassResources& resources) {
            context.uniforms.bind(UBO_AVG, grid.uniforms);
            resources.texture(grid.cells).bind_image(IMG_AVG_CELLS, GL_READ_WRITE);
            resources.buffer(grid.rows).bind_storage(SSBO_ROW_SUMS);
            const auto place = [&](const gl::Defines& defines) {
                context.programs.compute("passes/avg_places.comp", defines).use();
                glDispatchCompute((static_cast<GLuint>(rows) + GROUP_1D - 1) / GROUP_1D, 1, 1);
                finish_writes();
            };
            place({{"COUNT", "1"}});
            context.programs.compute("passes/vpl_scan.comp").use();
            glUniform1i(0, rows);
            glDispatchCompute(1, 1, 1);
            finish_writes();
            place({});
            const auto each_surface = [&](const gl::Defines& defines) {
                context.programs.compute("passes/avg_surfaces.comp", defines).use();
                resources.buffer(grid.rows).bind_storage(SSBO_ROW_SUMS);
                glUniform1i(0, rows);
                glDispatchCompute((static_cast<GLuint>(size.w) + GROUP_1D - 1) / GROUP_1D, 1, 1);
                finish_writes();
            };
            resources.buffer(sums).bind_storage(SSBO_AVG_SUMS);
            each_surface({{"CLEAR", "1"}});
            run_stage(context, resources, list, Stage::sum);
            resources.buffer(grid.surfaces).bind_storage(SSBO_AVG_VOXELS);
            each_surface({});
        };
    });
    graph.add_pass("avg slabs", [&](PassBuilder& builder) {
        builder.read(grid.cells);
        list.tiles = builder.write(list.tiles);
        list.counts = builder.write(list.counts);
        grid.surfaces = builder.write(grid.surfaces);
        builder.decided_by(decides);
        return [context, grid, list](const PassResources& resources) {
            context.uniforms.bind(UBO_AVG, grid.uniforms);
            resources.texture(grid.cells).bind_image(IMG_AVG_CELLS, GL_READ_ONLY);
            resources.buffer(grid.surfaces).bind_storage(SSBO_AVG_SUMS);
            run_stage(context, resources, list, Stage::bound);
        };
    });
    return grid;
}

void add_avg_view(FrameGraph& graph, const PassContext& context, const AvgGrid& grid, bool whole_voxels,
                  TextureHandle target) {
    graph.add_pass("avg view", [&](PassBuilder& builder) {
        builder.read(grid.cells);
        builder.read(grid.surfaces);
        const TextureHandle out = builder.write(target);
        return [context, grid, whole_voxels, out](const PassResources& resources) {
            gl::Defines defines;
            if (whole_voxels) defines["WHOLE_VOXELS"] = "1";
            context.programs.compute("passes/avg_view.comp", defines).use();
            context.uniforms.bind(UBO_FRAME, context.frame);
            context.uniforms.bind(UBO_AVG, grid.uniforms);
            resources.texture(grid.cells).bind_image(IMG_AVG_CELLS, GL_READ_ONLY);
            resources.buffer(grid.surfaces).bind_storage(SSBO_AVG_VOXELS);
            resources.texture(out).bind_image(IMG_OUT, GL_WRITE_ONLY);
            dispatch_2d(context.width, context.height);
            finish_writes();
        };
    });
}

}  // namespace bounce::passes
