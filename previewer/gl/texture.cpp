// SPDX-License-Identifier: Apache-2.0
#include "gl/texture.h"

#include <algorithm>

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

Texture::Texture(const std::string& name, const TextureDesc& desc) : desc_(desc) {
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
    set_label(GL_TEXTURE, id, name);
    allocation_ = Allocation(storage_bytes(desc));
}

}  // namespace bounce::gl
