// SPDX-License-Identifier: Apache-2.0
//
// What passes made in the frames before, and when it serves again.
#include "frame_graph/kept_contents.h"

#include <array>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include <gmock/gmock.h>

#include "core/error.h"
#include "frame_graph/frame_graph.h"
#include "gl_context.h"

namespace bounce {
namespace {

using testing::ElementsAre;
using testing::IsEmpty;
using Names = std::vector<std::string>;

constexpr gl::TextureDesc k_desc{.format = GL_RGBA32F, .width = 4, .height = 4};

ContentKey key_of(int value) {
    return ContentHash().add(value).key();
}

class Kept : public test::GlTest {
  protected:
    Kept() { kept_.set_on(true, pool_); }

    // Fills a texture with `value`, decided by it.
    TextureHandle fill(FrameGraph& graph, const std::string& name, int value, bool decided = true) {
        TextureHandle made;
        graph.add_pass(name, [&](PassBuilder& builder) {
            made = builder.create_texture(name, k_desc);
            if (decided) builder.decided_by(key_of(value));
            return [made, value](const PassResources& resources) { clear(resources.texture(made), value); };
        });
        return made;
    }
    // What it reads and `by` more, in a texture of its own.
    TextureHandle add(FrameGraph& graph, const std::string& name, TextureHandle from, int by) {
        TextureHandle made;
        graph.add_pass(name, [&](PassBuilder& builder) {
            builder.read(from);
            made = builder.create_texture(name, k_desc);
            builder.decided_by(key_of(by));
            return [made, from, by](const PassResources& resources) {
                clear(resources.texture(made), texel(resources.texture(from)) + static_cast<float>(by));
            };
        });
        return made;
    }
    // Changes it in place.
    TextureHandle change(FrameGraph& graph, const std::string& name, TextureHandle of, int by) {
        TextureHandle out;
        graph.add_pass(name, [&](PassBuilder& builder) {
            out = builder.write(of);
            builder.decided_by(key_of(by));
            return [out, by](const PassResources& resources) {
                clear(resources.texture(out), texel(resources.texture(out)) + static_cast<float>(by));
            };
        });
        return out;
    }
    void look(FrameGraph& graph, const std::string& name, TextureHandle handle, float& seen) {
        graph.add_pass(name, [&](PassBuilder& builder) {
            builder.read(handle);
            builder.side_effect();
            return [handle, &seen](const PassResources& resources) { seen = texel(resources.texture(handle)); };
        });
    }
    static void clear(const gl::Texture& texture, float value) {
        const std::array<float, 4> all = {value, value, value, value};
        glClearTexImage(texture.id(), 0, GL_RGBA, GL_FLOAT, all.data());
    }
    static void clear(const gl::Texture& texture, int value) { clear(texture, static_cast<float>(value)); }
    static float texel(const gl::Texture& texture) {
        std::array<float, 64> texels{};
        glGetTextureImage(texture.id(), 0, GL_RGBA, GL_FLOAT, sizeof texels, texels.data());
        return texels[0];
    }
    // Map, sum over it and what is seen of that; the names of the passes that ran.
    Names draw(int map, int by, float& seen) {
        FrameGraph graph(pool_);
        look(graph, "look", add(graph, "sum", fill(graph, "map", map), by), seen);
        graph.execute(timer_, &kept_);
        return graph.executed();
    }
    Names frame(int map, int by, float& seen) {
        Names out = draw(map, by, seen);
        kept_.keep_frame(pool_);
        return out;
    }

    TransientPool pool_;
    KeptContents kept_;
    gl::PassTimer timer_{gl::TimingMode::off};
};

TEST_F(Kept, WhatIsTheSameIsNotMadeAgainAndWhatFollowsFromAChangeIs) {
    float seen = 0.0F;
    EXPECT_THAT(frame(3, 4, seen), ElementsAre("map", "sum", "look"));
    EXPECT_THAT(frame(3, 4, seen), ElementsAre("look"));
    EXPECT_EQ(seen, 7.0F);
    EXPECT_THAT(frame(3, 5, seen), ElementsAre("map", "sum", "look"))
        << "nothing needed the map in the frame before, so it was given back";
    EXPECT_EQ(seen, 8.0F);
    EXPECT_THAT(frame(2, 5, seen), ElementsAre("map", "sum", "look"));
    EXPECT_EQ(seen, 7.0F);
}

TEST_F(Kept, WhatIsLookedAtInEachFrameStaysThoughAnotherReaderChanges) {
    const auto frame_of = [&](int by) {
        FrameGraph graph(pool_);
        float map = 0.0F;
        float sum = 0.0F;
        const TextureHandle filled = fill(graph, "map", 3);
        look(graph, "look at map", filled, map);
        look(graph, "look at sum", add(graph, "sum", filled, by), sum);
        graph.execute(timer_, &kept_);
        kept_.keep_frame(pool_);
        EXPECT_EQ(map, 3.0F);
        EXPECT_EQ(sum, 3.0F + static_cast<float>(by));
        return graph.executed();
    };
    frame_of(1);
    EXPECT_THAT(frame_of(2), ElementsAre("look at map", "sum", "look at sum"));
    EXPECT_THAT(frame_of(3), ElementsAre("look at map", "sum", "look at sum"));
}

TEST_F(Kept, AFrameDrawnTwiceStartsTwiceFromTheFrameBefore) {
    float seen = 0.0F;
    frame(3, 4, seen);
    EXPECT_THAT(draw(3, 9, seen), ElementsAre("sum", "look"));
    EXPECT_THAT(draw(3, 9, seen), ElementsAre("sum", "look")) << "what it made itself is not there yet";
    EXPECT_THAT(draw(3, 4, seen), ElementsAre("sum", "look")) << "what it had no use for is gone";
    kept_.keep_frame(pool_);
    EXPECT_THAT(draw(3, 4, seen), ElementsAre("look"));
    EXPECT_THAT(draw(3, 4, seen), ElementsAre("look")) << "what it used is there again";
    EXPECT_EQ(seen, 7.0F);
}

TEST_F(Kept, APassThatSaysNotWhatDecidesRunsInEachFrameAndAllThatReadsIt) {
    for (int frame = 0; frame < 3; ++frame) {
        FrameGraph graph(pool_);
        float seen = 0.0F;
        look(graph, "look", add(graph, "sum", fill(graph, "map", 3, false), 4), seen);
        graph.execute(timer_, &kept_);
        kept_.keep_frame(pool_);
        EXPECT_THAT(graph.executed(), ElementsAre("map", "sum", "look"));
        EXPECT_THAT(graph.unchanged(), IsEmpty());
    }
    EXPECT_EQ(kept_.bytes(), 0U);
}

TEST_F(Kept, WritersInPlaceAreOneResult) {
    const auto frame_of = [&](int last, float& seen) {
        FrameGraph graph(pool_);
        look(graph, "look", change(graph, "second", change(graph, "first", fill(graph, "map", 1), 2), last), seen);
        graph.execute(timer_, &kept_);
        kept_.keep_frame(pool_);
        return graph.executed();
    };
    float seen = 0.0F;
    frame_of(4, seen);
    EXPECT_THAT(frame_of(4, seen), ElementsAre("look"));
    EXPECT_EQ(seen, 7.0F);
    EXPECT_THAT(frame_of(5, seen), ElementsAre("map", "first", "second", "look"));
    EXPECT_EQ(seen, 8.0F) << "nothing was added twice";
}

TEST_F(Kept, AVersionThatIsReadBeforeItChangesIsMadeAgain) {
    const auto frame_of = [&] {
        FrameGraph graph(pool_);
        float before = 0.0F;
        float after = 0.0F;
        const TextureHandle map = fill(graph, "map", 1);
        look(graph, "before", map, before);
        look(graph, "after", change(graph, "change", map, 2), after);
        graph.execute(timer_, &kept_);
        kept_.keep_frame(pool_);
        EXPECT_EQ(before, 1.0F);
        EXPECT_EQ(after, 3.0F);
    };
    frame_of();
    frame_of();
}

TEST_F(Kept, WhatChangesInEachFrameIsNotHeld) {
    float seen = 0.0F;
    for (int value = 0; value < 4; ++value) {
        frame(value, 1, seen);
    }
    EXPECT_EQ(kept_.bytes(), 0U);
    frame(3, 1, seen);
    EXPECT_GT(kept_.bytes(), 0U) << "it came to rest";
}

TEST_F(Kept, AContentsKeyOfAnImportedBufferStandsForIt) {
    gl::Buffer numbers("numbers", 64, GL_DYNAMIC_STORAGE_BIT);
    const auto frame_of = [&](const ContentKey& content) {
        FrameGraph graph(pool_);
        const BufferHandle imported = graph.import_buffer("numbers", numbers, {}, content);
        TextureHandle made;
        graph.add_pass("use", [&](PassBuilder& builder) {
            builder.read(imported);
            made = builder.create_texture("made", k_desc);
            builder.decided_by(key_of(1));
            return [made](const PassResources& resources) { clear(resources.texture(made), 1.0F); };
        });
        float seen = 0.0F;
        look(graph, "look", made, seen);
        graph.execute(timer_, &kept_);
        kept_.keep_frame(pool_);
        return graph.executed();
    };
    frame_of(key_of(1));
    EXPECT_THAT(frame_of(key_of(1)), ElementsAre("look"));
    EXPECT_THAT(frame_of(key_of(2)), ElementsAre("use", "look"));
    EXPECT_THAT(frame_of({}), ElementsAre("use", "look"));
    EXPECT_THAT(frame_of({}), ElementsAre("use", "look")) << "nothing is known of it";
}

TEST_F(Kept, AFailedFrameLeavesNothingHalfDone) {
    float seen = 0.0F;
    const auto failing = [&] {
        FrameGraph graph(pool_);
        const TextureHandle map = fill(graph, "map", 5);
        graph.add_pass("fails", [&](PassBuilder& builder) {
            builder.read(map);
            builder.side_effect();
            return [](const PassResources&) { throw Error(ExitCode::failed, "a shader that does not compile"); };
        });
        graph.execute(timer_, &kept_);
    };
    EXPECT_THROW(failing(), Error);
    kept_.keep_frame(pool_);
    EXPECT_THAT(frame(5, 1, seen), ElementsAre("map", "sum", "look"));
    EXPECT_EQ(seen, 6.0F);
}

TEST_F(Kept, SwitchedOffItKeepsNothing) {
    float seen = 0.0F;
    frame(3, 4, seen);
    kept_.set_on(false, pool_);
    EXPECT_EQ(kept_.bytes(), 0U);
    EXPECT_THAT(frame(3, 4, seen), ElementsAre("map", "sum", "look"));
    EXPECT_THAT(frame(3, 4, seen), ElementsAre("map", "sum", "look"));
}

TEST_F(Kept, AForecastSaysWhatIsAllocated) {
    const size_t texture = gl::storage_bytes(k_desc);
    const auto build = [&](FrameGraph& graph, float& seen) {
        look(graph, "look", add(graph, "sum 2", add(graph, "sum", fill(graph, "map", 1), 1), 1), seen);
    };
    float seen = 0.0F;
    FrameGraph forecast(pool_);
    build(forecast, seen);
    EXPECT_EQ(forecast.forecast(false, true).peak_bytes, 2 * texture) << "the map's memory serves the second sum";
    FrameGraph keeping(pool_);
    build(keeping, seen);
    EXPECT_EQ(keeping.forecast(true, true).peak_bytes, 3 * texture);
    const size_t before = gl::allocated_bytes();
    FrameGraph drawn(pool_);
    build(drawn, seen);
    drawn.execute(timer_);
    EXPECT_EQ(gl::allocated_bytes() - before, 2 * texture);
    pool_.hold_idle(false);
    EXPECT_EQ(gl::allocated_bytes(), before);
    FrameGraph tight(pool_);
    build(tight, seen);
    EXPECT_EQ(tight.forecast(false, false).peak_bytes, 2 * texture);
    gl::restart_peak();
    FrameGraph freed(pool_);
    build(freed, seen);
    freed.execute(timer_);
    EXPECT_EQ(gl::peak_allocated_bytes() - before, 2 * texture);
    EXPECT_EQ(gl::allocated_bytes(), before);
}

}  // namespace
}  // namespace bounce
