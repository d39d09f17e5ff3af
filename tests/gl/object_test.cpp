// SPDX-License-Identifier: Apache-2.0
//
// Who owns an OpenGL name, and what the objects promise.
#include <array>
#include <span>
#include <type_traits>
#include <utility>
#include <vector>

#include <gmock/gmock.h>

#include "core/error.h"
#include "gl/buffer.h"
#include "gl/framebuffer.h"
#include "gl/memory.h"
#include "gl/program.h"
#include "gl/texture.h"
#include "gl_context.h"

namespace bounce::gl {
namespace {

using testing::HasSubstr;
using testing::ThrowsMessage;

class GlObjects : public test::GlTest {
  protected:
    static std::vector<Stage> composite() { return {{GL_COMPUTE_SHADER, "passes/composite.comp"}}; }
};

static_assert(!std::is_copy_constructible_v<Buffer> && !std::is_copy_assignable_v<Buffer>);
static_assert(!std::is_copy_constructible_v<Texture> && !std::is_copy_assignable_v<Texture>);
static_assert(!std::is_copy_constructible_v<Program> && !std::is_copy_assignable_v<Program>);
static_assert(!std::is_copy_constructible_v<Framebuffer> && !std::is_copy_assignable_v<Framebuffer>);
static_assert(std::is_nothrow_move_constructible_v<Texture> && std::is_nothrow_move_assignable_v<Texture>);

TEST_F(GlObjects, EmptyObjectsOwnNothing) {
    EXPECT_FALSE(Buffer());
    EXPECT_FALSE(Texture());
    EXPECT_FALSE(Program());
    EXPECT_FALSE(Framebuffer());
}

// Moves a and then lets b go; is_name tells whether the driver still knows the name.
template <typename T, typename IsName>
void check_moves(T a, T b, IsName is_name) {
    const GLuint id_a = a.id();
    const GLuint id_b = b.id();
    T moved(std::move(a));
    EXPECT_EQ(moved.id(), id_a);
    EXPECT_FALSE(a) << "what was moved from owns nothing";  // NOLINT(bugprone-use-after-move)
    EXPECT_TRUE(is_name(id_a));
    moved = std::move(b);
    EXPECT_EQ(moved.id(), id_b);
    EXPECT_FALSE(is_name(id_a)) << "what was assigned over is deleted";
    T& self = moved;
    moved = std::move(self);
    EXPECT_TRUE(is_name(id_b)) << "assignment to itself keeps it";
    { const T gone = std::move(moved); }
    EXPECT_FALSE(is_name(id_b)) << "deleted at the end of its scope";
}

TEST_F(GlObjects, BufferMoves) {
    check_moves(Buffer("a", 16, 0), Buffer("b", 16, 0), [](GLuint id) { return glIsBuffer(id) == GL_TRUE; });
}

TEST_F(GlObjects, TextureMoves) {
    check_moves(Texture("a", {}), Texture("b", {}), [](GLuint id) { return glIsTexture(id) == GL_TRUE; });
}

TEST_F(GlObjects, ProgramMoves) {
    check_moves(Program("a", composite(), {}), Program("b", composite(), {}),
                [](GLuint id) { return glIsProgram(id) == GL_TRUE; });
}

TEST_F(GlObjects, FramebufferMoves) {
    const Texture target("target", {});
    check_moves(Framebuffer("a", {{&target}}), Framebuffer("b", {{&target}}),
                [](GLuint id) { return glIsFramebuffer(id) == GL_TRUE; });
}

TEST_F(GlObjects, BufferKeepsWhatItIsGiven) {
    const std::vector<float> data = {1.0F, 2.0F, 3.0F, 4.0F};
    Buffer buffer = Buffer::of("data", std::span<const float>(data), GL_DYNAMIC_STORAGE_BIT);
    EXPECT_EQ(buffer.bytes(), 16U);
    EXPECT_EQ(buffer.read<float>(4), data);
    const std::array<float, 2> change = {8.0F, 9.0F};
    buffer.update(std::span<const float>(change), 4);
    EXPECT_EQ(buffer.read<float>(4), (std::vector<float>{1.0F, 8.0F, 9.0F, 4.0F}));
    EXPECT_EQ(buffer.read<float>(1, 8), std::vector<float>{9.0F});
    buffer.clear_to_zero();
    EXPECT_EQ(buffer.read<float>(4), std::vector<float>(4, 0.0F));
}

TEST_F(GlObjects, AnEmptyBufferIsStillABuffer) {
    const Buffer buffer = Buffer::of("nothing", std::span<const float>());
    EXPECT_TRUE(buffer);
    EXPECT_EQ(buffer.bytes(), 4U) << "OpenGL refuses a size of 0";
}

TEST_F(GlObjects, TextureStorageIsWhatWasDescribed) {
    const Texture flat("flat", {.format = GL_RGBA16F, .width = 7, .height = 5});
    const Texture array("array", {.format = GL_DEPTH_COMPONENT32F, .width = 8, .height = 8, .layers = 6});
    const Texture samples("samples",
                          {.format = GL_DEPTH_COMPONENT32F, .width = 8, .height = 4, .samples = 4});
    GLint value = 0;
    glGetTextureLevelParameteriv(flat.id(), 0, GL_TEXTURE_WIDTH, &value);
    EXPECT_EQ(value, 7);
    glGetTextureLevelParameteriv(flat.id(), 0, GL_TEXTURE_INTERNAL_FORMAT, &value);
    EXPECT_EQ(value, GL_RGBA16F);
    glGetTextureParameteriv(flat.id(), GL_TEXTURE_MIN_FILTER, &value);
    EXPECT_EQ(value, GL_NEAREST);
    glGetTextureLevelParameteriv(array.id(), 0, GL_TEXTURE_DEPTH, &value);
    EXPECT_EQ(value, 6);
    glGetTextureLevelParameteriv(samples.id(), 0, GL_TEXTURE_SAMPLES, &value);
    EXPECT_EQ(value, 4);
}

TEST_F(GlObjects, MemoryIsCountedWithLayersAndLevels) {
    const size_t before = allocated_bytes();
    const Texture array("array", {.format = GL_RGBA16F, .width = 8, .height = 4, .layers = 3});
    EXPECT_EQ(allocated_bytes() - before, 8U * 8 * 4 * 3);
    const Texture levels("levels", {.format = GL_RGBA8, .width = 4, .height = 2, .levels = 3});
    EXPECT_EQ(allocated_bytes() - before, 768U + 4U * (8 + 2 + 1));
    const Buffer buffer("buffer", 100, 0);
    EXPECT_EQ(allocated_bytes() - before, 768U + 44U + 100U);
    const Texture samples("samples", {.format = GL_R32F, .width = 4, .height = 2, .samples = 4});
    EXPECT_EQ(allocated_bytes() - before, 768U + 44U + 100U + 4U * 8 * 4);
}

TEST_F(GlObjects, AFramebufferThatCannotBeDrawnToIsRefusedByName) {
    const Texture depth("depth", {.format = GL_DEPTH_COMPONENT32F});
    EXPECT_THAT([&] { const Framebuffer wrong("the G-buffer", {{&depth}}); },
                ThrowsMessage<Error>(HasSubstr("the G-buffer")));
}

TEST_F(GlObjects, AProgramCompiledTwiceIsKeptOnce) {
    ProgramCache cache;
    const Program& plain = cache.compute("passes/composite.comp");
    EXPECT_EQ(cache.compute("passes/composite.comp").id(), plain.id());
    const GLuint first = plain.id();
    EXPECT_NE(cache.compute("passes/composite.comp", {{"WORLD", "1"}}).id(), first);
    EXPECT_EQ(cache.size(), 2U);
    EXPECT_EQ(cache.compute("passes/composite.comp").id(), first) << "still valid after the cache grew";
    cache.clear();
    EXPECT_EQ(cache.size(), 0U);
    EXPECT_EQ(glIsProgram(first), GL_FALSE);
}

}  // namespace
}  // namespace bounce::gl
