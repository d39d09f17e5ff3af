// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>

namespace bounce {

// Which Blender to run. Empty: $BLENDER, then `blender` on $PATH.
struct SceneSourceOptions {
    std::filesystem::path blender;
};

struct ResolvedScene {
    std::filesystem::path gltf;      // what to load: .glb or .gltf
    std::filesystem::path original;  // as the user named it
    double export_seconds = 0.0;     // Blender's, now or when it was exported; 0 where nothing was
    [[nodiscard]] bool exported() const { return gltf != original; }
};

// Turns what the user gave into a file that the loader reads. A .blend is exported by the add-on in a
// Blender of its own, into the cache folder; the same .blend (with the files it links) and add-on are
// exported once. Other files are returned as they are. Throws input_error where the file is missing or
// Blender cannot export it, Error (failed) where there is no Blender or add-on; each is one sentence.
[[nodiscard]] ResolvedScene resolve_scene(const std::filesystem::path& scene,
                                          const SceneSourceOptions& options);

// The Blender executable by the rule above. Throws Error (failed).
[[nodiscard]] std::filesystem::path find_blender(const std::filesystem::path& wanted);

// The folder with export_cli.py and the package `bounce`: $BOUNCE_ADDON, the checkout that this
// executable was built in, or share/bounce/blender_addon of the prefix it is installed in. Throws Error
// (failed).
[[nodiscard]] std::filesystem::path find_addon();

}  // namespace bounce
