// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "gl/texture.h"
#include "gpu/lobe_fit.h"
#include "shared/bindings.h"

namespace bounce::gpu {

// Columns: views, from above to grazing; rows: roughness from 0 to 1.
inline constexpr int k_lobe_table_size = 32;

// n_dot_v = 1 - u^2 at place u between the first column's middle, 0, and the last one's, 1: steps of about
// the same angle.
[[nodiscard]] double lobe_column_cosine(int column);
[[nodiscard]] double lobe_row_roughness(int row);

// The fit that is stored in gpu/lobe_fits.inc; fit_lobes writes that file.
[[nodiscard]] LobeFit stored_lobe(int column, int row);

// shaders/lib/lobe.glsl reads it. Layer 0: LobeFit's numbers; layer 1: environment_brdf().
class LobeTable {
  public:
    LobeTable();
    void bind() const { texture_.bind(TEX_LOBES); }

  private:
    gl::Texture texture_;
};

}  // namespace bounce::gpu
