// SPDX-License-Identifier: Apache-2.0
#include "evaluate/report_details.h"

#include <algorithm>

#include "evaluate/tuning.h"

namespace bounce {
namespace {

using nlohmann::ordered_json;

ordered_json known(double seconds) {
    return seconds > 0.0 ? ordered_json(seconds) : ordered_json(nullptr);
}

}  // namespace

ordered_json peers_json(const Evaluation& evaluation) {
    ordered_json peers = ordered_json::array();
    for (const PeerResult& peer : evaluation.peers) {
        peers.push_back({{"name", peer.name},
                         {"settings", peer.settings},
                         {"left_out", peer.left_out},
                         {"notes", peer.notes}});
    }
    return peers;
}

ordered_json sequence_json(const Evaluation& evaluation) {
    if (evaluation.sequence_step == 0) {
        return nullptr;
    }
    return {{"step", evaluation.sequence_step}, {"motion", evaluation.motion}};
}

ordered_json startup_json(const Evaluation& evaluation) {
    ordered_json rows = ordered_json::array();
    for (const StartUp& row : evaluation.startups) {
        rows.push_back({{"engine", row.engine},
                        {"export_seconds", known(row.export_seconds)},
                        {"display_seconds", known(row.display_seconds)},
                        {"start_seconds", known(row.start_seconds)},
                        {"load_seconds", known(row.load_seconds)},
                        {"first_render_seconds", known(row.first_render_seconds)},
                        {"note", row.note}});
    }
    return rows;
}

ordered_json passes_json(const Evaluation& evaluation) {
    ordered_json all = ordered_json::array();
    for (const PassTimes& item : evaluation.passes) {
        ordered_json passes = ordered_json::array();
        for (const PassSeconds& pass : item.passes) {
            passes.push_back({{"name", pass.name},
                              {"seconds", pass.seconds},
                              {"seconds_least", pass.seconds_least},
                              {"seconds_most", pass.seconds_most}});
        }
        ordered_json left_out = ordered_json::array();
        for (const LeftOutPass& left : item.left_out) {
            left_out.push_back({{"pass", left.pass}, {"reason", left.reason}});
        }
        all.push_back({{"curve", item.curve},
                       {"label", item.label},
                       {"frame", item.frame},
                       {"passes", passes},
                       {"left_out", left_out},
                       {"approximations", item.approximations}});
    }
    return all;
}

ordered_json budgets_json(const Evaluation& evaluation) {
    const std::vector<TunedSettings> winners =
        budget_winners(evaluation.curves, {k_budgets_ms.begin(), k_budgets_ms.end()});
    ordered_json all = ordered_json::array();
    for (const double budget_ms : k_budgets_ms) {
        const auto winner = std::find_if(winners.begin(), winners.end(), [&](const TunedSettings& item) {
            return item.budget_ms == budget_ms;
        });
        if (winner == winners.end()) {
            all.push_back({{"budget_ms", budget_ms}});
            continue;
        }
        all.push_back({{"budget_ms", budget_ms},
                       {"curve", winner->curve},
                       {"label", winner->label},
                       {"options", winner->options},
                       {"seconds", winner->seconds},
                       {"relmse", winner->relmse},
                       {"flip_ldr", winner->flip_ldr},
                       {"bias", winner->bias}});
    }
    return all;
}

}  // namespace bounce
