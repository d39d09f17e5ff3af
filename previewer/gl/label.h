// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <string>

#include <epoxy/gl.h>

namespace bounce::gl {

// Names an object for debuggers. Names come from files and may be longer than OpenGL takes (256 at least).
inline void set_label(GLenum kind, GLuint id, const std::string& name) {
    constexpr size_t longest = 255;
    glObjectLabel(kind, id, static_cast<GLsizei>(std::min(name.size(), longest)), name.data());
}

}  // namespace bounce::gl
