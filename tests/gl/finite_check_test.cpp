// SPDX-License-Identifier: Apache-2.0
//
// What passes leave that is not finite is found, and the first pass that left it is named.
#include "passes/finite_check.h"

#include <array>
#include <cmath>
#include <limits>
#include <vector>

#include <gmock/gmock.h>

#include "gl_context.h"

namespace bounce::passes {
namespace {

using testing::AllOf;
using testing::HasSubstr;

constexpr float k_nan = std::numeric_limits<float>::quiet_NaN();
constexpr float k_infinite = std::numeric_limits<float>::infinity();

class FiniteCheckTest : public test::GlTest {
  protected:
    static gl::Texture filled(const gl::TextureDesc& desc, float value) {
        gl::Texture texture("texture", desc);
        const bool depth = gl::texel_kind(desc.format) == gl::TexelKind::depth;
        const std::array<float, 4> texel = {value, value, value, value};
        for (int level = 0; level < desc.levels; ++level) {
            glClearTexImage(texture.id(), level, depth ? GL_DEPTH_COMPONENT : GL_RGBA, GL_FLOAT, texel.data());
        }
        return texture;
    }
    static void put(const gl::Texture& texture, int level, const glm::ivec3& at, const std::array<float, 4>& value) {
        glClearTexSubImage(texture.id(), level, at.x, at.y, at.z, 1, 1, 1, GL_RGBA, GL_FLOAT, value.data());
    }
    gl::ProgramCache programs_;
    FiniteCheck check_{programs_, 100, 40};
};

TEST_F(FiniteCheckTest, FiniteTexturesOfEveryKindHaveNoFault) {
    for (const gl::TextureDesc& desc : {gl::TextureDesc{.format = GL_RGBA32F, .width = 100, .height = 40},
                                        gl::TextureDesc{.format = GL_R16F, .width = 7, .height = 3, .layers = 6},
                                        gl::TextureDesc{.format = GL_RGBA16F, .width = 8, .height = 8, .levels = 3},
                                        gl::TextureDesc{.format = GL_DEPTH_COMPONENT32F, .width = 9, .height = 9},
                                        gl::TextureDesc{.format = GL_RGBA8, .width = 9, .height = 9}}) {
        check_.wrote("pass", "texture", filled(desc, 0.5F), {});
    }
    EXPECT_EQ(check_.fault(), "");
}

TEST_F(FiniteCheckTest, NamesPassTextureAndPixelFromTheTopLeft) {
    const gl::Texture good = filled({.format = GL_RGBA32F, .width = 100, .height = 40}, 1.0F);
    const gl::Texture bad = filled({.format = GL_RGBA32F, .width = 100, .height = 40}, 1.0F);
    put(bad, 0, {93, 35, 0}, {1.0F, k_nan, 1.0F, 1.0F});
    put(bad, 0, {2, 39, 0}, {1.0F, k_nan, 1.0F, k_infinite});
    check_.wrote("first", "good", good, {});
    check_.wrote("second", "bad", bad, {});
    check_.wrote("third", "bad again", bad, {});
    EXPECT_EQ(check_.fault(),
              "pass second wrote NaN into bad at pixel (93, 4) first; 2 values of it are NaN and 1 infinite");
}

TEST_F(FiniteCheckTest, LooksAtLayersLevelsHalvesAndInfinities) {
    const gl::Texture layers = filled({.format = GL_RGBA16F, .width = 32, .height = 64, .layers = 6, .levels = 2}, 1.0F);
    put(layers, 1, {15, 31, 5}, {k_infinite, 0.0F, 0.0F, 0.0F});
    check_.wrote("pass", "layers", layers, {});
    EXPECT_THAT(check_.fault(), AllOf(HasSubstr("wrote an infinite value into layers"),
                                      HasSubstr("texel (15, 31) of layer 5 of level 1 of 16x32")));
}

TEST_F(FiniteCheckTest, LooksIntoWholeNumbersThatHoldFloats) {
    const gl::Texture packed("packed", {.format = GL_RGBA32UI, .width = 3, .height = 2});
    const std::array<GLuint, 4> finite = {0x3c003c00U, 0x7bffU, 0x7c00U << 16U, 0x3f800000U};
    glClearTexImage(packed.id(), 0, GL_RGBA_INTEGER, GL_UNSIGNED_INT, finite.data());
    const PackedFloats words{.floats = 0x8U, .halves = 0x17U};  // all halves but the upper of y and of z
    check_.wrote("pass", "packed", packed, words);
    EXPECT_EQ(check_.fault(), "") << "what is no float may have any bits";
    const std::array<GLuint, 4> half_nan = {0x7e003c00U, 0, 0, 0};
    glClearTexSubImage(packed.id(), 0, 1, 1, 0, 1, 1, 1, GL_RGBA_INTEGER, GL_UNSIGNED_INT, half_nan.data());
    check_.wrote("pass", "packed", packed, words);
    EXPECT_THAT(check_.fault(), AllOf(HasSubstr("NaN into packed"), HasSubstr("(1, 1)")));
}

TEST_F(FiniteCheckTest, LooksAtTheFloatsOfBuffersOnly) {
    std::vector<float> words(64 * 1000, 1.0F);
    words[5 * 32 + 15] = k_nan;  // no float: bit 15 of the element's words is not set
    const auto look = [&](const FloatWords& layout) {
        FiniteCheck check(programs_, 100, 40);
        check.wrote("pass", "buffer", gl::Buffer::of("buffer", std::span<const float>(words)), layout);
        return check.fault();
    };
    EXPECT_EQ(look({}), "") << "nothing is known of it";
    EXPECT_EQ(look({32, 0xffff7fffU}), "");
    words[1999 * 32 + 31] = k_nan;
    EXPECT_THAT(look({32, 0xffff7fffU}), AllOf(HasSubstr("element 1999"), HasSubstr("1 values of it are NaN")));
    EXPECT_THAT(look({40, uint64_t{1} << 39U}), testing::IsEmpty());
    words[40 * 7 + 39] = -k_infinite;
    EXPECT_THAT(look({40, uint64_t{1} << 39U}), HasSubstr("element 7"));
}

TEST_F(FiniteCheckTest, TheGraphTellsOfWhatPassesWriteAndZerosWhatTheyDoNot) {
    TransientPool pool;
    constexpr gl::TextureDesc desc{.format = GL_RGBA32F, .width = 4, .height = 4};
    pool.release(filled(desc, k_nan));  // what the last frame left
    gl::PassTimer timer(gl::TimingMode::off);
    const auto frame = [&](float value) {
        FrameGraph graph(pool);
        TextureHandle made;
        graph.add_pass("make", [&](PassBuilder& builder) {
            made = builder.create_texture("made", desc);
            return [](const PassResources&) {};  // writes none of it
        });
        graph.add_pass("change", [&](PassBuilder& builder) {
            made = builder.write(made);
            builder.side_effect();
            return [made, value](const PassResources& resources) {
                put(resources.texture(made), 0, {1, 2, 0}, {value, 0.0F, 0.0F, 0.0F});
            };
        });
        FiniteCheck check(programs_, 4, 4);
        graph.execute(timer, nullptr, &check);
        return check.fault();
    };
    EXPECT_EQ(frame(1.0F), "");
    EXPECT_THAT(frame(k_nan), HasSubstr("pass change wrote NaN into made at pixel (1, 1)"));
}

}  // namespace
}  // namespace bounce::passes
