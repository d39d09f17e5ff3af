// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include <nlohmann/json.hpp>

#include "core/stopwatch.h"
#include "gl/context.h"
#include "renderer/converge.h"
#include "renderer/renderer.h"

namespace bounce::cli {

struct FrameStats {
    int frame = 0;
    double time_s = 0.0;
    std::vector<double> all_wall_ms;  // every repetition, glFinish to glFinish, without per-pass timing
    // The passes of every repetition with per-pass timing, in the order in which they ran; empty without it.
    std::vector<std::vector<gl::PassTime>> all_passes;
    FrameReport report;
    std::optional<Converged> converged;    // its picture is not kept
    [[nodiscard]] double wall_ms() const;  // their median
};

// What comes before the frames, once a run.
struct StartTimes {
    double context_ms = 0.0;      // the OpenGL context and its functions
    double load_ms = 0.0;         // the glTF file: reading, decoding, pictures; no export of a .blend
    double upload_ms = 0.0;       // the scene to OpenGL
    double first_frame_ms = 0.0;  // the first rendering, with shaders compiled and points made
};

// stats.json, schema bounce.stats/1 (docs/architecture.md).
class StatsFile {
  public:
    StatsFile(std::string scene, gl::DeviceInfo device, const Settings& settings)
        : scene_(std::move(scene)), device_(std::move(device)), settings_(settings) {}
    // run: since the command began; written as it stands then.
    void start(const StartTimes& times, const Stopwatch& run) {
        start_ = times;
        run_ = run;
    }
    // How preset auto came to the settings (automatic_json()).
    void chosen(nlohmann::ordered_json automatic) { automatic_ = std::move(automatic); }
    void add(FrameStats frame) { frames_.push_back(std::move(frame)); }
    // Atomically. Throws output_error.
    void write(const std::filesystem::path& path) const;

  private:
    std::string scene_;
    gl::DeviceInfo device_;
    Settings settings_;
    nlohmann::ordered_json automatic_;  // null: auto has chosen nothing
    StartTimes start_;
    Stopwatch run_;
    std::vector<FrameStats> frames_;
};

}  // namespace bounce::cli
