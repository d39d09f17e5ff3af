// SPDX-License-Identifier: Apache-2.0
//
// Pictures of other engines with their times, kept between runs, so that a killed run goes on where it
// stopped.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "image/image.h"

namespace bounce {

// One picture and what making it cost. What is not known is 0.
struct CachedRender {
    Image image;                      // scene-linear
    double seconds = 0.0;             // median of the renders
    std::vector<double> all_seconds;  // of each; one where it was rendered once, none where not known
    double setup_seconds = 0.0;
    double startup_seconds = 0.0;
    double first_render_seconds = 0.0;
    double export_seconds = 0.0;
    size_t rss_peak_bytes = 0;
    std::string date;                          // when it was measured, UTC, ISO 8601
    std::vector<std::string> notes;            // what the engine could not take over from the scene
    std::vector<std::filesystem::path> files;  // that the scene refers to; set by load()
    std::string engine;                        // what else its engine told: JSON, or empty
};

// Entries are <folder>/<hash of the key>.exr and .json. An entry counts only where its record holds the same
// key, the picture has the size asked for and the hash that was recorded, and the files that the scene refers
// to are unchanged: what is half-written, foreign or stale is made again.
class RenderCache {
  public:
    RenderCache(std::filesystem::path folder, int width, int height)
        : folder_(std::move(folder)), width_(width), height_(height) {}

    // Nothing where there is no such entry or it cannot be trusted; then a warning says why.
    [[nodiscard]] std::optional<CachedRender> load(const std::string& key) const;

    // Throws output_error.
    void store(const std::string& key, const CachedRender& render,
               const std::vector<std::filesystem::path>& scene_files) const;

    // As store, but a disk that takes nothing more is a warning: the run goes on with what it has in memory.
    void store_or_warn(const std::string& key, const CachedRender& render,
                       const std::vector<std::filesystem::path>& scene_files) const;

    void remove(const std::string& key) const;

  private:
    [[nodiscard]] std::filesystem::path file(const std::string& key, const char* extension) const;

    std::filesystem::path folder_;
    int width_;
    int height_;
};

// The time now, UTC, as ISO 8601.
[[nodiscard]] std::string utc_now();

}  // namespace bounce
