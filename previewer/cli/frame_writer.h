// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>

#include "image/image.h"
#include "renderer/settings.h"
#include "scene/scene.h"

namespace bounce::cli {

// Writes a frame: scene-linear formats as they are, display formats through the scene's view transform.
class FrameWriter {
  public:
    FrameWriter(const scene::Scene& scene, const Settings& settings) : scene_(scene), settings_(settings) {}

    // Throws output_error.
    void write(const std::filesystem::path& path, const Image& image, const scene::ViewSettings& view,
               int frame) const;

  private:
    const scene::Scene& scene_;
    const Settings& settings_;
};

}  // namespace bounce::cli
