// SPDX-License-Identifier: Apache-2.0
#include "gpu/lobe_table.h"

#include <algorithm>
#include <array>
#include <vector>

#include "gpu/environment_brdf.h"

namespace bounce::gpu {
namespace {

constexpr std::array<std::array<float, 3>, k_lobe_table_size* k_lobe_table_size> k_fits = {{
#include "gpu/lobe_fits.inc"
}};

double place(int i) {
    return i / (k_lobe_table_size - 1.0);
}

}  // namespace

double lobe_column_cosine(int column) {
    return std::max(1.0 - place(column) * place(column), k_least_cosine);
}

double lobe_row_roughness(int row) {
    return place(row);
}

LobeFit stored_lobe(int column, int row) {
    const std::array<float, 3>& fit = k_fits.at(static_cast<size_t>(row * k_lobe_table_size + column));
    return {static_cast<double>(fit[0]), static_cast<double>(fit[1]), static_cast<double>(fit[2])};
}

LobeTable::LobeTable()
    : texture_("lobes",
               {.format = GL_RGBA32F, .width = k_lobe_table_size, .height = k_lobe_table_size, .layers = 2}) {
    std::vector<glm::vec4> texels;
    for (int layer = 0; layer < 2; ++layer) {
        for (int row = 0; row < k_lobe_table_size; ++row) {
            for (int column = 0; column < k_lobe_table_size; ++column) {
                const LobeFit fit = stored_lobe(column, row);
                texels.emplace_back(layer == 0 ? glm::dvec4(fit.in_plane, fit.across, fit.sin_shift, 0.0)
                                               : glm::dvec4(environment_brdf(lobe_column_cosine(column),
                                                                             lobe_row_roughness(row)),
                                                            0.0, 0.0));
            }
        }
    }
    glTextureSubImage3D(texture_.id(), 0, 0, 0, 0, k_lobe_table_size, k_lobe_table_size, 2, GL_RGBA, GL_FLOAT,
                        texels.data());
    glTextureParameteri(texture_.id(), GL_TEXTURE_MIN_FILTER, GL_LINEAR);
    glTextureParameteri(texture_.id(), GL_TEXTURE_MAG_FILTER, GL_LINEAR);
}

}  // namespace bounce::gpu
