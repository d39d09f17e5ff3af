// SPDX-License-Identifier: Apache-2.0
#include "viewer/display.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "gl/debug_output.h"
#include "shared/display.h"
#include "viewer/display_lattice.h"

namespace bounce::viewer {

Display::Display() {
    GLuint id = 0;
    glCreateSamplers(1, &id);
    sampler_ = gl::Object<delete_sampler>(id);
    glSamplerParameteri(id, GL_TEXTURE_MIN_FILTER, GL_LINEAR);
    glSamplerParameteri(id, GL_TEXTURE_MAG_FILTER, GL_LINEAR);
    glSamplerParameteri(id, GL_TEXTURE_WRAP_S, GL_CLAMP_TO_EDGE);
    glSamplerParameteri(id, GL_TEXTURE_WRAP_T, GL_CLAMP_TO_EDGE);
    // The core profile draws nothing without a vertex array, even one that holds no attribute.
    glCreateVertexArrays(1, &id);
    no_vertices_ = gl::Object<delete_vertex_array>(id);
}

void Display::bind_lattice(const ViewTransform& view) {
    const bool same = lattice_view_ && lattice_view_->display_device == view.display_device &&
                      lattice_view_->view_transform == view.view_transform &&
                      lattice_view_->look == view.look;
    if (!same) {
        const std::vector<float> nodes = bake_lattice(view);
        lattice_ = gl::Texture("view transform", {.format = GL_RGBA16F,
                                                  .width = k_lattice_side,
                                                  .height = k_lattice_side,
                                                  .layers = k_lattice_side});
        glTextureSubImage3D(lattice_.id(), 0, 0, 0, 0, k_lattice_side, k_lattice_side, k_lattice_side, GL_RGB,
                            GL_FLOAT, nodes.data());
        lattice_view_ = view;
    }
    lattice_.bind(TEX_DISPLAY_LATTICE);
    glUniform2f(LOC_DISPLAY_LATTICE_RANGE, k_lattice_low_stops, k_lattice_high_stops);
}

void Display::draw(const gl::Texture& color, const ViewTransform& view, int width, int height) {
    const gl::DebugGroup group("display");
    const bool standard = is_plain_standard(view);
    programs_
        .raster("passes/display.vert", "passes/display.frag",
                standard ? gl::Defines{} : gl::Defines{{"LATTICE", "1"}})
        .use();
    color.bind(TEX_DISPLAY_COLOR);
    glBindSampler(TEX_DISPLAY_COLOR, sampler_.id());
    if (!standard) {
        bind_lattice(view);
    }
    glUniform1f(LOC_DISPLAY_SCALE, std::exp2(view.exposure));
    glUniform1f(LOC_DISPLAY_EXPONENT, 1.0F / std::max(view.gamma, std::numeric_limits<float>::epsilon()));
    glUniform2f(LOC_DISPLAY_SIZE, static_cast<float>(width), static_cast<float>(height));

    glMemoryBarrier(GL_TEXTURE_FETCH_BARRIER_BIT);
    glViewport(0, 0, width, height);
    glDisable(GL_DEPTH_TEST);
    glDisable(GL_CULL_FACE);
    glDisable(GL_SCISSOR_TEST);
    glDisable(GL_BLEND);
    glColorMask(GL_TRUE, GL_TRUE, GL_TRUE, GL_TRUE);
    glBindVertexArray(no_vertices_.id());
    glDrawArrays(GL_TRIANGLES, 0, 3);
    glBindVertexArray(0);
    glBindSampler(TEX_DISPLAY_COLOR, 0);  // the renderer's passes sample with the textures' own settings
    gl::throw_on_debug_error("display");
}

}  // namespace bounce::viewer
