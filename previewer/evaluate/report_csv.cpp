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

constexpr const char* k_final_columns = ",final_relmse,final_flip_ldr,final_ssim,final_psnr_db,final_bias";
constexpr size_t k_final_figures = 5;

// Against the scene by its own light paths: in the mean's row alone as well.
std::string final_csv(const CurvePoint& point) {
    if (!point.final_errors) {
        return std::string(k_final_figures, ',');
    }
    const FinalErrors& e = *point.final_errors;
    std::string text;
    for (const double value : {e.relmse, e.flip_ldr, e.ssim, e.psnr_db, e.bias}) {
        text += "," + if_known(value);
    }
    return text;
}

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

// What a frame and the mean over all of them have alike.
template <typename Errors>
std::string errors_csv(const Errors& errors) {
    std::string text;
    for (const double value :
         {errors.seconds, errors.relmse, errors.relmse_exposed, errors.flip_ldr, errors.flip_hdr, errors.ssim,
          errors.psnr_db, errors.nrmse, errors.smape, errors.bias, errors.bias_rgb[0], errors.bias_rgb[1],
          errors.bias_rgb[2], errors.seconds_least, errors.seconds_most}) {
        text += "," + if_known(value);
    }
    return text;
}

constexpr const char* k_columns =
    "curve,label,frame,seconds,relmse,relmse_exposed,flip_ldr,flip_hdr,ssim,psnr_db,nrmse,smape,bias,bias_r,"
    "bias_g,"
    "bias_b,seconds_least,seconds_most,max_abs,max_x,max_y,not_finite,pareto,own_front,cycles_seconds,ratio,"
    "cycles_time";

}  // namespace

std::string results_csv(const Evaluation& evaluation) {
    std::string csv = k_columns;
    csv += k_sequence_columns;
    csv += k_final_columns;
    csv += '\n';
    for (const Curve& curve : evaluation.curves) {
        for (const CurvePoint& point : curve.points) {
            csv += fmt::format("\"{}\",\"{}\",mean{},,,,,{},{},{}{}\n", curve.name, point.label,
                               errors_csv(point), point.pareto, point.own_front,
                               equal_error_csv(evaluation, curve.name, point.label),
                               sequence_csv(point) + final_csv(point));
            for (const FrameError& frame : point.frames) {
                csv += fmt::format("\"{}\",\"{}\",{}{},{},{},{},{},,,,,{}\n", curve.name, point.label,
                                   frame.frame, errors_csv(frame), if_known(frame.max_abs), frame.max_x,
                                   frame.max_y, frame.not_finite,
                                   std::string(k_sequence_figures + k_final_figures, ','));
            }
        }
    }
    return csv;
}

}  // namespace bounce
