// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "cli/compare_pictures.h"
#include "core/error.h"

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
};

// compare with a sequence: prints figures a frame and of the whole. Throws Error.
[[nodiscard]] ExitCode compare_sequence(const CompareArguments& arguments);

}  // namespace bounce::cli
