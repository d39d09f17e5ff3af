// SPDX-License-Identifier: Apache-2.0
#include "evaluate/peers.h"

#include <algorithm>
#include <cstdlib>

#include <fmt/format.h>

#include "core/error.h"
#include "core/log.h"
#include "core/process.h"
#include "evaluate/eevee_runner.h"
#include "evaluate/f3d_runner.h"
#include "evaluate/machine.h"

namespace bounce {

std::vector<std::string> known_peers() {
    return {"eevee", "f3d"};
}

PeerResult run_peer(const std::string& name, const PeerJob& job, const PeerProgress& progress) {
    PeerResult result;
    try {
        if (name == "eevee") {
            run_eevee(job, progress, result);
        } else if (name == "f3d") {
            run_f3d(job, progress, result);
        } else {
            throw usage_error(fmt::format("there is no peer {}", name));
        }
    } catch (const Error& error) {
        if (error.code() == ExitCode::usage) {
            throw;
        }
        result.left_out.push_back(fmt::format("{} is left out: {}", result.name, error.what()));
    }
    // A point is one where all its frames are.
    std::erase_if(result.points,
                  [&](const PeerPoint& point) { return point.frames.size() != job.frames.size(); });
    for (PeerPoint& point : result.points) {  // those of an earlier run came first
        std::sort(point.frames.begin(), point.frames.end(),
                  [](const PeerFrame& a, const PeerFrame& b) { return a.frame < b.frame; });
    }
    for (const std::string& line : result.left_out) {
        log::warning("{}", line);
    }
    return result;
}

std::vector<std::string> with_display() {
    const char* display = std::getenv("DISPLAY");
    if (display != nullptr && *display != '\0') {
        return {};
    }
    const auto xvfb = find_program("xvfb-run");
    if (!xvfb) {
        throw Error(ExitCode::failed, "there is no display and no xvfb-run; install Debian's package xvfb");
    }
    // The default screen is 1280 x 1024; a window that is larger would be cut.
    return {xvfb->string(), "-a", "-s", "-screen 0 4096x4096x24"};
}

std::string peer_key(const PeerJob& job, int frame, const std::string& settings) {
    const Machine machine = this_machine();
    return fmt::format("scene {}\nframe {}\n{}x{}\n{}\n{}, {} threads\n{}\n", job.scene_hash, frame,
                       job.width, job.height, job.blender_version, machine.cpu, machine.threads, settings);
}

}  // namespace bounce
