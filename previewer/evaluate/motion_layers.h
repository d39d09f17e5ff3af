// SPDX-License-Identifier: Apache-2.0
//
// Where each pixel's point was in the frame before, for TID: the layer `motion` of an evaluation's frames.
#pragma once

#include <filesystem>
#include <optional>
#include <vector>

#include "image/image.h"

namespace bounce {

class MotionLayers {
  public:
    // Rendered by `bounce render --show motion` into the folder, once for all points: the layer belongs to
    // the geometry, whoever lights it. None, and no process, where the frames do not follow each other one by
    // one, because the layer tells the way from the frame just before. A program that fails is a warning, and
    // there are none then: all other figures are worth having.
    MotionLayers(const std::filesystem::path& bounce, const std::filesystem::path& scene,
                 const std::vector<int>& frames, int width, int height, std::filesystem::path folder);

    [[nodiscard]] bool known() const { return known_; }

    // Of each frame but the first; nothing for it, and where there are none. Throws input_error where the
    // file cannot be read.
    [[nodiscard]] std::optional<Image> of(int frame) const;

  private:
    std::filesystem::path folder_;
    int first_ = 0;
    bool known_ = false;
};

}  // namespace bounce
