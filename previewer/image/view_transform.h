// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "image/image.h"

namespace bounce {

// What turns scene-linear light into display values: Blender's names.
struct ViewTransform {
    std::string display_device = "sRGB";
    std::string view_transform = "Standard";
    std::string look = "None";
    float exposure = 0.0F;  // stops
    float gamma = 1.0F;
};

// True where the transform is exposure, the sRGB curve and gamma alone, and needs no configuration.
[[nodiscard]] bool is_plain_standard(const ViewTransform& view);

// Display-referred copy of a scene-linear image, 0..1, by Blender's OpenColorIO configuration where one is
// found ($OCIO, then the datafiles of the Blender on this machine). "Standard" needs no configuration:
// exposure, the sRGB curve, gamma. Without a configuration any other transform falls back to Standard,
// with one warning a process.
[[nodiscard]] Image to_display(const Image& scene_linear, const ViewTransform& view);

}  // namespace bounce
