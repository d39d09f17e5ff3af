// SPDX-License-Identifier: Apache-2.0
#include "cli/compare_sequence.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include <fmt/format.h>

#include "cli/frame_list.h"
#include "cli/sequence_files.h"
#include "cli/thresholds.h"
#include "core/atomic_file.h"
#include "core/interrupt.h"
#include "core/progress.h"
#include "image/image_io.h"
#include "image/sequence_json.h"
#include "image/temporal_spectrum.h"

namespace bounce::cli {
namespace {

void require_pattern(const std::string& name, const char* option) {
    if (!name.empty() && !has_frame_field(name)) {
        throw usage_error(
            fmt::format("{} {} is one file but the image is a sequence; put #### where the frame "
                        "number belongs",
                        option, name));
    }
}

void check(const CompareArguments& arguments) {
    require_pattern(arguments.reference, "the reference");
    require_pattern(arguments.motion, "--motion");
    require_pattern(arguments.pictures.heatmap, "--heatmap");
    require_pattern(arguments.pictures.difference, "--difference");
    if (arguments.reference.empty() &&
        (!arguments.pictures.heatmap.empty() || !arguments.pictures.difference.empty())) {
        throw usage_error("--heatmap and --difference show the error against a reference; give one");
    }
}

// Thresholds whose figures nothing given can tell.
void check(const std::vector<Threshold>& thresholds, const CompareArguments& arguments, size_t frames) {
    for (const Threshold& threshold : thresholds) {
        if (std::holds_alternative<NamedMetric>(threshold.metric)) {
            if (arguments.reference.empty()) {
                throw usage_error(
                    fmt::format("--fail-above {}: this metric needs a reference", threshold.name()));
            }
            continue;
        }
        const auto& named = std::get<NamedSequenceMetric>(threshold.metric);
        if (named.name.starts_with("tid") && arguments.motion.empty()) {
            throw usage_error(fmt::format("--fail-above {}: this metric {}", named.name, named.needs));
        }
        if (named.name.starts_with("flicker") && frames < k_least_spectrum_frames) {
            throw usage_error(
                fmt::format("--fail-above {}: this metric needs {} frames or more, there are {}", named.name,
                            k_least_spectrum_frames, frames));
        }
    }
}

void print_frames(const SequenceMetrics& metrics) {
    const bool errors = metrics.frames.front().error.has_value();
    fmt::print("{:>6}", "frame");
    if (errors) {
        fmt::print(" {:>10} {:>10} {:>9} {:>9} {:>9}", "relmse", "nrmse", "bias", "flip_ldr", "ssim");
    }
    fmt::print(" {:>10} {:>10} {:>10}\n", "flip_step", "tid", "nan+inf");
    for (const SequenceFrame& entry : metrics.frames) {
        fmt::print("{:>6}", entry.frame);
        if (errors) {
            const Metrics& m = *entry.error;
            fmt::print(" {:>10.4g} {:>10.4g} {:>+9.4f} {:>9.5f} {:>9.5f}", m.relmse, m.nrmse, m.bias,
                       m.flip_ldr, m.ssim);
        }
        fmt::print(" {:>10.4g} {:>10.4g} {:>10}\n", entry.flip_step, entry.tid, entry.nan + entry.inf);
    }
}

void print_whole(const SequenceMetrics& m) {
    fmt::print("\n{:<26}{:>12}{:>12}  frame\n", "", "mean", "worst");
    for (const NamedMetric& metric : named_metrics()) {
        if (const SequenceFrame* worst = worst_frame(m, metric)) {
            fmt::print("{:<26}{:>12.6g}{:>12.6g}  {}\n", metric.name, mean_over_frames(m, metric),
                       metric.value(*worst->error), worst->frame);
        }
    }
    fmt::print("{:<26}{:>12.6g}{:>12.6g}  {}\n", "flip_step", m.flip_step_mean, m.flip_step_max,
               m.flip_step_max_frame);
    if (m.frames.front().error) {
        fmt::print("{:<26}{:>12.6g}{:>12.6g}\n", "flip_step of the reference", m.flip_step_reference_mean,
                   m.flip_step_reference_max);
    }
    const auto line = [](const char* name, double value, const std::string& more) {
        fmt::print("{:<26}{:>12.6g}  {}\n", name, value, more);
    };
    line("tid", m.tid,
         std::isnan(m.tid) ? "needs --motion"
                           : fmt::format("(reference {:.6g}; {:.1f} % of the pixels match)", m.tid_reference,
                                         100.0 * m.tid_coverage));
    line("tid_relative", m.tid_relative, "");
    line("flicker_power", m.flicker_power,
         m.frames.size() < k_least_spectrum_frames
             ? fmt::format("needs {} frames", k_least_spectrum_frames)
             : fmt::format("({:.1f} % of the pixels)", 100.0 * m.flicker_pixels));
    line("flicker_share", m.flicker_share, "");
    line("mean_luminance", m.mean_luminance, "");
    fmt::print("{:<26}{:>12}\n{:<26}{:>12}\n{:<26}{:>12}\n{:<26}{:>12}\n", "nan", m.nan, "inf", m.inf,
               "frames", m.frames.size(), "size", fmt::format("{}x{}", m.width, m.height));
}

std::optional<Image> read_frame(const std::string& pattern, int frame, double exposure_stops) {
    if (pattern.empty()) {
        return std::nullopt;
    }
    return read_exposed(frame_path(pattern, frame), exposure_stops);
}

}  // namespace

ExitCode compare_sequence(const CompareArguments& arguments) {
    check(arguments);
    const std::vector<Threshold> thresholds = parse_thresholds(arguments.fail_above, true);
    const std::vector<int> frames = frames_to_compare(arguments.image, arguments.reference, arguments.frames);
    check(thresholds, arguments, frames.size());
    if (!arguments.motion.empty()) {
        if (frames[1] - frames[0] != 1) {
            throw usage_error(
                "--motion tells the way from the frame before; compare every frame, without a step");
        }
        require_frames(arguments.motion, {frames.begin() + 1, frames.end()});
    }
    const bool hdr_flip =
        arguments.hdr_flip || std::any_of(thresholds.begin(), thresholds.end(),
                                          [](const auto& t) { return t.name() == "flip_hdr"; });
    SequenceMeter meter(hdr_flip ? HdrFlip::compute : HdrFlip::leave_out);
    Progress progress("compare", static_cast<int>(frames.size()));
    const InterruptGuard interrupts;
    for (const int frame : frames) {
        interrupts.throw_if_interrupted(fmt::format("frame {} was to be compared next", frame));
        const Image test = read_exposed(frame_path(arguments.image, frame), arguments.exposure_stops);
        const std::optional<Image> reference =
            read_frame(arguments.reference, frame, arguments.exposure_stops);
        const std::optional<Image> motion =
            frame == frames.front() ? std::nullopt : read_frame(arguments.motion, frame, 0.0);
        meter.add(frame, test, reference ? &*reference : nullptr, motion ? &*motion : nullptr);
        if (reference) {
            write_pictures(arguments.pictures, test, *reference, frame);
        }
        progress.step(fmt::format("frame {}", frame));
    }
    const SequenceMetrics metrics = meter.finish();
    print_frames(metrics);
    print_whole(metrics);
    if (!arguments.json.empty()) {
        write_text_file(arguments.json, sequence_to_json(metrics).dump(2) + "\n");
    }
    const std::string what = arguments.reference.empty()
                                 ? arguments.image
                                 : fmt::format("{} against {}", arguments.image, arguments.reference);
    return report_exceeded(thresholds, metrics, what) ? ExitCode::above_threshold : ExitCode::done;
}

}  // namespace bounce::cli
