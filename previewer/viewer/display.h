// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>

#include "gl/object.h"
#include "gl/program.h"
#include "gl/texture.h"
#include "image/view_transform.h"

namespace bounce::viewer {

inline void delete_sampler(GLuint id) {
    glDeleteSamplers(1, &id);
}
inline void delete_vertex_array(GLuint id) {
    glDeleteVertexArrays(1, &id);
}

// Shows a scene-linear picture through a view transform. Standard is computed as image/view_transform
// does; the others come from a lattice (display_lattice.h). Filmic's differs from image files by 0.02 of
// an 8-bit step in the mean and by less than 2 at worst (tests/viewer/display_test.cpp).
class Display {
  public:
    Display();

    // Fills the bound framebuffer's lower left width x height pixels with the picture, whose bottom row
    // comes first. A picture of another size is stretched.
    void draw(const gl::Texture& color, const ViewTransform& view, int width, int height);

  private:
    void bind_lattice(const ViewTransform& view);

    gl::ProgramCache programs_;
    gl::Object<delete_sampler> sampler_;
    gl::Object<delete_vertex_array> no_vertices_;
    gl::Texture lattice_;
    std::optional<ViewTransform> lattice_view_;
};

}  // namespace bounce::viewer
