// SPDX-License-Identifier: Apache-2.0
#include "evaluate/stored_runs.h"

#include <algorithm>
#include <cassert>
#include <chrono>
#include <cmath>
#include <cstring>
#include <system_error>

#include <fmt/format.h>

#include "core/error.h"
#include "core/log.h"
#include "evaluate/evaluation.h"
#include "image/image_io.h"

namespace bounce {
namespace fs = std::filesystem;
namespace {

// Pixels alone: a file's header has the time at which it was written.
bool same_bits(const Image& a, const Image& b) {
    return a.width == b.width && a.height == b.height &&
           std::memcmp(a.rgb.data(), b.rgb.data(), a.rgb.size() * sizeof(float)) == 0;
}

}  // namespace

StoredRuns::StoredRuns(const EvaluateOptions& options, fs::path gltf, const std::string& scene_hash,
                       fs::path scratch)
    : options_(options),
      gltf_(std::move(gltf)),
      scratch_(std::move(scratch)),
      results_(options.runs.size() * static_cast<size_t>(options.rounds)) {
    if (options_.point_folder.empty()) {
        return;
    }
    const std::string program = program_fingerprint(options_.bounce);
    const std::string machine = machine_fingerprint();
    for (size_t i = 0; i < results_.size(); ++i) {
        keys_.push_back({scene_hash, program, machine, options_.frames, options_.width, options_.height,
                         options_.repeat, static_cast<int>(i / options_.runs.size()),
                         run_at(i).render_arguments});
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

const PreviewRun& StoredRuns::run_at(size_t index) const {
    return options_.runs[index % options_.runs.size()];
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
    PreviewResult result = run_preview(options_.bounce, gltf_, run_at(index), options_.frames, options_.width,
                                       options_.height, options_.repeat, folder);
    if (kept) {
        keep_point(options_.point_folder, keys_[index], result);
    }
    return result;
}

std::vector<PreviewResult> StoredRuns::results(const std::function<void(const std::string&)>& on_run) {
    for (size_t i = 0; i < results_.size(); ++i) {
        if (!results_[i]) {
            results_[i] = measure(i);
            const PreviewRun& run = run_at(i);
            on_run(fmt::format("{}, {}: {:.3f} s a frame", run.name, run.label,
                               results_[i]->frames.front().seconds));
        }
    }
    std::vector<PreviewResult> all;
    for (size_t i = 0; i < options_.runs.size(); ++i) {
        std::vector<PreviewResult> rounds;
        for (size_t k = i; k < results_.size(); k += options_.runs.size()) {
            rounds.push_back(*results_[k]);
        }
        all.push_back(merge_rounds(rounds, options_.runs[i].name + ", " + options_.runs[i].label));
    }
    return all;
}

PreviewResult merge_rounds(const std::vector<PreviewResult>& rounds, const std::string& run) {
    assert(!rounds.empty());
    PreviewResult merged = rounds.front();
    if (rounds.size() == 1) {
        return merged;
    }
    for (size_t i = 0; i < merged.frames.size(); ++i) {
        PreviewFrame& frame = merged.frames[i];
        const Image picture = read_image(frame.image);
        frame.all_seconds.clear();
        for (const PreviewResult& round : rounds) {
            const PreviewFrame& other = round.frames[i];
            frame.all_seconds.insert(frame.all_seconds.end(), other.all_seconds.begin(),
                                     other.all_seconds.end());
            if (!same_bits(read_image(other.image), picture)) {
                log::warning("{}: frame {} is not the same picture in every round", run, frame.frame);
            }
        }
        std::vector<double> sorted = frame.all_seconds;
        std::sort(sorted.begin(), sorted.end());
        if (const size_t count = sorted.size(); count > 0) {
            frame.seconds = 0.5 * (sorted[(count - 1) / 2] + sorted[count / 2]);
        }
    }
    return merged;
}

}  // namespace bounce
