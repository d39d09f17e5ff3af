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

// The first name of the view that is not there, with those that are, as a sentence; empty where all are.
// Without a configuration there is Standard for sRGB, without looks.
[[nodiscard]] std::string unknown_name(const ViewTransform& view);

// Display-referred copy of a scene-linear image, 0..1, by Blender's OpenColorIO configuration where one is
// found (color_config_candidates()). "Standard" for sRGB needs none: exposure, the sRGB curve, gamma. What is
// not there is replaced, and a warning says so once a process: an unknown display or view by Standard of
// what is there, an unknown look by none; a configuration that cannot be read by the next one or, where there
// is none, by Standard for sRGB. Exposure and gamma always count.
[[nodiscard]] Image to_display(const Image& scene_linear, const ViewTransform& view);

}  // namespace bounce
