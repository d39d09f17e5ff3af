// SPDX-License-Identifier: Apache-2.0
#include <cmath>

#include <fmt/format.h>

#include "evaluate/report.h"

namespace bounce {
namespace {

// Empty where it is not known.
std::string if_known(double value) {
    return std::isfinite(value) ? fmt::format("{:.6g}", value) : "";
}

// Empty where there is no time to equal error.
std::string equal_error_csv(const Evaluation& evaluation, const std::string& curve,
                            const std::string& label) {
    for (const Speedup& speedup : evaluation.speedups) {
        if (speedup.curve == curve && speedup.label == label) {
            return fmt::format("{:.6g},{:.6g},{}", speedup.cycles_seconds, speedup.ratio,
                               equal_error_name(speedup.kind));
        }
    }
    return ",,";
}

// Figures of the whole sequence: in the mean's row alone.
constexpr const char* k_sequence_columns =
    ",flip_step_mean,flip_step_max,flip_step_reference_mean,flip_step_reference_max,tid,tid_relative,"
    "tid_reference,tid_coverage,flicker_power,flicker_share";
constexpr size_t k_sequence_figures = 10;

std::string sequence_csv(const CurvePoint& point) {
    if (!point.sequence) {
        return std::string(k_sequence_figures, ',');
    }
    const SequenceMetrics& m = *point.sequence;
    std::string text;
    for (const double value :
         {m.flip_step_mean, m.flip_step_max, m.flip_step_reference_mean, m.flip_step_reference_max, m.tid,
          m.tid_relative, m.tid_reference, m.tid_coverage, m.flicker_power, m.flicker_share}) {
        text += "," + if_known(value);
    }
    return text;
}

}  // namespace

std::string results_csv(const Evaluation& evaluation) {
    std::string csv =
        "curve,label,frame,seconds,relmse,relmse_exposed,flip_ldr,ssim,psnr_db,bias,pareto,own_front,"
        "seconds_least,seconds_most,cycles_seconds,ratio,cycles_time,flip_hdr";
    csv += k_sequence_columns;
    csv += '\n';
    for (const Curve& curve : evaluation.curves) {
        for (const CurvePoint& point : curve.points) {
            csv += fmt::format(
                "\"{}\",\"{}\",mean,{:.6g},{:.6g},{:.6g},{:.6g},{:.6g},{:.6g},{:.6g},{},{},{},{},{},{}{}\n",
                curve.name, point.label, point.seconds, point.relmse, point.relmse_exposed, point.flip_ldr,
                point.ssim, point.psnr_db, point.bias, point.pareto, point.own_front,
                if_known(point.seconds_least), if_known(point.seconds_most),
                equal_error_csv(evaluation, curve.name, point.label), if_known(point.flip_hdr),
                sequence_csv(point));
            for (const FrameError& frame : point.frames) {
                csv += fmt::format(
                    "\"{}\",\"{}\",{},{:.6g},{:.6g},{:.6g},{:.6g},{:.6g},{:.6g},{:.6g},,,{},{},,,,{}{}\n",
                    curve.name, point.label, frame.frame, frame.seconds, frame.relmse, frame.relmse_exposed,
                    frame.flip_ldr, frame.ssim, frame.psnr_db, frame.bias, if_known(frame.seconds_least),
                    if_known(frame.seconds_most), if_known(frame.flip_hdr),
                    std::string(k_sequence_figures, ','));
            }
        }
    }
    return csv;
}

}  // namespace bounce
