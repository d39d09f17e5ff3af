// SPDX-License-Identifier: Apache-2.0
#include "evaluate/blender_script.h"

#include <optional>

#include <fmt/format.h>

#include "core/atomic_file.h"
#include "core/error.h"
#include "core/json_fault.h"
#include "core/log.h"
#include "core/process.h"
#include "evaluate/blender_export.h"
#include "evaluate/cycles_runner.h"
#include "evaluate/draco_check.h"
#include "evaluate/embedded.h"
#include "evaluate/picture_room.h"
#include "evaluate/scene_defaults.h"
#include "evaluate/scene_files.h"

namespace bounce {
namespace fs = std::filesystem;
namespace {

using nlohmann::json;

constexpr std::string_view k_event_prefix = "BOUNCE ";

std::vector<int> frames_of(const json& description) {
    std::vector<int> frames;
    for (const json& item : description.at("frames")) {
        frames.push_back(item.at("frame"));
    }
    return frames;
}

// Throws output_error; that of a full disk where there is no room for the pictures either.
void write_job(const BlenderScript& script, const json& description, const ScratchFolder& scratch) {
    try {
        write_text_file(scratch / "blender_job.py", embedded::blender_job_py());
        write_text_file(scratch / "cycles_import_gltf.py", embedded::cycles_import_gltf_py());
        write_text_file(scratch / script.name, script.text);
        write_text_file(scratch / "job.json", description.dump());
    } catch (const Error&) {
        if (const auto full =
                no_room_for_picture(scratch.path(), description.at("width"), description.at("height"))) {
            throw *full;
        }
        throw;
    }
}

}  // namespace

BlenderEnd run_blender_script(const BlenderScript& script, const ScratchFolder& scratch,
                              const std::function<void(const std::string&, const json&)>& on_event,
                              const std::function<void(std::string_view)>& on_line) {
    const bool blend = is_blend(script.scene);
    json description = script.description;
    description["scene"] = fs::absolute(script.scene).string();
    if (!blend) {
        require_draco_library(script.scene, script.blender);
        description["addon"] = find_addon().string();  // its Draco library decodes the file
        description["defaults"] = scene_defaults(script.scene, frames_of(description),
                                                 description.at("width"), description.at("height"));
    }
    write_job(script, description, scratch);

    std::vector<std::string> command = script.display;
    command.insert(command.end(), {script.blender.string(), "-b", "--factory-startup"});
    if (blend) {
        command.push_back(fs::absolute(script.scene).string());
    }
    command.insert(command.end(), {"--python-exit-code", "1", "-P", (scratch / script.name).string(), "--",
                                   (scratch / "job.json").string()});
    std::optional<std::string> reason;
    std::optional<Error> error;
    const ProcessResult process = run_process(command, [&](std::string_view line) {
        // Blender's own status lines end without a newline where the script's output follows.
        const size_t at = line.find(k_event_prefix);
        if (at == std::string_view::npos) {
            if (on_line) on_line(line);
            return;
        }
        if (reason) {
            return;
        }
        try {
            const json event = json::parse(line.substr(at + k_event_prefix.size()));
            const auto kind = event.at("event").get<std::string>();
            if (kind == "error") {
                reason = event.at("message").get<std::string>();
            } else {
                on_event(kind, event);
            }
        } catch (const json::exception& exception) {
            reason = fmt::format("what Blender told cannot be read: {}", json_fault(exception));
        } catch (const Error& exception) {
            reason = exception.what();  // Blender is let end first
            error = exception;
        }
    });
    const bool failed = process.exit_code != 0 || reason.has_value();
    if (failed) {
        log::debug("{}", process.output);
    }
    if (!reason) {
        reason = fmt::format("Blender ended with code {} after \"{}\"", process.exit_code,
                             last_line(process.output));
    }
    if (failed && !error) {
        error = no_room_for_picture(scratch.path(), description.at("width"), description.at("height"));
    }
    return {failed, error ? error->what() : *reason, error};
}

}  // namespace bounce
