// SPDX-License-Identifier: Apache-2.0
#include "gl/shader_source.h"

#include <algorithm>
#include <charconv>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <sstream>

#include <fmt/format.h>

#include "core/error.h"

namespace bounce::gl {
namespace {

std::string read_shader_file(const std::string& path) {
    if (const char* folder = std::getenv("BOUNCE_SHADER_DIR"); folder != nullptr) {
        const std::filesystem::path file = std::filesystem::path(folder) / path;
        const std::ifstream in(file, std::ios::binary);
        if (!in) {
            throw Error(ExitCode::failed,
                        fmt::format("cannot read the shader {} ($BOUNCE_SHADER_DIR is set)", file.string()));
        }
        std::ostringstream text;
        text << in.rdbuf();
        return text.str();
    }
    const std::string_view text = embedded_shader(path);
    if (text.empty()) {
        throw Error(ExitCode::failed, fmt::format("the shader {} is not packed into this program", path));
    }
    return std::string(text);
}

// The path in a line `#include "path"`, or empty.
std::string_view included_path(std::string_view line) {
    constexpr std::string_view directive = "#include \"";
    if (!line.starts_with(directive)) {
        return {};
    }
    line.remove_prefix(directive.size());
    return line.substr(0, line.find('"'));
}

// Files guard themselves against being included twice (#ifndef), because an include may stand in a branch
// that the preprocessor skips. depth stops a file that includes itself without a guard.
void append_file(const std::string& path, ShaderSource& out, int depth) {
    constexpr int deepest = 16;
    if (depth > deepest) {
        throw Error(ExitCode::failed, fmt::format("the shader {} is included in a circle", path));
    }
    const auto known = std::find(out.files.begin(), out.files.end(), path);
    const auto index = static_cast<size_t>(known - out.files.begin());
    if (known == out.files.end()) {
        out.files.push_back(path);
    }
    const std::string content = read_shader_file(path);
    out.text += fmt::format("#line 1 {}\n", index);
    std::istringstream lines(content);
    std::string line;
    for (int number = 1; std::getline(lines, line); ++number) {
        if (const std::string_view include = included_path(line); !include.empty()) {
            append_file(std::string(include), out, depth + 1);
            out.text += fmt::format("#line {} {}\n", number + 1, index);
        } else {
            out.text += line;
            out.text += '\n';
        }
    }
}

}  // namespace

ShaderSource load_shader(std::string_view path, const Defines& defines) {
    ShaderSource source;
    source.text = "#version 450 core\n";
    for (const auto& [name, value] : defines) {
        source.text += fmt::format("#define {} {}\n", name, value);
    }
    append_file(std::string(path), source, 0);
    return source;
}

std::string name_files_in_log(std::string_view log, const std::vector<std::string>& files) {
    std::string out;
    std::istringstream lines{std::string(log)};
    std::string line;
    while (std::getline(lines, line)) {
        size_t index = 0;
        const auto [end, code] = std::from_chars(line.data(), line.data() + line.size(), index);
        const bool prefixed = code == std::errc() && end != line.data() + line.size() &&
                              (*end == ':' || *end == '(') && index < files.size();
        if (prefixed) {
            out += files[index];
            out += std::string_view(line).substr(static_cast<size_t>(end - line.data()));
        } else {
            out += line;
        }
        out += '\n';
    }
    return out;
}

}  // namespace bounce::gl
