// SPDX-License-Identifier: Apache-2.0
#include "evaluate/resume.h"

#include <algorithm>
#include <fstream>
#include <optional>
#include <system_error>

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <nlohmann/json.hpp>

#include "core/atomic_file.h"
#include "core/error.h"
#include "core/log.h"

namespace bounce {
namespace fs = std::filesystem;
namespace {

// The finished run in folder, or nothing.
std::optional<PreviewResult> finished(const std::string& key, const fs::path& folder,
                                      const std::vector<int>& frames) {
    std::ifstream in(folder / "done.json");
    const auto done = nlohmann::json::parse(in, nullptr, false);
    if (!done.is_object() || done.value("key", "") != key) {
        return std::nullopt;
    }
    try {
        PreviewResult result = read_preview(folder, frames);
        result.startup_seconds = done.at("startup_seconds");
        const bool whole =
            std::all_of(result.frames.begin(), result.frames.end(), [](const PreviewFrame& frame) {
                std::error_code ignored;
                return fs::is_regular_file(frame.image, ignored);
            });
        return whole ? std::optional(result) : std::nullopt;
    } catch (const nlohmann::json::exception& error) {
        log::warning("{} is rendered again: {}", folder.string(), error.what());
    } catch (const Error& error) {
        log::warning("{} is rendered again: {}", folder.string(), error.what());
    }
    return std::nullopt;
}

}  // namespace

PreviewResult run_or_resume_preview(const std::string& key, const fs::path& bounce, const fs::path& scene,
                                    const PreviewRun& run, const std::vector<int>& frames, int width,
                                    int height, int repeat, const fs::path& folder) {
    const std::string whole_key =
        fmt::format("{}\n{}\n{}\n{}\n{}x{}\n{} renders", key, scene.string(),
                    fmt::join(run.render_arguments, " "), fmt::join(frames, ","), width, height, repeat);
    if (auto result = finished(whole_key, folder, frames)) {
        return *result;
    }
    std::error_code ignored;
    fs::remove(folder / "done.json", ignored);
    PreviewResult result = run_preview(bounce, scene, run, frames, width, height, repeat, folder);
    write_text_file(
        folder / "done.json",
        nlohmann::json{{"key", whole_key}, {"startup_seconds", result.startup_seconds}}.dump(2) + "\n");
    return result;
}

}  // namespace bounce
