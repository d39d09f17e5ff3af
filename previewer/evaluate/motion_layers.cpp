// SPDX-License-Identifier: Apache-2.0
#include "evaluate/motion_layers.h"

#include <string>
#include <utility>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "core/atomic_file.h"
#include "core/error.h"
#include "core/log.h"
#include "core/process.h"
#include "evaluate/cycles_runner.h"
#include "image/image_io.h"
#include "image/sequence_metrics.h"

namespace bounce {
namespace fs = std::filesystem;

MotionLayers::MotionLayers(const fs::path& bounce, const fs::path& scene, const std::vector<int>& frames,
                           int width, int height, fs::path folder)
    : folder_(std::move(folder)), first_(frames.front()) {
    if (even_step(frames) != 1) {
        return;
    }
    create_folder(folder_);
    const std::vector<std::string> command{
        bounce.string(),
        "render",
        scene.string(),
        "-o",
        (folder_ / "motion.####.exr").string(),
        "--frames",
        fmt::format("{}", fmt::join(frames.begin() + 1, frames.end(), ",")),
        "--size",
        fmt::format("{}x{}", width, height),
        "--show",
        "motion",
        "--stats",
        (folder_ / "stats.json").string()};
    log::debug("{}", fmt::join(command, " "));
    const ProcessResult result = run_process(command);
    known_ = result.exit_code == 0;
    if (!known_) {
        log::warning("TID is not told, because the layer motion could not be drawn (code {}): {}",
                     result.exit_code, last_line(result.output));
    }
}

std::optional<Image> MotionLayers::of(int frame) const {
    if (!known_ || frame == first_) {
        return std::nullopt;
    }
    return read_image(folder_ / fmt::format("motion.{:04}.exr", frame));
}

}  // namespace bounce
