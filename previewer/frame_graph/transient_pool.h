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
    // Where off, what a pass no longer needs is freed at once, so that other passes' textures of any kind
    // take its memory; they are then made anew in each frame.
    void hold_idle(bool hold);
    [[nodiscard]] gl::Texture acquire_texture(const std::string& name, const gl::TextureDesc& desc);
    void release(gl::Texture texture);
    [[nodiscard]] gl::Buffer acquire_buffer(const std::string& name, size_t bytes);
    void release(gl::Buffer buffer);

    // A framebuffer over these attachments, made once. Valid until end_frame() or clear().
    const gl::Framebuffer& framebuffer(const std::string& name, std::initializer_list<gl::Attachment> colors,
                                       gl::Attachment depth = {});

    // Call between frames: drops what the last frames did not use, so that a change of settings does not keep
    // the old sizes for ever.
    void end_frame();
    // Drops everything; for a change of size.
    void clear();
    // Of what is idle.
    [[nodiscard]] size_t bytes() const;

  private:
    template <typename T>
    struct Idle {
        T resource;
        int since_frame = 0;
    };
    std::vector<Idle<gl::Texture>> textures_;
    std::vector<Idle<gl::Buffer>> buffers_;
    bool hold_ = true;
    int frame_ = 0;
    std::map<std::vector<int>, gl::Framebuffer> framebuffers_;
};

}  // namespace bounce
