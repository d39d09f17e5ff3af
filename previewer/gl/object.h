// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <utility>

#include <epoxy/gl.h>

namespace bounce::gl {

// Owns one OpenGL name; move-only. Delete is called with the name, never with 0.
template <auto Delete>
class Object {
  public:
    Object() = default;
    explicit Object(GLuint id) : id_(id) {}
    ~Object() { reset(); }
    Object(const Object&) = delete;
    Object& operator=(const Object&) = delete;
    Object(Object&& other) noexcept : id_(std::exchange(other.id_, 0)) {}
    Object& operator=(Object&& other) noexcept {
        if (this != &other) {
            reset();
            id_ = std::exchange(other.id_, 0);
        }
        return *this;
    }
    [[nodiscard]] GLuint id() const { return id_; }
    [[nodiscard]] explicit operator bool() const { return id_ != 0; }

  private:
    void reset() {
        if (id_ != 0) {
            Delete(id_);
            id_ = 0;
        }
    }
    GLuint id_ = 0;
};

}  // namespace bounce::gl
