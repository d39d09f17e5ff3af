// SPDX-License-Identifier: Apache-2.0
//
// Runs one of our scripts in Blender and listens to what it tells.
#pragma once

#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include <nlohmann/json.hpp>

#include "core/error.h"
#include "evaluate/scratch_folder.h"

namespace bounce {

// description: has "width", "height" and "frames", each with its "frame", beside what the script wants.
struct BlenderScript {
    std::filesystem::path blender;
    std::filesystem::path scene;       // .blend is opened by Blender, anything else imported by the script
    std::string name;                  // of the script's file
    std::string_view text;             // of the script; what it imports (blender_job.py, ...) lies beside it
    nlohmann::json description;        // of the job; "scene", "addon" and "defaults" are filled in
    std::vector<std::string> display;  // what runs Blender where there is no display; may be empty
};

struct BlenderEnd {
    bool failed = false;
    std::string reason;  // the script's own, or how Blender ended; filled also where nothing failed
    // What is not the scene's fault: what on_event threw, or that there is no room for temporary files.
    std::optional<Error> error;
};

// Calls on_event for each event that the script tells, with its kind, until one fails, and on_line for all
// other lines. An event "error", an event that on_event cannot read (nlohmann::json::exception) and an Error
// that on_event throws are the end's reason. Files are written to the scratch folder. Throws input_error
// where the scene is a glTF file that cannot be read.
[[nodiscard]] BlenderEnd run_blender_script(
    const BlenderScript& script, const ScratchFolder& scratch,
    const std::function<void(const std::string& kind, const nlohmann::json& event)>& on_event,
    const std::function<void(std::string_view)>& on_line = {});

}  // namespace bounce
