// SPDX-License-Identifier: Apache-2.0
//
// What of the frame graph needs no OpenGL: declaring. Running it is tested in tests/gl.
#include "frame_graph/frame_graph.h"

#include <stdexcept>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace bounce {
namespace {

using testing::AllOf;
using testing::HasSubstr;
using testing::ThrowsMessage;

class FrameGraphDeclarations : public testing::Test {
  protected:
    TextureHandle create(const std::string& pass) {
        TextureHandle made;
        graph_.add_pass(pass, [&](PassBuilder& builder) {
            made = builder.create_texture("map", {});
            return Execute{};
        });
        return made;
    }
    void read(const std::string& pass, TextureHandle handle) {
        graph_.add_pass(pass, [&](PassBuilder& builder) {
            builder.read(handle);
            return Execute{};
        });
    }
    TextureHandle write(const std::string& pass, TextureHandle handle) {
        TextureHandle next;
        graph_.add_pass(pass, [&](PassBuilder& builder) {
            next = builder.write(handle);
            return Execute{};
        });
        return next;
    }
    TransientPool pool_;
    FrameGraph graph_{pool_};
};

TEST_F(FrameGraphDeclarations, AResourceThatWasNeverMadeIsRefusedByPassName) {
    EXPECT_THAT([&] { read("blur", {}); }, ThrowsMessage<std::logic_error>(HasSubstr("blur")));
}

TEST_F(FrameGraphDeclarations, WritingGivesANewHandle) {
    const TextureHandle v0 = create("make");
    const TextureHandle v1 = write("change", v0);
    EXPECT_TRUE(v0.valid());
    EXPECT_TRUE(v1.valid());
    EXPECT_NE(v0.version, v1.version);
}

TEST_F(FrameGraphDeclarations, AnOldVersionCannotBeReadAfterItWasChanged) {
    // The pass would see what "change" left there, and nothing would say so.
    const TextureHandle v0 = create("make");
    (void)write("change", v0);
    EXPECT_THAT([&] { read("late", v0); },
                ThrowsMessage<std::logic_error>(AllOf(HasSubstr("late"), HasSubstr("map"))));
}

TEST_F(FrameGraphDeclarations, AVersionIsChangedOnce) {
    const TextureHandle v0 = create("make");
    (void)write("change", v0);
    EXPECT_THAT([&] { (void)write("change again", v0); },
                ThrowsMessage<std::logic_error>(AllOf(HasSubstr("change again"), HasSubstr("map"))));
}

TEST_F(FrameGraphDeclarations, OldVersionsMayBeReadBeforeTheChange) {
    const TextureHandle v0 = create("make");
    EXPECT_NO_THROW(read("early", v0));
    EXPECT_NO_THROW(read("new", write("change", v0)));
}

}  // namespace
}  // namespace bounce
