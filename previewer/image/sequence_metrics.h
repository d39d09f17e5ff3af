// SPDX-License-Identifier: Apache-2.0
//
// How steady a sequence of images is, and how far from its reference; definitions in docs/metrics.md.
#pragma once

#include <optional>
#include <string_view>
#include <vector>

#include "image/metrics.h"
#include "image/reprojection.h"

namespace bounce {

// One frame of a sequence. Steps are from the frame before; NaN in the first frame and where not finite.
struct SequenceFrame {
    int frame = 0;
    std::optional<Metrics> error;  // against the reference's frame
    size_t nan = 0;                // in all images of this frame
    size_t inf = 0;
    double flip_step = 0.0;            // mean LDR-FLIP against the frame before
    double flip_step_reference = 0.0;  // the reference's own
    double tid = 0.0;                  // root mean square of this frame's reprojected differences
};

// Figures of the whole. NaN: what they need was not given, or a value of the sequence is not finite.
struct SequenceMetrics {
    std::vector<SequenceFrame> frames;
    int width = 0;
    int height = 0;
    size_t nan = 0;
    size_t inf = 0;
    double mean_luminance = 0.0;  // of the reference, without one of the test: what is relative is so to it

    double flip_step_mean = 0.0;
    double flip_step_max = 0.0;
    int flip_step_max_frame = 0;  // the later one of the two
    double flip_step_reference_mean = 0.0;
    double flip_step_reference_max = 0.0;

    double tid = 0.0;           // Rec. 709 luminance, scene-linear
    double tid_relative = 0.0;  // over mean_luminance
    double tid_reference = 0.0;
    double tid_coverage = 0.0;  // part of the pixels that has a match in the frame before

    double flicker_power = 0.0;   // energy at high temporal frequencies over mean_luminance^2
    double flicker_share = 0.0;   // and over the energy at all of them but 0
    double flicker_pixels = 0.0;  // part of the pixels that was looked at
};

// The distance between the frames where there are two or more and they run forwards at one distance; else 0.
[[nodiscard]] int even_step(const std::vector<int>& frames);

// Takes a sequence frame by frame. It keeps a luminance plane a frame, 4 bytes a pixel, for the spectrum.
class SequenceMeter {
  public:
    explicit SequenceMeter(HdrFlip hdr_flip = HdrFlip::leave_out) : hdr_flip_(hdr_flip) {}

    // reference, motion: null where there is none; a reference in every frame or in none. Motion is the
    // layer of this frame and may be missing in the first one. Throws input_error where a size differs from
    // the first frame's, or where a frame between has no motion that others have.
    const SequenceFrame& add(int frame, const Image& test, const Image* reference, const Image* motion);

    // After the last frame.
    [[nodiscard]] SequenceMetrics finish();

  private:
    void add_steps(SequenceFrame& entry, const Image& test, PerceivedImage test_perceived,
                   const Image* reference, PerceivedImage reference_perceived, const Image* motion);
    void fill_tid(SequenceMetrics& out) const;

    HdrFlip hdr_flip_;
    SequenceMetrics metrics_;
    std::vector<Plane> signals_;                      // luminance: test less reference, or test
    PerceivedImage perceived_, reference_perceived_;  // of the frame before
    Plane luminance_, reference_luminance_;
    ReprojectedDifference all_, all_reference_;
    std::vector<char> still_;  // without a reference: pixels that never moved
    size_t with_motion_ = 0;   // frames, without the first
    double luminance_sum_ = 0.0;
};

// A sequence's figure by its name in the JSON, for thresholds. Less is better for all.
struct NamedSequenceMetric {
    std::string_view name;
    double (*value)(const SequenceMetrics&);
    std::string_view needs;  // what has to be given for it, a sentence's end; empty: nothing
};
[[nodiscard]] const std::vector<NamedSequenceMetric>& named_sequence_metrics();
[[nodiscard]] std::optional<NamedSequenceMetric> find_sequence_metric(std::string_view name);

// The frame with the largest magnitude of a metric (psnr_db, ssim: the smallest value); a frame that has a
// value that is not finite counts as the worst. Null where there is no reference.
[[nodiscard]] const SequenceFrame* worst_frame(const SequenceMetrics& metrics, const NamedMetric& metric);

}  // namespace bounce
