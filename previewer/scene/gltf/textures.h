// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "scene/gltf/buffers.h"
#include "scene/scene.h"

namespace bounce::scene::gltf {

// Textures and images of a scene, filled as materials ask for them: an image that no material uses is
// not decoded and may be missing.
class TextureTable {
  public:
    TextureTable(Source& source, Buffers& buffers, Scene& scene);

    // A texture reference of a material ("baseColorTexture" of owner), with KHR_texture_transform
    // applied. Not present where owner has none, or one that cannot be shown (with a warning).
    [[nodiscard]] TextureRef read(const nlohmann::json& owner, const char* key);

  private:
    [[nodiscard]] int texture(int gltf_texture);
    [[nodiscard]] int image(int gltf_image);

    Source& source_;
    Buffers& buffers_;
    Scene& scene_;
    std::vector<int> texture_of_;  // by glTF's index; k_unread until asked for
    std::vector<int> image_of_;
};

}  // namespace bounce::scene::gltf
