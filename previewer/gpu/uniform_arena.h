// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstring>
#include <span>
#include <vector>

#include "gl/buffer.h"

namespace bounce::gpu {

// One frame's uniform blocks in one buffer: add() while the frame is set up, upload() once, bind() a slot
// before a draw.
class UniformArena {
  public:
    struct Slot {
        size_t offset = 0;
        size_t bytes = 0;
    };

    UniformArena();
    void clear() { data_.clear(); }

    template <typename T>
    [[nodiscard]] Slot add(const T& block) {
        const Slot slot{data_.size(), sizeof(T)};
        const size_t padded = (sizeof(T) + alignment_ - 1) / alignment_ * alignment_;
        data_.resize(data_.size() + padded);
        std::memcpy(data_.data() + slot.offset, &block, sizeof(T));
        return slot;
    }
    // What was added there.
    [[nodiscard]] std::span<const std::byte> bytes(Slot slot) const {
        return std::span(data_).subspan(slot.offset, slot.bytes);
    }
    void upload();
    void bind(GLuint binding, Slot slot) const;

  private:
    size_t alignment_;
    std::vector<std::byte> data_;
    gl::Buffer buffer_;
};

}  // namespace bounce::gpu
