// SPDX-License-Identifier: Apache-2.0
#include "scene/points/point_materials.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <optional>

#include "scene/transparency.h"

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

struct Level {
    int width = 0;
    int height = 0;
    std::vector<glm::vec4> texels;
    [[nodiscard]] const glm::vec4& texel(int x, int y) const { return texels[at(y) * at(width) + at(x)]; }
};

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

class TextureReader {
  public:
    explicit TextureReader(const Scene& scene) : scene_(scene) {}

    // Nothing where the reference names no image or the primitive has no such coordinates. share: part of the
    // triangle's area to average over.
    std::optional<glm::vec4> read(const TextureRef& ref, const Primitive& primitive, const PointSample& point,
                                  float share, bool color) {
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
        const float texels =
            uv_area * static_cast<float>(levels[0].width) * static_cast<float>(levels[0].height);
        const float wanted = texels > 1.0F ? 0.5F * std::log2(texels) : 0.0F;
        const auto last = static_cast<float>(levels.size() - 1);
        const auto level = static_cast<size_t>(std::lround(std::min(wanted, last)));
        return bilinear(levels[level], texture.sampler, uv);
    }

  private:
    const std::vector<Level>& pyramid(int image, bool color) {
        const auto key = std::pair(image, color);
        const auto found = pyramids_.find(key);
        return found != pyramids_.end()
                   ? found->second
                   : pyramids_.emplace(key, make_pyramid(scene_.images[at(image)], color)).first->second;
    }

    const Scene& scene_;
    std::map<std::pair<int, bool>, std::vector<Level>> pyramids_;
};

const Primitive& primitive_of(const Scene& scene, const SurfaceParts& parts, const PointSample& point) {
    const PointSurface& surface = parts.surfaces[point.surface];
    return scene.meshes[at(surface.mesh)].primitives[at(surface.primitive)];
}

glm::vec4 vertex_color(const Primitive& primitive, const PointSample& point) {
    if (primitive.colors.empty()) {
        return glm::vec4(1.0F);
    }
    const glm::uvec3& corner = point.triangle;
    return primitive.colors[corner.x] * (1.0F - point.second - point.third) +
           primitive.colors[corner.y] * point.second + primitive.colors[corner.z] * point.third;
}

// Between 0 and 1, never either: of consecutive numbers evenly spread, as the points are over surfaces.
float threshold(uint32_t number) {
    const uint32_t golden = 0x9E3779B9U;  // of 2^32
    return (static_cast<float>((number * golden) >> 8U) + 0.5F) / 16777216.0F;
}

}  // namespace

std::vector<PointMaterial> point_materials(const Scene& scene, const SurfaceParts& parts,
                                           const std::vector<PointSample>& points) {
    TextureReader reader(scene);
    std::vector<PointMaterial> out;
    out.reserve(points.size());
    for (const PointSample& point : points) {
        const Primitive& primitive = primitive_of(scene, parts, point);
        PointMaterial& material = out.emplace_back();
        material.base_color = glm::vec3(vertex_color(primitive, point));
        if (primitive.material == k_none) {
            continue;
        }
        const Material& source = scene.materials[at(primitive.material)];
        const float share = std::min(point.share, 1.0F);
        if (const auto color = reader.read(source.base_color_texture, primitive, point, share, true)) {
            material.base_color *= glm::vec3(*color);
        }
        if (const auto mr = reader.read(source.metallic_roughness_texture, primitive, point, share, false)) {
            material.roughness = mr->g;
            material.metallic = mr->b;
        }
    }
    return out;
}

void drop_cut_out(const Scene& scene, const SurfaceParts& parts, std::vector<PointSample>& points) {
    TextureReader reader(scene);
    uint32_t number = 0;
    for (PointSample& point : points) {
        const Primitive& primitive = primitive_of(scene, parts, point);
        if (primitive.material == k_none) {
            continue;
        }
        const Material& material = scene.materials[at(primitive.material)];
        if (material.alpha_mode == AlphaMode::opaque) {
            continue;
        }
        float alpha = material.base_color.a * vertex_color(primitive, point).a;
        if (const auto color = reader.read(material.base_color_texture, primitive, point, 0.0F, true)) {
            alpha *= color->a;
        }
        // Of a blended surface a part alpha of the points stays.
        const float cutoff =
            material.alpha_mode == AlphaMode::blend ? threshold(number) : material.alpha_cutoff;
        ++number;
        if (alpha < cutoff) {
            point.share = 0.0F;
        }
    }
}

}  // namespace bounce::scene
