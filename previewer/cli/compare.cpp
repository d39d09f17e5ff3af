// SPDX-License-Identifier: Apache-2.0
#include <cmath>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "cli/commands.h"
#include "cli/compare_sequence.h"
#include "cli/frame_list.h"
#include "cli/thresholds.h"
#include "core/atomic_file.h"
#include "image/image_io.h"
#include "image/metrics_json.h"

namespace bounce::cli {
namespace {

void print_table(const Metrics& metrics) {
    for (const NamedMetric& metric : named_metrics()) {
        fmt::print("{:<16}{:.6g}", metric.name, metric.value(metrics));
        if (metric.name == "bias" && !std::isnan(metrics.bias)) {
            fmt::print("  (red {:+.3g}, green {:+.3g}, blue {:+.3g})", metrics.bias_rgb[0],
                       metrics.bias_rgb[1], metrics.bias_rgb[2]);
        } else if (metric.name == "max_abs" && metrics.max_abs > 0.0) {
            fmt::print("  (at pixel {}, {})", metrics.max_abs_x, metrics.max_abs_y);
        }
        fmt::print("\n");
    }
    fmt::print("{:<16}{}x{}\n", "size", metrics.width, metrics.height);
}

// Options that only sequences have, and the other way round.
void check(const CompareArguments& arguments) {
    if (arguments.reference.empty()) {
        throw usage_error(
            "give a reference to compare the image with; only a sequence, with #### in its name, "
            "says something without one");
    }
    for (const auto& [option, given] :
         {std::pair{"--frames", !arguments.frames.empty()}, std::pair{"--motion", !arguments.motion.empty()},
          std::pair{"a reference with #### in its name", has_frame_field(arguments.reference)}}) {
        if (given) {
            throw usage_error(
                fmt::format("{} is for sequences but {} is one file; put #### where the frame "
                            "number belongs",
                            option, arguments.image));
        }
    }
}

ExitCode compare_images(const CompareArguments& arguments) {
    check(arguments);
    const std::vector<Threshold> thresholds = parse_thresholds(arguments.fail_above, false);
    const Image test = read_exposed(arguments.image, arguments.exposure_stops);
    const Image reference = read_exposed(arguments.reference, arguments.exposure_stops);
    const Metrics metrics = compare(test, reference);
    print_table(metrics);
    if (!arguments.json.empty()) {
        write_text_file(arguments.json, metrics_to_json(metrics).dump(2) + "\n");
    }
    write_pictures(arguments.pictures, test, reference, 0);
    const std::string what = fmt::format("{} against {}", arguments.image, arguments.reference);
    return report_exceeded(thresholds, metrics, what) ? ExitCode::above_threshold : ExitCode::done;
}

}  // namespace

Image read_exposed(const std::filesystem::path& path, double exposure_stops) {
    Image image = read_scene_linear(path);
    if (exposure_stops != 0.0) {
        const auto scale = static_cast<float>(std::exp2(exposure_stops));
        for (float& value : image.rgb) {
            value *= scale;
        }
    }
    return image;
}

void add_compare(CLI::App& app, Run& run) {
    CLI::App* command = app.add_subcommand(
        "compare", "Say how far an image is from a reference, or a sequence, and how steady it is");
    const auto arguments = std::make_shared<CompareArguments>();
    command
        ->add_option("image", arguments->image,
                     "Image to judge (EXR, or PNG decoded from sRGB); with #### a sequence")
        ->required();
    command->add_option("reference", arguments->reference,
                        "Image it should equal; for a sequence one with ####, or none");
    command->add_option("--frames", arguments->frames,
                        "Sequences: frame numbers, 1-48 or 1-48x4; all that exist by default");
    command->add_option(
        "--motion", arguments->motion,
        "Sequences: files of 'render --show motion', by which surfaces are followed from frame to frame");
    command->add_flag("--hdr-flip", arguments->hdr_flip,
                      "Sequences: HDR-FLIP of each frame too, which takes most of the time");
    command
        ->add_option("--exposure", arguments->exposure_stops,
                     "Multiply both by two to this many stops first; relMSE, SMAPE and all that follows the "
                     "view transform depend on it")
        ->check([](const std::string& text) {
            double stops = 0.0;
            return CLI::detail::lexical_cast(text, stops) && std::abs(stops) <= 64.0
                       ? std::string{}
                       : fmt::format("{} is not a number of stops from -64 to 64", text);
        });
    command->add_option("--json", arguments->json, "Write every metric to this file");
    command->add_option("--heatmap", arguments->pictures.heatmap, "Write a colour map of the error (PNG)");
    command->add_option("--heatmap-of", arguments->pictures.heatmap_of, "What the colour map shows")
        ->check(CLI::IsMember({"flip", "relative"}))
        ->capture_default_str();
    command->add_option("--difference", arguments->pictures.difference,
                        "Write four times the absolute difference as it looks on screen (PNG)");
    command
        ->add_option("--fail-above", arguments->fail_above,
                     "METRIC=LIMIT: exit with 5 where the metric is above; may be given more than once")
        ->allow_extra_args(false);
    command->callback([arguments, &run] {
        run = [arguments] {
            return has_frame_field(arguments->image) ? compare_sequence(*arguments)
                                                     : compare_images(*arguments);
        };
    });
}

}  // namespace bounce::cli
