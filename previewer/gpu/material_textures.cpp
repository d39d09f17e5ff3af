// SPDX-License-Identifier: Apache-2.0
#include "gpu/material_textures.h"

#include <algorithm>
#include <bit>

#include <fmt/format.h>

#include "core/error.h"
#include "gl/context.h"

namespace bounce::gpu {
namespace {

GLint gl_wrap(scene::Wrap wrap) {
    switch (wrap) {
        case scene::Wrap::repeat:
            return GL_REPEAT;
        case scene::Wrap::clamp_to_edge:
            return GL_CLAMP_TO_EDGE;
        case scene::Wrap::mirrored_repeat:
            return GL_MIRRORED_REPEAT;
    }
    return GL_REPEAT;
}

// Where MaterialTextures::stays_encoded() is true of a texture that is read as sRGB; of others it has no
// effect.
bool skip_decode(const scene::Scene& scene, const scene::Texture& texture) {
    return scene.from_blender && texture.image != scene::k_none &&
           !scene.images[static_cast<size_t>(texture.image)].rgba8.empty() &&
           epoxy_has_gl_extension("GL_EXT_texture_sRGB_decode");
}

gl::Object<delete_sampler> make_sampler(const scene::Sampler& sampler, bool encoded) {
    GLuint id = 0;
    glCreateSamplers(1, &id);
    const bool linear = sampler.minify == scene::Filter::linear;
    const GLint minify = sampler.mipmaps ? (linear ? GL_LINEAR_MIPMAP_LINEAR : GL_NEAREST_MIPMAP_NEAREST)
                                         : (linear ? GL_LINEAR : GL_NEAREST);
    glSamplerParameteri(id, GL_TEXTURE_MIN_FILTER, minify);
    glSamplerParameteri(id, GL_TEXTURE_MAG_FILTER,
                        sampler.magnify == scene::Filter::linear ? GL_LINEAR : GL_NEAREST);
    glSamplerParameteri(id, GL_TEXTURE_WRAP_S, gl_wrap(sampler.wrap_u));
    glSamplerParameteri(id, GL_TEXTURE_WRAP_T, gl_wrap(sampler.wrap_v));
    if (encoded) {
        glSamplerParameteri(id, GL_TEXTURE_SRGB_DECODE_EXT, GL_SKIP_DECODE_EXT);
    }
    // Mesa's software drivers filter anisotropically at up to 40 s a picture, where a GPU does it in passing.
    if (linear && !gl::is_software_driver() && epoxy_has_gl_extension("GL_EXT_texture_filter_anisotropic")) {
        glSamplerParameterf(id, GL_TEXTURE_MAX_ANISOTROPY_EXT, 8.0F);
    }
    return gl::Object<delete_sampler>(id);
}

gl::Texture upload(const scene::Image& image, bool color) {
    GLint largest = 0;
    glGetIntegerv(GL_MAX_TEXTURE_SIZE, &largest);
    if (std::max(image.width, image.height) > largest) {
        throw input_error(
            fmt::format("the image {} is {} x {} pixels; this OpenGL takes {} a side: make it smaller",
                        image.name, image.width, image.height, largest));
    }
    gl::TextureDesc desc;
    const bool wide = !image.rgba16.empty();
    desc.format = wide ? GL_RGBA16 : (color ? GL_SRGB8_ALPHA8 : GL_RGBA8);
    desc.width = image.width;
    desc.height = image.height;
    desc.levels = std::bit_width(static_cast<unsigned>(std::max(image.width, image.height)));
    gl::Texture texture(image.name, desc);
    if (wide) {
        // No 16-bit sRGB format exists: colour images are decoded by the loader's contract to 8 bits first,
        // so what arrives here is data.
        glTextureSubImage2D(texture.id(), 0, 0, 0, image.width, image.height, GL_RGBA, GL_UNSIGNED_SHORT,
                            image.rgba16.data());
    } else {
        glTextureSubImage2D(texture.id(), 0, 0, 0, image.width, image.height, GL_RGBA, GL_UNSIGNED_BYTE,
                            image.rgba8.data());
    }
    glGenerateTextureMipmap(texture.id());
    return texture;
}

// A 16-bit colour image as 8 bits, because there is no 16-bit sRGB texture format.
scene::Image narrowed(const scene::Image& image) {
    scene::Image out;
    out.name = image.name;
    out.width = image.width;
    out.height = image.height;
    out.rgba8.reserve(image.rgba16.size());
    for (const uint16_t value : image.rgba16) {
        out.rgba8.push_back(static_cast<uint8_t>((value + 128U) / 257U));
    }
    return out;
}

}  // namespace

MaterialTextures::MaterialTextures(const scene::Scene& scene) : scene_(scene) {
    for (const scene::Texture& texture : scene.textures) {
        samplers_.push_back(make_sampler(texture.sampler, skip_decode(scene, texture)));
    }
    const auto add = [&](const scene::TextureRef& ref, bool color) {
        if (!ref.present()) {
            return;
        }
        color = ref.is_srgb(color);
        const int index = scene.textures[static_cast<size_t>(ref.texture)].image;
        if (index == scene::k_none || images_.contains({index, color})) {
            return;
        }
        const scene::Image& source = scene.images[static_cast<size_t>(index)];
        const bool narrow = color && !source.rgba16.empty();
        images_.emplace(std::pair{index, color}, upload(narrow ? narrowed(source) : source, color));
    };
    for (const scene::Material& material : scene.materials) {
        add(material.base_color_texture, true);
        add(material.emission_texture, true);
        add(material.metallic_roughness_texture, false);
        add(material.normal_texture, false);
    }
}

bool MaterialTextures::stays_encoded(const scene::TextureRef& ref, bool color) const {
    if (!ref.present() || !scene_.from_blender || !epoxy_has_gl_extension("GL_EXT_texture_sRGB_decode")) {
        return false;
    }
    const int image = scene_.textures[static_cast<size_t>(ref.texture)].image;
    return ref.is_srgb(color) && image != scene::k_none &&
           !scene_.images[static_cast<size_t>(image)].rgba8.empty();
}

void MaterialTextures::bind(GLuint unit, const scene::TextureRef& ref, bool color) const {
    if (!ref.present()) {
        return;
    }
    color = ref.is_srgb(color);
    const auto texture = static_cast<size_t>(ref.texture);
    const auto found = images_.find({scene_.textures[texture].image, color});
    if (found != images_.end()) {
        found->second.bind(unit);
        glBindSampler(unit, samplers_[texture].id());
    }
}

}  // namespace bounce::gpu
