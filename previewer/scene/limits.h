// SPDX-License-Identifier: Apache-2.0
//
// What a file may ask of us. A few bytes of glTF can name billions of vertices or pixels; these bounds
// refuse such files with a sentence, far above what a scene that can be previewed needs.
#pragma once

#include <cstddef>
#include <cstdint>

namespace bounce::scene {

// A GLB states its length in 32 bits; larger files are not valid glTF.
constexpr uint64_t k_max_file_bytes = (uint64_t{1} << 32U) - 1;
// Embedded .gltf files carry their buffers in the text, so the text may be long.
constexpr uint64_t k_max_json_bytes = uint64_t{1} << 30U;
// Extras nest; the deepest seen in the wild is below 20. Copying JSON recurses once a level.
constexpr int k_max_json_depth = 64;
// Any one list of a file (nodes, accessors, channels, ...): a city has some 10^5 objects.
constexpr size_t k_max_list_items = size_t{1} << 21U;
// One accessor. 2^28 vertices of 12 bytes are 3 GiB.
constexpr uint64_t k_max_accessor_elements = uint64_t{1} << 28U;
// An accessor without a buffer view costs no bytes in the file, so it gets a tighter bound.
constexpr uint64_t k_max_zero_elements = uint64_t{1} << 24U;
// All primitives together, since many may read the same bytes: about 10 GiB at 76 bytes a vertex.
constexpr uint64_t k_max_total_vertices = uint64_t{1} << 27U;
constexpr uint64_t k_max_total_indices = uint64_t{1} << 29U;
// Morph targets times vertices, all primitives together: 36 bytes each.
constexpr uint64_t k_max_total_morph_vertices = uint64_t{1} << 27U;
constexpr size_t k_max_morph_targets = 1024;
// EXT_mesh_gpu_instancing and nodes together.
constexpr uint64_t k_max_total_instances = uint64_t{1} << 22U;
// Joint indices are 16 bit.
constexpr size_t k_max_joints = 65535;
// OpenGL implementations stop at 16384 or 32768 a side.
constexpr int k_max_image_side = 32768;
constexpr uint64_t k_max_image_pixels = uint64_t{1} << 28U;
// All images together: 2 GiB of 8-bit RGBA.
constexpr uint64_t k_max_total_image_pixels = uint64_t{1} << 29U;
// Compressed buffer views (meshopt, Draco) may expand; a view may not become larger than this.
constexpr uint64_t k_max_decoded_view_bytes = uint64_t{1} << 32U;
// Numbers kept for all animations, floats: 10^3 bones at 10^4 frames stay below.
constexpr uint64_t k_max_total_animation_values = uint64_t{1} << 28U;

}  // namespace bounce::scene
