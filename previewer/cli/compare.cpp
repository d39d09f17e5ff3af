// SPDX-License-Identifier: Apache-2.0
#include <charconv>
#include <cmath>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "cli/commands.h"
#include "core/atomic_file.h"
#include "core/log.h"
#include "image/heatmap.h"
#include "image/image_io.h"
#include "image/metrics_json.h"
#include "image/view_transform.h"

namespace bounce::cli {
namespace {

struct CompareArguments {
    std::filesystem::path image;
    std::filesystem::path reference;
    std::filesystem::path json;
    std::filesystem::path heatmap;
    std::string heatmap_of = "flip";
    std::filesystem::path difference;
    std::vector<std::string> fail_above;
};

struct Threshold {
    NamedMetric metric;
    double limit = 0.0;
};

// "relmse=0.01"; throws usage_error.
Threshold parse_threshold(const std::string& text) {
    const size_t equals = text.find('=');
    const auto metric = find_metric(std::string_view(text).substr(0, equals));
    std::string names;
    for (const NamedMetric& known : named_metrics()) {
        if (known.lower_is_better) {
            names += fmt::format("{}{}", names.empty() ? "" : ", ", known.name);
        }
    }
    if (!metric || !metric->lower_is_better) {
        throw usage_error(fmt::format("--fail-above {}: {}; the metrics with an upper limit are {}", text,
                                      metric ? "more is better for this metric" : "no such metric", names));
    }
    double limit = 0.0;
    const char* end = text.data() + text.size();
    const char* start = equals == std::string::npos ? end : text.data() + equals + 1;
    const auto [parsed, error] = std::from_chars(start, end, limit);
    if (error != std::errc{} || parsed != end || !(limit >= 0.0)) {
        throw usage_error(
            fmt::format("--fail-above {}: give a limit of 0 or more, as in {}=0.01", text, metric->name));
    }
    return {*metric, limit};
}

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

void write_pictures(const CompareArguments& arguments, const Image& test, const Image& reference) {
    if (arguments.heatmap.empty() && arguments.difference.empty()) {
        return;
    }
    const Image test_display = to_display(test, {});
    const Image reference_display = to_display(reference, {});
    if (!arguments.heatmap.empty()) {
        write_image(arguments.heatmap,
                    magma(arguments.heatmap_of == "flip" ? flip_ldr(test_display, reference_display)
                                                         : relative_error(test, reference)));
    }
    if (!arguments.difference.empty()) {
        write_image(arguments.difference, magnified_difference(test_display, reference_display));
    }
}

ExitCode run_compare(const CompareArguments& arguments) {
    std::vector<Threshold> thresholds;
    thresholds.reserve(arguments.fail_above.size());
    for (const std::string& text : arguments.fail_above) {
        thresholds.push_back(parse_threshold(text));
    }
    const Image test = read_scene_linear(arguments.image);
    const Image reference = read_scene_linear(arguments.reference);
    const Metrics metrics = compare(test, reference);
    print_table(metrics);
    if (!arguments.json.empty()) {
        write_text_file(arguments.json, metrics_to_json(metrics).dump(2) + "\n");
    }
    write_pictures(arguments, test, reference);

    ExitCode result = ExitCode::done;
    for (const Threshold& threshold : thresholds) {
        if (exceeds(metrics, threshold.metric, threshold.limit)) {
            const std::string why = metrics.nan + metrics.inf > 0
                                        ? fmt::format("cannot be told: {} values are NaN and {} infinite",
                                                      metrics.nan, metrics.inf)
                                        : fmt::format("is {:.6g}", threshold.metric.value(metrics));
            log::error("{} against {}: {} {}, the limit is {:g}", arguments.image.string(),
                       arguments.reference.string(), threshold.metric.name, why, threshold.limit);
            result = ExitCode::above_threshold;
        }
    }
    return result;
}

}  // namespace

void add_compare(CLI::App& app, Run& run) {
    CLI::App* command = app.add_subcommand("compare", "Say how far an image is from a reference");
    const auto arguments = std::make_shared<CompareArguments>();
    command->add_option("image", arguments->image, "Image to judge (EXR, or PNG decoded from sRGB)")
        ->required();
    command->add_option("reference", arguments->reference, "Image it should equal")->required();
    command->add_option("--json", arguments->json, "Write every metric to this file");
    command->add_option("--heatmap", arguments->heatmap, "Write a colour map of the error (PNG)");
    command->add_option("--heatmap-of", arguments->heatmap_of, "What the colour map shows")
        ->check(CLI::IsMember({"flip", "relative"}))
        ->capture_default_str();
    command->add_option("--difference", arguments->difference,
                        "Write four times the absolute difference as it looks on screen (PNG)");
    command
        ->add_option("--fail-above", arguments->fail_above,
                     "METRIC=LIMIT: exit with 5 where the metric is above; may be given more than once")
        ->allow_extra_args(false);
    command->callback([arguments, &run] { run = [arguments] { return run_compare(*arguments); }; });
}

}  // namespace bounce::cli
