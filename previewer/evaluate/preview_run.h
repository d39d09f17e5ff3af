// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace bounce {

// One way in which Bounce renders the frames: a point of a curve.
struct PreviewRun {
    std::string name;   // of the curve
    std::string label;  // of the point
    std::vector<std::string> render_arguments;
};

// The runs of `bounce evaluate` against a reference of so many bounces: direct light alone, reflective shadow
// maps, and virtual point lights, 64 to 1,024 of them, with imperfect shadow maps and without, with the
// reference's bounces (at most 4) and with one. Without bounces direct light alone.
[[nodiscard]] std::vector<PreviewRun> default_preview_runs(int bounces);

struct PreviewFrame {
    int frame = 1;
    double seconds = 0.0;             // median of the repeated renders
    std::filesystem::path image;      // scene-linear EXR
    std::vector<double> all_seconds;  // of the repeated renders, in their order
};

struct PreviewResult {
    std::vector<PreviewFrame> frames;
    double startup_seconds = 0.0;  // the process's time outside the repeated renders
    // Of it; the rest is writing files and warming up for later frames.
    double start_seconds =
        0.0;  // the process, from its start to its end, but for the command; OpenGL's context
    double load_seconds = 0.0;         // reading the file, taking it to OpenGL
    double first_frame_seconds = 0.0;  // with compiling shaders
    std::string gl_vendor, gl_renderer, gl_version;
    size_t rss_peak_bytes = 0;
    size_t gl_peak_bytes = 0;
};

// Renders the frames with the program's own `render` command in a process of its own, and reads its
// stats.json. bounce is the program's path; images are written below folder. Throws Error where it fails:
// input_refused and no_opengl as the program says, failed otherwise.
[[nodiscard]] PreviewResult run_preview(const std::filesystem::path& bounce,
                                        const std::filesystem::path& scene, const PreviewRun& run,
                                        const std::vector<int>& frames, int width, int height, int repeat,
                                        const std::filesystem::path& folder);

// What run_preview left in folder: its pictures and stats.json; startup_seconds and start_seconds, which
// only the one who ran it knows, stay 0. Throws
// nlohmann::json::exception where stats.json is damaged, Error where it tells of other frames.
[[nodiscard]] PreviewResult read_preview(const std::filesystem::path& folder, const std::vector<int>& frames);

}  // namespace bounce
