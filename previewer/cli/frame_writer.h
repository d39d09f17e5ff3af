// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <utility>

#include "cli/view_options.h"
#include "image/image.h"
#include "renderer/settings.h"
#include "scene/scene.h"

namespace bounce::cli {

// Writes a frame: scene-linear formats as they are, display formats through the scene's view transform,
// but for what options say otherwise.
class FrameWriter {
  public:
    FrameWriter(const scene::Scene& scene, const Settings& settings, ViewOptions view)
        : scene_(scene), settings_(settings), view_(std::move(view)) {}

    // Throws output_error.
    void write(const std::filesystem::path& path, const Image& image, const scene::ViewSettings& view,
               int frame) const;

  private:
    const scene::Scene& scene_;
    const Settings& settings_;
    ViewOptions view_;
};

}  // namespace bounce::cli
