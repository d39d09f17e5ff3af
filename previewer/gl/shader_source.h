// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <map>
#include <string>
#include <string_view>
#include <vector>

namespace bounce::gl {

// Name to value; an ordered map, so that equal permutations give equal source.
using Defines = std::map<std::string, std::string>;

// A complete GLSL text, and the files it came from (index = GLSL source string number in #line).
struct ShaderSource {
    std::string text;
    std::vector<std::string> files;
};

// Reads a shader by its path under shaders/, resolves #include "path under shaders/" and puts the version
// line and the defines in front. Shaders are packed into the program; where $BOUNCE_SHADER_DIR is set they
// are read from that folder instead, for work on them. Throws Error(failed) for a missing file.
[[nodiscard]] ShaderSource load_shader(std::string_view path, const Defines& defines);

// Replaces "FILE_INDEX(" or "FILE_INDEX:" at the start of a compiler's message lines by the file's name.
[[nodiscard]] std::string name_files_in_log(std::string_view log, const std::vector<std::string>& files);

// Embedded text of a shader file, or an empty view; generated at build time.
[[nodiscard]] std::string_view embedded_shader(std::string_view path);

}  // namespace bounce::gl
