// SPDX-License-Identifier: Apache-2.0
//
// tinygltf is compiled here rather than linked from Debian's library: without its file access and image
// decoders (ours obey limits.h and decode only what is used), and seen by the sanitizers.
#define TINYGLTF_IMPLEMENTATION
#define TINYGLTF_NO_FS
#define TINYGLTF_NO_EXTERNAL_IMAGE
#define TINYGLTF_NO_STB_IMAGE
#define TINYGLTF_NO_STB_IMAGE_WRITE
#include <tiny_gltf.h>
