// SPDX-License-Identifier: Apache-2.0
#include "gl/texture.h"

#include <algorithm>

#include <fmt/format.h>

#include "core/error.h"
#include "gl/debug_output.h"
#include "gl/label.h"

namespace bounce::gl {

size_t bytes_per_texel(GLenum format) {
    switch (format) {
        case GL_R8:
        case GL_R8UI:
            return 1;
        case GL_R16F:
        case GL_R16UI:
            return 2;
        case GL_RGBA8:
        case GL_SRGB8_ALPHA8:
        case GL_R32F:
        case GL_RG16:
        case GL_R32UI:
        case GL_DEPTH_COMPONENT32F:
            return 4;
        case GL_RGBA16:
        case GL_RGBA16F:
        case GL_RG32F:
            return 8;
        default:
            return 16;
    }
}

size_t storage_bytes(const TextureDesc& desc) {
    size_t texels = 0;
    for (int level = 0; level < desc.levels; ++level) {
        texels += static_cast<size_t>(std::max(desc.width >> level, 1)) *
                  static_cast<size_t>(std::max(desc.height >> level, 1));
    }
    return texels * static_cast<size_t>(std::max(std::max(desc.layers, desc.samples), 1)) *
           bytes_per_texel(desc.format);
}

TexelKind texel_kind(GLenum format) {
    switch (format) {
        case GL_DEPTH_COMPONENT32F:
            return TexelKind::depth;
        case GL_R8UI:
        case GL_R16UI:
        case GL_R32UI:
        case GL_RG32UI:
        case GL_RGBA32UI:
        case GL_R32I:
            return TexelKind::integer;
        default:
            return TexelKind::real;
    }
}

bool holds_floats(GLenum format) {
    switch (format) {
        case GL_R8:
        case GL_RG16:
        case GL_RGBA8:
        case GL_RGBA16:
        case GL_SRGB8_ALPHA8:
            return false;
        default:
            return texel_kind(format) != TexelKind::integer;
    }
}

namespace {

// What the driver holds at most; else it would say no more than that a value is invalid.
void require_within_limits(const std::string& name, const TextureDesc& desc) {
    GLint side = 0;
    GLint layers = 0;
    glGetIntegerv(GL_MAX_TEXTURE_SIZE, &side);
    glGetIntegerv(GL_MAX_ARRAY_TEXTURE_LAYERS, &layers);
    if (std::max(desc.width, desc.height) > side || desc.layers > layers) {
        throw Error(
            ExitCode::failed,
            fmt::format("the texture {} would have {}x{} texels in {} layers; this OpenGL driver holds {} "
                        "a side and {} layers: lower --size, --shadow-size or --shadow-samples",
                        name, desc.width, desc.height, std::max(desc.layers, 1), side, layers));
    }
}

}  // namespace

Texture::Texture(const std::string& name, const TextureDesc& desc) : desc_(desc) {
    require_within_limits(name, desc);
    GLuint id = 0;
    if (desc.samples > 0) {
        glCreateTextures(GL_TEXTURE_2D_MULTISAMPLE, 1, &id);
        object_ = Object<delete_texture>(id);
        glTextureStorage2DMultisample(id, desc.samples, desc.format, desc.width, desc.height, GL_TRUE);
    } else {
        const bool array = desc.layers > 0;
        glCreateTextures(array ? GL_TEXTURE_2D_ARRAY : GL_TEXTURE_2D, 1, &id);
        object_ = Object<delete_texture>(id);
        if (array) {
            glTextureStorage3D(id, desc.levels, desc.format, desc.width, desc.height, desc.layers);
        } else {
            glTextureStorage2D(id, desc.levels, desc.format, desc.width, desc.height);
        }
        glTextureParameteri(id, GL_TEXTURE_MIN_FILTER, GL_NEAREST);
        glTextureParameteri(id, GL_TEXTURE_MAG_FILTER, GL_NEAREST);
        glTextureParameteri(id, GL_TEXTURE_WRAP_S, GL_CLAMP_TO_EDGE);
        glTextureParameteri(id, GL_TEXTURE_WRAP_T, GL_CLAMP_TO_EDGE);
    }
    const size_t bytes = storage_bytes(desc);
    throw_on_failed_allocation("the texture " + name, bytes);
    set_label(GL_TEXTURE, id, name);
    allocation_ = Allocation(bytes);
}

void Texture::clear_to_zero() {
    const TexelKind kind = texel_kind(desc_.format);
    const GLenum format = kind == TexelKind::depth     ? GL_DEPTH_COMPONENT
                          : kind == TexelKind::integer ? GL_RED_INTEGER
                                                       : GL_RED;
    const GLenum type = kind == TexelKind::integer ? GL_UNSIGNED_INT : GL_FLOAT;
    for (int level = 0; level < desc_.levels; ++level) {
        glClearTexImage(id(), level, format, type, nullptr);
    }
}

}  // namespace bounce::gl
