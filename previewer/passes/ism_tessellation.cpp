// SPDX-License-Identifier: Apache-2.0
#include "passes/ism_tessellation.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>

#include "gl/context.h"

namespace bounce::passes {
namespace {

// Of a draw that deforms it is not known how large its triangles get: the list of their pieces has room for
// this many times the points of all maps, and what does not fit is left out.
constexpr double k_most_growth = 16.0;

// Mesa's software drivers count what the patches of a draw are made into in 16 bits, and draw what is beyond
// it wrongly: there a draw has no more patches than can give so many points. 0: no bound.
constexpr GLuint k_most_points_a_draw = 65535;
GLuint most_patches(double points_a_patch) {
    if (!gl::is_software_driver()) {
        return 0;
    }
    // A line has two points at least.
    const double points = std::clamp(points_a_patch, 2.0, static_cast<double>(PATCH_POINTS));
    return static_cast<GLuint>(k_most_points_a_draw / std::ceil(points));
}

// A batch some of whose triangles may have more points than a patch gives, and its part of the list of
// pieces.
struct LargeBatch {
    size_t batch = 0;
    GLuint first = 0;
    GLuint most = 0;
};

struct Pieces {
    std::vector<LargeBatch> batches;
    GLuint count = 0;
};

// Points of all maps on a squared render unit.
double density(const TessellatedPoints& points, const VplSet& set) {
    return static_cast<double>(set.points_a_map) * set.maps / points.area;
}

Pieces find_pieces(const PassContext& context, const TessellatedPoints& points, const VplSet& set) {
    Pieces out;
    const double dense = density(points, set);
    const double all = static_cast<double>(set.points_a_map) * set.maps;
    for (size_t i = 0; i < context.scene.batches().size(); ++i) {
        // Numbers are rounded up at most.
        if (points.patches->runs(i, points.cover).empty() ||
            points.patches->largest_triangle(i) * dense + 1.0 <= PATCH_POINTS) {
            continue;
        }
        const uint32_t draws = context.scene.batches()[i].draw_count;
        const double known = points.patches->draw_area(i) * dense * draws;
        const double most = std::isfinite(known) ? known : k_most_growth * all;
        // Each piece but a triangle's first is of a full one's points or the last; 1 % for rounding.
        const auto room = static_cast<GLuint>(std::ceil(most * 1.01 / PATCH_POINTS)) + 1;
        out.batches.push_back({i, out.count, room});
        out.count += room;
    }
    return out;
}

void set_spread(const TessellatedPoints& points, const VplSet& set) {
    glUniform4f(1, static_cast<float>(density(points, set)), static_cast<float>(set.maps),
                static_cast<float>(points.area / (std::numbers::pi * set.points_a_map)), 0.0F);
}

gl::Defines cover_defines(const TessellatedPoints& points) {
    gl::Defines defines;
    if (points.patches->drops_triangles(points.cover)) defines["DROPS"] = "1";
    return defines;
}

void bind_triangles(const PassContext& context, const TessellatedPoints& points) {
    context.scene.bind();
    context.scene.vertices().positions().bind_storage(SSBO_PATCH_POSITIONS);
    context.scene.vertices().indices().bind_storage(SSBO_PATCH_INDICES);
    if (points.patches->drops_triangles(points.cover)) {
        points.patches->bind_dropped();
    }
}

void list_batch(const gpu::DrawBatch& batch, const gpu::TrianglePatches::Run& run, GLuint command,
                const LargeBatch& large) {
    const GLuint triangles = batch.index_count / 3;
    constexpr GLuint most = MOST_GROUPS * GROUP_1D;  // triangles of one dispatch
    for (GLuint draws = 0; draws < run.count; draws += MOST_GROUPS) {
        glUniform4ui(2, batch.first_index, static_cast<GLuint>(batch.base_vertex), run.first + draws,
                     triangles);
        for (GLuint done = 0; done < triangles; done += most) {
            glUniform4ui(3, command, large.first, large.most, done);
            const GLuint part = std::min(triangles - done, most);
            glDispatchCompute((part + GROUP_1D - 1) / GROUP_1D,
                              std::min<GLuint>(run.count - draws, MOST_GROUPS), 1);
        }
    }
}

// The list of pieces and the commands that draw them.
struct PieceList {
    BufferHandle pieces;
    BufferHandle commands;
};

PieceList add_pieces(FrameGraph& graph, const PassContext& context, const TessellatedPoints& points,
                     const VplSet& set, const Pieces& pieces) {
    PieceList out;
    graph.add_pass("ism pieces", [&](PassBuilder& builder) {
        out.pieces = builder.create_buffer("patch pieces", pieces.count * sizeof(gpu::GpuPatchPiece));
        out.commands =
            builder.create_buffer("piece commands", pieces.batches.size() * sizeof(gpu::GpuPieceCommand));
        return [context, points, set, pieces, out](const PassResources& resources) {
            const gl::Buffer& commands = resources.buffer(out.commands);
            for (size_t i = 0; i < pieces.batches.size(); ++i) {
                const gpu::GpuPieceCommand command{{0U, 1U, pieces.batches[i].first, 0U}};
                glClearNamedBufferSubData(commands.id(), GL_RGBA32UI,
                                          static_cast<GLintptr>(i * sizeof(command)), sizeof(command),
                                          GL_RGBA_INTEGER, GL_UNSIGNED_INT, &command);
            }
            resources.buffer(out.pieces).clear_to_zero();
            context.programs.compute("passes/ism_pieces.comp", cover_defines(points)).use();
            bind_triangles(context, points);
            resources.buffer(out.pieces).bind_storage(SSBO_PIECES_OUT);
            commands.bind_storage(SSBO_PIECE_COMMANDS);
            set_spread(points, set);
            for (size_t i = 0; i < pieces.batches.size(); ++i) {
                const LargeBatch& large = pieces.batches[i];
                for (const gpu::TrianglePatches::Run& run : points.patches->runs(large.batch, points.cover)) {
                    list_batch(context.scene.batches()[large.batch], run, static_cast<GLuint>(i), large);
                }
            }
            finish_writes();
        };
    });
    return out;
}

// Of what a batch's material cuts out, compiled in; binds what it is told by.
gl::Defines bind_cut_outs(const PassContext& context, const gpu::DrawBatch& batch) {
    gl::Defines defines;
    if (!batch.features.alpha_test) {
        return defines;
    }
    defines["ALPHA_TEST"] = "1";
    if (batch.features.blend) defines["BLENDED"] = "1";
    const gpu::VertexStore& vertices = context.scene.vertices();
    if (batch.features.base_color_texture) {
        defines["BASE_COLOR_TEXTURE"] = "1";
        context.scene.bind_material(batch);
        vertices.uvs(context.scene.base_color_uv_set(batch)).bind_storage(SSBO_PATCH_UVS);
    }
    if (batch.features.vertex_color) {
        defines["VERTEX_COLOR"] = "1";
        vertices.colors().bind_storage(SSBO_PATCH_COLORS);
    }
    return defines;
}

void use_program(const PassContext& context, const TessellatedPoints& points, const VplSet& set,
                 gl::Defines defines) {
    defines.merge(map_defines(set));
    context.programs.tessellation("passes/ism_tessellation", "passes/ism_points.frag", defines).use();
    glUniform2f(0, static_cast<float>(set.columns * set.map_size),
                static_cast<float>(set.rows * set.map_size));
    set_spread(points, set);
}

void draw_triangles(const PassContext& context, const TessellatedPoints& points, const VplSet& set) {
    bind_triangles(context, points);
    for (size_t i = 0; i < context.scene.batches().size(); ++i) {
        const gpu::DrawBatch& batch = context.scene.batches()[i];
        const std::vector<gpu::TrianglePatches::Run>& runs = points.patches->runs(i, points.cover);
        if (runs.empty()) {
            continue;
        }
        gl::Defines defines = cover_defines(points);
        defines.merge(bind_cut_outs(context, batch));
        use_program(context, points, set, defines);
        const GLuint triangles = batch.index_count / 3;
        // A line may have a point too many.
        const GLuint bound =
            most_patches(points.patches->largest_triangle(i) * density(points, set) + 1.0 + PATCH_LINES);
        const GLuint step = bound > 0 ? bound : triangles;
        for (const gpu::TrianglePatches::Run& run : runs) {
            glUniform4ui(2, batch.first_index, static_cast<GLuint>(batch.base_vertex), run.first, 0U);
            for (GLuint first = 0; first < triangles; first += step) {
                glDrawArraysInstanced(GL_PATCHES, static_cast<GLint>(first),
                                      static_cast<GLsizei>(std::min(step, triangles - first)),
                                      static_cast<GLsizei>(run.count));
            }
        }
    }
}

void draw_pieces(const PassContext& context, const TessellatedPoints& points, const VplSet& set,
                 const Pieces& pieces, const gl::Buffer& list, const gl::Buffer& commands) {
    list.bind_storage(SSBO_PATCH_PIECES);
    glBindBuffer(GL_DRAW_INDIRECT_BUFFER, commands.id());
    for (size_t i = 0; i < pieces.batches.size(); ++i) {
        const LargeBatch& large = pieces.batches[i];
        gl::Defines defines{{"PIECES", "1"}};
        defines.merge(bind_cut_outs(context, context.scene.batches()[large.batch]));
        use_program(context, points, set, defines);
        glUniform4ui(2, large.first, large.most, 0U, 0U);
        if (const GLuint step = most_patches(PATCH_POINTS); step > 0) {
            // All of the list's room: what is not listed gives no point.
            for (GLuint first = 0; first < large.most; first += step) {
                glDrawArrays(GL_PATCHES, static_cast<GLint>(large.first + first),
                             static_cast<GLsizei>(std::min(step, large.most - first)));
            }
            continue;
        }
        const auto* offset = reinterpret_cast<const void*>(  // NOLINT: OpenGL takes the offset as a pointer
            i * sizeof(gpu::GpuPieceCommand));
        glDrawArraysIndirect(GL_PATCHES, offset);
    }
    glBindBuffer(GL_DRAW_INDIRECT_BUFFER, 0);
}

}  // namespace

TextureHandle add_tessellation(FrameGraph& graph, const PassContext& context, const TessellatedPoints& points,
                               const VplSet& set) {
    const Pieces pieces = find_pieces(context, points, set);
    std::optional<PieceList> list;
    if (!pieces.batches.empty()) {
        list = add_pieces(graph, context, points, set, pieces);
    }
    TextureHandle out;
    graph.add_pass("ism tessellation", [&](PassBuilder& builder) {
        builder.read(set.vpls);
        if (list) {
            builder.read(list->pieces);
            builder.read(list->commands);
        }
        out = builder.create_texture("ism depth", {.format = GL_DEPTH_COMPONENT32F,
                                                   .width = set.columns * set.map_size,
                                                   .height = set.rows * set.map_size});
        return [context, points, set, pieces, list, out](const PassResources& resources) {
            const gl::Framebuffer& target = resources.framebuffer({}, {&resources.texture(out)});
            target.bind();
            const float far_depth = 0.0F;
            glClearNamedFramebufferfv(target.id(), GL_DEPTH, 0, &far_depth);
            context.uniforms.bind(UBO_ISM, set.uniforms);
            resources.buffer(set.vpls).bind_storage(SSBO_VPLS);
            glPatchParameteri(GL_PATCH_VERTICES, 1);
            glEnable(GL_DEPTH_TEST);
            glEnable(GL_PROGRAM_POINT_SIZE);
            draw_triangles(context, points, set);
            if (list) {
                draw_pieces(context, points, set, pieces, resources.buffer(list->pieces),
                            resources.buffer(list->commands));
            }
            glDisable(GL_PROGRAM_POINT_SIZE);
            glDisable(GL_DEPTH_TEST);
            finish_writes();
        };
    });
    return out;
}

}  // namespace bounce::passes
