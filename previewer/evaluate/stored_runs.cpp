// SPDX-License-Identifier: Apache-2.0
#include "evaluate/stored_runs.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <system_error>

#include <fmt/format.h>

#include "core/error.h"
#include "core/log.h"
#include "evaluate/evaluation.h"

namespace bounce {
namespace fs = std::filesystem;

StoredRuns::StoredRuns(const EvaluateOptions& options, fs::path gltf, const std::string& scene_hash,
                       fs::path scratch)
    : options_(options), gltf_(std::move(gltf)), scratch_(std::move(scratch)), results_(options.runs.size()) {
    if (options_.point_folder.empty()) {
        return;
    }
    const std::string program = program_fingerprint(options_.bounce);
    const std::string machine = machine_fingerprint();
    for (size_t i = 0; i < options_.runs.size(); ++i) {
        keys_.push_back({scene_hash, program, machine, options_.frames, options_.width, options_.height,
                         options_.repeat, options_.runs[i].render_arguments});
        if (options_.resume) {
            results_[i] = load_point(options_.point_folder, keys_.back());
        }
    }
    if (options_.resume) {
        log::info("{} of {} points are there already", results_.size() - missing(), results_.size());
    }
}

size_t StoredRuns::missing() const {
    return static_cast<size_t>(std::count(results_.begin(), results_.end(), std::nullopt));
}

PreviewResult StoredRuns::measure(size_t index) const {
    const bool kept = !keys_.empty();
    const fs::path folder =
        kept ? options_.point_folder / point_name(keys_[index]) : scratch_ / fmt::format("run{}", index);
    std::error_code code;
    fs::remove_all(folder, code);
    if (code) {
        throw output_error(fmt::format("cannot remove {}: {}", folder.string(), code.message()));
    }
    PreviewResult result = run_preview(options_.bounce, gltf_, options_.runs[index], options_.frames,
                                       options_.width, options_.height, options_.repeat, folder);
    if (kept) {
        keep_point(options_.point_folder, keys_[index], result);
    }
    return result;
}

std::vector<PreviewResult> StoredRuns::results(const std::function<void(const std::string&)>& on_run) {
    using Clock = std::chrono::steady_clock;
    const Clock::time_point start = Clock::now();
    const size_t total = missing();
    size_t done = 0;
    std::vector<PreviewResult> all;
    for (size_t i = 0; i < results_.size(); ++i) {
        if (!results_[i]) {
            results_[i] = measure(i);
            ++done;
            const double elapsed = std::chrono::duration<double>(Clock::now() - start).count();
            const double left = elapsed / static_cast<double>(done) * static_cast<double>(total - done);
            const PreviewRun& run = options_.runs[i];
            on_run(fmt::format("{}, {}: {:.3f} s a frame{}", run.name, run.label,
                               results_[i]->frames.front().seconds,
                               done < total ? fmt::format("; {} left for Bounce", rough_time(left)) : ""));
        }
        all.push_back(*results_[i]);
    }
    return all;
}

std::string rough_time(double seconds) {
    const auto whole = std::max(std::llround(seconds), 0LL);
    if (whole < 90) {
        return fmt::format("{} s", whole);
    }
    const long long minutes = (whole + 30) / 60;
    return minutes < 60 ? fmt::format("{} min", minutes)
                        : fmt::format("{} h {} min", minutes / 60, minutes % 60);
}

}  // namespace bounce
