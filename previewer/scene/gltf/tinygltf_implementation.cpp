// SPDX-License-Identifier: Apache-2.0
//
// tinygltf is compiled here rather than linked from Debian's library: without its file access and image
// decoders (ours obey limits.h and decode only what is used), and seen by the sanitizers. The switches
// stand in CMakeLists.txt.
#define TINYGLTF_IMPLEMENTATION
// tinygltf forgets this one when it is kept from files; it must stand first.
#include <fstream>

#include <tiny_gltf.h>
