// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <string>

#include "evaluate/peers.h"

namespace bounce {

// Renders the frames with f3d from the scene's camera, with the file's lights and with f3d's own, from glTF
// files that Blender writes of each frame (evaluate/f3d_export.py). What is found in job.cache is not
// rendered again. Throws Error where f3d or a display is missing, or where it cannot take the scene's camera;
// what was finished is in result then.
void run_f3d(const PeerJob& job, const PeerProgress& progress, PeerResult& result);

// A record of so many key presses for f3d's --interaction-test-play, each of which draws a frame.
[[nodiscard]] std::string f3d_presses(int count);

}  // namespace bounce
