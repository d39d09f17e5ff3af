// SPDX-License-Identifier: Apache-2.0
#include "passes/deform.h"

namespace bounce::passes {

void run_deform(gl::ProgramCache& programs, gpu::GpuScene& scene) {
    const gpu::VertexStore& vertices = scene.vertices();
    gl::Defines defines;
    if (vertices.has_tangents()) {
        defines["TANGENTS"] = "1";
    }
    programs.compute("passes/deform.comp", defines).use();
    vertices.bind_for_deform();
    for (size_t job = 0; job < vertices.jobs().size(); ++job) {
        glUniform1ui(0, static_cast<GLuint>(job));
        const auto count = static_cast<GLuint>(vertices.jobs()[job].vertices.z);
        glDispatchCompute((count + GROUP_1D - 1) / GROUP_1D, 1, 1);
    }
    glMemoryBarrier(GL_VERTEX_ATTRIB_ARRAY_BARRIER_BIT | GL_SHADER_STORAGE_BARRIER_BIT);
    scene.deform_done();
}

}  // namespace bounce::passes
