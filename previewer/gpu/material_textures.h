// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <map>
#include <utility>
#include <vector>

#include "gl/object.h"
#include "gl/texture.h"
#include "scene/scene.h"

namespace bounce::gpu {

inline void delete_sampler(GLuint id) {
    glDeleteSamplers(1, &id);
}

// Images as mip-mapped textures, once for colour use (decoded from sRGB by the hardware) and once for data
// use where both occur, and a sampler object for each glTF sampler.
class MaterialTextures {
  public:
    explicit MaterialTextures(const scene::Scene& scene);

    // Whether the shader has to decode what it reads from sRGB: Cycles interpolates 8-bit images between
    // their encoded texels, as glTF does not. Levels of detail are means of light either way.
    [[nodiscard]] bool stays_encoded(const scene::TextureRef& ref, bool color) const;

    // Binds a material's texture to a unit; absent references are left as they are.
    void bind(GLuint unit, const scene::TextureRef& ref, bool color) const;

  private:
    const gl::Texture& image(int index, bool color) const;

    const scene::Scene& scene_;
    std::map<std::pair<int, bool>, gl::Texture> images_;
    std::vector<gl::Object<delete_sampler>> samplers_;
};

}  // namespace bounce::gpu
