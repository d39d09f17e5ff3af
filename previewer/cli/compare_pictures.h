// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "image/image.h"

namespace bounce::cli {

// Pictures of the error that compare writes; empty names write none.
struct ComparePictures {
    std::string heatmap;  // #### in a name stands for the frame number
    std::string heatmap_of = "flip";
    std::string difference;
};

// frame: put in for ####. Throws output_error.
void write_pictures(const ComparePictures& pictures, const Image& test, const Image& reference, int frame);

}  // namespace bounce::cli
