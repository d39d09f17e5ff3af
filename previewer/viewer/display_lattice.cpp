// SPDX-License-Identifier: Apache-2.0
#include "viewer/display_lattice.h"

#include <array>
#include <cmath>
#include <utility>

namespace bounce::viewer {

std::vector<float> bake_lattice(const ViewTransform& view) {
    std::array<float, k_lattice_side> nodes{};
    for (size_t i = 1; i < nodes.size(); ++i) {
        const float part = static_cast<float>(i) / static_cast<float>(nodes.size() - 1);
        nodes[i] = std::exp2(k_lattice_low_stops + part * (k_lattice_high_stops - k_lattice_low_stops));
    }
    Image colors(k_lattice_side * k_lattice_side, k_lattice_side);
    size_t at = 0;
    for (const float blue : nodes) {
        for (const float green : nodes) {
            for (const float red : nodes) {
                colors.rgb[at++] = red;
                colors.rgb[at++] = green;
                colors.rgb[at++] = blue;
            }
        }
    }
    ViewTransform bare = view;
    bare.exposure = 0.0F;
    bare.gamma = 1.0F;
    return std::move(to_display(colors, bare).rgb);
}

}  // namespace bounce::viewer
