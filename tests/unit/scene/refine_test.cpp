// SPDX-License-Identifier: Apache-2.0
#include "scene/refine.h"

#include <array>
#include <cmath>
#include <map>
#include <tuple>

#include <gtest/gtest.h>

#include "scene/primitive_bounds.h"

namespace bounce::scene {
namespace {

double area(const Primitive& primitive) {
    double sum = 0.0;
    for (size_t i = 0; i < primitive.indices.size(); i += 3) {
        const glm::dvec3 a(primitive.positions[primitive.indices[i]]);
        const glm::dvec3 b(primitive.positions[primitive.indices[i + 1]]);
        const glm::dvec3 c(primitive.positions[primitive.indices[i + 2]]);
        sum += 0.5 * glm::length(glm::cross(b - a, c - a));
    }
    return sum;
}

// A tetrahedron whose faces share no vertex: hard edges all over.
Primitive tetrahedron() {
    const std::array<glm::vec3, 4> corners = {
        glm::vec3(0.1F, 0, 0), {1.3F, 0.2F, 0}, {0.3F, 0.9F, 0.1F}, {0.2F, 0.3F, 1.1F}};
    constexpr std::array<std::array<size_t, 3>, 4> faces = {{{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {2, 0, 3}}};
    Primitive out;
    for (const auto& face : faces) {
        const glm::vec3 normal = glm::normalize(
            glm::cross(corners[face[1]] - corners[face[0]], corners[face[2]] - corners[face[0]]));
        for (const size_t corner : face) {
            out.indices.push_back(static_cast<uint32_t>(out.positions.size()));
            out.positions.push_back(corners[corner]);
            out.normals.push_back(normal);
        }
    }
    out.bounds = primitive_bounds(out);
    return out;
}

// One triangle with every stream, each a linear function of the position where it can be.
Primitive full_triangle() {
    Primitive out;
    out.positions = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
    out.normals = {{0, 0, 1}, {1, 0, 0}, {0, 1, 0}};
    out.tangents = {{1, 0, 0, -1}, {0, 1, 0, -1}, {0, 0, 1, -1}};
    out.uv0 = {{0, 0}, {2, 0}, {0, 4}};
    out.uv1 = {{1, 1}, {1, 1}, {1, 1}};
    out.colors = {{0, 0, 0, 1}, {1, 0, 0, 1}, {0, 1, 0, 0}};
    out.joints = {{0, 1, 0, 0}, {2, 3, 0, 0}, {4, 5, 0, 0}};
    out.weights = {{0.75F, 0.25F, 0, 0}, {0.5F, 0.5F, 0, 0}, {0.9F, 0.1F, 0, 0}};
    out.targets = {{{{0, 0, 1}, {0, 0, 2}, {0, 0, 3}}, {{0, 0, 0}, {0, 0, 1}, {0, 0, 0}}, {}}};
    out.indices = {0, 1, 2};
    out.material = 3;
    return out;
}

TEST(Refine, FactorsAreExactBetweenOneAndThreeAndFromFour) {
    for (const double factor : {1.0, 1.1, 2.0, 3.0, 4.0, 5.5, 8.9, 9.0, 10.0, 16.0, 99.0}) {
        EXPECT_NEAR(refinement_by(factor).factor(), factor, 1e-9);
    }
    EXPECT_EQ(refinement_by(3.5).factor(), 4.0);
}

TEST(Refine, TriangleCountIsTheFactorOverManyPrimitives) {
    Scene scene;
    for (int i = 0; i < 25; ++i) {
        scene.meshes.push_back({"m", {tetrahedron()}, {}});
    }
    refine_scene(scene, refinement_by(1.1));  // 100 triangles; a primitive alone has too few for a tenth more
    size_t triangles = 0;
    for (const Mesh& mesh : scene.meshes) {
        triangles += mesh.primitives[0].indices.size() / 3;
    }
    EXPECT_EQ(triangles, 110U);
    EXPECT_EQ(refine(tetrahedron(), refinement_by(10.0)).indices.size() / 3, 40U);
}

TEST(Refine, KeepsAreaPlaneAndSide) {
    const Primitive before = tetrahedron();
    for (const double factor : {2.0, 4.0, 10.0, 27.0}) {
        const Primitive after = refine(before, refinement_by(factor));
        EXPECT_NEAR(area(after), area(before), 1e-6 * area(before)) << factor;
        for (size_t i = 0; i < after.indices.size(); i += 3) {
            const glm::vec3 a = after.positions[after.indices[i]];
            const glm::vec3 face = glm::cross(after.positions[after.indices[i + 1]] - a,
                                              after.positions[after.indices[i + 2]] - a);
            EXPECT_GT(glm::length(face), 0.0F);
            EXPECT_GT(glm::dot(glm::normalize(face), after.normals[after.indices[i]]), 0.999F);
        }
    }
}

// Every edge of a closed surface borders two triangles, once in each direction, by places to the last bit: no
// crack, and no vertex on a neighbour's edge.
TEST(Refine, LeavesAClosedSurfaceClosed) {
    const Primitive after = refine(tetrahedron(), refinement_by(10.0));
    using Place = std::array<float, 3>;
    std::map<std::pair<Place, Place>, int> edges;
    const auto place = [&](size_t i) {
        const glm::vec3& p = after.positions[after.indices[i]];
        return Place{p.x, p.y, p.z};
    };
    for (size_t i = 0; i < after.indices.size(); i += 3) {
        for (size_t k = 0; k < 3; ++k) {
            ++edges[{place(i + k), place(i + (k + 1) % 3)}];
        }
    }
    for (const auto& [edge, count] : edges) {
        EXPECT_EQ(count, 1);
        EXPECT_EQ(edges.count({edge.second, edge.first}), 1U);
    }
}

TEST(Refine, EveryStreamTakesTheMean) {
    const Primitive after = refine(full_triangle(), refinement_by(4.0));
    ASSERT_EQ(after.positions.size(), 6U);
    ASSERT_EQ(after.indices.size(), 12U);
    EXPECT_EQ(after.material, 3);
    bool seen = false;
    for (size_t i = 3; i < 6; ++i) {
        const glm::vec3 p = after.positions[i];
        EXPECT_EQ(after.uv0[i], glm::vec2(2.0F * p.x, 4.0F * p.y));
        EXPECT_EQ(after.uv1[i], glm::vec2(1.0F));
        EXPECT_EQ(after.colors[i].x, p.x);
        EXPECT_NEAR(glm::length(after.normals[i]), 1.0F, 1e-6F);
        EXPECT_NEAR(glm::length(glm::vec3(after.tangents[i])), 1.0F, 1e-6F);
        EXPECT_EQ(after.tangents[i].w, -1.0F);
        EXPECT_FLOAT_EQ(after.targets[0].positions[i].z, 1.0F + p.x + 2.0F * p.y);
        EXPECT_TRUE(after.targets[0].tangents.empty());
        if (p == glm::vec3(0.5F, 0.0F, 0.0F)) {  // between the first and the second
            seen = true;
            EXPECT_NEAR(after.normals[i].x, std::sqrt(0.5F), 1e-6F);
            EXPECT_NEAR(after.normals[i].z, std::sqrt(0.5F), 1e-6F);
        }
    }
    EXPECT_TRUE(seen);
    EXPECT_FALSE(after.bounds.all.empty());
}

TEST(Refine, KeepsTheFourLargestInfluences) {
    // At the centre six joints meet, with a third of .75 .25 .5 .5 .9 .1: 0, 2, 3 and 4 are the largest.
    const Primitive after = refine(full_triangle(), {1, 1.0});
    ASSERT_EQ(after.joints.size(), 4U);
    const glm::u16vec4 joints = after.joints[3];
    const glm::vec4 weights = after.weights[3];
    std::map<int, float> by_joint;
    for (int k = 0; k < 4; ++k) {
        by_joint[joints[k]] = weights[k];
    }
    constexpr float sum = 0.75F + 0.5F + 0.5F + 0.9F;
    EXPECT_NEAR(by_joint.at(0), 0.75F / sum, 1e-6F);
    EXPECT_NEAR(by_joint.at(2), 0.5F / sum, 1e-6F);
    EXPECT_NEAR(by_joint.at(3), 0.5F / sum, 1e-6F);
    EXPECT_NEAR(by_joint.at(4), 0.9F / sum, 1e-6F);
}

}  // namespace
}  // namespace bounce::scene
