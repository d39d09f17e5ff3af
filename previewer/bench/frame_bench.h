// SPDX-License-Identifier: Apache-2.0
//
// Times of the program's own frames and passes: the experiments measure what `bounce render` runs.
#pragma once

#include <functional>
#include <set>
#include <string>
#include <vector>

#include "bench/samples.h"
#include "core/interrupt.h"
#include "core/progress.h"
#include "gl/pass_timer.h"
#include "image/image.h"
#include "renderer/renderer.h"
#include "renderer/settings.h"
#include "scene/scene.h"

namespace bounce::bench {

// What a pass is for.
enum class Part {
    direct,  // everything that a frame of direct light alone draws
    rsm,     // reflective shadow maps of the lights, drawn from triangles
    vpls,    // choosing virtual point lights
    maps,    // their shadow maps: what a frame without occlusion does not draw
    gather,
    finish,  // near field and blur
};
inline constexpr int k_parts = 6;
[[nodiscard]] std::string part_name(Part part);

// Tells parts by comparing frames, so that no list of passes has to be kept: of direct light only, and of
// bounced light without occlusion.
class PassParts {
  public:
    PassParts(const std::vector<std::string>& direct, const std::vector<std::string>& unoccluded)
        : direct_(direct.begin(), direct.end()), unoccluded_(unoccluded.begin(), unoccluded.end()) {}
    [[nodiscard]] Part part_of(const std::string& pass) const;

  private:
    std::set<std::string> direct_;
    std::set<std::string> unoccluded_;
};

struct MeasuredPass {
    std::string name;
    Part part = Part::direct;
    Samples time;
};

struct MeasuredFrame {
    Samples frame;                     // as users have it, without per-pass timing
    Samples timed_frame;               // of the frames in which passes were timed, begin to end
    std::vector<MeasuredPass> passes;  // in order
    FrameReport report;                // of the last frame

    // Of all passes that the filter takes, frame by frame. Empty where there is none.
    [[nodiscard]] Samples sum(const std::function<bool(const MeasuredPass&)>& filter) const;
    [[nodiscard]] Samples part(Part part) const;
    // All but direct light.
    [[nodiscard]] Samples indirect() const;
};

enum class Measure {
    frame_and_passes,
    passes,  // where the time of a whole frame is not asked for
    frame,   // where those of its passes are not
};

// One scene at one frame, drawn again and again with different settings, in steady state: shaders are
// compiled and buffers filled by a frame that is not counted.
class FrameBench {
  public:
    // frame: Blender's number. camera: a node's name, or empty for the active one. progress and interrupts
    // outlive it.
    FrameBench(const scene::Scene& scene, double frame, std::string camera, gl::TimingMode timing,
               const InterruptGuard& interrupts);

    // Throws input_error where the frame has no bounced light to measure, and what stops the program between
    // two frames.
    [[nodiscard]] MeasuredFrame measure(const Settings& settings, int repeat,
                                        Measure what = Measure::frame_and_passes);
    // The picture of these settings, and what the frame reports.
    [[nodiscard]] Image picture(const Settings& settings, FrameReport* report = nullptr);

  private:
    FrameReport draw(const Settings& settings, gl::TimingMode timing, double* ms = nullptr);
    void find_parts(const Settings& settings);

    const scene::Scene& scene_;
    scene::Pose pose_;
    std::string camera_;
    gl::TimingMode timing_;
    const InterruptGuard& interrupts_;
    Renderer renderer_;
    std::unique_ptr<PassParts> parts_;
};

}  // namespace bounce::bench
