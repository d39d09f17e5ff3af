// SPDX-License-Identifier: Apache-2.0
#pragma once

namespace bounce::scene::gltf {

struct Source;

// Refuses a file that requires an extension that is not read, by name; warns of each one that it uses
// and that is not carried, or not whole.
void check_extensions(Source& source);

}  // namespace bounce::scene::gltf
