// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <map>
#include <string>
#include <vector>

#include "gl/buffer.h"
#include "gl/framebuffer.h"
#include "gl/texture.h"

namespace bounce {

// Textures and buffers that live for part of a frame, reused within the frame and by the next ones;
// and the framebuffers made of them.
class TransientPool {
  public:
    [[nodiscard]] gl::Texture acquire_texture(const std::string& name, const gl::TextureDesc& desc);
    void release(gl::Texture texture);
    [[nodiscard]] gl::Buffer acquire_buffer(const std::string& name, size_t bytes);
    void release(gl::Buffer buffer);

    // A framebuffer over these attachments, made once. Valid until clear().
    const gl::Framebuffer& framebuffer(const std::string& name, std::initializer_list<gl::Attachment> colors,
                                       gl::Attachment depth = {});

    // Drops everything; for a change of size.
    void clear();

  private:
    std::vector<gl::Texture> textures_;
    std::vector<gl::Buffer> buffers_;
    std::map<std::vector<int>, gl::Framebuffer> framebuffers_;
};

}  // namespace bounce
