// SPDX-License-Identifier: Apache-2.0
//
// Engines beside Bounce and Cycles that render the same frames: Eevee and f3d.
#pragma once

#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "evaluate/render_cache.h"

namespace bounce {

// What every peer is asked for.
struct PeerJob {
    std::filesystem::path scene;  // .blend, .glb or .gltf
    std::string scene_hash;       // of its content
    std::filesystem::path blender;
    std::string blender_version;
    std::vector<int> frames{1};  // Bounce's numbers
    int width = 640;
    int height = 360;
    double limit_seconds = 60.0;  // a step whose frame is expected to take longer is left out
    bool fresh = false;           // use nothing from earlier runs
    std::filesystem::path cache;  // folder for finished pictures
};

struct PeerFrame {
    int frame = 1;
    CachedRender render;
    bool cached = false;
};

// One way in which a peer rendered the frames.
struct PeerPoint {
    std::string curve;
    std::string label;
    std::vector<PeerFrame> frames;  // all that were asked for
};

struct PeerResult {
    std::string name;
    std::string settings;  // a sentence or two: what it was set to
    std::vector<PeerPoint> points;
    std::vector<std::string> left_out;  // what is missing and why, a sentence each
    std::vector<std::string> notes;
};

// Told after each picture: "Eevee, frame 1, 16 samples: 3.4 s".
using PeerProgress = std::function<void(const std::string&)>;

// The peers by name, in the order of the report.
[[nodiscard]] std::vector<std::string> known_peers();

// Runs one of known_peers(). Nothing about a peer ends the evaluation: a program that is missing or fails is
// a sentence in left_out, and the points that are whole are there.
[[nodiscard]] PeerResult run_peer(const std::string& name, const PeerJob& job, const PeerProgress& progress);

// The command that gives a program a display: empty where $DISPLAY is set, xvfb-run where it is installed.
// Throws Error (failed) with a sentence that names the package.
[[nodiscard]] std::vector<std::string> with_display();

// The text under which a peer's picture is kept: scene, frame, size, machine and what else the peer names.
[[nodiscard]] std::string peer_key(const PeerJob& job, int frame, const std::string& settings);

}  // namespace bounce
