// SPDX-License-Identifier: Apache-2.0
//
// What imperfect shadow maps keep: parabolic maps, texels that hold planes, points, bounced light.
#include <algorithm>
#include <random>

#include "shader_harness.h"

namespace bounce::test {
namespace {

class IsmGlsl : public ShaderTest {};

TEST_F(IsmGlsl, ParaboloidRoundTrip) {
    std::vector<glm::vec4> in;
    std::vector<glm::dvec3> all;
    double length = 1e-4;
    for (const glm::dvec3& d : directions(2000)) {
        if (d.z > -1e-9) {
            length = length > 10.0 ? 1e-4 : length * 1.3;
            in.emplace_back(glm::vec3(d * length), 0.0F);
            in.emplace_back(0.0F);
            all.push_back(d);
        }
    }
    const std::vector<glm::vec4> out = run("paraboloid.comp", 2, 3, in);
    for (size_t i = 0; i < all.size(); ++i) {
        const glm::dvec2 st(out[3 * i].x, out[3 * i].y);
        EXPECT_LE(glm::length(st), 1.0 + 1e-6) << "within the disk";
        // By the definition: a parabola z = (1 - r^2) / 2 turns the direction into one along z at (s, t).
        EXPECT_NEAR(glm::length(st), std::tan(0.5 * std::acos(std::min(all[i].z, 1.0))), 1e-5);
        EXPECT_LT(angle_between(glm::dvec3(glm::vec3(out[3 * i + 1])), all[i]), 2e-6);
    }
}

TEST_F(IsmGlsl, SolidAnglesOfTexels) {
    for (const int size : {32, 64, 128, 256}) {
        std::vector<glm::vec4> in;
        const double side = 2.0 / size;
        for (int y = 0; y < size; ++y) {
            for (int x = 0; x < size; ++x) {
                const glm::dvec2 st((x + 0.5) * side - 1.0, (y + 0.5) * side - 1.0);
                if (glm::dot(st, st) < 1.0) {
                    in.emplace_back(0.0F, 0.0F, 1.0F, 0.0F);
                    in.emplace_back(glm::dvec4(st, side * side, 0.0));
                }
            }
        }
        const std::vector<glm::vec4> out = run("paraboloid.comp", 2, 3, in);
        double sum = 0.0;
        double cosines = 0.0;
        for (size_t i = 0; i < out.size(); i += 3) {
            sum += static_cast<double>(out[i].z);
            cosines += static_cast<double>(out[i].z) * static_cast<double>(out[i + 2].z);
        }
        // The rim's texels are in or out as a whole: an error of the order of the number of texels to the
        // power -0.75.
        EXPECT_NEAR(sum / (2.0 * pi), 1.0, 2.0 * std::pow(size, -1.4)) << size;
        EXPECT_NEAR(cosines / pi, 1.0, 1e-3) << size << ": at the rim the cosine is 0";
    }
}

TEST_F(IsmGlsl, ASolidAngleIsThatOfTheDirections) {
    // The triangle of three directions next to each other, against what the map says of their triangle in it.
    std::vector<glm::vec4> in;
    constexpr double step = 2e-3;
    for (int i = 0; i < 400; ++i) {
        const double angle = 2.4 * i;
        const glm::dvec2 st = 0.98 * std::sqrt(i / 400.0) * glm::dvec2(std::cos(angle), std::sin(angle));
        for (const glm::dvec2& off : {glm::dvec2(0.0), glm::dvec2(step, 0.0), glm::dvec2(0.0, step)}) {
            in.emplace_back(0.0F, 0.0F, 1.0F, 0.0F);
            in.emplace_back(glm::dvec4(st + off - step / 3.0, 0.5 * step * step, 0.0));
        }
    }
    const std::vector<glm::vec4> out = run("paraboloid.comp", 2, 3, in);
    for (size_t i = 0; i < out.size(); i += 9) {
        const glm::dvec3 a(glm::vec3(out[i + 2]));
        const glm::dvec3 b(glm::vec3(out[i + 5]));
        const glm::dvec3 c(glm::vec3(out[i + 8]));
        const double solid_angle = std::abs(glm::dot(a, glm::cross(b, c))) /
                                   (1.0 + glm::dot(a, b) + glm::dot(b, c) + glm::dot(c, a)) * 2.0;
        EXPECT_NEAR((out[i].z + out[i + 3].z + out[i + 6].z) / 3.0F / solid_angle, 1.0, 1e-3);
    }
}

// Planes of all slopes as seen in texels all over the map; receivers on each texel's rays at `factor` times
// their distance to the plane.
struct PlaneTest {
    double factor, cosine, weight, depth;
    bool lit;
};

class IsmPlane : public IsmGlsl {
  protected:
    static std::vector<PlaneTest> test(int size, double factor, double least_cosine) {
        std::mt19937 random(11);
        std::uniform_real_distribution<double> unit(0.0, 1.0);
        std::normal_distribution<double> normal;
        std::vector<glm::vec4> in;
        while (in.size() < 3 * 40000) {
            const glm::dvec2 texel(std::floor(unit(random) * size), std::floor(unit(random) * size));
            const glm::dvec2 st = (texel + 0.5) * 2.0 / static_cast<double>(size) - 1.0;
            const double r2 = glm::dot(st, st);
            if (r2 >= 1.0) {
                continue;
            }
            const glm::dvec3 ray = glm::dvec3(2.0 * st, 1.0 - r2) / (1.0 + r2);
            // Cosines to the ray as surfaces of no particular direction have them.
            glm::dvec3 n = glm::normalize(glm::dvec3(normal(random), normal(random), normal(random)));
            n *= glm::dot(n, ray) < 0.0 ? -1.0 : 1.0;
            if (glm::dot(n, ray) < least_cosine) {
                continue;
            }
            in.emplace_back(glm::dvec4(n, 0.002 + 0.5 * unit(random)));
            in.emplace_back(glm::dvec4(texel, size, 0.0));
            in.emplace_back(glm::dvec4(unit(random), unit(random), factor, 0.0));
        }
        const std::vector<glm::vec4> out = run("ism_plane.comp", 3, 2, in);
        std::vector<PlaneTest> tests;
        for (size_t i = 0; i < out.size(); i += 2) {
            const double cosine = out[i].z;
            if (cosine > 0.0) {  // at the rim a ray of the texel may miss the plane
                const glm::vec4& place = in[i / 2 * 3 + 1];
                const glm::dvec2 st =
                    (glm::dvec2(place.x, place.y) + 0.5) * 2.0 / static_cast<double>(size) - 1.0;
                const double r2 = glm::dot(st, st);
                const double solid = 4.0 / ((1.0 + r2) * (1.0 + r2));
                tests.push_back(
                    {factor, cosine, cosine * (1.0 - r2) / (1.0 + r2) * solid, out[i].y, out[i].x > 0.5F});
                EXPECT_TRUE(out[i + 1].x == 1.0F || out[i].y > 65504.0F) << "an empty texel hides nothing";
            }
        }
        return tests;
    }
    // Of the light that reaches the planes, weighed by both cosines, the part that is lit.
    static double lit_share(const std::vector<PlaneTest>& tests) {
        double lit = 0.0;
        double all = 0.0;
        for (const PlaneTest& t : tests) {
            lit += t.lit ? t.weight : 0.0;
            all += t.weight;
        }
        return lit / all;
    }
};

TEST_F(IsmPlane, NeverHidesItself) {
    // What fails is steeper than a texel's slope can say, and counts for little. 32 texels a side are so few
    // that the map's own curvature across half of one reaches the last of what is given for rounding.
    struct Case {
        int size;
        double lit, steepest;
    };
    for (const Case& c :
         {Case{32, 0.997, 1.0}, {64, 0.9995, 0.1}, {128, 0.9998, 0.05}, {256, 0.9999, 0.02}}) {
        const std::vector<PlaneTest> tests = test(c.size, 1.0, 0.0);
        EXPECT_GE(lit_share(tests), c.lit) << c.size;
        for (const PlaneTest& t : tests) {
            EXPECT_TRUE(t.lit || t.cosine < c.steepest) << "map of " << c.size << ", cosine " << t.cosine;
        }
    }
}

TEST_F(IsmPlane, HidesWhatIsBehindAndNotWhatIsInFront) {
    // 2 % behind and 3 % in front: beyond what a texel gives for rounding, 0.8 %, twice at worst.
    for (const int size : {32, 64, 128, 256}) {
        for (const double factor : {0.5, 0.97}) {
            EXPECT_EQ(lit_share(test(size, factor, 0.2)), 1.0) << size << ' ' << factor;
            EXPECT_GE(lit_share(test(size, factor, 0.0)), 0.999) << size << ' ' << factor;
        }
        for (const double factor : {1.02, 1.1, 100.0}) {
            EXPECT_EQ(lit_share(test(size, factor, 0.2)), 0.0) << size << ' ' << factor;
            EXPECT_LE(lit_share(test(size, factor, 0.0)), 0.004) << size << ' ' << factor;
        }
    }
}

// Part of random planes' places that a light at infinity lights, `behind` texel widths behind the plane.
class IsmDistant : public IsmGlsl {
  protected:
    double lit(double size, double steepest, double behind) {
        std::mt19937 random(7);
        std::uniform_real_distribution<float> unit(0.0F, 1.0F);
        std::vector<glm::vec4> in;
        constexpr int count = 4000;
        for (int i = 0; i < count; ++i) {
            const float angle = unit(random) * 6.2831853F;
            const float steep = unit(random) * static_cast<float>(steepest);
            in.emplace_back(1.8F * unit(random) - 0.9F, steep * std::cos(angle), steep * std::sin(angle),
                            static_cast<float>(size));
            in.emplace_back(unit(random), unit(random), static_cast<float>(behind * 2.0 / size), 0.0F);
        }
        int lit = 0;
        for (const glm::vec4& out : run("ism_distant.comp", 2, 1, in, {{"DISTANT", "1"}})) {
            lit += out.x > 0.5F ? 1 : 0;
            EXPECT_EQ(out.y, 1.0F) << "an empty texel hides nothing";
        }
        return static_cast<double>(lit) / count;
    }
};

TEST_F(IsmDistant, APlaneNeverHidesItselfHoweverSteep) {
    for (const int size : {32, 64, 256}) {
        EXPECT_EQ(lit(size, 7.9, 0.0), 1.0) << size;
        EXPECT_EQ(lit(size, 100.0, 0.0), 1.0) << size << ", beyond what its slopes can say";
    }
}

TEST_F(IsmDistant, HidesWhatIsBehind) {
    // Rounding of slopes takes a sixteenth of a texel's width at most, that of depths 65,536 steps of 2.
    for (const int size : {32, 64, 256}) {
        EXPECT_EQ(lit(size, 7.9, 0.07), 0.0) << size;
        EXPECT_EQ(lit(size, 7.9, 1.0), 0.0) << size;
        EXPECT_EQ(lit(size, 7.9, -0.07), 1.0) << size;
    }
}

// Depths of a map of `side` texels after pull-push; negative: a hole.
class PullPush : public IsmGlsl {
  protected:
    using Map = std::vector<double>;

    static Map fill(const Map& map, int side, int levels, double pull, double push, bool paper) {
        std::vector<glm::vec4> in;
        for (const double depth : map) {
            in.emplace_back(static_cast<float>(depth), 0.0F, 0.0F, 0.0F);
        }
        const int items = side * side / 64;
        gl::Defines defines{{"SIDE", std::to_string(side)},
                            {"LEVELS", std::to_string(levels)},
                            {"PULL", std::to_string(pull)},
                            {"PUSH", std::to_string(push)}};
        if (paper) {
            defines["PAPER"] = "1";
        }
        Map out;
        for (const glm::vec4& value : run("pull_push.comp", items, items, in, defines)) {
            out.push_back(value.x);
        }
        return out;
    }
    // The same in doubles, with whole images a level, written from Marroquim et al. 2007 and the thresholds
    // of the 2008 paper: a parent is the mean of its children that lie within the threshold of the nearest
    // one; a hole takes the bilinear mean of the four parents around it that are there.
    static Map reference(const Map& map, int side, int levels, double pull, double push, bool paper) {
        if (levels == 0) {
            return map;
        }
        const int half = side / 2;
        const auto at = [](int n, int x, int y) { return static_cast<size_t>(y * n + x); };
        Map coarse(static_cast<size_t>(half * half), -1.0);
        for (int y = 0; y < half; ++y) {
            for (int x = 0; x < half; ++x) {
                std::vector<double> there;
                for (const int i : {0, 1, 2, 3}) {
                    if (const double depth = map[at(side, 2 * x + i % 2, 2 * y + i / 2)]; depth >= 0.0) {
                        there.push_back(depth);
                    }
                }
                if (!there.empty()) {
                    const double nearest = *std::min_element(there.begin(), there.end());
                    double sum = 0.0;
                    double count = 0.0;
                    double farthest = nearest;
                    for (const double depth : there) {
                        farthest = depth <= nearest + pull ? std::max(farthest, depth) : farthest;
                        sum += depth <= nearest + pull ? depth : 0.0;
                        count += depth <= nearest + pull ? 1.0 : 0.0;
                    }
                    coarse[at(half, x, y)] = paper ? sum / count : farthest;
                }
            }
        }
        coarse = reference(coarse, half, levels - 1, 2.0 * pull, 2.0 * push, paper);
        Map out = map;
        for (int y = 0; y < side; ++y) {
            for (int x = 0; x < side; ++x) {
                double sum = 0.0;
                double weights = 0.0;
                double farthest = -1.0;
                // A texel's middle in the coarse level's texels.
                const double u = 0.5 * (x + 0.5) - 0.5;
                const double v = 0.5 * (y + 0.5) - 0.5;
                for (int j = 0; j < 2; ++j) {
                    for (int i = 0; i < 2; ++i) {
                        const int cx = static_cast<int>(std::floor(u)) + i;
                        const int cy = static_cast<int>(std::floor(v)) + j;
                        const double depth =
                            coarse[at(half, std::clamp(cx, 0, half - 1), std::clamp(cy, 0, half - 1))];
                        if (depth >= 0.0) {
                            const double w = (1.0 - std::abs(u - cx)) * (1.0 - std::abs(v - cy));
                            sum += w * depth;
                            weights += w;
                            farthest = std::max(farthest, depth);
                        }
                    }
                }
                const double pushed = !paper ? farthest : weights > 0.0 ? sum / weights : -1.0;
                double& depth = out[at(side, x, y)];
                if (depth < 0.0 || (paper && pushed >= 0.0 && depth - pushed > push)) {
                    depth = pushed;
                }
            }
        }
        return out;
    }
};

TEST_F(PullPush, AConstantStaysConstantAndItsHolesAreFilled) {
    std::mt19937 random(2);
    for (const int side : {16, 32, 64}) {
        for (const int levels : {1, 2, 3}) {
            for (const bool paper : {false, true}) {
                // One texel of each coarsest block, and half of the others.
                PullPush::Map map(static_cast<size_t>(side * side), 0.37);
                for (int i = 0; i < side * side; ++i) {
                    const int block = 1 << levels;
                    const bool kept = i % side % block == 1 && i / side % block == 0;
                    map[static_cast<size_t>(i)] = kept || random() % 2 == 0 ? 0.37 : -1.0;
                }
                for (const double depth : fill(map, side, levels, 0.05, 0.05, paper)) {
                    ASSERT_NEAR(depth, 0.37, 1e-6) << side << ' ' << levels;
                }
            }
        }
    }
}

TEST_F(PullPush, HolesBeyondItsReachStay) {
    // A single texel: one level reaches a texel beyond its own block of two, and nothing further.
    PullPush::Map map(32 * 32, -1.0);
    map[16 * 32 + 16] = 0.5;
    const PullPush::Map out = fill(map, 32, 1, 0.05, 0.05, false);
    for (int y = 0; y < 32; ++y) {
        for (int x = 0; x < 32; ++x) {
            const bool reached = x >= 15 && x <= 18 && y >= 15 && y <= 18;
            EXPECT_EQ(out[static_cast<size_t>(y * 32 + x)], reached ? 0.5 : -1.0) << x << ' ' << y;
        }
    }
    const PullPush::Map none = fill(PullPush::Map(32 * 32, -1.0), 32, 3, 0.05, 0.05, true);
    EXPECT_EQ(*std::max_element(none.begin(), none.end()), -1.0) << "nothing comes from nothing";
    EXPECT_EQ(fill(map, 32, 0, 0.05, 0.05, false), map) << "no levels, no change";
}

TEST_F(PullPush, FarTexelsAreReplacedOnlyAsInThePaperAndOnlyBeyondTheThreshold) {
    // A near surface at 0.2 with lone texels behind it. Their parents are near: three near children of four,
    // and far ones are not averaged in.
    for (const double behind : {0.04, 0.06, 0.5}) {
        PullPush::Map map(32 * 32, 0.2);
        for (int y = 1; y < 32; y += 4) {
            for (int x = 2; x < 32; x += 4) {
                map[static_cast<size_t>(y * 32 + x)] = 0.2 + behind;
            }
        }
        EXPECT_NEAR(fill(map, 32, 1, 0.01, 0.05, false)[32 + 2], 0.2 + behind, 1e-6)
            << "filling replaces nothing";
        const double replaced = fill(map, 32, 1, 0.01, 0.05, true)[32 + 2];
        EXPECT_NEAR(replaced, behind > 0.05 ? 0.2 : 0.2 + behind, 1e-6) << behind;
        for (const double depth : fill(map, 32, 1, 0.01, 1.0, true)) {
            EXPECT_TRUE(std::abs(depth - 0.2) < 1e-6 || std::abs(depth - 0.2 - behind) < 1e-6);
        }
    }
}

TEST_F(PullPush, AsWrittenDownApart) {
    std::mt19937 random(8);
    std::uniform_real_distribution<double> depth(0.1, 0.6);
    for (const int side : {32, 64}) {
        for (const int levels : {1, 2, 3}) {
            for (const bool paper : {false, true}) {
                PullPush::Map map;
                for (int i = 0; i < side * side; ++i) {
                    // Dense to the left, sparse to the right.
                    const bool kept = static_cast<int>(random() % 64) > i % side * 64 / side;
                    map.push_back(kept ? static_cast<double>(static_cast<float>(depth(random))) : -1.0);
                }
                const PullPush::Map expected = reference(map, side, levels, 0.07, 0.11, paper);
                const PullPush::Map got = fill(map, side, levels, 0.07, 0.11, paper);
                int changed = 0;
                int differ = 0;
                for (size_t i = 0; i < map.size(); ++i) {
                    changed += std::abs(got[i] - map[i]) > 1e-6 ? 1 : 0;
                    differ += std::abs(got[i] - expected[i]) > 1e-5 ? 1 : 0;
                }
                EXPECT_GT(changed, side);
                // One in a thousand lies within rounding of a threshold.
                EXPECT_LE(differ, side * side / 1000 + 1) << side << ' ' << levels << ' ' << paper;
            }
        }
    }
}

TEST_F(IsmGlsl, PointsArePacked) {
    std::vector<glm::vec4> in;
    const std::vector<glm::dvec3> normals = directions(3000);
    double radius = 1e-4;
    for (size_t i = 0; i < normals.size(); ++i) {
        radius = radius > 0.5 ? 1e-4 : radius * 1.1;
        in.emplace_back(glm::dvec4(1.0 / 3.0 * normals[(i * 7) % normals.size()], radius));
        in.emplace_back(glm::dvec4(normals[i], i % 2));
    }
    const std::vector<glm::vec4> out = run("point.comp", 2, 2, in);
    double worst = 0.0;
    for (size_t i = 0; i < normals.size(); ++i) {
        EXPECT_EQ(glm::vec3(out[2 * i]), glm::vec3(in[2 * i])) << "positions keep all bits";
        // Eleven bits; subnormal below 6e-5.
        EXPECT_NEAR(out[2 * i].w / in[2 * i].w, 1.0F, 1.0F / 2048.0F);
        EXPECT_EQ(out[2 * i + 1].w, in[2 * i + 1].w) << "flat or not";
        worst = std::max(worst, angle_between(glm::dvec3(glm::vec3(out[2 * i + 1])), normals[i]));
        EXPECT_NEAR(glm::length(glm::vec3(out[2 * i + 1])), 1.0F, 1e-6F);
    }
    // Cigolle et al. 2014, table 1: rounded to 2 x 8 bits, 0.94 degrees at worst.
    EXPECT_LT(worst, 0.95 * pi / 180.0);
    EXPECT_GT(worst, 1e-3) << "a case that tells";
    const std::vector<glm::vec4> hidden = run("point.comp", 2, 2, {glm::vec4(0.0F), glm::vec4(0, 0, 1, 0)});
    EXPECT_EQ(hidden[0].w, 0.0F) << "a radius of 0 stays 0";
}

TEST_F(IsmGlsl, BouncedLightIsPacked) {
    std::vector<glm::vec4> in;
    std::mt19937 random(1);
    std::uniform_real_distribution<double> exponent(-4.0, 4.8);
    for (int i = 0; i < 2000; ++i) {
        const auto value = [&] { return static_cast<float>(std::pow(10.0, exponent(random))); };
        in.emplace_back(value(), value(), value(), static_cast<float>(i) / 2000.0F);
        in.emplace_back(value(), value(), value(), 0.0F);
    }
    in.emplace_back(1e30F, 70000.0F, 0.0F, 1e-7F);
    in.emplace_back(0.0F, 65504.0F, 1e9F, 0.0F);
    const std::vector<glm::vec4> out = run("bounced.comp", 2, 2, in);
    for (size_t i = 0; i < in.size(); ++i) {
        for (int c = 0; c < 3; ++c) {
            const float expected = std::min(in[i][c], 65504.0F);  // never infinite
            EXPECT_NEAR(out[i][c], expected, expected / 2048.0F) << i << ' ' << c;
        }
        if (i % 2 == 0) {
            EXPECT_EQ(out[i].w, in[i].w) << "depth keeps all bits";
        }
    }
}

}  // namespace
}  // namespace bounce::test
