// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "evaluate/reference.h"
#include "image/image_io.h"

namespace bounce {

// What a reference picture says of itself in its header: written by write_report(), read by
// load_given_reference().
[[nodiscard]] ImageAttributes reference_attributes(const Reference& reference, const std::string& scene,
                                                   const std::string& scene_hash, int bounces);

// The same of a final render, which load_given_reference() refuses.
[[nodiscard]] ImageAttributes final_attributes(const Reference& reference, const std::string& scene,
                                               const std::string& scene_hash);

// A frame's reference from an image file instead of from Cycles. name: #### stands for the frame's number.
// Its noise floor, time and samples are what its header says, else NaN, 0 and 0. Throws input_error where it
// cannot be read, where its size, or by its header its scene, frame or bounces, are not those asked for, and
// where it has values that are not numbers.
[[nodiscard]] Reference load_given_reference(const std::string& name, int frame, int width, int height,
                                             int bounces, const std::string& scene_hash);

}  // namespace bounce
