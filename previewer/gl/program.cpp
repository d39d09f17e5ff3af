// SPDX-License-Identifier: Apache-2.0
#include "gl/program.h"

#include <string>

#include <fmt/format.h>

#include "core/error.h"
#include "gl/label.h"

namespace bounce::gl {
namespace {

void delete_shader(GLuint id) {
    glDeleteShader(id);
}
using Shader = Object<delete_shader>;

Shader compile(const Stage& stage, const Defines& defines) {
    const ShaderSource source = load_shader(stage.path, defines);
    Shader shader(glCreateShader(stage.type));
    const char* text = source.text.c_str();
    glShaderSource(shader.id(), 1, &text, nullptr);
    glCompileShader(shader.id());
    GLint ok = GL_FALSE;
    glGetShaderiv(shader.id(), GL_COMPILE_STATUS, &ok);
    if (ok == GL_FALSE) {
        GLint length = 0;
        glGetShaderiv(shader.id(), GL_INFO_LOG_LENGTH, &length);
        std::string log(static_cast<size_t>(length), '\0');
        glGetShaderInfoLog(shader.id(), length, nullptr, log.data());
        throw Error(ExitCode::failed, fmt::format("the shader {} does not compile:\n{}", stage.path,
                                                  name_files_in_log(log.c_str(), source.files)));
    }
    return shader;
}

}  // namespace

Program::Program(const std::string& name, const std::vector<Stage>& stages, const Defines& defines)
    : object_(glCreateProgram()) {
    std::vector<Shader> shaders;
    for (const Stage& stage : stages) {
        shaders.push_back(compile(stage, defines));
        glAttachShader(id(), shaders.back().id());
    }
    glLinkProgram(id());
    GLint ok = GL_FALSE;
    glGetProgramiv(id(), GL_LINK_STATUS, &ok);
    if (ok == GL_FALSE) {
        GLint length = 0;
        glGetProgramiv(id(), GL_INFO_LOG_LENGTH, &length);
        std::string log(static_cast<size_t>(length), '\0');
        glGetProgramInfoLog(id(), length, nullptr, log.data());
        throw Error(ExitCode::failed, fmt::format("the program {} does not link: {}", name, log.c_str()));
    }
    for (const Shader& shader : shaders) {
        glDetachShader(id(), shader.id());
    }
    set_label(GL_PROGRAM, id(), name);
}

const Program& ProgramCache::compute(const std::string& path, const Defines& defines) {
    return get({{GL_COMPUTE_SHADER, path}}, defines);
}

const Program& ProgramCache::raster(const std::string& vertex, const std::string& fragment,
                                    const Defines& defines) {
    return get({{GL_VERTEX_SHADER, vertex}, {GL_FRAGMENT_SHADER, fragment}}, defines);
}

const Program& ProgramCache::tessellation(const std::string& stem, const std::string& fragment,
                                          const Defines& defines) {
    return get({{GL_VERTEX_SHADER, stem + ".vert"},
                {GL_TESS_CONTROL_SHADER, stem + ".tesc"},
                {GL_TESS_EVALUATION_SHADER, stem + ".tese"},
                {GL_FRAGMENT_SHADER, fragment}},
               defines);
}

const Program& ProgramCache::get(const std::vector<Stage>& stages, const Defines& defines) {
    std::string key;
    for (const Stage& stage : stages) {
        key += stage.path + '\n';
    }
    for (const auto& [name, value] : defines) {
        key += name + '=' + value + '\n';
    }
    auto found = programs_.find(key);
    if (found == programs_.end()) {
        found = programs_.emplace(key, Program(stages.back().path, stages, defines)).first;
    }
    return found->second;
}

}  // namespace bounce::gl
