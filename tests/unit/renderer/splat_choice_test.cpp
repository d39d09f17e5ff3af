// SPDX-License-Identifier: Apache-2.0
#include "renderer/splat_choice.h"

#include <gtest/gtest.h>

namespace bounce {
namespace {

TEST(SplatChoice, TessellatesWhereSplatsAreMoreThanTriangles) {
    // Table 3 of Barak et al. 2013: 10,000 splats are slower on every mesh, a million faster.
    const SplatChoice few = choose_splat({.triangles = 262'000, .splats = 10'000});
    EXPECT_EQ(few.splat, Splat::compute);
    EXPECT_EQ(few.reason, "10000 splats are no more than the 262000 triangles to go through");
    const SplatChoice many = choose_splat({.triangles = 262'000, .splats = 1'000'000});
    EXPECT_EQ(many.splat, Splat::tessellation);
    EXPECT_EQ(many.reason, "1000000 splats are more than the 262000 triangles to go through");
    EXPECT_EQ(choose_splat({.triangles = 1000, .splats = 1000}).splat, Splat::compute);
    EXPECT_EQ(choose_splat({.triangles = 1000, .splats = 1001}).splat, Splat::tessellation);
    EXPECT_EQ(choose_splat({.triangles = 0, .splats = 0}).splat, Splat::compute);
}

TEST(SplatChoice, NeverTessellatesWhereTheDriverDoesItSlowlyOrNotAtAll) {
    const SplatChoice software = choose_splat({.triangles = 10, .splats = 1'000'000, .software = true});
    EXPECT_EQ(software.splat, Splat::compute);
    EXPECT_NE(software.reason.find("software driver"), std::string::npos);
    const SplatChoice unable = choose_splat({.triangles = 10, .splats = 1'000'000, .can_tessellate = false});
    EXPECT_EQ(unable.splat, Splat::compute);
    EXPECT_NE(unable.reason.find("storage buffers"), std::string::npos);
}

}  // namespace
}  // namespace bounce
