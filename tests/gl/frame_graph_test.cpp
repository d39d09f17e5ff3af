// SPDX-License-Identifier: Apache-2.0
//
// The frame graph on OpenGL: what runs, what passes may touch, what they share, how they fail.
#include "frame_graph/frame_graph.h"

#include <array>
#include <stdexcept>
#include <string>
#include <vector>

#include <gmock/gmock.h>

#include "core/error.h"
#include "gl_context.h"

namespace bounce {
namespace {

using testing::AllOf;
using testing::HasSubstr;
using testing::ThrowsMessage;
using Names = std::vector<std::string>;

constexpr gl::TextureDesc k_desc{.format = GL_RGBA32F, .width = 4, .height = 4};

class FrameGraphOnGl : public test::GlTest {
  protected:
    // A pass that makes a texture and fills it with `value`.
    TextureHandle fill(FrameGraph& graph, const std::string& name, float value, GLuint* id = nullptr,
                       const gl::TextureDesc& desc = k_desc) {
        TextureHandle made;
        graph.add_pass(name, [&](PassBuilder& builder) {
            made = builder.create_texture(name, desc);
            return [made, value, id](const PassResources& resources) {
                const gl::Texture& texture = resources.texture(made);
                const std::array<float, 4> texel = {value, value, value, value};
                glClearTexImage(texture.id(), 0, GL_RGBA, GL_FLOAT, texel.data());
                if (id != nullptr) {
                    *id = texture.id();
                }
            };
        });
        return made;
    }
    // A pass that runs and keeps the first texel of what it reads.
    void look(FrameGraph& graph, const std::string& name, TextureHandle handle, float* seen = nullptr) {
        graph.add_pass(name, [&](PassBuilder& builder) {
            builder.read(handle);
            builder.side_effect();
            return [handle, seen](const PassResources& resources) {
                std::array<float, 64> texels{};
                glGetTextureImage(resources.texture(handle).id(), 0, GL_RGBA, GL_FLOAT, sizeof texels,
                                  texels.data());
                if (seen != nullptr) {
                    *seen = texels[0];
                }
            };
        });
    }
    TransientPool pool_;
    gl::PassTimer timer_{gl::TimingMode::off};
};

TEST_F(FrameGraphOnGl, PassesRunInTheOrderTheyWereAddedAndUnreadOnesNotAtAll) {
    FrameGraph graph(pool_);
    float seen = 0.0F;
    GLuint unread = 0;
    const TextureHandle a = fill(graph, "fill", 3.0F);
    fill(graph, "unread", 5.0F, &unread);
    look(graph, "look", a, &seen);
    graph.execute(timer_);
    EXPECT_EQ(graph.executed(), (Names{"fill", "look"}));
    EXPECT_EQ(graph.culled(), Names{"unread"});
    EXPECT_EQ(seen, 3.0F);
    EXPECT_EQ(unread, 0U) << "a culled pass does not run";
}

TEST_F(FrameGraphOnGl, WritingAnImportedTextureIsASideEffect) {
    const gl::Texture picture("picture", k_desc);
    FrameGraph graph(pool_);
    const TextureHandle target = graph.import_texture("picture", picture);
    GLuint id = 0;
    graph.add_pass("draw", [&](PassBuilder& builder) {
        const TextureHandle out = builder.write(target);
        return [out, &id](const PassResources& resources) { id = resources.texture(out).id(); };
    });
    graph.add_pass("only looks", [&](PassBuilder& builder) {
        const TextureHandle made = builder.create_texture("unread", k_desc);
        return [made](const PassResources&) {};
    });
    graph.execute(timer_);
    EXPECT_EQ(graph.executed(), Names{"draw"});
    EXPECT_EQ(id, picture.id());
}

TEST_F(FrameGraphOnGl, UndeclaredTextureIsRefusedByPassAndResource) {
    FrameGraph graph(pool_);
    const TextureHandle secret = fill(graph, "secret map", 1.0F);
    look(graph, "look", secret);
    graph.add_pass("thief", [&](PassBuilder& builder) {
        builder.side_effect();
        return [secret](const PassResources& resources) { (void)resources.texture(secret); };
    });
    EXPECT_THAT([&] { graph.execute(timer_); },
                ThrowsMessage<std::logic_error>(AllOf(HasSubstr("thief"), HasSubstr("secret map"))));
}

TEST_F(FrameGraphOnGl, UndeclaredBufferIsRefusedByPassAndResource) {
    FrameGraph graph(pool_);
    BufferHandle list;
    graph.add_pass("make", [&](PassBuilder& builder) {
        list = builder.create_buffer("pixel list", 64);
        builder.side_effect();
        return [](const PassResources&) {};
    });
    graph.add_pass("thief", [&](PassBuilder& builder) {
        builder.side_effect();
        return [list](const PassResources& resources) { (void)resources.buffer(list); };
    });
    EXPECT_THAT([&] { graph.execute(timer_); },
                ThrowsMessage<std::logic_error>(AllOf(HasSubstr("thief"), HasSubstr("pixel list"))));
}

TEST_F(FrameGraphOnGl, AnInvalidHandleIsRefusedByPass) {
    FrameGraph graph(pool_);
    graph.add_pass("careless", [&](PassBuilder& builder) {
        builder.side_effect();
        return [](const PassResources& resources) { (void)resources.texture({}); };
    });
    EXPECT_THAT([&] { graph.execute(timer_); }, ThrowsMessage<std::logic_error>(HasSubstr("careless")));
}

TEST_F(FrameGraphOnGl, TexturesShareMemoryWhereTheirLivesDoNotMeet) {
    FrameGraph graph(pool_);
    GLuint first = 0;
    GLuint second = 0;
    look(graph, "look 1", fill(graph, "fill 1", 1.0F, &first));
    look(graph, "look 2", fill(graph, "fill 2", 2.0F, &second));
    graph.execute(timer_);
    EXPECT_NE(first, 0U);
    EXPECT_EQ(first, second);
}

TEST_F(FrameGraphOnGl, TexturesDoNotShareWhileBothAreNeeded) {
    FrameGraph graph(pool_);
    GLuint first = 0;
    GLuint second = 0;
    float seen = 0.0F;
    const TextureHandle a = fill(graph, "fill 1", 1.0F, &first);
    const TextureHandle b = fill(graph, "fill 2", 2.0F, &second);
    look(graph, "look 2", b);
    look(graph, "look 1", a, &seen);
    graph.execute(timer_);
    EXPECT_NE(first, second);
    EXPECT_EQ(seen, 1.0F);
}

TEST_F(FrameGraphOnGl, TexturesOfAnotherKindAreNotShared) {
    FrameGraph graph(pool_);
    GLuint first = 0;
    GLuint second = 0;
    gl::TextureDesc other = k_desc;
    other.format = GL_RGBA16F;
    look(graph, "look 1", fill(graph, "fill 1", 1.0F, &first));
    look(graph, "look 2", fill(graph, "fill 2", 2.0F, &second, other));
    graph.execute(timer_);
    EXPECT_NE(first, second);
}

TEST_F(FrameGraphOnGl, TheNextFrameReusesWhatTheLastOneHad) {
    std::array<GLuint, 2> ids{};
    for (GLuint& id : ids) {
        FrameGraph graph(pool_);
        look(graph, "look", fill(graph, "fill", 1.0F, &id));
        graph.execute(timer_);
    }
    EXPECT_EQ(ids[0], ids[1]);
    pool_.clear();
}

TEST_F(FrameGraphOnGl, EachVersionIsSeenByThePassesBetweenItsWriters) {
    FrameGraph graph(pool_);
    float before = 0.0F;
    float after = 0.0F;
    const TextureHandle v0 = fill(graph, "fill", 1.0F);
    look(graph, "before", v0, &before);
    TextureHandle v1;
    graph.add_pass("change", [&](PassBuilder& builder) {
        v1 = builder.write(v0);
        return [v1](const PassResources& resources) {
            const std::array<float, 4> two = {2.0F, 2.0F, 2.0F, 2.0F};
            glClearTexImage(resources.texture(v1).id(), 0, GL_RGBA, GL_FLOAT, two.data());
        };
    });
    look(graph, "after", v1, &after);
    graph.execute(timer_);
    EXPECT_EQ(before, 1.0F);
    EXPECT_EQ(after, 2.0F);
    EXPECT_EQ(graph.executed(), (Names{"fill", "before", "change", "after"}));
}

TEST_F(FrameGraphOnGl, AnOpenGlErrorIsThrownWithThePassesName) {
    FrameGraph graph(pool_);
    graph.add_pass("faulty pass", [&](PassBuilder& builder) {
        builder.side_effect();
        return [](const PassResources&) { glBindBufferBase(GL_ARRAY_BUFFER, 0, 0); };  // no indexed target
    });
    EXPECT_THAT([&] { graph.execute(timer_); }, ThrowsMessage<Error>(HasSubstr("faulty pass")));
}

TEST_F(FrameGraphOnGl, AFrameAfterAFailedOneDrawsWhole) {
    // The failed frame's textures go back to the pool; were they deleted, the framebuffers kept there would
    // stand for names that the next frame gets again.
    GLuint id = 0;
    const auto frame = [&](bool fail) {
        FrameGraph graph(pool_);
        TextureHandle made;
        float seen = 0.0F;
        graph.add_pass("draw", [&](PassBuilder& builder) {
            made = builder.create_texture("target", k_desc);
            return [made, fail, &id](const PassResources& resources) {
                id = resources.texture(made).id();
                const gl::Framebuffer& target = resources.framebuffer({{&resources.texture(made)}});
                const std::array<float, 4> seven = {7.0F, 7.0F, 7.0F, 7.0F};
                glClearNamedFramebufferfv(target.id(), GL_COLOR, 0, seven.data());
                if (fail) {
                    throw Error(ExitCode::failed, "a shader that does not compile");
                }
            };
        });
        look(graph, "look", made, &seen);
        graph.execute(timer_);
        return seen;
    };
    EXPECT_THROW(frame(true), Error);
    const GLuint first = id;
    EXPECT_EQ(glIsTexture(first), GL_TRUE);
    EXPECT_EQ(frame(false), 7.0F);
    EXPECT_EQ(id, first);
}

TEST_F(FrameGraphOnGl, AFailedPassEndsItsTimer) {
    // A query left open would make every later frame's first pass an error.
    gl::PassTimer timer(gl::TimingMode::query);
    FrameGraph failing(pool_);
    failing.add_pass("fails", [&](PassBuilder& builder) {
        builder.side_effect();
        return [](const PassResources&) { throw Error(ExitCode::failed, "no"); };
    });
    EXPECT_THROW(failing.execute(timer), Error);
    FrameGraph next(pool_);
    float seen = 0.0F;
    gl::PassTimer next_timer(gl::TimingMode::query);
    look(next, "look", fill(next, "fill", 4.0F), &seen);
    EXPECT_NO_THROW(next.execute(next_timer));
    EXPECT_EQ(seen, 4.0F);
    EXPECT_EQ(next_timer.collect().size(), 2U);
}

TEST_F(FrameGraphOnGl, BuffersHaveTheSizeThatWasAskedForAndAreReused) {
    std::array<GLuint, 2> ids{};
    FrameGraph graph(pool_);
    for (GLuint& id : ids) {
        graph.add_pass("use", [&](PassBuilder& builder) {
            const BufferHandle list = builder.create_buffer("list", 256);
            builder.side_effect();
            return [list, &id](const PassResources& resources) {
                EXPECT_EQ(resources.buffer(list).bytes(), 256U);
                id = resources.buffer(list).id();
            };
        });
    }
    graph.execute(timer_);
    EXPECT_NE(ids[0], 0U);
    EXPECT_EQ(ids[0], ids[1]);
}

}  // namespace
}  // namespace bounce
