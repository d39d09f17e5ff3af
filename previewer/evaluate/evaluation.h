// SPDX-License-Identifier: Apache-2.0
//
// Error against run time: renders frames of a scene with Bounce and with Cycles and measures both.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "evaluate/blender_export.h"
#include "evaluate/curves.h"
#include "evaluate/cycles_runner.h"
#include "evaluate/machine.h"
#include "evaluate/pass_times.h"
#include "evaluate/peers.h"
#include "evaluate/preview_run.h"
#include "evaluate/reference.h"
#include "evaluate/reference_growth.h"
#include "image/image.h"

namespace bounce {

struct EvaluateOptions {
    std::filesystem::path scene;  // .blend, .glb or .gltf
    std::vector<int> frames{1};   // Blender's numbers
    int width = 640;
    int height = 360;
    ReferenceGoal reference;
    std::vector<int> cycles_spp{1, 4, 16, 64};
    int bounces = 1;
    int repeat = 5;  // renders of each frame by Bounce, of which the median counts
    SceneSourceOptions source;
    std::filesystem::path bounce;  // the program whose `render` command draws
    std::vector<PreviewRun> runs;
    std::string command;  // as typed, for the report
    // Image files for the reference, #### for the frame's number; empty: Cycles renders it. With it and no
    // cycles_spp and no peers Blender is not needed.
    std::string given_reference;
    // How often all runs are measured, one after the other: what changes on the machine meanwhile shows in
    // the spread.
    int rounds = 1;
    std::filesystem::path point_folder;  // measured runs are kept here; empty: nowhere
    bool resume = false;                 // runs that are kept there are not measured again
    std::vector<std::string> peers;      // of known_peers()
    double peer_limit_seconds = 60.0;
    bool final_render = false;  // compare with the scene by its own light paths as well
    bool fresh = false;         // measure the other engines anew; references are kept all the same
};

// What comes before the frames that count, of one engine. 0: not known, or there is no such step.
struct StartUp {
    std::string engine;
    double export_seconds = 0.0;
    double display_seconds = 0.0;  // a virtual one's start
    double start_seconds = 0.0;    // the program's, with nothing loaded
    double load_seconds = 0.0;     // of the scene; holds the start where that cannot be told
    double first_render_seconds = 0.0;
    std::string note;  // what the figures hold
};

// One frame drawn one way, for the report's pictures.
struct Picture {
    std::string curve;
    std::string label;
    int frame = 1;
    Image image;  // scene-linear
};

// The scene as Cycles renders it by its own light paths: what the artist will get.
struct FinalRender {
    std::vector<Reference> references;  // one a frame
    // Of the references that match Bounce's light paths: how far off the best of previews would be.
    FinalErrors matched;
};

struct Evaluation {
    std::string scene;            // file name
    std::string scene_hash;       // of its content
    std::string scene_sha256;     // of what the renderer loads: the .glb, also where a .blend was given
    std::string given_reference;  // as in the options
    std::string command;
    std::string date;  // UTC, ISO 8601
    int width = 0;
    int height = 0;
    int bounces = 1;
    std::vector<int> frames;
    int sequence_step = 0;  // even_step() of the frames; 0 where they are no sequence
    bool motion = false;    // whether their motion is known, and so TID
    Machine machine;
    std::string gl_vendor, gl_renderer, gl_version;
    std::string blender;
    CyclesReport cycles;                // version, threads, times beside the frames
    std::vector<Reference> references;  // one a frame
    std::optional<FinalRender> final_render;
    std::vector<Curve> curves;  // Cycles first
    std::vector<Speedup> speedups;
    FrontSummary front;
    std::vector<Picture> pictures;  // at least those that the report shows
    std::vector<PeerResult> peers;  // what they were set to, and what is missing; their points are in curves
    std::vector<PassTimes> passes;
    std::vector<StartUp> startups;
};

// Throws input_error where the scene cannot be rendered, Error where a program fails.
[[nodiscard]] Evaluation evaluate(const EvaluateOptions& options);

}  // namespace bounce
