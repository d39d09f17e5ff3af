// SPDX-License-Identifier: Apache-2.0
#include <algorithm>

#include "shader_harness.h"

namespace bounce::test {
namespace {

class MathGlsl : public ShaderTest {};

TEST_F(MathGlsl, OctahedralRoundTrip) {
    const std::vector<glm::dvec3> normals = directions(20000);
    std::vector<glm::vec4> in;
    for (const glm::dvec3& n : normals) {
        in.emplace_back(glm::vec3(n), 0.0F);
    }
    const std::vector<glm::vec4> out = run("octahedral.comp", 1, 4, in);
    double exact = 0.0;
    double unorm = 0.0;
    double snorm = 0.0;
    for (size_t i = 0; i < in.size(); ++i) {
        const glm::dvec3 n = glm::normalize(glm::dvec3(glm::vec3(in[i])));
        ASSERT_LE(std::abs(out[4 * i].x), 1.0F);
        ASSERT_LE(std::abs(out[4 * i].y), 1.0F);
        for (int k = 1; k < 4; ++k) {
            ASSERT_NEAR(glm::length(glm::vec3(out[4 * i + static_cast<size_t>(k)])), 1.0F, 1e-6F);
        }
        exact = std::max(exact, angle_between(n, glm::dvec3(glm::vec3(out[4 * i + 1]))));
        unorm = std::max(unorm, angle_between(n, glm::dvec3(glm::vec3(out[4 * i + 2]))));
        snorm = std::max(snorm, angle_between(n, glm::dvec3(glm::vec3(out[4 * i + 3]))));
    }
    EXPECT_LT(exact, 5e-7) << "a few float steps";
    // Half a step, 1/65535, in both coordinates moves a point of the octahedron by sqrt(6) times that, and
    // the middle of its faces is 1/sqrt(3) from the centre: sqrt(18)/65535 = 6.47e-5 rad.
    EXPECT_LT(unorm, 6.6e-5);
    EXPECT_LT(snorm, 6.6e-5);
    EXPECT_GT(snorm, 5e-5) << "or the worst directions are not among those tried";
}

TEST_F(MathGlsl, AxesSurviveSnormExactly) {
    std::vector<glm::vec4> in;
    for (const glm::vec3& axis : {glm::vec3(1, 0, 0), glm::vec3(0, 1, 0), glm::vec3(0, 0, 1)}) {
        in.emplace_back(axis, 0.0F);
        in.emplace_back(-axis, 0.0F);
    }
    const std::vector<glm::vec4> out = run("octahedral.comp", 1, 4, in);
    for (size_t i = 0; i < in.size(); ++i) {
        EXPECT_EQ(glm::vec3(out[4 * i + 3]), glm::vec3(in[i]));
    }
}

TEST_F(MathGlsl, OrthonormalBasis) {
    std::vector<glm::vec4> in;
    for (const glm::dvec3& n : directions(5000)) {
        in.emplace_back(glm::vec3(n), 0.0F);
    }
    in.emplace_back(0.0F, 0.0F, -1.0F, 0.0F);
    in.emplace_back(-0.0F, -0.0F, -0.99999994F, 0.0F);
    const std::vector<glm::vec4> out = run("vectors.comp", 1, 3, in);
    for (size_t i = 0; i < in.size(); ++i) {
        const glm::vec3 n(in[i]);
        const glm::vec3 t(out[3 * i]);
        const glm::vec3 b(out[3 * i + 1]);
        ASSERT_NEAR(glm::length(t), 1.0F, 2e-6F);
        ASSERT_NEAR(glm::length(b), 1.0F, 2e-6F);
        ASSERT_NEAR(glm::dot(t, n), 0.0F, 2e-6F);
        ASSERT_NEAR(glm::dot(b, n), 0.0F, 2e-6F);
        ASSERT_NEAR(glm::dot(t, b), 0.0F, 2e-6F);
        ASSERT_NEAR(glm::dot(glm::cross(t, b), n), 1.0F, 2e-6F) << "right-handed";
    }
}

TEST_F(MathGlsl, SafeNormalize) {
    const std::vector<glm::vec4> in = {{3.0F, 0.0F, 4.0F, 0.0F},
                                       {0.0F, 0.0F, 0.0F, 0.0F},
                                       {1e-20F, 0.0F, 0.0F, 0.0F},
                                       {1e-10F, 0.0F, 0.0F, 0.0F},
                                       {0.0F, -1e15F, 0.0F, 0.0F}};
    const std::vector<glm::vec4> out = run("vectors.comp", 1, 3, in);
    const std::vector<glm::vec3> expected = {{0.6F, 0.0F, 0.8F}, {0, 1, 0}, {0, 1, 0}, {1, 0, 0}, {0, -1, 0}};
    for (size_t i = 0; i < in.size(); ++i) {
        EXPECT_LT(glm::length(glm::vec3(out[3 * i + 2]) - expected[i]), 1e-6F) << i;
    }
}

}  // namespace
}  // namespace bounce::test
