// SPDX-License-Identifier: Apache-2.0
//
// References as files of their own: a report writes them, another evaluation of the same frames may take
// them.
#pragma once

#include <filesystem>

#include "evaluate/evaluation.h"
#include "evaluate/reference.h"
#include "image/image_io.h"

namespace bounce {

// What a report's reference says of itself in its header.
[[nodiscard]] ImageAttributes reference_attributes(const Evaluation& evaluation, const Reference& reference);

struct GivenReference {
    Reference reference;
    int spp = 0;
};

// Reads such a file. Throws input_error, with a sentence, where it is of another scene, frame, size or number
// of bounces than key, or does not say of what it is.
[[nodiscard]] GivenReference read_given_reference(const std::filesystem::path& path, const ReferenceKey& key);

}  // namespace bounce
