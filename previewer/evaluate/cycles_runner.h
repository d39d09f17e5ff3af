// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <functional>
#include <string>
#include <string_view>
#include <vector>

#include "image/view_transform.h"

namespace bounce {

// One picture by Cycles. Inputs first, results below.
struct CyclesRender {
    int frame = 1;
    int spp = 1;
    int seed = 1;
    int repeat = 1;                // renders, of which seconds is the median
    std::filesystem::path output;  // a scene-linear EXR of 32-bit floats is written here
    double seconds = 0.0;        // of one render in steady state: a later render of a frame already rendered
    double setup_seconds = 0.0;  // of those, until the first sample starts: scene transfer and BVH
    size_t rss_peak_bytes = 0;   // of Blender until then
    std::string measured;        // when, where it comes from an earlier run; else empty
    std::vector<double> all_seconds{};  // of each of the renders
};

// In the place of a number of bounces: the scene's own light paths, clamping included.
inline constexpr int k_own_light_paths = -1;

struct CyclesJob {
    std::filesystem::path scene;  // .blend, .glb or .gltf
    int width = 640;
    int height = 360;
    int bounces = 1;
    std::vector<CyclesRender> renders;  // those of one frame stand together
};

struct CyclesReport {
    std::string version;  // "3.4.1"
    int threads = 0;
    ViewTransform view;                        // the scene's own
    std::vector<std::filesystem::path> files;  // that the scene refers to
    std::vector<std::string> notes;            // what was changed or could not be carried over
    double startup_seconds = 0.0;              // from the start of the process to the open scene
    double first_render_seconds = 0.0;         // the very first render, one sample
    std::vector<CyclesRender> renders;         // as asked for, results filled in
};

// Renders the job with Cycles on the CPU in one Blender process. Light paths: direct light and exactly
// `bounces` bounces, diffuse or glossy, no clamping; or the scene's own (k_own_light_paths). No denoiser, no
// adaptive sampling; pixel filter Blackman-Harris, width 1.5 (evaluate/cycles_render.py says how each is
// set). on_render is called after each picture, with what is known so far. Throws input_error where Blender
// cannot render the scene, output_error where there is no room for temporary files, and what on_render
// throws.
[[nodiscard]] CyclesReport run_cycles(
    const CyclesJob& job, const std::filesystem::path& blender,
    const std::function<void(const CyclesRender&, const CyclesReport&)>& on_render = {});

// "2 bounces", or "own light paths", for keys.
[[nodiscard]] std::string bounces_text(int bounces);

// First line of `blender --version` and its build hash; names the engine in cache keys. Throws Error
// (failed) where the program does not answer like Blender.
[[nodiscard]] std::string blender_version(const std::filesystem::path& blender);

// The last line of what a program printed, for a sentence about its failure.
[[nodiscard]] std::string last_line(const std::string& output);

// Hash of the scripts that render such a scene: a changed setting in them makes other references.
[[nodiscard]] std::string cycles_scripts_hash(const std::filesystem::path& scene);

// Hash of what all our scripts share for such a scene: opening it and setting its picture.
[[nodiscard]] std::string shared_scripts_hash(const std::filesystem::path& scene);

}  // namespace bounce
