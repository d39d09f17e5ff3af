// SPDX-License-Identifier: Apache-2.0
#include "evaluate/engine_starts.h"

#include <algorithm>

#include "core/error.h"
#include "core/log.h"
#include "core/process.h"

namespace bounce {
namespace {

// A start is only ever slowed down, so the faster of two is nearer to it.
constexpr int k_tries = 2;

double seconds_of(const std::vector<std::string>& command) {
    double least = 0.0;
    for (int i = 0; i < k_tries; ++i) {
        const ProcessResult result = run_process(command);
        if (result.exit_code != 0) {
            log::debug("{} cannot be timed: {}", command.front(), result.output);
            return 0.0;
        }
        least = i == 0 ? result.seconds : std::min(least, result.seconds);
    }
    return least;
}

}  // namespace

EngineStarts measure_engine_starts(const std::filesystem::path& blender, const Evaluation& evaluation) {
    EngineStarts starts;
    const auto drawn = [&](const char* name) {
        return std::any_of(evaluation.peers.begin(), evaluation.peers.end(),
                           [&](const PeerResult& peer) { return peer.name == name && !peer.points.empty(); });
    };
    const bool eevee = drawn("Eevee");
    const bool f3d = drawn("f3d");
    try {
        if (eevee || f3d) {
            if (std::vector<std::string> display = with_display(); !display.empty()) {
                display.emplace_back("true");
                starts.display = seconds_of(display);
            }
        }
        if (!blender.empty() && (eevee || !evaluation.cycles.version.empty())) {
            // Ends as soon as Blender could begin with a scene.
            starts.blender = seconds_of({blender.string(), "-b", "--factory-startup", "--python-exit-code",
                                         "1", "--python-expr", "import os; os._exit(0)"});
        }
        if (f3d) {
            starts.f3d = seconds_of({"f3d", "--version"});
        }
    } catch (const Error& error) {
        log::debug("how long engines take to start is not known: {}", error.what());
    }
    return starts;
}

}  // namespace bounce
