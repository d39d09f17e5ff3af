// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "evaluate/cycles_runner.h"
#include "image/image.h"

namespace bounce {

// What a reference follows from.
struct ReferenceKey {
    std::string scene_hash;  // of the file's content
    int frame = 1;
    int width = 0;
    int height = 0;
    int spp = 0;
    int bounces = 1;
    std::string blender;       // blender_version()
    std::string scripts_hash;  // cycles_scripts_hash()
};

// The name, without extension, of the reference's files in the cache.
[[nodiscard]] std::string cache_name(const ReferenceKey& key);

struct Reference {
    int frame = 1;
    Image image;  // scene-linear, the mean of two halves of spp/2 samples with two seeds
    double noise_floor =
        0;               // relMSE that the exact picture would have against image, estimated from the halves
    double seconds = 0;  // both halves
    bool cached = false;
};

// From two renders of one frame with half the samples each. The halves h1 and h2 have independent noise
// of variance v, so their mean m has v/2, which is the expectation of ((h1 - h2)/2)^2 = (h1 - m)^2: the
// noise floor of m is relMSE(h1, m).
[[nodiscard]] Reference make_reference(const Image& half1, const Image& half2);

// Reads and writes <folder>/<name>.exr and .json. Nothing where there is none, where it cannot be read,
// or where a file that the scene refers to has changed.
[[nodiscard]] std::optional<Reference> load_reference(const std::filesystem::path& folder,
                                                      const ReferenceKey& key);
void store_reference(const std::filesystem::path& folder, const ReferenceKey& key, const Reference& reference,
                     const std::vector<std::filesystem::path>& scene_files);

}  // namespace bounce
