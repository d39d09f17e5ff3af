// SPDX-License-Identifier: Apache-2.0
#include "evaluate/blender_export.h"

#include <algorithm>
#include <cstdlib>
#include <fstream>
#include <optional>
#include <string>
#include <string_view>
#include <system_error>
#include <vector>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "core/atomic_file.h"
#include "core/disk_room.h"
#include "core/error.h"
#include "core/log.h"
#include "core/process.h"
#include "evaluate/cache.h"
#include "evaluate/scene_files.h"
#include "evaluate/sha256.h"

namespace bounce {
namespace fs = std::filesystem;
namespace {

// A disk with less is taken for full where an export has failed: what was written of it still lies there.
constexpr size_t k_room_bytes = size_t{64} << 10U;

// Runs after the export in the same Blender: the images, libraries and other files that the .blend
// refers to, because a change in one of them must lead to a new export.
std::string list_files_expression(const fs::path& output) {
    return fmt::format(
        "import bpy, json; json.dump([bpy.path.abspath(p) for p in bpy.utils.blend_paths(absolute=True, "
        "packed=False)], open({}, 'w'))",
        nlohmann::json(output.string()).dump());
}

// The line that says why, out of all that Blender printed.
std::string reason_in(const std::string& output) {
    if (output.find("No module named 'numpy'") != std::string::npos) {
        return "its Python lacks numpy; install Debian's package python3-numpy";
    }
    std::string last_error;
    size_t start = 0;
    while (start < output.size()) {
        const size_t end = std::min(output.find('\n', start), output.size());
        const std::string line = output.substr(start, end - start);
        constexpr std::string_view prefix = "bounce: export failed: ";
        if (line.starts_with(prefix)) {
            return line.substr(prefix.size());
        }
        if (line.find("Error") != std::string::npos || line.starts_with("Warning: File written by newer")) {
            last_error = line;
        }
        start = end + 1;
    }
    return last_error.empty() ? "it gave no reason" : last_error;
}

void export_blend(const fs::path& blend, const fs::path& blender, const fs::path& addon,
                  const fs::path& target, const fs::path& record) {
    log::info("exporting {} with Blender", blend.string());
    AtomicFile output(target);
    const AtomicFile listing(fs::path(target).replace_extension(".list.json"));  // read here, never committed
    const ProcessResult result = run_process(
        {blender.string(), "-b", "--factory-startup", fs::absolute(blend).string(), "-P",
         (addon / "export_cli.py").string(), "--python-expr", list_files_expression(listing.temporary_path()),
         "--", output.temporary_path().string()});
    log::debug("{}", result.output);
    std::error_code code;
    // Blender may end with 0 after a failure; an empty file is what AtomicFile made.
    const bool failed = result.exit_code != 0 || fs::file_size(output.temporary_path(), code) == 0 || code;
    std::ifstream in(listing.temporary_path());
    const auto paths = nlohmann::json::parse(in, nullptr, false);
    if (failed || !paths.is_array()) {
        // Not the scene's fault, whatever Blender said.
        if (const std::error_code full = check_room(target.parent_path(), k_room_bytes)) {
            throw output_error(fmt::format("there is no room for the export of {} in the cache folder {}: {}",
                                           blend.string(), target.parent_path().string(), full.message()));
        }
    }
    if (failed) {
        throw input_error(
            fmt::format("Blender could not export {}: {}", blend.string(), reason_in(result.output)));
    }
    if (!paths.is_array()) {
        throw input_error(fmt::format("Blender did not list the files that {} refers to", blend.string()));
    }
    output.commit();
    auto files = paths.get<std::vector<fs::path>>();
    files.push_back(target);  // so that a damaged or foreign export is made again
    write_file_hashes(record, hash_files(files), result.seconds);
}

}  // namespace

fs::path find_blender(const fs::path& wanted) {
    const char* variable = std::getenv("BLENDER");
    const bool from_variable = wanted.empty() && variable != nullptr && *variable != '\0';
    const std::string name = from_variable ? variable : (wanted.empty() ? "blender" : wanted.string());
    if (const auto found = find_program(name)) {
        return *found;
    }
    if (!wanted.empty()) {
        throw Error(ExitCode::failed, fmt::format("--blender {}: there is no such program", name));
    }
    throw Error(ExitCode::failed, from_variable
                                      ? fmt::format("$BLENDER is {}, but there is no such program", name)
                                      : "Blender was not found on PATH; install Debian's package blender, or "
                                        "give its path with --blender or $BLENDER");
}

fs::path find_addon() {
    const char* variable = std::getenv("BOUNCE_ADDON");
    std::vector<fs::path> candidates;
    if (variable != nullptr && *variable != '\0') {
        candidates = {variable};
    } else {
        const fs::path here = executable_folder();
        candidates = {here / "../../blender_addon", here / "../share/bounce/blender_addon"};
    }
    std::error_code ignored;
    for (const fs::path& candidate : candidates) {
        if (fs::is_regular_file(candidate / "export_cli.py", ignored)) {
            return fs::canonical(candidate);
        }
    }
    throw Error(
        ExitCode::failed,
        "the Blender add-on was not found beside the program; set BOUNCE_ADDON to the folder that holds "
        "export_cli.py");
}

ResolvedScene resolve_scene(const fs::path& scene, const SceneSourceOptions& options) {
    if (!is_blend(scene)) {
        return {scene, scene, 0.0};
    }
    std::error_code ignored;
    if (!fs::is_regular_file(scene, ignored)) {
        throw input_error(fmt::format("cannot open {}: there is no such file", scene.string()));
    }
    const fs::path blender = find_blender(options.blender);
    const fs::path addon = find_addon();
    // The path counts: images are found relative to it. So does which Blender, by its size and date.
    const fs::path real_blender = fs::canonical(blender);
    const std::string key = sha256_of_text(
        fmt::format("{}\n{}\n{}\n{} {} {}", fs::canonical(scene).string(), sha256_of_file(scene),
                    hash_folder(addon), real_blender.string(), fs::file_size(real_blender),
                    fs::last_write_time(real_blender).time_since_epoch().count()));
    const fs::path folder = cache_folder() / "exports";
    const fs::path target = folder / fmt::format("{}-{}.glb", scene.stem().string(), key.substr(0, 32));
    const fs::path record = fs::path(target).replace_extension(".json");
    if (fs::is_regular_file(target, ignored) && files_unchanged(record)) {
        log::debug("{} was exported before: {}", scene.string(), target.string());
        return {target, scene, recorded_seconds(record)};
    }
    if (fs::exists(target, ignored)) {
        log::warning(
            "{} is exported again: {} is not what its record tells of, or a file that the scene refers to "
            "has "
            "changed",
            scene.string(), target.string());
    }
    export_blend(scene, blender, addon, target, record);
    return {target, scene, recorded_seconds(record)};
}

}  // namespace bounce
