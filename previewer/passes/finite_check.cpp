// SPDX-License-Identifier: Apache-2.0
#include "passes/finite_check.h"

#include <algorithm>
#include <array>
#include <span>
#include <utility>

#include <fmt/format.h>

#include "gpu/shared_types.h"

namespace bounce::passes {
namespace {

// Textures' levels and buffers that are searched before what was found is read back; a frame has some tens.
constexpr size_t k_slots = 1024;

struct Found {
    uint32_t nan = 0;
    uint32_t infinite = 0;
    uint32_t first_nan = 0xffffffffU;
    uint32_t first_infinite = 0xffffffffU;
};

// Passes find the bindings as those before them left them.
class RestoredStorage {
  public:
    explicit RestoredStorage(GLuint binding) : binding_(binding) {
        glGetIntegeri_v(GL_SHADER_STORAGE_BUFFER_BINDING, binding, &buffer_);
        glGetInteger64i_v(GL_SHADER_STORAGE_BUFFER_START, binding, &start_);
        glGetInteger64i_v(GL_SHADER_STORAGE_BUFFER_SIZE, binding, &size_);
    }
    ~RestoredStorage() {
        const auto buffer = static_cast<GLuint>(buffer_);
        if (size_ > 0) {
            glBindBufferRange(GL_SHADER_STORAGE_BUFFER, binding_, buffer, static_cast<GLintptr>(start_),
                              static_cast<GLsizeiptr>(size_));
        } else {
            glBindBufferBase(GL_SHADER_STORAGE_BUFFER, binding_, buffer);
        }
    }
    RestoredStorage(const RestoredStorage&) = delete;
    RestoredStorage& operator=(const RestoredStorage&) = delete;
    RestoredStorage(RestoredStorage&&) = delete;
    RestoredStorage& operator=(RestoredStorage&&) = delete;

  private:
    GLuint binding_;
    GLint buffer_ = 0;
    GLint64 start_ = 0;
    GLint64 size_ = 0;
};

GLuint groups(int count, int group) {
    return static_cast<GLuint>((count + group - 1) / group);
}

}  // namespace

FiniteCheck::FiniteCheck(gl::ProgramCache& programs, int width, int height)
    : programs_(programs), width_(width), height_(height) {}

GLuint FiniteCheck::next_slot(Looked looked) {
    if (looked_.size() == k_slots) {
        collect();
    }
    if (!found_) {
        found_ = gl::Buffer("not finite", k_slots * sizeof(Found), GL_DYNAMIC_STORAGE_BIT);
    }
    if (looked_.empty()) {
        const std::vector<Found> nothing(k_slots);
        found_.update(std::span<const Found>(nothing));
    }
    looked_.push_back(std::move(looked));
    return static_cast<GLuint>(looked_.size() - 1);
}

void FiniteCheck::wrote(const std::string& pass, const std::string& resource, const gl::Texture& texture,
                        const PackedFloats& packed) {
    const gl::TextureDesc& desc = texture.desc();
    const bool real = gl::holds_floats(desc.format);
    if (!real && !packed.any()) {
        return;
    }
    gl::Defines defines{{"TEXTURE", "1"}};
    if (!real) defines["PACKED"] = "1";
    if (desc.layers > 0) defines["LAYERED"] = "1";
    if (desc.samples > 0) defines["SAMPLES"] = "1";
    glMemoryBarrier(GL_TEXTURE_FETCH_BARRIER_BIT);
    const RestoredStorage restored(SSBO_NOT_FINITE);
    for (int level = 0; level < desc.levels; ++level) {
        const int width = std::max(desc.width >> level, 1);
        const int height = std::max(desc.height >> level, 1);
        const GLuint slot =
            next_slot({pass, resource, width, height, level, desc.layers > 0 || desc.samples > 0});
        programs_.compute("passes/finite_check.comp", defines).use();
        found_.bind_storage(SSBO_NOT_FINITE);
        texture.bind(TEX_CHECKED);
        glUniform4i(0, width, height, level, static_cast<GLint>(slot));
        if (!real) {
            glUniform2ui(1, packed.floats, packed.halves);
        }
        glDispatchCompute(groups(width, GROUP_2D), groups(height, GROUP_2D * CHECKED_ROWS),
                          static_cast<GLuint>(std::max({desc.layers, desc.samples, 1})));
    }
    glBindTextureUnit(TEX_CHECKED, 0);
}

void FiniteCheck::wrote(const std::string& pass, const std::string& resource, const gl::Buffer& buffer,
                        const FloatWords& words) {
    if (words.stride == 0) {
        return;
    }
    glMemoryBarrier(GL_SHADER_STORAGE_BARRIER_BIT);
    const RestoredStorage restored(SSBO_NOT_FINITE);
    const RestoredStorage restored_checked(SSBO_CHECKED);
    const GLuint slot = next_slot({.pass = pass, .resource = resource});
    programs_.compute("passes/finite_check.comp").use();
    found_.bind_storage(SSBO_NOT_FINITE);
    buffer.bind_storage(SSBO_CHECKED);
    const size_t count = buffer.bytes() / sizeof(uint32_t);
    glUniform4ui(0, static_cast<GLuint>(count), static_cast<GLuint>(words.stride), slot, 0);
    glUniform2ui(1, static_cast<GLuint>(words.floats), static_cast<GLuint>(words.floats >> 32U));
    const size_t wanted = (count + GROUP_1D - 1) / GROUP_1D;
    glDispatchCompute(static_cast<GLuint>(std::min<size_t>(wanted, MOST_GROUPS)), 1, 1);
}

std::string FiniteCheck::place(const Looked& looked, uint32_t first) const {
    if (looked.width == 0) {
        return fmt::format("element {}", first);
    }
    const auto width = static_cast<uint32_t>(looked.width);
    const auto height = static_cast<uint32_t>(looked.height);
    const uint32_t x = first % width;
    const uint32_t y = first / width % height;
    if (looked.width == width_ && looked.height == height_) {
        return fmt::format("pixel ({}, {})", x, height - 1 - y);
    }
    return fmt::format("texel ({}, {}){}{} of {}x{}", x, y,
                       looked.layered ? fmt::format(" of layer {}", first / width / height) : std::string(),
                       looked.level > 0 ? fmt::format(" of level {}", looked.level) : std::string(),
                       looked.width, looked.height);
}

void FiniteCheck::collect() {
    if (looked_.empty()) {
        return;
    }
    glMemoryBarrier(GL_BUFFER_UPDATE_BARRIER_BIT);
    const std::vector<Found> found = found_.read<Found>(looked_.size());
    for (size_t slot = 0; slot < looked_.size() && fault_.empty(); ++slot) {
        const Found& of = found[slot];
        if (of.nan == 0 && of.infinite == 0) {
            continue;
        }
        const bool nan = of.nan > 0;
        fault_ =
            fmt::format("pass {} wrote {} into {} at {} first; {} values of it are NaN and {} infinite",
                        looked_[slot].pass, nan ? "NaN" : "an infinite value", looked_[slot].resource,
                        place(looked_[slot], nan ? of.first_nan : of.first_infinite), of.nan, of.infinite);
    }
    looked_.clear();
}

std::string FiniteCheck::fault() {
    collect();
    return fault_;
}

}  // namespace bounce::passes
