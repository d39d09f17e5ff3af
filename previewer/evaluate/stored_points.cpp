// SPDX-License-Identifier: Apache-2.0
#include "evaluate/stored_points.h"

#include <algorithm>
#include <cstdlib>
#include <string_view>

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <nlohmann/json.hpp>
#include <unistd.h>

#include "core/atomic_file.h"
#include "core/error.h"
#include "core/json_fault.h"
#include "core/log.h"
#include "evaluate/cache.h"
#include "evaluate/machine.h"
#include "evaluate/record_file.h"
#include "evaluate/sha256.h"

namespace bounce {
namespace fs = std::filesystem;
namespace {

constexpr const char* k_schema = "bounce.point/1";

fs::path record_path(const fs::path& folder, const PointKey& key) {
    return folder / point_name(key) / "point.json";
}

// All that the record vouches for: file names in the point's folder.
std::vector<std::string> files_of(const PreviewResult& result) {
    std::vector<std::string> files{"stats.json"};
    for (const PreviewFrame& frame : result.frames) {
        files.push_back(frame.image.filename().string());
    }
    return files;
}

}  // namespace

std::string point_name(const PointKey& key) {
    return sha256_of_text(fmt::format("{}\n{}\n{}\n{}\nframes {}\n{}x{}\nrepeat {}\nround {}\n{}\n", k_schema,
                                      key.scene_hash, key.program_hash, key.machine,
                                      fmt::join(key.frames, ","), key.width, key.height, key.repeat,
                                      key.round, fmt::join(key.render_arguments, "\n")))
        .substr(0, 32);
}

std::string program_fingerprint(const fs::path& bounce) {
    const std::string program = sha256_of_file(bounce);
    const char* shaders = std::getenv("BOUNCE_SHADER_DIR");
    if (shaders == nullptr) {
        return program;
    }
    std::error_code ignored;
    // A folder that is not there is an error of the renderer's, which says so.
    return program + " " + (fs::is_directory(shaders, ignored) ? hash_folder(shaders) : "missing");
}

std::string machine_fingerprint() {
    const Machine machine = this_machine();
    std::vector<std::string> variables;
    for (char** variable = environ; *variable != nullptr; ++variable) {
        const std::string_view text = *variable;
        for (const std::string_view prefix : {"GALLIUM_", "LP_", "LIBGL_", "MESA_"}) {
            if (text.starts_with(prefix)) {
                variables.emplace_back(text);
            }
        }
    }
    std::sort(variables.begin(), variables.end());
    return fmt::format("{}, {} threads, {}; {}", machine.cpu, machine.threads, machine.system,
                       fmt::join(variables, " "));
}

void keep_point(const fs::path& folder, const PointKey& key, const PreviewResult& result) {
    nlohmann::ordered_json files = nlohmann::ordered_json::object();
    for (const std::string& file : files_of(result)) {
        files[file] = sha256_of_file(folder / point_name(key) / file);
    }
    const nlohmann::ordered_json record{{"schema", k_schema},
                                        {"options", key.render_arguments},
                                        {"startup_seconds", result.startup_seconds},
                                        {"start_seconds", result.start_seconds},
                                        {"sha256", files}};
    write_text_file(record_path(folder, key), record.dump(2) + "\n");
}

std::optional<PreviewResult> load_point(const fs::path& folder, const PointKey& key) {
    const auto record = read_record(record_path(folder, key));
    if (!record.is_object() || !record.contains("schema") || record["schema"] != k_schema) {
        return std::nullopt;
    }
    try {
        const fs::path place = folder / point_name(key);
        for (const auto& [file, hash] : record.at("sha256").items()) {
            if (sha256_of_file(place / file) != hash) {
                return std::nullopt;
            }
        }
        PreviewResult result = read_preview(place, key.frames);
        for (const std::string& file : files_of(result)) {
            if (!record.at("sha256").contains(file)) {
                return std::nullopt;
            }
        }
        result.startup_seconds = finite_number(record, "startup_seconds");
        result.start_seconds = finite_number(record, "start_seconds");
        return result;
    } catch (const nlohmann::json::exception& error) {
        log::debug("{}: {}; the point is measured again", point_name(key), json_fault(error));
    } catch (const Error& error) {
        log::debug("{}; the point is measured again", error.what());
    }
    return std::nullopt;
}

}  // namespace bounce
