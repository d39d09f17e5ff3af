// SPDX-License-Identifier: Apache-2.0
//
// What is left out of a picture is not in it.
#include "gpu/draw_box.h"

#include <random>

#include <glm/gtc/matrix_transform.hpp>
#include <gtest/gtest.h>

namespace bounce {
namespace {

using gpu::DrawBox;
using gpu::may_be_seen;

// Looks along -z from the origin, 90 degrees wide.
glm::mat4 looking(const glm::mat4& view = glm::mat4(1.0F)) {
    return glm::perspective(glm::radians(90.0F), 1.0F, 0.1F, 10.0F) * view;
}

DrawBox cube(const glm::vec3& center, float half) {
    return {center - half, center + half};
}

TEST(DrawBox, BesideAndBehindIsNotSeen) {
    EXPECT_TRUE(may_be_seen(cube({0, 0, -1}, 0.1F), looking()));
    EXPECT_TRUE(may_be_seen(cube({1.05F, 0, -1}, 0.1F), looking())) << "reaches in";
    EXPECT_TRUE(may_be_seen(cube({0, 0, 0}, 0.1F), looking())) << "around the eye";
    EXPECT_TRUE(may_be_seen(cube({0, 0, -500}, 0.1F), looking())) << "no far plane";
    EXPECT_TRUE(may_be_seen(cube({0, 0, -0.01F}, 0.001F), looking())) << "no near plane";
    EXPECT_FALSE(may_be_seen(cube({0, 0, 1}, 0.1F), looking()));
    for (const glm::vec3& side :
         {glm::vec3(1, 0, 0), glm::vec3(-1, 0, 0), glm::vec3(0, 1, 0), glm::vec3(0, -1, 0)}) {
        EXPECT_FALSE(may_be_seen(cube(2.0F * side - glm::vec3(0, 0, 1), 0.1F), looking()));
        EXPECT_TRUE(may_be_seen(cube(2.0F * side - glm::vec3(0, 0, 1), 1.0F), looking()));
    }
    const glm::mat4 parallel = glm::ortho(-1.0F, 1.0F, -2.0F, 2.0F, 0.1F, 10.0F);
    EXPECT_FALSE(may_be_seen(cube({1.5F, 0, -1}, 0.1F), parallel));
    EXPECT_TRUE(may_be_seen(cube({0, 1.5F, -1}, 0.1F), parallel));
}

TEST(DrawBox, OfUnknownExtentIsAlwaysSeen) {
    EXPECT_TRUE(may_be_seen(DrawBox{}, looking()));
    EXPECT_TRUE(may_be_seen(gpu::draw_box(scene::Bounds{}, {}), looking()));
    EXPECT_TRUE(may_be_seen(cube({0, 0, 1}, NAN), looking()));
}

TEST(DrawBox, IsOfRenderSpace) {
    gpu::RenderSpace space;
    space.origin = {100.0, 0.0, 0.0};
    space.scale = 0.5;
    scene::Bounds world;
    world.grow({102.0, -1.0, 0.0});
    world.grow({104.0, 1.0, 6.0});
    const DrawBox box = gpu::draw_box(world, space);
    EXPECT_EQ(box.low, glm::vec3(1.0F, -0.5F, 0.0F));
    EXPECT_EQ(box.high, glm::vec3(2.0F, 0.5F, 3.0F));
}

TEST(DrawBox, NothingInThePictureIsLeftOut) {
    std::mt19937 random(5);
    std::uniform_real_distribution<float> in(-1.0F, 1.0F);
    const auto place = [&] { return glm::vec3(in(random), in(random), in(random)); };
    int left_out = 0;
    for (int i = 0; i < 3000; ++i) {
        const glm::mat4 clip = looking(glm::rotate(glm::mat4(1.0F), 3.0F * in(random), place()) *
                                       glm::translate(glm::mat4(1.0F), 0.5F * place()));
        const DrawBox box = cube(place(), 0.02F + 0.3F * std::abs(in(random)));
        const bool seen = may_be_seen(box, clip);
        left_out += seen ? 0 : 1;
        for (int k = 0; k < 50 && !seen; ++k) {
            const glm::vec4 p = clip * glm::vec4(glm::mix(box.low, box.high, 0.5F + 0.5F * place()), 1.0F);
            ASSERT_FALSE(std::abs(p.x) <= p.w && std::abs(p.y) <= p.w);
        }
    }
    EXPECT_GT(left_out, 1000);
}

}  // namespace
}  // namespace bounce
