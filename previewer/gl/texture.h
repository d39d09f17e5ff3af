// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "gl/memory.h"
#include "gl/object.h"

namespace bounce::gl {

inline void delete_texture(GLuint id) {
    glDeleteTextures(1, &id);
}

// What a texture is; equal descriptions are interchangeable in the transient pool.
struct TextureDesc {
    GLenum format = GL_RGBA32F;
    int width = 1;
    int height = 1;
    int layers = 0;  // 0: a 2D texture; more: an array
    int levels = 1;
    int samples = 0;  // more: a 2D texture of so many samples a texel, without layers or levels
    friend bool operator==(const TextureDesc&, const TextureDesc&) = default;
};

[[nodiscard]] size_t bytes_per_texel(GLenum format);
// Of all levels, layers and samples; the driver's own overhead is not in it.
[[nodiscard]] size_t storage_bytes(const TextureDesc& desc);

// How texels are read and cleared: as depths, as whole numbers or as values with a fraction.
enum class TexelKind { depth, integer, real };
[[nodiscard]] TexelKind texel_kind(GLenum format);
// Real texels that can hold something that is not finite.
[[nodiscard]] bool holds_floats(GLenum format);

// Immutable storage. Sampling is nearest and clamps to the edge.
class Texture {
  public:
    Texture() = default;
    Texture(const std::string& name, const TextureDesc& desc);

    [[nodiscard]] GLuint id() const { return object_.id(); }
    [[nodiscard]] const TextureDesc& desc() const { return desc_; }
    [[nodiscard]] size_t bytes() const { return storage_bytes(desc_); }
    [[nodiscard]] explicit operator bool() const { return static_cast<bool>(object_); }
    void bind(GLuint unit) const { glBindTextureUnit(unit, id()); }
    void bind_image(GLuint unit, GLenum access) const {
        glBindImageTexture(unit, id(), 0, desc_.layers > 0 ? GL_TRUE : GL_FALSE, 0, access, desc_.format);
    }

    void clear_to_zero();

  private:
    Object<delete_texture> object_;
    Allocation allocation_;
    TextureDesc desc_;
};

}  // namespace bounce::gl
