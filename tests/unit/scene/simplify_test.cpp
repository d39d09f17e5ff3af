// SPDX-License-Identifier: Apache-2.0
//
// Simplified meshes: fewer triangles, about the same surface.
#include "scene/simplify.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <random>
#include <set>

#include <glm/gtc/matrix_transform.hpp>
#include <gtest/gtest.h>

namespace bounce::scene {
namespace {

constexpr double pi = std::numbers::pi;

glm::dvec3 across(const Primitive& p, const std::vector<uint32_t>& indices, size_t first) {
    const glm::dvec3 a(p.positions[indices[first]]);
    const glm::dvec3 b(p.positions[indices[first + 1]]);
    const glm::dvec3 c(p.positions[indices[first + 2]]);
    return glm::cross(b - a, c - a);
}

double area(const Primitive& p, const std::vector<uint32_t>& indices) {
    double sum = 0.0;
    for (size_t i = 0; i < indices.size(); i += 3) {
        sum += 0.5 * glm::length(across(p, indices, i));
    }
    return sum;
}

Box box(const Primitive& p, const std::vector<uint32_t>& indices) {
    Box out;
    for (const uint32_t i : indices) {
        out.grow(p.positions[i]);
    }
    return out;
}

// A ball of radius 1: `rings` from pole to pole and twice as many around, 4 rings^2 triangles.
Primitive ball(int rings) {
    Primitive p;
    const int around = 2 * rings;
    for (int i = 0; i <= rings; ++i) {
        for (int j = 0; j <= around; ++j) {
            const double theta = pi * i / rings;
            const double phi = 2.0 * pi * (j % around) / around;
            const bool pole = i == 0 || i == rings;
            const glm::dvec3 n = pole ? glm::dvec3(0.0, 0.0, i == 0 ? 1.0 : -1.0)
                                      : glm::dvec3(std::sin(theta) * std::cos(phi),
                                                   std::sin(theta) * std::sin(phi), std::cos(theta));
            p.positions.emplace_back(n);
            p.normals.emplace_back(n);
            if (i < rings && j < around) {
                const auto a = static_cast<uint32_t>(i * (around + 1) + j);
                const uint32_t b = a + static_cast<uint32_t>(around) + 1;
                p.indices.insert(p.indices.end(), {a, b, a + 1, a + 1, b, b + 1});
            }
        }
    }
    return p;
}

// A square of 2 x 2 on a plane that is not square to the axes, cut into n x n, without the middle quarter;
// cut unevenly by chance with a seed.
Primitive tilted_frame(int n, uint32_t seed = 0) {
    std::mt19937 random(seed);
    const auto chance = [&] { return seed == 0 ? 0.5 : static_cast<double>(random()) / 4294967296.0; };
    const glm::dmat4 turn =
        glm::rotate(glm::dmat4(1.0), 0.7 + 5.0 * (chance() - 0.5),
                    glm::normalize(glm::dvec3(0.5 + chance(), 2.0 * chance() + 1.0, chance())));
    Primitive p;
    for (int y = 0; y <= n; ++y) {
        for (int x = 0; x <= n; ++x) {
            const bool inside = std::min(x, y) > 0 && std::max(x, y) < n;
            const double aside = inside ? 0.6 * (chance() - 0.5) : 0.0;
            const double along = inside ? 0.6 * (chance() - 0.5) : 0.0;
            p.positions.emplace_back(
                turn * glm::dvec4(2.0 * (x + aside) / n - 1.0, 2.0 * (y + along) / n - 1.0, 0.0, 1.0));
            p.normals.emplace_back(turn * glm::dvec4(0.0, 0.0, 1.0, 0.0));
            const bool hole = std::min(x, y) >= n / 4 && std::max(x, y) < 3 * n / 4;
            if (x < n && y < n && !hole) {
                const auto a = static_cast<uint32_t>(y * (n + 1) + x);
                const uint32_t b = a + static_cast<uint32_t>(n) + 1;
                if (chance() < 0.5) {
                    p.indices.insert(p.indices.end(), {a, a + 1, b + 1, a, b + 1, b});
                } else {
                    p.indices.insert(p.indices.end(), {a, a + 1, b, a + 1, b + 1, b});
                }
            }
        }
    }
    return p;
}

// Every triangle with vertices of its own, and the normal of its face.
Primitive faceted(const Primitive& p) {
    Primitive out;
    for (size_t i = 0; i < p.indices.size(); i += 3) {
        const glm::dvec3 n = across(p, p.indices, i);
        if (!(glm::length(n) > 0.0)) {
            continue;
        }
        for (size_t corner = 0; corner < 3; ++corner) {
            out.indices.push_back(static_cast<uint32_t>(out.positions.size()));
            out.positions.push_back(p.positions[p.indices[i + corner]]);
            out.normals.emplace_back(glm::normalize(n));
        }
    }
    return out;
}

TEST(Simplify, ABallKeepsItsAreaAndBoundsAtAQuarter) {
    const Primitive p = ball(24);
    const SimplifiedPrimitive s = simplify(p, 0.25, 0.05, false);
    EXPECT_LE(s.indices.size(), p.indices.size() / 4);
    EXPECT_GE(s.indices.size(), p.indices.size() / 5) << "no further than asked for";
    // Chords of a ball of 576 triangles: about 1 % of its area.
    EXPECT_NEAR(area(p, s.indices) / area(p, p.indices), 1.0, 0.02);
    const Box whole = box(p, p.indices);
    const Box fewer = box(p, s.indices);
    for (int axis = 0; axis < 3; ++axis) {
        EXPECT_NEAR(fewer.low[axis], whole.low[axis], 0.04);
        EXPECT_NEAR(fewer.high[axis], whole.high[axis], 0.04);
    }
    EXPECT_GT(s.error_model, 1e-4);
    EXPECT_LT(s.error_model, 0.05 * 2.0) << "the extent is 2";
}

TEST(Simplify, ItsErrorIsALimit) {
    const Primitive p = ball(24);
    size_t before = 0;
    for (const double error : {0.05, 0.01, 0.002, 0.0004}) {
        const SimplifiedPrimitive s = simplify(p, 0.001, error, false);
        EXPECT_LE(s.error_model, error * 2.0 * 1.001) << error;
        EXPECT_GT(s.indices.size(), before) << error << ": what may move less keeps more";
        before = s.indices.size();
    }
}

TEST(Simplify, TheWholeRatioChangesNothing) {
    const Primitive p = ball(8);
    const SimplifiedPrimitive s = simplify(p, 1.0, 0.5, false);
    EXPECT_EQ(s.indices, p.indices);
    EXPECT_EQ(s.error_model, 0.0);
}

TEST(Simplify, IsTheSameEachTimeAndNeverMore) {
    for (const Primitive& p : {ball(5), ball(17), tilted_frame(8), tilted_frame(20), faceted(ball(9))}) {
        for (const double ratio : {0.01, 0.3, 0.77, 0.99}) {
            for (const bool lock : {false, true}) {
                const SimplifiedPrimitive s = simplify(p, ratio, 0.02, lock);
                EXPECT_LE(s.indices.size(), p.indices.size());
                EXPECT_EQ(s.indices.size() % 3, 0U);
                EXPECT_FALSE(s.indices.empty());
                for (const uint32_t i : s.indices) {
                    ASSERT_LT(i, p.positions.size());
                }
                EXPECT_EQ(s.indices, simplify(p, ratio, 0.02, lock).indices);
            }
        }
    }
}

TEST(Simplify, ATiltedPlaneDoesNotGrow) {
    // Flat: every collapse within it costs nothing, and rounding alone tells whether it turns a triangle
    // over.
    for (uint32_t seed = 0; seed < 300; ++seed) {
        const Primitive p = tilted_frame(8 + static_cast<int>(seed % 30), seed);
        for (const double error : {1e-4, 1e-3}) {
            const SimplifiedPrimitive s = simplify(p, 0.1, error, false);
            EXPECT_LE(area(p, s.indices), area(p, p.indices) * 1.0051) << seed << ' ' << error;
            EXPECT_GE(area(p, s.indices), area(p, p.indices) * 0.99) << seed << ' ' << error;
        }
    }
}

TEST(Simplify, WhatHasFewTrianglesStaysAsItIs) {
    // 36 triangles: a quarter of them would be no ball.
    const Primitive coarse = ball(3);
    EXPECT_EQ(simplify(coarse, 0.25, 1.0, false).indices, coarse.indices);
    EXPECT_LT(simplify(ball(5), 0.25, 1.0, false).indices.size(), ball(5).indices.size());
}

TEST(Simplify, FacetsAreOneSurfaceAndStayFacets) {
    // A box cut finely, with no vertex shared between triangles: as points of one surface it needs twelve.
    Primitive p;
    for (int axis = 0; axis < 3; ++axis) {
        for (const float side : {-1.0F, 1.0F}) {
            constexpr int n = 8;  // its eighths are exact, so that faces meet
            for (int y = 0; y < n; ++y) {
                for (int x = 0; x < n; ++x) {
                    const auto at = [&](int u, int v) {
                        glm::vec3 out(side);
                        out[(axis + 1) % 3] = (2.0F * static_cast<float>(u) / n - 1.0F) * side;
                        out[(axis + 2) % 3] = 2.0F * static_cast<float>(v) / n - 1.0F;
                        return out;
                    };
                    const auto first = static_cast<uint32_t>(p.positions.size());
                    for (const glm::vec3& q : {at(x, y), at(x + 1, y), at(x + 1, y + 1), at(x, y + 1)}) {
                        p.positions.push_back(q);
                        p.normals.emplace_back(0.0F);
                        p.normals.back()[axis] = side;
                    }
                    for (const uint32_t i : {0U, 1U, 2U, 0U, 2U, 3U}) {
                        p.indices.push_back(first + i);
                    }
                }
            }
        }
    }
    const SimplifiedPrimitive s = simplify(p, 0.01, 1e-3, false);
    EXPECT_LE(s.indices.size() / 3, 30U) << "of 768";
    EXPECT_NEAR(area(p, s.indices), 24.0, 0.12);
    for (size_t i = 0; i < s.indices.size(); i += 3) {
        const glm::dvec3 face = glm::normalize(across(p, s.indices, i));
        for (size_t corner = 0; corner < 3; ++corner) {
            EXPECT_GT(glm::dot(glm::dvec3(p.normals[s.indices[i + corner]]), face), 0.9);
        }
    }
}

TEST(Simplify, WhatMovesApartIsNotJoined) {
    // Two sheets that lie edge to edge, until a morph target moves one of them.
    Primitive p;
    for (const float side : {-1.0F, 1.0F}) {
        const auto first = static_cast<uint32_t>(p.positions.size());
        constexpr int n = 8;
        for (int y = 0; y <= n; ++y) {
            for (int x = 0; x <= n; ++x) {
                p.positions.emplace_back(side * static_cast<float>(x) / n, static_cast<float>(y) / n, 0.0F);
                p.normals.emplace_back(0.0F, 0.0F, 1.0F);
                if (x < n && y < n) {
                    const uint32_t a = first + static_cast<uint32_t>(y * (n + 1) + x);
                    const uint32_t b = a + n + 1;
                    p.indices.insert(p.indices.end(), {a, a + 1, b, a + 1, b + 1, b});
                }
            }
        }
    }
    const auto half = static_cast<uint32_t>(p.positions.size() / 2);
    MorphTarget aside;
    aside.positions.assign(p.positions.size(), glm::vec3(0.0F));
    std::fill(aside.positions.begin() + half, aside.positions.end(), glm::vec3(0.0F, 0.0F, 1.0F));
    const auto joined = [&](const Primitive& of) {
        int count = 0;
        const SimplifiedPrimitive s = simplify(of, 0.05, 0.01, false);
        for (size_t i = 0; i < s.indices.size(); i += 3) {
            const bool a = s.indices[i] < half;
            count += a != (s.indices[i + 1] < half) || a != (s.indices[i + 2] < half) ? 1 : 0;
        }
        return count;
    };
    EXPECT_GT(joined(p), 0) << "without the target they are one surface";
    p.targets = {aside};
    EXPECT_EQ(joined(p), 0);
}

TEST(Simplify, DegenerateMeshesComeBack) {
    Primitive empty;
    EXPECT_TRUE(simplify(empty, 0.1, 0.1, false).indices.empty());

    Primitive one;
    one.positions = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
    one.normals.assign(3, {0, 0, 1});
    one.indices = {0, 1, 2};
    EXPECT_EQ(simplify(one, 0.1, 1.0, false).indices.size(), 3U);

    // All in one place, along a line, and without area.
    Primitive point = ball(6);
    std::fill(point.positions.begin(), point.positions.end(), glm::vec3(3.0F));
    Primitive line = ball(6);
    for (glm::vec3& q : line.positions) {
        q = {q.x, 0.0F, 0.0F};
    }
    for (const Primitive& p : {point, line}) {
        const SimplifiedPrimitive s = simplify(p, 0.2, 0.1, false);
        EXPECT_LE(s.indices.size(), p.indices.size());
        EXPECT_TRUE(std::isfinite(s.error_model));
    }
}

TEST(SimplifyScene, CutOutsKeepTheirTriangles) {
    Scene scene;
    scene.materials.resize(2);
    scene.materials[1].alpha_mode = AlphaMode::mask;
    for (const int material : {0, 1, k_none}) {
        Primitive p = ball(16);
        p.material = material;
        scene.meshes.push_back({"ball", {p}, {}});
    }
    const SimplifiedMeshes meshes = simplify_scene(scene, {.ratio = 0.25, .error = 0.1});
    const size_t all = scene.meshes[0].primitives[0].indices.size();
    EXPECT_LE(meshes[0][0].indices.size(), all / 4);
    EXPECT_EQ(meshes[1][0].indices.size(), all);
    EXPECT_LE(meshes[2][0].indices.size(), all / 4);
}

TEST(SimplifyScene, PrimitivesThatMeetStayTogether) {
    // Halves of a ball, in two primitives of one mesh: no vertex of the seam may go.
    Primitive upper = ball(16);
    Primitive lower = upper;
    upper.indices.resize(upper.indices.size() / 2);
    lower.indices.erase(lower.indices.begin(),
                        lower.indices.begin() + static_cast<std::ptrdiff_t>(lower.indices.size() / 2));
    Scene scene;
    scene.meshes.push_back({"halves", {upper, lower}, {}});
    const SimplifiedMeshes meshes = simplify_scene(scene, {.ratio = 0.1, .error = 0.1});
    for (const SimplifiedPrimitive& half : meshes[0]) {
        std::set<std::pair<float, float>> seam;
        for (const uint32_t i : half.indices) {
            if (std::abs(upper.positions[i].z) < 1e-6F) {
                seam.emplace(upper.positions[i].x, upper.positions[i].y);
            }
        }
        EXPECT_EQ(seam.size(), 32U);
    }
}

TEST(SimplifyScene, AutomaticRatioLeavesSeveralThousandTriangles) {
    EXPECT_EQ(simplified_ratio(3400), 1.0) << "as the paper leaves its sphere";
    EXPECT_EQ(simplified_ratio(k_simplified_triangles), 1.0);
    EXPECT_DOUBLE_EQ(simplified_ratio(120000), 0.05);
    Scene scene;
    scene.meshes.push_back({"ball", {ball(40)}, {}});  // 6,400, drawn three times
    for (int i = 0; i < 3; ++i) {
        Node node;
        node.mesh = 0;
        scene.topological_order.push_back(static_cast<int>(scene.nodes.size()));
        scene.nodes.push_back(node);
    }
    const size_t drawn = 3 * simplify_scene(scene, {})[0][0].indices.size() / 3;
    EXPECT_LE(drawn, k_simplified_triangles);
    EXPECT_GE(drawn, k_simplified_triangles * 8 / 10);
}

}  // namespace
}  // namespace bounce::scene
