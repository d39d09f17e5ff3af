// SPDX-License-Identifier: Apache-2.0
//
// Images of the world: their layout, and what is read of them.
#include "scene/environment.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include <gtest/gtest.h>

#include "gltf_builder.h"
#include "image/image_io.h"
#include "scene/pose.h"

namespace bounce::scene::test {
namespace {

using nlohmann::json;

TEST(Environment, IsLaidOutAsInCycles) {
    // Cycles: u = 1/2 - atan2(y, x) / 2 pi with Z up; here Y is up and Z is its -Y.
    const auto near = [](const glm::dvec3& a, const glm::dvec3& b) { return glm::length(a - b) < 1e-12; };
    EXPECT_TRUE(near(environment_direction(0.5, 0.5), {1, 0, 0}));
    EXPECT_TRUE(near(environment_direction(0.25, 0.5), {0, 0, -1}));
    EXPECT_TRUE(near(environment_direction(0.75, 0.5), {0, 0, 1}));
    EXPECT_TRUE(near(environment_direction(0.0, 0.5), {-1, 0, 0}));
    EXPECT_TRUE(near(environment_direction(0.3, 0.0), {0, 1, 0}));
    double all = 0.0;
    for (int y = 0; y < 7; ++y) {
        all += 5.0 * environment_texel_sr(5, 7, y);
    }
    EXPECT_NEAR(all, 4.0 * std::numbers::pi, 1e-12);
}

std::vector<uint8_t> exr(const std::vector<float>& rgb, int width, int height) {
    const TemporaryFolder folder;
    bounce::Image image(width, height);
    std::copy(rgb.begin(), rgb.end(), image.rgb.begin());
    write_image(folder.path() / "w.exr", image, {}, ExrValues::full);
    std::FILE* file = std::fopen((folder.path() / "w.exr").c_str(), "rb");
    std::vector<uint8_t> bytes(std::filesystem::file_size(folder.path() / "w.exr"));
    EXPECT_EQ(std::fread(bytes.data(), 1, bytes.size(), file), bytes.size());
    std::fclose(file);
    return bytes;
}

GltfBuilder under(const json& image, GltfBuilder builder = {}) {
    builder.triangle_node();
    builder.use_extension("BOUNCE_scene");
    builder.root["extensions"]["BOUNCE_scene"] = {{"version", 1},
                                                  {"world",
                                                   {{"color", {0.1, 0.2, 0.3}},
                                                    {"strength", 2.0},
                                                    {"rotation", {0.0, 0.70710678, 0.0, 0.70710678}},
                                                    {"image", image}}}};
    return builder;
}

GltfBuilder under_view(const std::vector<uint8_t>& bytes, const std::string& name = "sky") {
    GltfBuilder builder;
    const int view = builder.view(bytes.data(), bytes.size());
    return under({{"name", name}, {"bufferView", view}, {"mimeType", "image/x-exr"}}, builder);
}

TEST(LoaderEnvironment, ExrInTheFile) {
    const LoadResult loaded = under_view(exr({1, 2, 3, 4, 5, 1e5F}, 2, 1)).load();
    ASSERT_TRUE(loaded.scene.environment.has_value());
    EXPECT_EQ(loaded.scene.environment->rgb, (std::vector<float>{1, 2, 3, 4, 5, 1e5F}));
    EXPECT_EQ(loaded.scene.environment->name, "sky");
    EXPECT_EQ(loaded.scene.world.color, glm::vec3(2.5F, 3.5F, 50001.5F)) << "the mean";
    EXPECT_NEAR(loaded.scene.world.world_from_environment.y, 0.7071068, 1e-6);
    EXPECT_TRUE(loaded.warnings.empty());
}

TEST(LoaderEnvironment, RadianceFileBesideIt) {
    const TemporaryFolder folder;
    std::string hdr = "#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y 1 +X 2\n";
    hdr += std::string{'\x80', '\x40', '\x20', '\x81'} + std::string{'\x40', '\x40', '\x40', '\x82'};
    folder.write("sky 1.hdr", hdr);
    GltfBuilder builder =
        under({{"name", "sky"}, {"uri", "sky%201.hdr"}, {"mimeType", "image/vnd.radiance"}});
    const LoadResult loaded = load_gltf(folder.write("scene.glb", builder.glb()));
    ASSERT_TRUE(loaded.scene.environment.has_value()) << (loaded.warnings.empty() ? "" : loaded.warnings[0]);
    EXPECT_NEAR(loaded.scene.environment->rgb[0], 1.0F, 0.01F);
    EXPECT_NEAR(loaded.scene.environment->rgb[1], 0.5F, 0.01F);
    EXPECT_NEAR(loaded.scene.environment->rgb[3], 1.0F, 0.02F);
}

TEST(LoaderEnvironment, WhatIsNoRadianceCountsAsNone) {
    const float nan = std::numeric_limits<float>::quiet_NaN();
    const float inf = std::numeric_limits<float>::infinity();
    const LoadResult loaded = under_view(exr({nan, 1, inf, -1, -2, 3}, 2, 1)).load();
    ASSERT_TRUE(loaded.scene.environment.has_value());
    EXPECT_EQ(loaded.scene.environment->rgb, (std::vector<float>{0, 1, 0, 0, 0, 3}));
    ASSERT_EQ(loaded.warnings.size(), 2U);
    EXPECT_NE(loaded.warnings[0].find("sky has 2 values that are not finite"), std::string::npos);
    EXPECT_NE(loaded.warnings[1].find("sky has 2 negative values"), std::string::npos);
}

TEST(LoaderEnvironment, AnImageThatCannotBeReadIsTheWorldsColour) {
    std::vector<uint8_t> cut = exr({1, 2, 3, 4, 5, 6}, 2, 1);
    cut.resize(cut.size() / 2);
    for (GltfBuilder builder : {under_view(cut), under_view({1, 2, 3, 4}),
                                under({{"name", "sky"}, {"uri", "gone.exr"}}), under({{"name", "sky"}})}) {
        const LoadResult loaded = builder.load();
        EXPECT_FALSE(loaded.scene.environment.has_value());
        EXPECT_EQ(loaded.scene.world.color, glm::vec3(0.1F, 0.2F, 0.3F));
        ASSERT_EQ(loaded.warnings.size(), 1U);
        EXPECT_NE(loaded.warnings[0].find("the world's image sky"), std::string::npos) << loaded.warnings[0];
        EXPECT_NE(loaded.warnings[0].find("the world's colour is used instead"), std::string::npos);
    }
}

TEST(LoaderEnvironment, ItsTurnIsAnimated) {
    GltfBuilder builder = under_view(exr({1, 1, 1, 1, 1, 1}, 2, 1));
    const std::vector<float> times{0.0F, 2.0F};
    const std::vector<float> turns{0.0F, 0.0F, 0.0F, 1.0F, 0.0F, 1.0F, 0.0F, 0.0F};
    builder.use_extension("KHR_animation_pointer");
    builder.add(
        "animations",
        {{"samplers",
          {{{"input", builder.accessor(times, "SCALAR")}, {"output", builder.accessor(turns, "VEC4")}}}},
         {"channels",
          {{{"sampler", 0},
            {"target",
             {{"path", "pointer"},
              {"extensions",
               {{"KHR_animation_pointer", {{"pointer", "/extensions/BOUNCE_scene/world/rotation"}}}}}}}}}}});
    const Scene scene = builder.load().scene;
    const Pose pose = evaluate_pose(scene, 1.0);
    EXPECT_NEAR(pose.world.world_from_environment.y, std::sqrt(0.5), 1e-6);
    EXPECT_NEAR(pose.world.world_from_environment.w, std::sqrt(0.5), 1e-6);
}

}  // namespace
}  // namespace bounce::scene::test
