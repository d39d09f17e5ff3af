// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>

#include "image/image.h"
#include "image/view_transform.h"

namespace bounce::viewer {

// Writes STEM.FRAME.png, through the view transform, and STEM.FRAME.exr, scene-linear as rendered, into
// the folder; STEM.FRAME-2 and so on where either is there already. Returns the PNG's path. Throws
// output_error.
std::filesystem::path save_screenshot(const std::filesystem::path& folder, const std::string& stem, int frame,
                                      const Image& image, const ViewTransform& view);

}  // namespace bounce::viewer
