// SPDX-License-Identifier: Apache-2.0
#include "gl/shader_cache_room.h"

#include <cerrno>
#include <cstdlib>
#include <string>
#include <system_error>

#include "core/disk_room.h"
#include "core/log.h"

namespace bounce::gl {
namespace fs = std::filesystem;
namespace {

constexpr const char* k_disable = "MESA_SHADER_CACHE_DISABLE";
// The index has 1.3 MB; the shaders of a frame have about as much.
constexpr size_t k_needed_bytes = size_t{4} << 20U;

std::string variable(const char* name) {
    const char* value = std::getenv(name);
    return value != nullptr ? value : "";
}

}  // namespace

fs::path shader_cache_folder() {
    fs::path folder;
    // In Mesa's order (util/disk_cache_os.c).
    for (const char* name : {"MESA_SHADER_CACHE_DIR", "MESA_GLSL_CACHE_DIR", "XDG_CACHE_HOME"}) {
        if (folder.empty()) {
            folder = variable(name);
        }
    }
    if (const std::string home = variable("HOME"); folder.empty() && !home.empty()) {
        folder = fs::path(home) / ".cache";
    }
    if (folder.empty()) {
        return {};
    }
    std::error_code ignored;
    folder = fs::absolute(folder / "mesa_shader_cache", ignored);
    while (!fs::is_directory(folder, ignored) && folder.has_relative_path()) {
        folder = folder.parent_path();
    }
    return folder;
}

void leave_shader_cache_where_disk_is_full() {
    if (!variable(k_disable).empty()) {
        return;
    }
    const fs::path folder = shader_cache_folder();
    if (folder.empty()) {
        return;
    }
    const std::error_code code = check_room(folder, k_needed_bytes);
    if (code.value() == ENOSPC || code.value() == EDQUOT) {
        log::debug("shaders are not cached: {}: {}", folder.string(), code.message());
        setenv(k_disable, "true", 1);
    }
}

}  // namespace bounce::gl
