// SPDX-License-Identifier: Apache-2.0
#include "evaluate/baseline.h"

#include <algorithm>
#include <cmath>
#include <fstream>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "core/error.h"
#include "core/json_fault.h"
#include "evaluate/record_file.h"

namespace bounce {
namespace {

constexpr const char* k_schema = "bounce.baseline/1";

struct NamedError {
    const char* name;
    double BaselinePoint::*before;
    double CurvePoint::*now;
};

constexpr NamedError k_errors[] = {{"relmse", &BaselinePoint::relmse, &CurvePoint::relmse},
                                   {"flip_ldr", &BaselinePoint::flip_ldr, &CurvePoint::flip_ldr},
                                   {"bias", &BaselinePoint::bias, &CurvePoint::bias}};

Error unusable(const std::filesystem::path& path, const std::string& why) {
    return input_error(fmt::format("the baseline {} cannot be used: {}", path.string(), why));
}

std::map<std::string, Tolerance> parse_tolerances(const nlohmann::json& json,
                                                  const std::filesystem::path& path) {
    std::map<std::string, Tolerance> tolerances = default_tolerances();
    for (const auto& [name, item] : json.items()) {
        if (tolerances.count(name) == 0) {
            throw unusable(path, fmt::format("it has a tolerance of {}; there are those of relmse, flip_ldr "
                                             "and bias",
                                             name));
        }
        const Tolerance tolerance{member<double>(item, "relative"), member<double>(item, "absolute"),
                                  member<std::string>(item, "reason")};
        // Negated, so that NaN is refused too.
        if (!(tolerance.relative >= 0.0) || !(tolerance.absolute >= 0.0) || tolerance.reason.empty()) {
            throw unusable(
                path, fmt::format("the tolerance of {} needs two numbers of 0 or more and a reason", name));
        }
        tolerances[name] = tolerance;
    }
    return tolerances;
}

BaselinePoint parse_point(const nlohmann::json& item, const std::string& curve,
                          const std::filesystem::path& path) {
    BaselinePoint point;
    point.curve = curve;
    point.label = member<std::string>(item, "label");
    for (const NamedError& error : k_errors) {
        const auto& value = item.at(error.name);
        if (!value.is_number()) {
            throw unusable(path, fmt::format("{} of {}, {} is not a number", error.name, curve, point.label));
        }
        point.*error.before = value;
    }
    return point;
}

std::vector<int> frames_of(const nlohmann::json& json) {
    return member<std::vector<int>>(json, "frames");
}

// results.json has the bounces beside the reference.
int bounces_of(const nlohmann::json& json) {
    return member<int>(json.contains("bounces") ? json : json.at("reference"), "bounces");
}

void compare_point(const Baseline& baseline, const BaselinePoint& before, const CurvePoint& now,
                   std::vector<std::string>& regressions) {
    for (const NamedError& error : k_errors) {
        const Tolerance& tolerance = baseline.tolerances.at(error.name);
        const double old_value = before.*error.before;
        const double value = now.*error.now;
        const double limit = std::abs(old_value) * (1.0 + tolerance.relative) + tolerance.absolute;
        if (!(std::abs(value) <= limit)) {  // NaN is above every limit
            regressions.push_back(fmt::format("{}, {}: {} is {:.6g}, was {:.6g}, the limit is {:.6g}",
                                              before.curve, before.label, error.name, value, old_value,
                                              limit));
        }
    }
    size_t not_finite = 0;
    for (const FrameError& frame : now.frames) {
        not_finite += frame.not_finite;
    }
    if (not_finite > 0) {
        regressions.push_back(
            fmt::format("{}, {}: {} values are NaN or infinite", before.curve, before.label, not_finite));
    }
}

}  // namespace

const std::map<std::string, Tolerance>& default_tolerances() {
    static const std::map<std::string, Tolerance> tolerances = {
        {"relmse",
         {0.05, 1e-5,
          "one driver repeats every bit; another rounds otherwise and so draws a few other lights"}},
        {"flip_ldr", {0.03, 5e-4, "as of relmse; FLIP changes less, because it is no square"}},
        {"bias", {0.05, 2e-3, "as of relmse; another set of lights of the same size is off by so much"}}};
    return tolerances;
}

nlohmann::ordered_json baseline_json(const Evaluation& evaluation) {
    nlohmann::ordered_json tolerances = nlohmann::ordered_json::object();
    for (const auto& [name, tolerance] : default_tolerances()) {
        tolerances[name] = {
            {"relative", tolerance.relative}, {"absolute", tolerance.absolute}, {"reason", tolerance.reason}};
    }
    nlohmann::ordered_json curves = nlohmann::ordered_json::array();
    for (const Curve& curve : evaluation.curves) {
        nlohmann::ordered_json points = nlohmann::ordered_json::array();
        for (const CurvePoint& point : curve.points) {
            nlohmann::ordered_json item{{"label", point.label}};
            for (const NamedError& error : k_errors) {
                const double value = point.*error.now;
                item[error.name] =
                    std::isfinite(value) ? nlohmann::ordered_json(value) : nlohmann::ordered_json(nullptr);
            }
            points.push_back(item);
        }
        curves.push_back({{"name", curve.name}, {"points", points}});
    }
    return {{"schema", k_schema},
            {"scene", evaluation.scene},
            {"scene_sha256", evaluation.scene_sha256},
            {"width", evaluation.width},
            {"height", evaluation.height},
            {"frames", evaluation.frames},
            {"bounces", evaluation.bounces},
            {"tolerances", tolerances},
            {"curves", curves}};
}

Baseline read_baseline(const std::filesystem::path& path) {
    std::ifstream in(path);
    std::error_code ignored;
    if (!in || std::filesystem::is_directory(path, ignored)) {
        throw input_error(fmt::format("cannot read the baseline {}", path.string()));
    }
    const auto json = nlohmann::json::parse(in, nullptr, false);
    if (!json.is_object()) {
        throw unusable(path, "it is not JSON");
    }
    // results.json has no schema's name.
    if (json.contains("schema") && json["schema"] != k_schema) {
        throw unusable(path, fmt::format("its schema is {}, not \"{}\"", json["schema"].dump(), k_schema));
    }
    try {
        Baseline baseline;
        baseline.conditions.scene = member<std::string>(json, "scene");
        baseline.scene_sha256 = json.value("scene_sha256", "");
        baseline.conditions.width = member<int>(json, "width");
        baseline.conditions.height = member<int>(json, "height");
        baseline.conditions.frames = frames_of(json);
        baseline.conditions.bounces = bounces_of(json);
        baseline.tolerances = parse_tolerances(json.value("tolerances", nlohmann::json::object()), path);
        for (const auto& curve : list_member(json, "curves")) {
            for (const auto& item : list_member(curve, "points")) {
                baseline.points.push_back(parse_point(item, member<std::string>(curve, "name"), path));
            }
        }
        return baseline;
    } catch (const nlohmann::json::exception& error) {
        throw unusable(path, json_fault(error));
    }
}

void require_same_conditions(const Baseline& baseline, const BaselineConditions& run) {
    const auto text = [](const BaselineConditions& of) {
        return fmt::format("{}, frames {} at {}x{} with {} bounces", of.scene, fmt::join(of.frames, ","),
                           of.width, of.height, of.bounces);
    };
    if (text(baseline.conditions) != text(run)) {
        throw input_error(
            fmt::format("the baseline is of {}; the run is of {}; errors of the two cannot be "
                        "compared",
                        text(baseline.conditions), text(run)));
    }
}

BaselineReport compare_with_baseline(const Baseline& baseline, const Evaluation& evaluation) {
    require_same_conditions(baseline, {evaluation.scene, evaluation.width, evaluation.height,
                                       evaluation.bounces, evaluation.frames});
    BaselineReport report;
    const auto find_before = [&](const std::string& curve, const std::string& label) {
        return std::find_if(baseline.points.begin(), baseline.points.end(), [&](const BaselinePoint& point) {
            return point.curve == curve && point.label == label;
        });
    };
    std::vector<bool> found(baseline.points.size(), false);
    for (const Curve& curve : evaluation.curves) {
        for (const CurvePoint& point : curve.points) {
            const auto before = find_before(curve.name, point.label);
            if (before == baseline.points.end()) {
                report.added.push_back(curve.name + ", " + point.label);
                continue;
            }
            found[static_cast<size_t>(before - baseline.points.begin())] = true;
            ++report.compared;
            compare_point(baseline, *before, point, report.regressions);
        }
    }
    for (size_t i = 0; i < found.size(); ++i) {
        if (!found[i]) {
            report.missing.push_back(baseline.points[i].curve + ", " + baseline.points[i].label);
        }
    }
    if (report.compared == 0) {
        throw input_error("the run has no point that the baseline has; give the same --sweep");
    }
    return report;
}

}  // namespace bounce
