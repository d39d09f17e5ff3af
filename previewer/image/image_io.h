// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <map>
#include <string>

#include "image/image.h"

namespace bounce {

// Metadata written into the file's header (scene, frame, settings).
using ImageAttributes = std::map<std::string, std::string>;

// How an .exr stores values: half floats hold light, but of data (places, distances) only the first 3 digits.
enum class ExrValues { half, full };

// Writes atomically, format by extension: .exr (half unless asked otherwise, scene-linear as it is), .png (8
// bit, the values are taken as display-referred already: apply a view transform first) and what else
// OpenImageIO writes by the same two rules (.hdr, .tif float: linear; .jpg, .tga: display). Throws
// output_error.
void write_image(const std::filesystem::path& path, const Image& image,
                 const ImageAttributes& attributes = {}, ExrValues values = ExrValues::half);

// True where the extension names a scene-linear format (exr, hdr, pfm, tif).
[[nodiscard]] bool is_scene_linear(const std::filesystem::path& path);

// Reads RGB floats as stored (no colour conversion; 8-bit values become 0..1). An alpha channel is
// dropped where it is 1 everywhere and refused otherwise. Throws input_error.
[[nodiscard]] Image read_image(const std::filesystem::path& path);

// The text attributes of the file's header whose names begin with "bounce:", as write_image() puts them
// there. Throws input_error.
[[nodiscard]] ImageAttributes read_attributes(const std::filesystem::path& path);

// read_image, and for the formats that are not scene-linear the sRGB curve undone, so that the Standard
// view transform of the result gives the file's values again.
[[nodiscard]] Image read_scene_linear(const std::filesystem::path& path);

}  // namespace bounce
