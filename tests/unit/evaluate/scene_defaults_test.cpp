// SPDX-License-Identifier: Apache-2.0
//
// A glTF file without camera and light: what Bounce shows, and that Blender's renders of it show the same.
#include "evaluate/scene_defaults.h"

#include <cmath>
#include <cstdlib>
#include <fstream>

#include <glm/glm.hpp>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/error.h"
#include "core/process.h"
#include "environment.h"
#include "evaluate/cycles_runner.h"
#include "image/image_io.h"
#include "temporary_folder.h"
#include "triangle_gltf.h"

namespace bounce {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;
using test::TemporaryFolder;
using test::write_triangle;

// Column and row, from the top left, in pixels.
glm::dvec2 project(const json& camera, const glm::dvec3& point, int width, int height) {
    glm::dmat4 world_from_camera;
    for (int column = 0; column < 4; ++column) {
        for (int row = 0; row < 4; ++row) {
            world_from_camera[column][row] =
                camera["world_from_camera"][static_cast<size_t>(column)][static_cast<size_t>(row)];
        }
    }
    const glm::dvec3 seen(glm::inverse(world_from_camera) * glm::dvec4(point, 1.0));
    const double scale = 0.5 * height / std::tan(0.5 * camera["yfov_rad"].get<double>());
    return {0.5 * width - scale * seen.x / seen.z, 0.5 * height + scale * seen.y / seen.z};
}

// Twice the area of the triangle, with a sign.
double area(const glm::dvec2& a, const glm::dvec2& b, const glm::dvec2& c) {
    return (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x);
}

// Distance of the point to the triangle's outline along its nearest edge's normal, inside positive; pixels.
double depth_inside(const std::array<glm::dvec2, 3>& corners, const glm::dvec2& point) {
    const double turn = area(corners[0], corners[1], corners[2]) > 0 ? 1.0 : -1.0;
    double least = 1e9;
    for (size_t i = 0; i < 3; ++i) {
        const glm::dvec2& a = corners[i];
        const glm::dvec2& b = corners[(i + 1) % 3];
        least = std::min(least, turn * area(a, b, point) / glm::length(b - a));
    }
    return least;
}

TEST(SceneDefaults, NothingIsLeftOpenByABlendOrByAFileThatSaysAll) {
    const TemporaryFolder folder;
    EXPECT_TRUE(scene_defaults("a.blend", {1}, 16, 9).is_null());
    std::ofstream(folder / "text.glb") << "no glTF";
    EXPECT_TRUE(scene_defaults(folder / "text.glb", {1}, 16, 9).is_null()) << "the loader refuses it";
}

TEST(SceneDefaults, ACameraOfTheFileIsNamedAndALightLeavesTheSkyBlack) {
    const TemporaryFolder folder;
    const json more = json::parse(R"({"nodes": [{"mesh": 0}, {"camera": 0},
        {"extensions": {"KHR_lights_punctual": {"light": 0}}}], "scenes": [{"nodes": [0, 1, 2]}],
        "cameras": [{"type": "perspective", "perspective": {"yfov": 1, "znear": 0.1}}],
        "extensionsUsed": ["KHR_lights_punctual"],
        "extensions": {"KHR_lights_punctual": {"lights": [{"type": "point"}]}}})");
    const json defaults = scene_defaults(write_triangle(folder / "a.gltf", more), {1}, 16, 9);
    EXPECT_EQ(defaults["camera_node"], 1);
    EXPECT_FALSE(defaults.contains("cameras"));
    EXPECT_EQ(defaults["world"]["strength"], 0.0);
}

// As an export of a .blend without an active camera: Bounce frames the scene, and so must Blender.
TEST(SceneDefaults, AFileOfOursThatNamesNoCameraIsFramed) {
    const TemporaryFolder folder;
    const json more = json::parse(R"({"nodes": [{"mesh": 0}, {"camera": 0}], "scenes": [{"nodes": [0, 1]}],
        "cameras": [{"type": "perspective", "perspective": {"yfov": 1, "znear": 0.1}}],
        "extensionsUsed": ["BOUNCE_scene"],
        "extensions": {"BOUNCE_scene": {"version": 1, "blender_version": "3.4.1", "lights": [],
            "frames": {"start": 1, "end": 2, "fps": 24}}}})");
    const json defaults = scene_defaults(write_triangle(folder / "a.gltf", more), {1}, 16, 9);
    EXPECT_FALSE(defaults.contains("camera_node"));
    EXPECT_EQ(defaults["cameras"].size(), 1U);
}

TEST(SceneDefaults, FramesTheWholeSceneUnderASky) {
    const TemporaryFolder folder;
    const json defaults = scene_defaults(write_triangle(folder / "a.gltf"), {1, 7}, 64, 36);
    EXPECT_FALSE(defaults.contains("camera_node"));
    EXPECT_EQ(defaults["cameras"][1]["frame"], 7);
    for (const glm::dvec3& corner : test::k_triangle) {
        const glm::dvec2 pixel = project(defaults["cameras"][0], corner, 64, 36);
        EXPECT_TRUE(pixel.x > 0 && pixel.x < 64 && pixel.y > 0 && pixel.y < 36) << pixel.x << ", " << pixel.y;
    }
    EXPECT_EQ(defaults["world"]["color"], json({1.0, 1.0, 1.0}));
    EXPECT_GT(defaults["world"]["strength"], 0.0);
}

TEST(SceneDefaults, CyclesShowsWhatBounceFrames) {
    const auto blender = find_program(std::getenv("BLENDER") != nullptr ? std::getenv("BLENDER") : "blender");
    if (!blender) {
        GTEST_SKIP() << "Blender is not installed here";
    }
    if (!fs::exists(fs::path(BOUNCE_SOURCE_DIR) / "blender_addon/export_cli.py")) {
        GTEST_SKIP() << "the add-on is not in this checkout";
    }
    const test::Environment addon("BOUNCE_ADDON", BOUNCE_SOURCE_DIR "/blender_addon");
    const TemporaryFolder folder;
    const fs::path gltf = write_triangle(folder / "a.gltf");
    CyclesJob job{gltf, 64, 36, 0, {}};
    CyclesRender render;
    render.spp = 16;
    render.output = folder / "out.exr";
    job.renders.push_back(render);
    (void)run_cycles(job, *blender);
    const Image image = read_image(render.output);
    const json defaults = scene_defaults(gltf, {1}, 64, 36);
    std::array<glm::dvec2, 3> corners{};
    for (size_t i = 0; i < 3; ++i) {
        corners.at(i) = project(defaults["cameras"][0], test::k_triangle.at(i), 64, 36);
    }
    const double sky = defaults["world"]["strength"];
    size_t inside = 0;
    size_t outside = 0;
    for (int y = 0; y < 36; ++y) {
        for (int x = 0; x < 64; ++x) {
            const double depth = depth_inside(corners, {x + 0.5, y + 0.5});
            const double value = image.rgb[3 * static_cast<size_t>(y * 64 + x)];
            if (depth < -1.5) {  // the pixel filter reaches as far
                ++outside;
                EXPECT_NEAR(value, sky, 1e-4) << x << ", " << y;
            } else if (depth > 1.5) {
                ++inside;
                EXPECT_LT(value, 0.5 * sky) << x << ", " << y;
            }
        }
    }
    EXPECT_GT(inside, 20U);
    EXPECT_GT(outside, 500U);
}

}  // namespace
}  // namespace bounce
