// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>

namespace bounce::gl {

// Counts what we ask of the driver: the sum over everything ever allocated, which is the peak as long as
// resources live for the whole run (transient textures are pooled). The driver's own overhead is not in it.
void note_allocation(size_t bytes);
[[nodiscard]] size_t allocated_bytes();

}  // namespace bounce::gl
