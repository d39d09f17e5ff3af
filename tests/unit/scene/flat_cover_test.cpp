// SPDX-License-Identifier: Apache-2.0
//
// Few triangles for many of one plane: the same places are covered, as often as before.
#include "scene/points/flat_cover.h"

#include <functional>
#include <random>
#include <set>

#include <gtest/gtest.h>

#include "made_scenes.h"
#include "scene/points/outline.h"
#include "scene/refine.h"

namespace bounce::scene::test {
namespace {

struct Piece {
    std::vector<glm::dvec3> positions;
    std::vector<glm::uvec3> triangles;
};

using Keep = std::function<bool(int, int)>;

// Cells of one unit in the XY plane, two triangles each, of those that are kept.
Piece grid(
    int width, int height, const Keep& keep = [](int, int) { return true; }) {
    Piece piece;
    for (int y = 0; y <= height; ++y) {
        for (int x = 0; x <= width; ++x) {
            piece.positions.emplace_back(x, y, 0.0);
        }
    }
    for (int y = 0; y < height; ++y) {
        for (int x = 0; x < width; ++x) {
            if (keep(x, y)) {
                const auto a = static_cast<uint32_t>(y * (width + 1) + x);
                const auto up = static_cast<uint32_t>(width + 1);
                piece.triangles.emplace_back(a, a + 1, a + 1 + up);
                piece.triangles.emplace_back(a, a + 1 + up, a + up);
            }
        }
    }
    return piece;
}

// As a file holds it: turned, far from the origin and rounded to floats.
Piece placed(Piece piece, double angle_rad) {
    for (glm::dvec3& p : piece.positions) {
        p = glm::dvec3(glm::vec3(glm::dvec3(moved({30.0, -7.0, 11.0}) * turned(angle_rad) *
                                            glm::dvec4(p * glm::dvec3(0.37, 0.23, 1.0), 1.0))));
    }
    return piece;
}

double area_of(const std::vector<glm::dvec3>& p, const std::vector<glm::uvec3>& triangles) {
    double sum = 0.0;
    for (const glm::uvec3& t : triangles) {
        sum += 0.5 * glm::length(glm::cross(p[t.y] - p[t.x], p[t.z] - p[t.x]));
    }
    return sum;
}

// How many triangles a place of the XY plane lies in, by the positions before they were turned.
int covering(const Piece& piece, const std::vector<glm::uvec3>& triangles, const glm::dvec2& at) {
    int count = 0;
    for (const glm::uvec3& t : triangles) {
        bool inside = true;
        for (int k = 0; k < 3; ++k) {
            const glm::dvec2 a(piece.positions[t[k]]);
            const glm::dvec2 b(piece.positions[t[(k + 1) % 3]]);
            inside &= (b.x - a.x) * (at.y - a.y) - (b.y - a.y) * (at.x - a.x) > 0.0;
        }
        count += inside ? 1 : 0;
    }
    return count;
}

// The cover covers what the triangles do, at any turn, and is of so many triangles at most.
void expect_cover(const Piece& piece, size_t count) {
    for (const double angle : {0.0, 0.7, 2.9}) {
        const Piece turned_piece = placed(piece, angle);
        const std::vector<glm::uvec3> cover = flat_cover(turned_piece.positions, turned_piece.triangles);
        ASSERT_FALSE(cover.empty()) << angle;
        ASSERT_LE(cover.size(), count) << angle;
        const double area = area_of(turned_piece.positions, turned_piece.triangles);
        // Floats 30 m from the origin are 1.9e-6 m apart: half of that along the 6.3 m around the smallest
        // piece, of 1 m^2, is 6e-6 of it.
        EXPECT_NEAR(area_of(turned_piece.positions, cover) / area, 1.0, 6e-6);
        std::mt19937 random(1);
        std::uniform_real_distribution<double> in(-1.0, 13.0);
        for (int i = 0; i < 2000; ++i) {
            const glm::dvec2 at(in(random), in(random));
            ASSERT_EQ(covering(piece, cover, at), covering(piece, piece.triangles, at))
                << at.x << ' ' << at.y;
        }
    }
}

TEST(FlatCover, AFinelyCutWallIsTwoTriangles) {
    expect_cover(grid(12, 9), 2);
    expect_cover(grid(1, 12), 2);
}

TEST(FlatCover, AWallKeepsItsHoles) {
    expect_cover(grid(12, 12, [](int x, int y) { return x < 3 || x > 5 || y < 4 || y > 9; }), 8);
    expect_cover(
        grid(12, 12,
             [](int x, int y) { return !(x == 2 && y == 3) && !(x > 5 && x < 9 && y > 6 && y < 10); }),
        14);
}

TEST(FlatCover, PiecesThatDoNotTouchStayApart) {
    expect_cover(grid(12, 12, [](int x, int) { return x < 4 || x > 6; }), 4);
    // A piece in another's hole.
    expect_cover(grid(12, 12,
                      [](int x, int y) {
                          const int ring = std::max(std::abs(2 * x - 11), std::abs(2 * y - 11));
                          return ring > 8 || ring < 5;
                      }),
                 10);
}

TEST(FlatCover, AnLIsFourTriangles) {
    expect_cover(grid(12, 12, [](int x, int y) { return x < 4 || y < 3; }), 4);
}

TEST(FlatCover, PiecesAndHolesMayTouchInAPlace) {
    // Squares of a board; and a hole whose corner is on the outline's straight edge.
    expect_cover(grid(12, 12, [](int x, int y) { return (x / 4 + y / 4) % 2 == 0; }), 10);
    Piece piece = grid(12, 12, [](int x, int y) { return !(x >= 4 && x < 8 && y >= 0 && y < 4); });
    // Fills the notch again but for a triangle that stands on its point.
    const auto corner = [](int x, int y) { return static_cast<uint32_t>(13 * y + x); };
    piece.triangles.emplace_back(corner(4, 0), corner(6, 0), corner(4, 4));
    piece.triangles.emplace_back(corner(6, 0), corner(8, 0), corner(8, 4));
    expect_cover(piece, 6);
}

TEST(FlatCover, SeamsAndVerticesOnNeighboursEdgesDoNotShow) {
    // Cells have vertices of their own.
    const Piece shared = grid(6, 5);
    Piece apart;
    for (const glm::uvec3& t : shared.triangles) {
        for (int k = 0; k < 3; ++k) {
            apart.positions.push_back(shared.positions[t[k]]);
        }
        const auto first = static_cast<uint32_t>(apart.positions.size() - 3);
        apart.triangles.emplace_back(first, first + 1, first + 2);
    }
    expect_cover(apart, 2);
    // Two triangles beside a fine strip, whose vertices lie on their edge.
    Piece beside = grid(12, 12, [](int, int y) { return y > 9; });
    const auto corner = [](int x, int y) { return static_cast<uint32_t>(13 * y + x); };
    beside.triangles.emplace_back(corner(0, 0), corner(12, 0), corner(12, 10));
    beside.triangles.emplace_back(corner(0, 0), corner(12, 10), corner(0, 10));
    expect_cover(beside, 2);
}

TEST(FlatCover, FacesTheSameWay) {
    Piece piece = placed(grid(5, 5), 1.1);
    const auto normal = [&](const glm::uvec3& t) {
        return glm::cross(piece.positions[t.y] - piece.positions[t.x],
                          piece.positions[t.z] - piece.positions[t.x]);
    };
    for (int turn = 0; turn < 2; ++turn) {
        for (const glm::uvec3& t : flat_cover(piece.positions, piece.triangles)) {
            EXPECT_GT(glm::dot(normal(t), normal(piece.triangles[0])), 0.0);
        }
        for (glm::uvec3& t : piece.triangles) {
            std::swap(t.y, t.z);
        }
    }
}

TEST(FlatCover, ASplitWallHasTheUnsplitOnesCorners) {
    const Primitive wall = square(3.3F);
    for (const double factor : {4.0, 10.0, 57.0, 1000.0}) {
        const Primitive fine = refine(wall, refinement_by(factor));
        const std::vector<glm::dvec3> positions(fine.positions.begin(), fine.positions.end());
        std::vector<glm::uvec3> triangles;
        for (size_t i = 0; i < fine.indices.size(); i += 3) {
            triangles.emplace_back(fine.indices[i], fine.indices[i + 1], fine.indices[i + 2]);
        }
        const std::vector<glm::uvec3> cover = flat_cover(positions, triangles);
        ASSERT_EQ(cover.size(), 2U) << factor;
        std::set<uint32_t> corners;
        for (const glm::uvec3& t : cover) {
            corners.insert({t.x, t.y, t.z});
        }
        EXPECT_EQ(corners, (std::set<uint32_t>{0, 1, 2, 3})) << "the first four are the wall's own";
    }
}

TEST(FlatCover, CurvedOutlinesKeepTheirCorners) {
    // A disk as a fan of 200: its middle goes, its rim stays.
    Piece piece;
    piece.positions.emplace_back(0.0);
    for (uint32_t i = 0; i < 200; ++i) {
        const double angle = 2.0 * pi * i / 200.0;
        piece.positions.emplace_back(5.0 * std::cos(angle), 5.0 * std::sin(angle), 0.0);
        piece.triangles.emplace_back(0, 1 + i, 1 + (i + 1) % 200);
    }
    expect_cover(piece, 198);
}

TEST(FlatCover, IsEmptyWhereThereIsNothingToGain) {
    EXPECT_TRUE(flat_cover({}, {}).empty());
    const Piece square = grid(1, 1);
    EXPECT_TRUE(flat_cover(square.positions, square.triangles).empty());
    // As few as its corners allow.
    const Piece cross = grid(3, 3, [](int x, int y) { return x == 1 || y == 1; });
    EXPECT_EQ(flat_cover(cross.positions, cross.triangles).size(), 0U);
}

TEST(FlatCover, IsEmptyWhereTrianglesBend) {
    Piece piece = grid(6, 6);
    piece.positions[24].z = 1e-3;
    EXPECT_TRUE(flat_cover(piece.positions, piece.triangles).empty());
    piece.positions[24].z = 1e-6;
    EXPECT_FALSE(flat_cover(piece.positions, piece.triangles).empty());
}

TEST(FlatCover, IsEmptyWhereTrianglesOverlap) {
    Piece piece = grid(6, 6);
    piece.triangles.push_back(piece.triangles[7]);
    EXPECT_TRUE(flat_cover(piece.positions, piece.triangles).empty());
    piece.triangles.back() = glm::uvec3(0, 9, 48);  // across others' edges
    EXPECT_TRUE(flat_cover(piece.positions, piece.triangles).empty());
}

TEST(FlatCover, IsEmptyWhereTheOutlineIsTooLong) {
    const Piece board = grid(60, 60, [](int x, int y) { return (x + y) % 2 == 0; });
    EXPECT_TRUE(flat_cover(board.positions, board.triangles).empty());
}

TEST(Outline, RunsRoundTheSurface) {
    const Piece piece = grid(3, 3, [](int x, int y) { return x != 1 || y != 1; });
    const std::vector<Outline> outlines = find_outlines(piece.triangles);
    ASSERT_EQ(outlines.size(), 2U);
    EXPECT_EQ(outlines[0].size(), 12U);
    EXPECT_EQ(outlines[1].size(), 4U);
    std::vector<glm::dvec2> places;
    for (const glm::dvec3& p : piece.positions) {
        places.emplace_back(p);
    }
    const auto doubled_area = [&](const Outline& outline) {
        double sum = 0.0;
        for (size_t i = 0; i < outline.size(); ++i) {
            const glm::dvec2& a = places[outline[i]];
            const glm::dvec2& b = places[outline[(i + 1) % outline.size()]];
            sum += a.x * b.y - a.y * b.x;
        }
        return sum;
    };
    EXPECT_NEAR(doubled_area(outlines[0]), 18.0, 1e-12);
    EXPECT_NEAR(doubled_area(outlines[1]), -2.0, 1e-12) << "clockwise about a hole";
    EXPECT_EQ(straighten(outlines[0], places, 1e-6).size(), 4U);
    EXPECT_EQ(straighten(outlines[1], places, 1e-6).size(), 4U);
}

TEST(Outline, StraightenStaysWithinTheTolerance) {
    std::mt19937 random(3);
    std::uniform_real_distribution<double> in(-1.0, 1.0);
    std::vector<glm::dvec2> places;
    Outline outline;
    for (uint32_t i = 0; i < 500; ++i) {
        const double angle = 2.0 * pi * i / 500.0;
        places.push_back((1.0 + 0.02 * in(random)) * glm::dvec2(std::cos(angle), std::sin(angle)));
        outline.push_back(i);
    }
    for (const double tolerance : {0.0, 1e-3, 1e-2, 0.1}) {
        const Outline straight = straighten(outline, places, tolerance);
        ASSERT_GE(straight.size(), 3U);
        EXPECT_LE(straight.size(), 500U);
        for (size_t i = 0; i < straight.size(); ++i) {
            const uint32_t from = straight[i];
            const uint32_t to = straight[(i + 1) % straight.size()];
            for (uint32_t v = from; v != to; v = (v + 1) % 500) {
                const glm::dvec2 ab = places[to] - places[from];
                const double along =
                    std::clamp(glm::dot(places[v] - places[from], ab) / glm::dot(ab, ab), 0.0, 1.0);
                ASSERT_LE(glm::distance(places[v], places[from] + along * ab), tolerance + 1e-12);
            }
        }
    }
    EXPECT_TRUE(straighten({0, 1, 2}, std::vector<glm::dvec2>{{0, 0}, {1, 0}, {0.5, 0}}, 1e-6).empty());
}

}  // namespace
}  // namespace bounce::scene::test
