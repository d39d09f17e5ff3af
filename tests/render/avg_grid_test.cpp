// SPDX-License-Identifier: Apache-2.0
//
// The approximate visibility grid: no part of a surface is missing from it, and what it holds is the
// surface's.
#include <bit>
#include <cstring>

#include "avg_fixture.h"

namespace bounce::test {
namespace {

class AvgGridOf : public ::testing::Test {
  protected:
    void SetUp() override { require_context(); }

    static scene::Scene scene_of(const std::vector<glm::vec3>& corners,
                                 const glm::dmat4& matrix = glm::dmat4(1.0)) {
        scene::Scene scene;
        scene.from_blender = true;
        add_mesh_node(scene, add_triangles(scene, corners, add_diffuse(scene, glm::vec3(0.25F, 0.5F, 0.75F))),
                      matrix);
        return scene;
    }
    static double area_of(const std::vector<glm::vec3>& corners) {
        double sum = 0.0;
        for (size_t i = 0; i < corners.size(); i += 3) {
            const glm::dvec3 a(corners[i]);
            sum +=
                0.5 * glm::length(glm::cross(glm::dvec3(corners[i + 1]) - a, glm::dvec3(corners[i + 2]) - a));
        }
        return sum;
    }
    // Triangles of all shapes: across the whole grid, below a voxel, and slivers of any length.
    static std::vector<glm::vec3> all_shapes(int count) {
        std::mt19937 random(7);
        std::uniform_real_distribution<float> place(-1.0F, 1.0F);
        std::uniform_real_distribution<float> exponent(-5.0F, 0.3F);
        std::vector<glm::vec3> out;
        for (int i = 0; i < count; ++i) {
            const glm::vec3 a(place(random), place(random), place(random));
            for (int k = 0; k < 3; ++k) {
                const float size = std::pow(10.0F, exponent(random));
                const glm::vec3 to(place(random), place(random), place(random));
                out.push_back(glm::clamp(a + to * size, glm::vec3(-1.0F), glm::vec3(1.0F)));
            }
        }
        return out;
    }
};

TEST_F(AvgGridOf, TrianglesOfAllShapesHasEveryPlaceOfThem) {
    const std::vector<glm::vec3> corners = all_shapes(4000);
    for (const int size : {32, 64}) {
        const ReadGrid grid = trace(scene_of(corners), traced(size)).grid;
        std::mt19937 random(11);
        std::uniform_real_distribution<double> part(0.0, 1.0);
        int places = 0;
        for (size_t i = 0; i < corners.size(); i += 3) {
            const glm::dvec3 a(corners[i]);
            const glm::dvec3 ab = glm::dvec3(corners[i + 1]) - a;
            const glm::dvec3 ac = glm::dvec3(corners[i + 2]) - a;
            const glm::dvec3 n = glm::cross(ab, ac);
            const glm::dvec3 sizes = glm::abs(n);
            const double most = std::max({sizes.x, sizes.y, sizes.z});
            std::array<double, 3> sorted = {sizes.x, sizes.y, sizes.z};
            std::sort(sorted.begin(), sorted.end());
            if (sorted[1] > 0.999 * most || !(most > 1e-4 * glm::dot(ab, ab))) {
                continue;  // rounding decides which axis it belongs to
            }
            for (int k = 0; k < 20; ++k, ++places) {
                double u = part(random);
                double v = part(random);
                if (u + v > 1.0) {
                    u = 1.0 - u;
                    v = 1.0 - v;
                }
                ASSERT_TRUE(holds(grid, a + ab * u + ac * v, n)) << "triangle " << i / 3;
            }
        }
        EXPECT_GT(places, 40000);
    }
}

TEST_F(AvgGridOf, ATriangleThatRoundingThinsToALineIsInAllItsVoxels) {
    // A thousandth of a voxel wide and as long as the grid, along every kind of way.
    std::mt19937 random(3);
    std::uniform_real_distribution<float> place(-1.0F, 1.0F);
    std::vector<glm::vec3> corners;
    for (int i = 0; i < 300; ++i) {
        const glm::vec3 a(place(random), place(random), place(random));
        const glm::vec3 b(place(random), place(random), place(random));
        corners.insert(corners.end(), {a, b, b + glm::vec3(place(random), place(random), 1.0F) * 2e-5F});
    }
    const ReadGrid grid = trace(scene_of(corners), traced(64)).grid;
    for (size_t i = 0; i < corners.size(); i += 3) {
        for (double t = 0.003; t < 1.0; t += 0.01) {
            const glm::dvec3 at =
                grid.voxels(glm::mix(glm::dvec3(corners[i]), glm::dvec3(corners[i + 1]), t));
            const glm::dvec3 inside = at - glm::floor(at);
            // Not within rounding of a voxel's side.
            if (std::min({inside.x, inside.y, inside.z}) > 2e-3 &&
                std::max({inside.x, inside.y, inside.z}) < 0.998) {
                EXPECT_NE(grid.word(glm::ivec3(glm::floor(at))), 0U) << "triangle " << i / 3 << " at " << t;
            }
        }
    }
}

TEST_F(AvgGridOf, SurfacesHasTheirArea) {
    // Voxels reach into each other by 1/4096 on each side, so a plane counts (1 + 2/4096)^2 times: 0.1 %; and
    // its edges somewhat more.
    std::vector<glm::vec3> one = {{-1.0F, -0.8F, -0.9F}, {1.0F, -0.3F, 0.2F}, {-0.2F, 0.9F, 1.0F}};
    EXPECT_NEAR(trace(scene_of(one), traced(64)).grid.area_m2() / area_of(one), 1.0, 0.002) << "one triangle";
    const std::vector<glm::vec3> specks = box_triangles(glm::vec3(1.0F, 0.7F, 0.5F), 150);
    const glm::dmat4 turned = rotated(33.0, {0.3, 1.0, 0.2});
    EXPECT_NEAR(trace(scene_of(specks, turned), traced(32)).grid.area_m2() / area_of(specks), 1.0, 0.002)
        << specks.size() / 3 << " triangles below a voxel";
    const std::vector<glm::vec3> sides = box_triangles(glm::vec3(1.0F, 0.7F, 0.5F), 1);
    EXPECT_NEAR(trace(scene_of(sides, turned), traced(64)).grid.area_m2() / area_of(sides), 1.0, 0.002)
        << "twelve triangles";
}

TEST_F(AvgGridOf, WallsOfABoxHasFlatSlabsAndTheirColour) {
    const glm::dmat4 turned = rotated(20.0, {0.1, 0.2, 1.0});
    const ReadGrid grid = trace(scene_of(box_triangles(glm::vec3(1.0F), 1), turned), traced(64)).grid;
    int flat = 0;
    int all = 0;
    for (const auto& [place, surface] : grid.sorted()) {
        // Of what faces up, and of what faces down; one of them is empty.
        const glm::dvec4 slabs = glm::dvec4(surface.slab) / AVG_SLAB_STEPS;
        const double up = slabs.y - slabs.x;
        const double down = slabs.w - slabs.z;
        ++all;
        flat += (up < 0.0) != (down < 0.0) && std::max(up, down) < 0.01 ? 1 : 0;
        for (int c = 0; c < 3; ++c) {
            EXPECT_NEAR(surface.color[c], 0.25 * (c + 1), 5e-4) << "to the sums' steps of the least area";
        }
        EXPECT_EQ(surface.tensor_rest.w, 1.0F) << "no hole";
    }
    // Three walls' normals point along different axes, so that not even where they meet are two of them one
    // surface.
    EXPECT_EQ(flat, all);
}

TEST_F(AvgGridOf, TheTwoSidesOfAThinWallDoNotCancelOut) {
    // Normals that add up to nothing.
    std::vector<glm::vec3> corners = box_triangles(glm::vec3(1.0F, 1.0F, 1e-3F), 1);
    const ReadGrid grid = trace(scene_of(corners, rotated(25.0, {1.0, 0.3, 0.0})), traced(32)).grid;
    const glm::dvec3 n = glm::dvec3(rotated(25.0, {1.0, 0.3, 0.0}) * glm::dvec4(0.0, 0.0, 1.0, 0.0));
    int looked_at = 0;
    for (const auto& [place, surface] : grid.sorted()) {
        if (place[3] != main_axis(n) || surface.tensor_diagonal.w < 0.5F) {
            continue;
        }
        ++looked_at;
        EXPECT_NEAR(std::abs(glm::dot(glm::dvec3(glm::vec3(surface.normal)), n)), 1.0, 1e-3);
    }
    EXPECT_GT(looked_at, 500);
}

TEST_F(AvgGridOf, TheSameTrianglesInAnyOrderAreTheSameBits) {
    const auto bits = [](const std::map<std::array<int, 4>, gpu::GpuAvgVoxel>& sorted) {
        std::vector<std::byte> out;
        for (const auto& [place, surface] : sorted) {
            const auto* bytes = reinterpret_cast<const std::byte*>(&surface);
            out.insert(out.end(), bytes, bytes + sizeof(surface));
        }
        return out;
    };
    for (const int count : {300, 6000}) {  // of the latter there is not room for all
        const std::vector<glm::vec3> corners = all_shapes(count);
        const auto first = bits(trace(scene_of(corners), traced(32)).grid.sorted());
        EXPECT_TRUE(first == bits(trace(scene_of(corners), traced(32)).grid.sorted()));
        // Triangle by triangle backwards; the scene has its bounds from the same corners.
        std::vector<glm::vec3> backwards;
        for (size_t i = corners.size(); i >= 3; i -= 3) {
            backwards.insert(backwards.end(), {corners[i - 3], corners[i - 2], corners[i - 1]});
        }
        EXPECT_TRUE(first == bits(trace(scene_of(backwards), traced(32)).grid.sorted()));
        EXPECT_GT(first.size(), 1000 * sizeof(gpu::GpuAvgVoxel));
    }
}

// A square whose texture has a colour, and holes, by a function of the texel.
template <typename Texel>
scene::Scene textured_square(int texels, const Texel& texel, scene::AlphaMode mode) {
    scene::Scene scene;
    scene.from_blender = true;
    const int material = add_diffuse(scene);
    scene.materials[0].alpha_mode = mode;
    scene.materials[0].alpha_cutoff = 0.5F;
    scene.textures.resize(1);
    scene.textures[0].image = 0;
    scene::Image image;
    image.width = image.height = texels;
    for (int y = 0; y < texels; ++y) {
        for (int x = 0; x < texels; ++x) {
            const std::array<uint8_t, 4> rgba = texel(x, y);
            image.rgba8.insert(image.rgba8.end(), rgba.begin(), rgba.end());
        }
    }
    scene.images.push_back(image);
    scene.materials[0].base_color_texture.texture = 0;
    const int square = add_square(scene, 2.0F, material);
    scene.meshes[0].primitives[0].uv0 = {{0, 0}, {1, 0}, {1, 1}, {0, 1}};
    add_mesh_node(scene, square, glm::dmat4(1.0));
    return scene;
}

TEST_F(AvgGridOf, ATextureHasItsMeanOverEachVoxel) {
    // Columns of black and white finer than a voxel, to the left; red to the right.
    const scene::Scene scene = textured_square(
        512,
        [](int x, int) -> std::array<uint8_t, 4> {
            if (x >= 256) return {255, 0, 0, 255};
            return x % 2 == 0 ? std::array<uint8_t, 4>{255, 255, 255, 255}
                              : std::array<uint8_t, 4>{0, 0, 0, 255};
        },
        scene::AlphaMode::opaque);
    const ReadGrid grid = trace(scene, traced(32)).grid;
    int looked_at = 0;
    for (const auto& [place, surface] : grid.sorted()) {
        const double x = (place[0] + 0.5) / grid.layout.size.x;
        if (surface.tensor_diagonal.w < 0.9F || std::abs(x - 0.5) < 0.1) {
            continue;
        }
        ++looked_at;
        // The mean of light, not of encoded values: half of white is 0.5.
        EXPECT_NEAR(surface.color.r, x < 0.5 ? 0.5 : 1.0, 0.02);
        EXPECT_NEAR(surface.color.g, x < 0.5 ? 0.5 : 0.0, 0.02);
    }
    EXPECT_GT(looked_at, 500);
}

TEST_F(AvgGridOf, WhatIsCutOutIsNotThere) {
    const auto quarters = [](int x, int y) -> std::array<uint8_t, 4> {
        // Nothing to the left; to the right a quarter of each block of 8 x 8 texels.
        const bool opaque = x >= 256 && x % 8 < 4 && y % 8 < 4;
        return {200, 200, 200, static_cast<uint8_t>(opaque ? 255 : 0)};
    };
    const ReadGrid grid = trace(textured_square(512, quarters, scene::AlphaMode::mask), traced(32)).grid;
    double coverage = 0.0;
    int looked_at = 0;
    for (const auto& [place, surface] : grid.sorted()) {
        const double x = (place[0] + 0.5) / grid.layout.size.x;
        EXPECT_GT(x, 0.45) << "a hole";
        if (x > 0.55 && surface.tensor_diagonal.w > 0.0F) {
            coverage += static_cast<double>(surface.tensor_rest.w);
            ++looked_at;
        }
    }
    ASSERT_GT(looked_at, 300);
    // A few samples of a texture's levels, whose alpha is a mean that the cutoff rounds up or down.
    EXPECT_NEAR(coverage / looked_at, 0.25, 0.12);
    const auto veil = [](int, int) -> std::array<uint8_t, 4> { return {200, 200, 200, 102}; };
    const ReadGrid half = trace(textured_square(16, veil, scene::AlphaMode::blend), traced(32)).grid;
    for (const auto& [place, surface] : half.sorted()) {
        EXPECT_NEAR(surface.tensor_rest.w, 0.4, 0.005);
    }
}

TEST_F(AvgGridOf, MoreSurfacesThanThereIsRoomForAreStillThere) {
    // Far more voxels with surfaces than the list holds: the last ones share a place.
    std::mt19937 random(5);
    std::uniform_real_distribution<float> place(-1.0F, 1.0F);
    std::vector<glm::vec3> corners;
    for (int i = 0; i < 200000; ++i) {
        const glm::vec3 a(place(random), place(random), place(random));
        const glm::vec3 b(place(random), place(random), place(random));
        const glm::vec3 c(place(random), place(random), place(random));
        corners.insert(corners.end(), {a, a + b * 4e-3F, a + c * 4e-3F});
    }
    const ReadGrid grid = trace(scene_of(corners), traced(32)).grid;
    ASSERT_GT(grid.found, grid.layout.size.w);
    for (size_t i = 0; i < corners.size(); i += 300) {
        const glm::dvec3 at = grid.voxels(glm::dvec3(corners[i] + corners[i + 1] + corners[i + 2]) / 3.0);
        EXPECT_NE(grid.word(glm::ivec3(glm::floor(at))), 0U);
    }
    for (const int most : {grid.surfaces.back().slab.y, grid.surfaces.back().slab.w}) {
        EXPECT_GE(most, 2 * static_cast<int>(AVG_SLAB_STEPS) - 1) << "anywhere in its voxels";
    }
}

TEST_F(AvgGridOf, AMovingThingStaysOnTheSameLattice) {
    scene::Scene scene = scene_of(box_triangles(glm::vec3(1.0F), 1));
    const scene::Pose pose = scene::evaluate_pose(scene, 0.0);
    const scene::Bounds first = scene::world_bounds(scene, pose);
    const gpu::RenderSpace space = gpu::RenderSpace::around(first);
    const gpu::AvgUniforms still = avg_layout(first, first, space, 64, 1LL << 27);
    EXPECT_EQ(glm::ivec3(still.size), glm::ivec3(64));
    for (const double by : {0.001, 0.37, 5.0}) {
        scene::Bounds moved_bounds = first;
        moved_bounds.high.x += by;
        moved_bounds.low.y += 0.4;
        const gpu::AvgUniforms now = avg_layout(first, moved_bounds, space, 64, 1LL << 27);
        const double ratio = static_cast<double>(now.origin.w / still.origin.w);
        EXPECT_NEAR(std::log2(ratio), std::round(std::log2(ratio)), 1e-6);
        EXPECT_LE(std::max({now.size.x, now.size.y, now.size.z}), 64);
        // What the pose shows is inside.
        const glm::dvec3 low = (space.point(moved_bounds.low) - glm::dvec3(glm::vec3(now.origin))) /
                               static_cast<double>(now.origin.w);
        const glm::dvec3 high = (space.point(moved_bounds.high) - glm::dvec3(glm::vec3(now.origin))) /
                                static_cast<double>(now.origin.w);
        EXPECT_TRUE(glm::all(glm::greaterThan(low, glm::dvec3(-1e-3))));
        EXPECT_TRUE(glm::all(glm::lessThan(high, glm::dvec3(glm::ivec3(now.size)) + 1e-3)));
        if (ratio == 1.0) {
            const double shift = static_cast<double>((now.origin.y - still.origin.y) / still.origin.w);
            EXPECT_NEAR(shift, std::round(shift), 1e-3) << "whole voxels";
        }
    }
}

}  // namespace
}  // namespace bounce::test
