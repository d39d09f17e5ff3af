// SPDX-License-Identifier: Apache-2.0
#include "scene/points/texture_reader.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace bounce::scene {
namespace {

size_t at(int index) {
    return static_cast<size_t>(index);
}

float srgb_to_linear(float value) {
    return value <= 0.04045F ? value / 12.92F : std::pow((value + 0.055F) / 1.055F, 2.4F);
}

// An image as a pyramid of means, from at most k_base texels a side: points stand for areas far larger than a
// texel of a large image.
constexpr int k_base = 512;

using Level = TextureReader::Level;

glm::vec4 image_texel(const Image& image, int x, int y, bool color) {
    const size_t i = 4 * (at(y) * at(image.width) + at(x));
    glm::vec4 out;
    for (int c = 0; c < 4; ++c) {
        const float value =
            image.rgba16.empty() ? image.rgba8[i + at(c)] / 255.0F : image.rgba16[i + at(c)] / 65535.0F;
        out[c] = color && c < 3 ? srgb_to_linear(value) : value;
    }
    return out;
}

// Means over blocks that tile the larger image.
template <typename Load>
Level shrink(int from_width, int from_height, int width, int height, Load&& load) {
    Level out{width, height, {}};
    out.texels.reserve(at(width) * at(height));
    for (int y = 0; y < height; ++y) {
        const int y0 = y * from_height / height;
        const int y1 = std::max((y + 1) * from_height / height, y0 + 1);
        for (int x = 0; x < width; ++x) {
            const int x0 = x * from_width / width;
            const int x1 = std::max((x + 1) * from_width / width, x0 + 1);
            glm::vec4 sum(0.0F);
            for (int v = y0; v < y1; ++v) {
                for (int u = x0; u < x1; ++u) {
                    sum += load(u, v);
                }
            }
            out.texels.push_back(sum / static_cast<float>((y1 - y0) * (x1 - x0)));
        }
    }
    return out;
}

std::vector<Level> make_pyramid(const Image& image, bool color) {
    std::vector<Level> levels;
    levels.push_back(shrink(image.width, image.height, std::min(image.width, k_base),
                            std::min(image.height, k_base),
                            [&](int x, int y) { return image_texel(image, x, y, color); }));
    while (levels.back().width > 1 || levels.back().height > 1) {
        const Level& from = levels.back();
        Level next = shrink(from.width, from.height, std::max(from.width / 2, 1),
                            std::max(from.height / 2, 1), [&](int x, int y) { return from.texel(x, y); });
        levels.push_back(std::move(next));
    }
    return levels;
}

int wrapped(int i, int size, Wrap wrap) {
    switch (wrap) {
        case Wrap::clamp_to_edge:
            return std::clamp(i, 0, size - 1);
        case Wrap::mirrored_repeat: {
            const int period = ((i % (2 * size)) + 2 * size) % (2 * size);
            return period < size ? period : 2 * size - 1 - period;
        }
        case Wrap::repeat:
            break;
    }
    return ((i % size) + size) % size;
}

glm::vec4 bilinear(const Level& level, const Sampler& sampler, const glm::vec2& uv) {
    const float x = uv.x * static_cast<float>(level.width) - 0.5F;
    const float y = uv.y * static_cast<float>(level.height) - 0.5F;
    if (!std::isfinite(x) || !std::isfinite(y) || std::abs(x) > 1e8F || std::abs(y) > 1e8F) {
        return level.texels.front();
    }
    const auto x0 = static_cast<int>(std::floor(x));
    const auto y0 = static_cast<int>(std::floor(y));
    const float fx = x - std::floor(x);
    const float fy = y - std::floor(y);
    const auto texel = [&](int u, int v) {
        return level.texel(wrapped(u, level.width, sampler.wrap_u), wrapped(v, level.height, sampler.wrap_v));
    };
    return glm::mix(glm::mix(texel(x0, y0), texel(x0 + 1, y0), fx),
                    glm::mix(texel(x0, y0 + 1), texel(x0 + 1, y0 + 1), fx), fy);
}

}  // namespace

std::optional<glm::vec4> TextureReader::read(const TextureRef& ref, const Primitive& primitive,
                                             const PointSample& point, float share, bool color) {
    if (!ref.present() || scene_.textures[at(ref.texture)].image == k_none) {
        return std::nullopt;
    }
    const std::vector<glm::vec2>& uvs = ref.uv_set == 0 ? primitive.uv0 : primitive.uv1;
    if (uvs.empty()) {
        return std::nullopt;
    }
    color = ref.is_srgb(color);
    const Texture& texture = scene_.textures[at(ref.texture)];
    std::array<glm::vec2, 3> corner;
    for (size_t k = 0; k < 3; ++k) {
        const glm::vec2& uv = uvs[point.triangle[static_cast<int>(k)]];
        corner[k] = glm::vec2(ref.uv_transform * glm::vec3(uv, 1.0F));
    }
    const glm::vec2 ab = corner[1] - corner[0];
    const glm::vec2 ac = corner[2] - corner[0];
    const glm::vec2 uv = corner[0] + ab * point.second + ac * point.third;
    const std::vector<Level>& levels = pyramid(texture.image, color);
    const float uv_area = 0.5F * std::abs(ab.x * ac.y - ab.y * ac.x) * share;
    const float texels = uv_area * static_cast<float>(levels[0].width) * static_cast<float>(levels[0].height);
    const float wanted = texels > 1.0F ? 0.5F * std::log2(texels) : 0.0F;
    const auto last = static_cast<float>(levels.size() - 1);
    const auto level = static_cast<size_t>(std::lround(std::min(wanted, last)));
    return bilinear(levels[level], texture.sampler, uv);
}

double TextureReader::texels(const TextureRef& ref, const Primitive& primitive, const glm::uvec3& triangle) {
    const std::vector<glm::vec2>& uvs = ref.uv_set == 0 ? primitive.uv0 : primitive.uv1;
    if (!ref.present() || scene_.textures[at(ref.texture)].image == k_none || uvs.empty()) {
        return 0.0;
    }
    std::array<glm::dvec2, 3> corner;
    for (size_t k = 0; k < 3; ++k) {
        corner[k] =
            glm::dvec2(glm::vec2(ref.uv_transform * glm::vec3(uvs[triangle[static_cast<int>(k)]], 1.0F)));
    }
    const glm::dvec2 ab = corner[1] - corner[0];
    const glm::dvec2 ac = corner[2] - corner[0];
    const Level& base = pyramid(scene_.textures[at(ref.texture)].image, true).front();
    const double texels = 0.5 * std::abs(ab.x * ac.y - ab.y * ac.x) * base.width * base.height;
    return std::isfinite(texels) ? texels : 0.0;
}

const std::vector<TextureReader::Level>& TextureReader::pyramid(int image, bool color) {
    const auto key = std::pair(image, color);
    const auto found = pyramids_.find(key);
    return found != pyramids_.end()
               ? found->second
               : pyramids_.emplace(key, make_pyramid(scene_.images[at(image)], color)).first->second;
}

}  // namespace bounce::scene
