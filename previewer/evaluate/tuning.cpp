// SPDX-License-Identifier: Apache-2.0
#include "evaluate/tuning.h"

#include <algorithm>
#include <cmath>
#include <fstream>

#include <fmt/format.h>

#include "core/error.h"
#include "core/json_fault.h"
#include "evaluate/record_file.h"

namespace bounce {
namespace {

constexpr const char* k_schema = "bounce.tuning/1";

bool better(const CurvePoint& a, const CurvePoint& b) {
    return a.relmse != b.relmse ? a.relmse < b.relmse : a.seconds < b.seconds;
}

TunedSettings parse_settings(const nlohmann::json& item) {
    TunedSettings tuned;
    tuned.budget_ms = member<double>(item, "budget_ms");
    tuned.seconds = member<double>(item, "seconds");
    tuned.relmse = member<double>(item, "relmse");
    tuned.flip_ldr = member<double>(item, "flip_ldr");
    tuned.bias = member<double>(item, "bias");
    tuned.curve = member<std::string>(item, "curve");
    tuned.label = member<std::string>(item, "label");
    tuned.options = member<std::vector<std::string>>(item, "options");
    return tuned;
}

}  // namespace

std::vector<TunedSettings> budget_winners(const std::vector<Curve>& curves,
                                          const std::vector<double>& budgets_ms) {
    std::vector<TunedSettings> winners;
    for (const double budget : budgets_ms) {
        const CurvePoint* best = nullptr;
        const Curve* best_curve = nullptr;
        for (const Curve& curve : curves) {
            for (const CurvePoint& point : curve.points) {
                // Seconds for a frame are no settings of one.
                const bool converges = std::find(point.options.begin(), point.options.end(), "--converge") !=
                                       point.options.end();
                const bool can_win = !point.options.empty() && !converges && std::isfinite(point.relmse) &&
                                     1000.0 * point.seconds <= budget;  // NaN compares false
                if (can_win && (best == nullptr || better(point, *best))) {
                    best = &point;
                    best_curve = &curve;
                }
            }
        }
        if (best != nullptr) {
            winners.push_back({budget, best->seconds, best->relmse, best->flip_ldr, best->bias,
                               best_curve->name, best->label, best->options});
        }
    }
    return winners;
}

Tuning tuning_of(const Evaluation& evaluation) {
    return {evaluation.scene,
            evaluation.width,
            evaluation.height,
            evaluation.bounces,
            evaluation.machine.cpu,
            evaluation.machine.threads,
            evaluation.gl_renderer,
            budget_winners(evaluation.curves, {k_budgets_ms.begin(), k_budgets_ms.end()})};
}

nlohmann::ordered_json tuning_json(const Tuning& tuning) {
    nlohmann::ordered_json budgets = nlohmann::ordered_json::array();
    for (const TunedSettings& tuned : tuning.budgets) {
        const auto number = [](double value) {
            return std::isfinite(value) ? nlohmann::ordered_json(value) : nlohmann::ordered_json(nullptr);
        };
        budgets.push_back({{"budget_ms", tuned.budget_ms},
                           {"options", tuned.options},
                           {"seconds", number(tuned.seconds)},
                           {"relmse", number(tuned.relmse)},
                           {"flip_ldr", number(tuned.flip_ldr)},
                           {"bias", number(tuned.bias)},
                           {"curve", tuned.curve},
                           {"label", tuned.label}});
    }
    return {
        {"schema", k_schema},
        {"scene", tuning.scene},
        {"width", tuning.width},
        {"height", tuning.height},
        {"bounces", tuning.bounces},
        {"machine", {{"cpu", tuning.cpu}, {"threads", tuning.threads}, {"gl_renderer", tuning.gl_renderer}}},
        {"budgets", budgets}};
}

Tuning read_tuning(const std::filesystem::path& path) {
    std::ifstream in(path);
    std::error_code ignored;
    if (!in || std::filesystem::is_directory(path, ignored)) {
        throw input_error(fmt::format("cannot read the tuning file {}", path.string()));
    }
    const auto json = nlohmann::json::parse(in, nullptr, false);
    if (!json.is_object()) {
        throw input_error(
            fmt::format("the tuning file {} is not JSON; bounce evaluate --sweep writes one as "
                        "tuning.json beside its report",
                        path.string()));
    }
    const auto schema = json.find("schema");
    if (schema == json.end() || *schema != k_schema) {
        throw input_error(fmt::format("the tuning file {} has the schema {}, not \"{}\"", path.string(),
                                      schema == json.end() ? "null" : schema->dump(), k_schema));
    }
    try {
        Tuning tuning;
        tuning.scene = member<std::string>(json, "scene");
        tuning.width = member<int>(json, "width");
        tuning.height = member<int>(json, "height");
        tuning.bounces = member<int>(json, "bounces");
        const auto& machine = json.at("machine");
        tuning.cpu = member<std::string>(machine, "cpu");
        tuning.threads = member<int>(machine, "threads");
        tuning.gl_renderer = member<std::string>(machine, "gl_renderer");
        for (const auto& item : list_member(json, "budgets")) {
            tuning.budgets.push_back(parse_settings(item));
        }
        std::sort(tuning.budgets.begin(), tuning.budgets.end(),
                  [](const auto& a, const auto& b) { return a.budget_ms < b.budget_ms; });
        return tuning;
    } catch (const nlohmann::json::exception& error) {
        throw input_error(
            fmt::format("the tuning file {} cannot be used: {}", path.string(), json_fault(error)));
    }
}

const TunedSettings* settings_within(const Tuning& tuning, double budget_ms) {
    const TunedSettings* best = nullptr;
    for (const TunedSettings& tuned : tuning.budgets) {
        if (tuned.budget_ms <= budget_ms && (best == nullptr || tuned.budget_ms > best->budget_ms)) {
            best = &tuned;
        }
    }
    return best;
}

}  // namespace bounce
