// SPDX-License-Identifier: Apache-2.0
#include "scene/gltf/textures.h"

#include <cmath>

#include "scene/gltf/images.h"

namespace bounce::scene::gltf {
namespace {

using nlohmann::json;

constexpr int k_unread = -2;

Wrap wrap_of(int code) {
    switch (code) {
        case TINYGLTF_TEXTURE_WRAP_CLAMP_TO_EDGE:
            return Wrap::clamp_to_edge;
        case TINYGLTF_TEXTURE_WRAP_MIRRORED_REPEAT:
            return Wrap::mirrored_repeat;
        default:
            return Wrap::repeat;
    }
}

Sampler sampler_of(const tinygltf::Sampler& typed) {
    Sampler sampler;
    sampler.wrap_u = wrap_of(typed.wrapS);
    sampler.wrap_v = wrap_of(typed.wrapT);
    sampler.magnify = typed.magFilter == TINYGLTF_TEXTURE_FILTER_NEAREST ? Filter::nearest : Filter::linear;
    sampler.minify = typed.minFilter == TINYGLTF_TEXTURE_FILTER_NEAREST ||
                             typed.minFilter == TINYGLTF_TEXTURE_FILTER_NEAREST_MIPMAP_NEAREST ||
                             typed.minFilter == TINYGLTF_TEXTURE_FILTER_NEAREST_MIPMAP_LINEAR
                         ? Filter::nearest
                         : Filter::linear;
    sampler.mipmaps = typed.minFilter != TINYGLTF_TEXTURE_FILTER_NEAREST &&
                      typed.minFilter != TINYGLTF_TEXTURE_FILTER_LINEAR;
    return sampler;
}

glm::vec2 pair_or(const json& object, const char* key, const glm::vec2& otherwise) {
    const json* value = member(object, key);
    return value == nullptr ? otherwise : glm::vec2((*value)[0].get<float>(), (*value)[1].get<float>());
}

// KHR_texture_transform: scale, then turn counter-clockwise as seen with v running down, then move.
glm::mat3 uv_transform_of(const json& transform) {
    const glm::vec2 offset = pair_or(transform, "offset", glm::vec2(0.0F));
    const glm::vec2 scale = pair_or(transform, "scale", glm::vec2(1.0F));
    const float angle_rad = number_or(transform, "rotation", 0.0F);
    const float c = std::cos(angle_rad);
    const float s = std::sin(angle_rad);
    return {glm::vec3(c * scale.x, -s * scale.x, 0.0F), glm::vec3(s * scale.y, c * scale.y, 0.0F),
            glm::vec3(offset, 1.0F)};
}

}  // namespace

TextureTable::TextureTable(Source& source, Buffers& buffers, Scene& scene)
    : source_(source),
      buffers_(buffers),
      scene_(scene),
      texture_of_(source.model.textures.size(), k_unread),
      image_of_(list(source.json(), "images").size(), k_unread) {}

int TextureTable::image(int gltf_image) {
    int& known = image_of_[static_cast<size_t>(gltf_image)];
    if (known == k_unread) {
        scene_.images.push_back(read_image(source_, buffers_, gltf_image));
        known = static_cast<int>(scene_.images.size()) - 1;
    }
    return known;
}

int TextureTable::texture(int gltf_texture) {
    const auto at = static_cast<size_t>(gltf_texture);
    if (texture_of_[at] != k_unread) {
        return texture_of_[at];
    }
    const json& description = source_.json()["textures"][at];
    const tinygltf::Texture& typed = source_.model.textures[at];
    int from = typed.source;
    if (const json* webp = extension(description, "EXT_texture_webp");
        webp != nullptr && webp->contains("source")) {
        from = (*webp)["source"].get<int>();
    }
    if (from < 0) {
        source_.warn(
            fmt::format("texture {} has no image in a format that is read, and is left out", gltf_texture));
        texture_of_[at] = k_none;
        return k_none;
    }
    Texture texture;
    texture.image = image(from);
    if (typed.sampler >= 0) {
        texture.sampler = sampler_of(source_.model.samplers[static_cast<size_t>(typed.sampler)]);
    }
    scene_.textures.push_back(texture);
    texture_of_[at] = static_cast<int>(scene_.textures.size()) - 1;
    return texture_of_[at];
}

TextureRef TextureTable::read(const json& owner, const char* key) {
    const json* info = member(owner, key);
    if (info == nullptr) {
        return {};
    }
    TextureRef ref;
    ref.uv_set = int_or(*info, "texCoord", 0);
    if (const json* transform = extension(*info, "KHR_texture_transform")) {
        ref.uv_set = int_or(*transform, "texCoord", ref.uv_set);
        ref.uv_transform = uv_transform_of(*transform);
    }
    if (ref.uv_set > 1) {
        source_.warn(fmt::format(
            "a texture uses texture coordinates {}; only sets 0 and 1 are read, and it is left out",
            ref.uv_set));
        return {};
    }
    if (const json* blender = extension(*info, "BOUNCE_scene")) {
        const std::string encoding = string_or(*blender, "encoding", "");
        ref.encoding = encoding == "srgb"     ? Encoding::srgb
                       : encoding == "linear" ? Encoding::linear
                                              : Encoding::by_use;
    }
    ref.texture = texture((*info)["index"].get<int>());
    return ref;
}

}  // namespace bounce::scene::gltf
