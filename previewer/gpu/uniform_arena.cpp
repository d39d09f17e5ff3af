// SPDX-License-Identifier: Apache-2.0
#include "gpu/uniform_arena.h"

#include <algorithm>

namespace bounce::gpu {

UniformArena::UniformArena() {
    GLint alignment = 256;
    glGetIntegerv(GL_UNIFORM_BUFFER_OFFSET_ALIGNMENT, &alignment);
    alignment_ = static_cast<size_t>(std::max(alignment, 16));
}

void UniformArena::upload() {
    if (buffer_.bytes() < data_.size()) {
        buffer_ = gl::Buffer("uniforms", data_.size() * 2, GL_DYNAMIC_STORAGE_BIT);
    }
    if (data_.empty()) {
        return;
    }
    buffer_.update(std::span<const std::byte>(data_));
}

void UniformArena::bind(GLuint binding, Slot slot) const {
    glBindBufferRange(GL_UNIFORM_BUFFER, binding, buffer_.id(), static_cast<GLintptr>(slot.offset),
                      static_cast<GLsizeiptr>(slot.bytes));
}

}  // namespace bounce::gpu
