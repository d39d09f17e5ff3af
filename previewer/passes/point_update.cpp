// SPDX-License-Identifier: Apache-2.0
#include "passes/point_update.h"

#include <algorithm>

#include "passes/float_layouts.h"

namespace bounce::passes {

namespace {

// OpenGL promises 65,535 groups a dispatch.
void dispatch_run(GLuint first, GLuint count) {
    constexpr GLuint most = 65535U * GROUP_1D;
    for (GLuint done = 0; done < count; done += most) {
        const GLuint part = std::min(count - done, most);
        glUniform2ui(0, first + done, part);
        glDispatchCompute((part + GROUP_1D - 1) / GROUP_1D, 1, 1);
    }
}

// Only the shadow maps of what is outside of the scene draw triangles on the hull.
void add_seals(const PassContext& context, gpu::PointStore& store) {
    const size_t inside = store.large_triangles_inside();
    const size_t on_hull = store.large_triangles() - inside;
    if (on_hull == 0) {
        return;
    }
    finish_writes();
    context.programs.compute("passes/triangle_seals.comp").use();
    store.bind_for_triangle_update();
    glUniform2i(0, static_cast<GLint>(inside), static_cast<GLint>(on_hull));
    glDispatchCompute((static_cast<GLuint>(on_hull) + GROUP_1D - 1) / GROUP_1D, 1, 1);
}

}  // namespace

ScenePoints add_point_update(FrameGraph& graph, const PassContext& context, gpu::PointStore& store) {
    const ContentKey content = store.content();
    if (!store.any_changed()) {
        return {graph.import_buffer("points", store.points(), k_point_floats, content),
                graph.import_buffer("large triangles", store.triangles(), k_all_floats, content)};
    }
    ScenePoints out{graph.import_buffer("points", store.points(), k_point_floats),
                    graph.import_buffer("large triangles", store.triangles(), k_all_floats)};
    graph.add_pass("points", [&](PassBuilder& builder) {
        out.points = builder.write(out.points, content);
        out.triangles = builder.write(out.triangles, content);
        return [context, &store](const PassResources&) {
            context.programs.compute("passes/point_update.comp").use();
            store.bind_for_update();
            for (const gpu::PointRun& run : store.changed()) {
                dispatch_run(run.first, run.count);
            }
            if (store.large_triangles() > 0) {
                context.programs.compute("passes/point_update.comp", {{"TRIANGLES", "1"}}).use();
                store.bind_for_triangle_update();
                dispatch_run(0, static_cast<GLuint>(store.large_triangles()));
                add_seals(context, store);
            }
            finish_writes();
            store.update_done();
        };
    });
    return out;
}

}  // namespace bounce::passes
