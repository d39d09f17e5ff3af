// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <map>
#include <optional>
#include <utility>
#include <vector>

#include <glm/glm.hpp>

#include "scene/points/point_set.h"
#include "scene/scene.h"

namespace bounce::scene {

// What textures say at points. Images are kept as pyramids of means, made when one is first asked for. The
// scene must outlive it.
class TextureReader {
  public:
    explicit TextureReader(const Scene& scene) : scene_(scene) {}

    // Linear where color is set, else as stored. Nothing where the reference names no image or the primitive
    // has no such coordinates. share: part of the triangle's area to average over.
    [[nodiscard]] std::optional<glm::vec4> read(const TextureRef& ref, const Primitive& primitive,
                                                const PointSample& point, float share, bool color);

    // Texels that the triangle covers of the image as it is kept; 0 where read() reads nothing.
    [[nodiscard]] double texels(const TextureRef& ref, const Primitive& primitive,
                                const glm::uvec3& triangle);

    struct Level {
        int width = 0;
        int height = 0;
        std::vector<glm::vec4> texels;
        [[nodiscard]] const glm::vec4& texel(int x, int y) const {
            return texels[static_cast<size_t>(y) * static_cast<size_t>(width) + static_cast<size_t>(x)];
        }
    };

  private:
    [[nodiscard]] const std::vector<Level>& pyramid(int image, bool color);

    const Scene& scene_;
    std::map<std::pair<int, bool>, std::vector<Level>> pyramids_;
};

}  // namespace bounce::scene
