// SPDX-License-Identifier: Apache-2.0
#include "renderer/splat_choice.h"

#include <fmt/format.h>

namespace bounce {

SplatChoice choose_splat(const SplatCounts& counts) {
    if (!counts.can_tessellate) {
        return {Splat::compute, "the driver's tessellation shaders read no storage buffers"};
    }
    if (counts.software) {
        // docs/papers/tessellation_splatting.md has the measurement.
        return {Splat::compute, "a software driver tessellates on one thread of the processor"};
    }
    if (counts.splats <= counts.triangles) {
        return {Splat::compute, fmt::format("{} splats are no more than the {} triangles to go through",
                                            counts.splats, counts.triangles)};
    }
    return {Splat::tessellation, fmt::format("{} splats are more than the {} triangles to go through",
                                             counts.splats, counts.triangles)};
}

}  // namespace bounce
