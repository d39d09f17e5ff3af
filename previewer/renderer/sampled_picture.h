// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <vector>

#include "gl/pass_timer.h"
#include "image/image.h"
#include "renderer/renderer.h"

namespace bounce {

// The mean of pictures of one size, scene-linear. Sums are doubles, so that the order of a thousand frames
// does not show. What is not finite in one picture is not finite in the mean: a fault stays visible.
class PictureMean {
  public:
    void add(const Image& picture);
    // Of what was added; empty where nothing was.
    [[nodiscard]] Image mean() const;
    // Pixels that a picture added held something not finite in.
    [[nodiscard]] size_t faulty_pixels() const;

  private:
    int width_ = 0;
    int height_ = 0;
    int count_ = 0;
    std::vector<double> sum_;
};

// Draws settings.samples frames that look at different places of their pixels (pixel_offsets()) and adds each
// to mean. The report is the first frame's, with the passes' times of all together, and counts that are
// averages. Throws like Renderer::render().
FrameReport render_samples(Renderer& renderer, const Moment& now, const Settings& settings,
                           gl::TimingMode timing, PictureMean& mean);

}  // namespace bounce
