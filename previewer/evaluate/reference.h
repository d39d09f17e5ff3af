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
    int spp = 0;  // 0: as many as the noise must be small for (reference_growth.h)
    int bounces = 1;
    std::string blender;       // blender_version()
    std::string scripts_hash;  // cycles_scripts_hash() of the scene
};

// The name, without extension, of the reference's files in the cache.
[[nodiscard]] std::string cache_name(const ReferenceKey& key);

struct Reference {
    int frame = 1;
    Image image;             // scene-linear, the mean of all samples
    double noise_floor = 0;  // relMSE that the exact picture would have against image, estimated
    double seconds = 0;      // of all samples
    int spp = 0;             // 0: not known
    int batches = 0;         // that its samples came in
    bool cached = false;
};

// From two renders of one frame with half the samples each. The halves h1 and h2 have independent noise
// of variance v, so their mean m has v/2, which is the expectation of ((h1 - h2)/2)^2 = (h1 - m)^2: the
// noise floor of m is relMSE(h1, m).
[[nodiscard]] Reference make_reference(const Image& half1, const Image& half2, int spp);

// Two references of one frame with independent samples, n1 and n2 a pixel, as one: images are weighted by
// their samples, and so the floors by the squares: (n1^2 f1 + n2^2 f2) / (n1 + n2)^2.
[[nodiscard]] Reference merge(const Reference& a, const Reference& b);

// Reads and writes <folder>/<name>.json and the image that it names. Nothing where there is none, where it
// cannot be read, or where a file that the scene refers to has changed. A reference with more samples takes
// the place of one with fewer under the same key; where it cannot be written (output_error) the old one
// stays.
[[nodiscard]] std::optional<Reference> load_reference(const std::filesystem::path& folder,
                                                      const ReferenceKey& key);
void store_reference(const std::filesystem::path& folder, const ReferenceKey& key, const Reference& reference,
                     const std::vector<std::filesystem::path>& scene_files);

}  // namespace bounce
