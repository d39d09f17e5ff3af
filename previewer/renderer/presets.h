// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <map>
#include <string>

#include "renderer/settings.h"

namespace bounce {

// Settings that belong together.
enum class Preset {
    automatic,       // ours
    rsm2005,         // Dachsbacher and Stamminger 2005, "Reflective Shadow Maps"
    lv2009,          // Lv et al. 2009, "A Fast Method for Real-time Computation of Approximated Global
                     // Illumination"
    ism2008,         // Ritschel et al. 2008, "Imperfect Shadow Maps for Efficient Computation of Indirect
                     // Illumination"
    avg2012,         // Bashford-Rogers et al. 2012, "Approximate Visibility Grids for Interactive Indirect
                     // Illumination"
    metropolis2013,  // Barak et al. 2013, "Temporally Coherent Adaptive Sampling for Imperfect Shadow Maps"
};

// As on the command line.
[[nodiscard]] const std::map<std::string, Preset>& preset_names();

[[nodiscard]] Settings preset_settings(Preset preset);

}  // namespace bounce
