// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "cli/compare_pictures.h"
#include "core/error.h"
#include "image/image.h"

namespace bounce::cli {

// Files of compare; a sequence's have #### where the frame number belongs.
struct CompareArguments {
    std::string image;
    std::string reference;  // a sequence may have none
    std::string motion;
    std::string frames;
    std::filesystem::path json;
    ComparePictures pictures;
    std::vector<std::string> fail_above;
    bool hdr_flip = false;
    double exposure_stops = 0.0;  // both are multiplied by two to this before they are compared
};

// A picture as it is compared: scene-linear, exposed. Throws input_error.
[[nodiscard]] Image read_exposed(const std::filesystem::path& path, double exposure_stops);

// compare with a sequence: prints figures a frame and of the whole. Throws Error.
[[nodiscard]] ExitCode compare_sequence(const CompareArguments& arguments);

}  // namespace bounce::cli
