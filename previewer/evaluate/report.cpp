// SPDX-License-Identifier: Apache-2.0
#include "evaluate/report.h"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <limits>
#include <system_error>

#include <fmt/format.h>

#include "core/atomic_file.h"
#include "evaluate/given_reference.h"
#include "evaluate/report_details.h"
#include "image/image_io.h"
#include "image/sequence_json.h"

namespace bounce {
namespace {

using nlohmann::ordered_json;

ordered_json number(double value) {
    return std::isfinite(value) ? ordered_json(value) : ordered_json(nullptr);
}

double mean_of(const std::vector<Reference>& references, double Reference::*member) {
    double sum = 0.0;
    for (const Reference& reference : references) {
        sum += reference.*member;
    }
    return sum / static_cast<double>(references.size());
}

int fewest_spp(const Evaluation& evaluation) {
    int fewest = std::numeric_limits<int>::max();
    for (const Reference& reference : evaluation.references) {
        fewest = std::min(fewest, reference.spp);
    }
    return fewest;
}

// "1024 spp", or "1024 to 4096 spp" where the frames' references differ.
std::string spp_text(const Evaluation& evaluation) {
    int most = 0;
    for (const Reference& reference : evaluation.references) {
        most = std::max(most, reference.spp);
    }
    const int fewest = fewest_spp(evaluation);
    return fewest == most ? fmt::format("{} spp", most) : fmt::format("{} to {} spp", fewest, most);
}

// The least that any engine has in a frame: what the noise floor has to stay below.
double smallest_relmse(const Evaluation& evaluation, int frame) {
    double least = std::numeric_limits<double>::infinity();
    for (const Curve& curve : evaluation.curves) {
        for (const CurvePoint& point : curve.points) {
            for (const FrameError& item : point.frames) {
                if (item.frame == frame && std::isfinite(item.relmse)) {
                    least = std::min(least, item.relmse);
                }
            }
        }
    }
    return least;
}

ordered_json reference_json(const Evaluation& evaluation) {
    ordered_json frames = ordered_json::array();
    for (const Reference& reference : evaluation.references) {
        frames.push_back({{"frame", reference.frame},
                          {"seconds", number(reference.seconds)},
                          {"noise_floor_relmse", number(reference.noise_floor)},
                          {"spp", reference.spp},
                          {"smallest_relmse", number(smallest_relmse(evaluation, reference.frame))},
                          {"cached", reference.cached}});
    }
    const bool given = !evaluation.given_reference.empty();
    return {{"engine", given ? "a given image: " + evaluation.given_reference : "Cycles (CPU)"},
            {"version", evaluation.cycles.version},
            {"spp", fewest_spp(evaluation)},
            {"seconds", number(mean_of(evaluation.references, &Reference::seconds))},
            {"noise_floor_relmse", number(mean_of(evaluation.references, &Reference::noise_floor))},
            {"bounces", evaluation.bounces},
            {"threads", evaluation.cycles.threads},
            {"startup_seconds", number(evaluation.cycles.startup_seconds)},
            {"first_render_seconds", number(evaluation.cycles.first_render_seconds)},
            {"frames", frames}};
}

ordered_json final_errors_json(const FinalErrors& errors) {
    return {{"relmse", number(errors.relmse)},
            {"flip_ldr", number(errors.flip_ldr)},
            {"ssim", number(errors.ssim)},
            {"psnr_db", number(errors.psnr_db)},
            {"bias", number(errors.bias)}};
}

ordered_json point_json(const CurvePoint& point) {
    ordered_json frames = ordered_json::array();
    for (const FrameError& frame : point.frames) {
        frames.push_back(
            {{"frame", frame.frame},
             {"seconds", number(frame.seconds)},
             {"seconds_least", number(frame.seconds_least)},
             {"seconds_most", number(frame.seconds_most)},
             {"relmse", number(frame.relmse)},
             {"relmse_exposed", number(frame.relmse_exposed)},
             {"flip_ldr", number(frame.flip_ldr)},
             {"flip_hdr", number(frame.flip_hdr)},
             {"ssim", number(frame.ssim)},
             {"psnr_db", number(frame.psnr_db)},
             {"bias", number(frame.bias)},
             {"nrmse", number(frame.nrmse)},
             {"smape", number(frame.smape)},
             {"bias_rgb", {number(frame.bias_rgb[0]), number(frame.bias_rgb[1]), number(frame.bias_rgb[2])}},
             {"max_abs", number(frame.max_abs)},
             {"max_abs_pixel", {frame.max_x, frame.max_y}},
             {"not_finite", frame.not_finite}});
    }
    const auto final = point.final_errors ? final_errors_json(*point.final_errors) : ordered_json(nullptr);
    return {{"label", point.label},
            {"seconds", number(point.seconds)},
            {"relmse", number(point.relmse)},
            {"relmse_exposed", number(point.relmse_exposed)},
            {"flip_ldr", number(point.flip_ldr)},
            {"flip_hdr", number(point.flip_hdr)},
            {"ssim", number(point.ssim)},
            {"psnr_db", number(point.psnr_db)},
            {"bias", number(point.bias)},
            {"nrmse", number(point.nrmse)},
            {"smape", number(point.smape)},
            {"bias_rgb", {number(point.bias_rgb[0]), number(point.bias_rgb[1]), number(point.bias_rgb[2])}},
            {"pareto", point.pareto},
            {"setup_seconds", number(point.setup_seconds)},
            {"startup_seconds", number(point.startup_seconds)},
            {"rss_peak_bytes", point.rss_peak_bytes},
            {"gl_peak_bytes", point.gl_peak_bytes},
            {"measured", point.measured},
            {"seconds_least", number(point.seconds_least)},
            {"seconds_most", number(point.seconds_most)},
            {"own_front", point.own_front},
            {"options", point.options},
            {"sequence", point.sequence ? sequence_figures_json(*point.sequence) : ordered_json(nullptr)},
            {"final_render", final},
            {"frames", frames}};
}

ordered_json final_render_json(const Evaluation& evaluation) {
    if (!evaluation.final_render) {
        return nullptr;
    }
    ordered_json frames = ordered_json::array();
    for (const Reference& reference : evaluation.final_render->references) {
        frames.push_back({{"frame", reference.frame},
                          {"seconds", number(reference.seconds)},
                          {"noise_floor_relmse", number(reference.noise_floor)},
                          {"spp", reference.spp},
                          {"cached", reference.cached}});
    }
    return {{"light_paths", "the scene's own"},
            {"matched_reference", final_errors_json(evaluation.final_render->matched)},
            {"frames", frames}};
}

ordered_json front_json(const FrontSummary& front) {
    return {{"points", front.points},
            {"compared", front.compared},
            {"extrapolated", front.extrapolated},
            {"upper_bounds", front.upper_bounds},
            {"geometric_mean_ratio", number(front.geometric_mean_ratio)},
            {"least_ratio", number(front.least_ratio)},
            {"least_curve", front.least_curve},
            {"least_label", front.least_label}};
}

// A part of a file name: "RSM, every pixel" becomes "rsm_every_pixel".
std::string slug(const std::string& text) {
    std::string result;
    for (const char c : text) {
        if (std::isalnum(static_cast<unsigned char>(c)) != 0) {
            result += static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
        } else if (!result.empty() && result.back() != '_') {
            result += '_';
        }
    }
    return result;
}

// "-3+12%": the fastest and the slowest of the repeated renders against the median.
std::string spread_text(const CurvePoint& point) {
    if (!std::isfinite(point.seconds_least) || !(point.seconds > 0.0)) {
        return "";
    }
    return fmt::format("{:+.0f}{:+.0f}%", 100.0 * (point.seconds_least / point.seconds - 1.0),
                       100.0 * (point.seconds_most / point.seconds - 1.0));
}

}  // namespace

ordered_json results_json(const Evaluation& evaluation) {
    ordered_json curves = ordered_json::array();
    for (const Curve& curve : evaluation.curves) {
        ordered_json points = ordered_json::array();
        for (const CurvePoint& point : curve.points) {
            points.push_back(point_json(point));
        }
        curves.push_back({{"name", curve.name},
                          {"reference_engine", curve.reference_engine},
                          {"peer", curve.peer},
                          {"points", points}});
    }
    ordered_json speedups = ordered_json::array();
    for (const Speedup& speedup : evaluation.speedups) {
        speedups.push_back({{"curve", speedup.curve},
                            {"label", speedup.label},
                            {"relmse", number(speedup.relmse)},
                            {"bounce_seconds", number(speedup.bounce_seconds)},
                            {"cycles_seconds", number(speedup.cycles_seconds)},
                            {"ratio", number(speedup.ratio)},
                            {"cycles_time", equal_error_name(speedup.kind)}});
    }
    const ViewTransform& view = evaluation.cycles.view;
    return {{"scene", evaluation.scene},
            {"scene_sha256", evaluation.scene_sha256},
            {"reference", reference_json(evaluation)},
            {"final_render", final_render_json(evaluation)},
            {"curves", curves},
            {"speedup_at_equal_error", speedups},
            {"own_front", front_json(evaluation.front)},
            {"budgets", budgets_json(evaluation)},
            {"width", evaluation.width},
            {"height", evaluation.height},
            {"frames", evaluation.frames},
            {"sequence", sequence_json(evaluation)},
            {"machine",
             {{"cpu", evaluation.machine.cpu},
              {"threads", evaluation.machine.threads},
              {"system", evaluation.machine.system}}},
            {"gl",
             {{"vendor", evaluation.gl_vendor},
              {"renderer", evaluation.gl_renderer},
              {"version", evaluation.gl_version}}},
            {"blender", evaluation.blender},
            {"view", {{"transform", view.view_transform}, {"look", view.look}, {"exposure", view.exposure}}},
            {"notes", evaluation.cycles.notes},
            {"peers", peers_json(evaluation)},
            {"startup", startup_json(evaluation)},
            {"passes", passes_json(evaluation)},
            {"command", evaluation.command},
            {"date", evaluation.date}};
}

std::string results_table(const Evaluation& evaluation) {
    // Spread: from the fastest to the slowest of the repeated renders, as parts of the median.
    std::string table = fmt::format("{:<22}{:<18}{:>11}{:>11}{:>12}{:>9}{:>9}  {}\n", "curve", "point",
                                    "s/frame", "spread", "relMSE", "FLIP", "bias", "time to equal error");
    for (const Curve& curve : evaluation.curves) {
        for (const CurvePoint& point : curve.points) {
            const auto speedup = std::find_if(
                evaluation.speedups.begin(), evaluation.speedups.end(),
                [&](const Speedup& item) { return item.curve == curve.name && item.label == point.label; });
            std::string equal;
            if (speedup != evaluation.speedups.end()) {
                const bool at_most = speedup->kind == EqualErrorKind::fastest_point;
                equal = fmt::format("Cycles {}{:.3g} s, ratio {}{:.3g}{}", at_most ? "<= " : "",
                                    speedup->cycles_seconds, at_most ? "<= " : "", speedup->ratio,
                                    speedup->kind == EqualErrorKind::extrapolated ? " (extrapolated)" : "");
            }
            table += fmt::format("{:<22}{:<18}{:>11.4f}{:>11}{:>12.3g}{:>9.4f}{:>+8.2f}% {}{}\n", curve.name,
                                 point.label, point.seconds, spread_text(point), point.relmse, point.flip_ldr,
                                 100.0 * point.bias, point.pareto ? "* " : "  ", equal);
        }
    }
    if (evaluation.final_render) {
        const FinalErrors& matched = evaluation.final_render->matched;
        table += fmt::format(
            "Against the scene by its own light paths the reference itself is off by relMSE {:.3g}, FLIP "
            "{:.4f}, {:+.2f}%.\n",
            matched.relmse, matched.flip_ldr, 100.0 * matched.bias);
    }
    if (!evaluation.given_reference.empty()) {
        return table + fmt::format("* on the Pareto front. Reference: {}, noise floor {:.2g}.\n",
                                   evaluation.given_reference,
                                   mean_of(evaluation.references, &Reference::noise_floor));
    }
    table += fmt::format(
        "* on the Pareto front. Reference: Cycles {}, {}, {:.1f} s a frame, noise floor {:.2g}.\n",
        evaluation.cycles.version, spp_text(evaluation), mean_of(evaluation.references, &Reference::seconds),
        mean_of(evaluation.references, &Reference::noise_floor));
    return table;
}

std::vector<std::pair<std::string, std::string>> shown_points(const Evaluation& evaluation) {
    const auto more_exact = [](const CurvePoint& a, const CurvePoint& b) { return a.relmse < b.relmse; };
    std::vector<std::pair<std::string, std::string>> shown;
    const CurvePoint* best = nullptr;
    for (const Curve& curve : evaluation.curves) {
        if (!curve.reference_engine && !curve.points.empty()) {
            const auto point = std::min_element(curve.points.begin(), curve.points.end(), more_exact);
            shown.emplace_back(curve.name, point->label);
            best = best == nullptr || more_exact(*point, *best) ? &*point : best;
        }
    }
    std::reverse(shown.begin(), shown.end());  // direct light alone is the least interesting
    for (const Curve& curve : evaluation.curves) {
        if (curve.reference_engine && !curve.points.empty()) {
            const auto nearest = std::min_element(
                curve.points.begin(), curve.points.end(), [&](const CurvePoint& a, const CurvePoint& b) {
                    const auto distance = [&](const CurvePoint& point) {
                        return best == nullptr ? 0.0 : std::abs(std::log(point.seconds / best->seconds));
                    };
                    return distance(a) < distance(b);
                });
            shown.emplace_back(curve.name, nearest->label);
        }
    }
    return shown;
}

void write_report(const Evaluation& evaluation, const std::filesystem::path& folder) {
    // Of an earlier run: it would say that this one's report is whole before it is.
    std::error_code ignored;
    std::filesystem::remove(folder / "results.json", ignored);
    const auto shown = shown_points(evaluation);
    const auto attributes = [&](int frame) {
        return ImageAttributes{{"bounce:scene", evaluation.scene}, {"bounce:frame", std::to_string(frame)}};
    };
    for (const Reference& reference : evaluation.references) {
        write_image(
            folder / "frames" / fmt::format("reference.{:04}.exr", reference.frame), reference.image,
            reference_attributes(reference, evaluation.scene, evaluation.scene_hash, evaluation.bounces));
    }
    if (evaluation.final_render) {
        for (const Reference& reference : evaluation.final_render->references) {
            write_image(folder / "frames" / fmt::format("final.{:04}.exr", reference.frame), reference.image,
                        final_attributes(reference, evaluation.scene, evaluation.scene_hash));
        }
    }
    for (const Picture& picture : evaluation.pictures) {
        if (std::find(shown.begin(), shown.end(), std::pair{picture.curve, picture.label}) != shown.end()) {
            write_image(
                folder / "frames" /
                    fmt::format("{}.{:04}.exr", slug(picture.curve + " " + picture.label), picture.frame),
                picture.image, attributes(picture.frame));
        }
    }
    write_text_file(folder / "results.csv", results_csv(evaluation));
    write_text_file(folder / "index.html", results_html(evaluation));
    // Last: where it stands the report is whole.
    write_text_file(folder / "results.json", results_json(evaluation).dump(2) + "\n");
}

}  // namespace bounce
