// SPDX-License-Identifier: Apache-2.0
//
// Measured points kept beside a report, so that a sweep that was killed goes on where it stopped.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "evaluate/preview_run.h"

namespace bounce {

// What a measured point follows from. A change in any of it makes another point.
struct PointKey {
    std::string scene_hash;    // sha256_of_gltf()
    std::string program_hash;  // program_fingerprint()
    std::string machine;       // machine_fingerprint()
    std::vector<int> frames;
    int width = 0;
    int height = 0;
    int repeat = 1;
    std::vector<std::string> render_arguments;
};

// The name of the point's folder.
[[nodiscard]] std::string point_name(const PointKey& key);

// Hash of the program and of its shaders: those packed into it, or of $BOUNCE_SHADER_DIR where that is set.
// Throws input_error where the program cannot be read.
[[nodiscard]] std::string program_fingerprint(const std::filesystem::path& bounce);

// What times and the last bits of a picture depend on beside the program: processor, system, and the
// environment variables that choose and configure Mesa's drivers.
[[nodiscard]] std::string machine_fingerprint();

// A point whose pictures and stats.json run_preview() left in folder / point_name(key). keep_point() adds a
// record with the hashes of them all, last, so that a half-written or damaged point counts as none;
// load_point() checks it. keep_point throws output_error.
void keep_point(const std::filesystem::path& folder, const PointKey& key, const PreviewResult& result);
[[nodiscard]] std::optional<PreviewResult> load_point(const std::filesystem::path& folder,
                                                      const PointKey& key);

}  // namespace bounce
