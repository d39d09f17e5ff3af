// SPDX-License-Identifier: Apache-2.0
//
// Writes gpu/lobe_fits.inc:  fit_lobes > previewer/gpu/lobe_fits.inc
#include <cmath>
#include <cstdio>

#include "gpu/lobe_table.h"

int main() {
    using namespace bounce::gpu;
    std::puts(
        "// Written by fit_lobes. in_plane, across and sin_shift of gpu/lobe_fit.h; column by column, row by "
        "row.");
    for (int row = 0; row < k_lobe_table_size; ++row) {
        for (int column = 0; column < k_lobe_table_size; ++column) {
            const double cosine = lobe_column_cosine(column);
            const LobeFit fit = fit_lobe(cosine, lobe_row_roughness(row), {2.0, 2.0 * cosine, 0.0}).fit;
            // Adding 0 leaves no minus before one.
            const double shift = std::round(fit.sin_shift * 1e6) * 1e-6 + 0.0;
            std::printf("{%.4fF, %.4fF, %.6fF},\n", fit.in_plane, fit.across, shift);
        }
    }
    return 0;
}
