// SPDX-License-Identifier: Apache-2.0
#include "evaluate/draco_check.h"

#include <algorithm>
#include <cstdlib>
#include <string>
#include <system_error>
#include <vector>

#include <fmt/format.h>

#include "core/error.h"
#include "evaluate/blender_export.h"
#include "evaluate/scene_files.h"

namespace bounce {
namespace fs = std::filesystem;
namespace {

constexpr const char* k_extension = "KHR_draco_mesh_compression";
constexpr const char* k_variable = "BLENDER_EXTERN_DRACO_LIBRARY_PATH";
constexpr const char* k_file = "libextern_draco.so";

bool is_file(const fs::path& path) {
    std::error_code ignored;
    return fs::is_regular_file(path, ignored);
}

// The folders in a folder, none where it cannot be read.
std::vector<fs::path> folders_in(const fs::path& folder) {
    std::vector<fs::path> found;
    std::error_code code;
    for (fs::directory_iterator entry(folder, code); !code && entry != fs::directory_iterator();
         entry.increment(code)) {
        std::error_code ignored;
        if (entry->is_directory(ignored)) {
            found.push_back(entry->path());
        }
    }
    return found;
}

// Inside the add-on or in a build of the checkout that holds it.
bool addon_has_library(const fs::path& addon) {
    const fs::path build = addon.parent_path() / "build";
    const std::vector<fs::path> builds = folders_in(build);
    return is_file(addon / "bounce" / k_file) || is_file(build / k_file) ||
           std::any_of(builds.begin(), builds.end(),
                       [](const fs::path& folder) { return is_file(folder / k_file); });
}

// BLENDER/3.4/python/lib/python3.10/site-packages beside the program, as Blender's own builds are packed.
bool blender_has_library(const fs::path& blender) {
    std::error_code ignored;
    for (const fs::path& folder : {blender.parent_path(), fs::canonical(blender, ignored).parent_path()}) {
        for (const fs::path& version : folders_in(folder)) {
            for (const fs::path& python : folders_in(version / "python/lib")) {
                if (is_file(python / "site-packages" / k_file)) {
                    return true;
                }
            }
        }
    }
    return false;
}

}  // namespace

void require_draco_library(const fs::path& scene, const fs::path& blender) {
    if (is_blend(scene) || !gltf_uses_extension(scene, k_extension)) {
        return;
    }
    const char* variable = std::getenv(k_variable);
    if (variable != nullptr && *variable != '\0') {
        if (!is_file(variable)) {
            throw Error(ExitCode::failed,
                        fmt::format("{} is compressed with Draco, but ${} is {}, which is no file",
                                    scene.string(), k_variable, variable));
        }
        return;
    }
    if (!addon_has_library(find_addon()) && !blender_has_library(blender)) {
        throw Error(
            ExitCode::failed,
            fmt::format("{} is compressed with Draco, which this Blender cannot decode; build the target "
                        "extern_draco (cmake --build --preset release --target extern_draco) or set ${} to "
                        "a {}",
                        scene.string(), k_variable, k_file));
    }
}

}  // namespace bounce
