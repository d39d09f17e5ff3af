// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace bounce {

// The files that a .glb or .gltf refers to (buffers, images), in the order in which it names them; data URIs
// are in the file itself. Empty where the file is no glTF: the loader says so when it is opened.
[[nodiscard]] std::vector<std::filesystem::path> gltf_external_files(const std::filesystem::path& gltf);

// SHA-256 of the scene as the renderer sees it: the file and all files that it refers to. A missing one
// counts as such. Throws input_error where the scene itself cannot be read.
[[nodiscard]] std::string sha256_of_gltf(const std::filesystem::path& gltf);

// Whether the file lists the extension as used. False where it cannot be read, and for a .blend.
[[nodiscard]] bool gltf_uses_extension(const std::filesystem::path& gltf, std::string_view name);

// Whether the name is a .blend's, in small letters or capitals; all else is taken for glTF.
[[nodiscard]] bool is_blend(const std::filesystem::path& scene);

// Whether the file names the scene's active camera, as our exporter does where Blender has one.
[[nodiscard]] bool gltf_names_camera(const std::filesystem::path& gltf);

// What our exporter could not carry over, a sentence each: "not exported: Suzanne: Glass BSDF, exported as a
// ...".
[[nodiscard]] std::vector<std::string> gltf_not_exported(const std::filesystem::path& gltf);

// Whether the file holds what a glTF begins with, a JSON object; it may still be none that can be loaded.
[[nodiscard]] bool is_gltf(const std::filesystem::path& gltf);

}  // namespace bounce
