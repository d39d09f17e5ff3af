// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "gl/object.h"
#include "gl/shader_source.h"

namespace bounce::gl {

inline void delete_program(GLuint id) {
    glDeleteProgram(id);
}

struct Stage {
    GLenum type;
    std::string path;  // under shaders/
};

// A linked program. Data reaches it through the buffers and units of shared/bindings.h, so there are no
// uniforms to look up by name; the few loose ones carry an explicit location.
class Program {
  public:
    Program() = default;
    // Compiles and links. Throws Error(failed) with the compiler's first lines, files named.
    Program(const std::string& name, const std::vector<Stage>& stages, const Defines& defines);

    void use() const { glUseProgram(object_.id()); }
    [[nodiscard]] GLuint id() const { return object_.id(); }
    [[nodiscard]] explicit operator bool() const { return static_cast<bool>(object_); }

  private:
    Object<delete_program> object_;
};

// Compiled programs by stages and defines, so that a permutation is compiled once.
class ProgramCache {
  public:
    const Program& compute(const std::string& path, const Defines& defines = {});
    const Program& raster(const std::string& vertex, const std::string& fragment,
                          const Defines& defines = {});
    // Stages of `stem`.vert, .tesc and .tese, with a fragment shader.
    const Program& tessellation(const std::string& stem, const std::string& fragment,
                                const Defines& defines = {});
    [[nodiscard]] size_t size() const { return programs_.size(); }
    void clear() { programs_.clear(); }

  private:
    const Program& get(const std::vector<Stage>& stages, const Defines& defines);
    std::map<std::string, Program> programs_;
};

}  // namespace bounce::gl
