// SPDX-License-Identifier: Apache-2.0
#include "gl/buffer.h"

#include <algorithm>
#include <cassert>

#include "gl/debug_output.h"
#include "gl/label.h"

namespace bounce::gl {

Buffer::Buffer(const std::string& name, size_t bytes, GLbitfield flags, const void* data)
    : bytes_(std::max<size_t>(bytes, 4)) {
    GLuint id = 0;
    glCreateBuffers(1, &id);
    object_ = Object<delete_buffer>(id);
    glNamedBufferStorage(id, static_cast<GLsizeiptr>(bytes_), bytes == 0 ? nullptr : data, flags);
    throw_on_failed_allocation("the buffer " + name, bytes_);
    set_label(GL_BUFFER, id, name);
    allocation_ = Allocation(bytes_);
}

void Buffer::update_bytes(const void* data, size_t bytes, size_t offset) {
    assert(offset + bytes <= bytes_);
    if (bytes > 0) {
        glNamedBufferSubData(id(), static_cast<GLintptr>(offset), static_cast<GLsizeiptr>(bytes), data);
    }
}

void Buffer::read_bytes(void* out, size_t bytes, size_t offset) const {
    assert(offset + bytes <= bytes_);
    if (bytes > 0) {
        glGetNamedBufferSubData(id(), static_cast<GLintptr>(offset), static_cast<GLsizeiptr>(bytes), out);
    }
}

void Buffer::clear_to_zero() {
    const GLuint zero = 0;
    glClearNamedBufferData(id(), GL_R32UI, GL_RED_INTEGER, GL_UNSIGNED_INT, &zero);
}

}  // namespace bounce::gl
