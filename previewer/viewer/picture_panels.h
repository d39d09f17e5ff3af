// SPDX-License-Identifier: Apache-2.0
//
// The sections of the side panel.
#pragma once

#include "viewer/panels.h"

namespace bounce::viewer {

// What is shown and from where: mode, light, exposure, camera.
void view_section(ViewState& state, Viewpoint& viewpoint, const PanelFacts& facts, PanelResult& result);
// How it is computed: technique, samples, interpolation, map sizes.
void technique_section(ViewState& state, PanelResult& result);
// What the frame did and cost.
void frame_section(ViewState& state, const PanelFacts& facts, PanelResult& result);
// What was left out and why, where the picture differs knowingly, what the loader warned about.
void notes_section(const PanelFacts& facts);

}  // namespace bounce::viewer
