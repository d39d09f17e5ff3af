// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <vector>

#include "gl/memory.h"
#include "gl/object.h"

namespace bounce::gl {

inline void delete_buffer(GLuint id) {
    glDeleteBuffers(1, &id);
}

// A buffer of fixed size. OpenGL refuses empty buffers, so a size of 0 allocates 4 bytes.
class Buffer {
  public:
    Buffer() = default;
    // flags: of glNamedBufferStorage (GL_DYNAMIC_STORAGE_BIT where update() is to be called).
    Buffer(const std::string& name, size_t bytes, GLbitfield flags, const void* data = nullptr);

    template <typename T>
    static Buffer of(const std::string& name, std::span<const T> data, GLbitfield flags = 0) {
        return Buffer(name, data.size_bytes(), flags, data.empty() ? nullptr : data.data());
    }

    template <typename T>
    void update(std::span<const T> data, size_t byte_offset = 0) {
        update_bytes(data.data(), data.size_bytes(), byte_offset);
    }
    template <typename T>
    [[nodiscard]] std::vector<T> read(size_t count, size_t byte_offset = 0) const {
        std::vector<T> out(count);
        read_bytes(out.data(), count * sizeof(T), byte_offset);
        return out;
    }
    void clear_to_zero();
    void bind_storage(GLuint binding) const { glBindBufferBase(GL_SHADER_STORAGE_BUFFER, binding, id()); }
    void bind_uniform(GLuint binding) const { glBindBufferBase(GL_UNIFORM_BUFFER, binding, id()); }
    [[nodiscard]] GLuint id() const { return object_.id(); }
    [[nodiscard]] size_t bytes() const { return bytes_; }
    [[nodiscard]] explicit operator bool() const { return static_cast<bool>(object_); }

  private:
    void update_bytes(const void* data, size_t bytes, size_t offset);
    void read_bytes(void* out, size_t bytes, size_t offset) const;

    Object<delete_buffer> object_;
    Allocation allocation_;
    size_t bytes_ = 0;
};

}  // namespace bounce::gl
