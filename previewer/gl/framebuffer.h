// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <initializer_list>
#include <string>

#include "gl/object.h"
#include "gl/texture.h"

namespace bounce::gl {

inline void delete_framebuffer(GLuint id) {
    glDeleteFramebuffers(1, &id);
}

// Where a raster pass draws: a texture, or one layer of an array.
struct Attachment {
    const Texture* texture = nullptr;
    int layer = -1;  // -1: a 2D texture, whole
};

class Framebuffer {
  public:
    Framebuffer() = default;
    // Throws Error(failed) where the driver cannot draw to this combination.
    Framebuffer(const std::string& name, std::initializer_list<Attachment> colors, Attachment depth = {});

    // Binds it and sets the viewport to the attachments' size.
    void bind() const;
    [[nodiscard]] GLuint id() const { return object_.id(); }
    [[nodiscard]] explicit operator bool() const { return static_cast<bool>(object_); }

  private:
    Object<delete_framebuffer> object_;
    int width_ = 0;
    int height_ = 0;
};

}  // namespace bounce::gl
