// SPDX-License-Identifier: Apache-2.0
//
// What the reference's settings mean, measured in Cycles itself. Skipped where Blender is not installed.
#include <algorithm>
#include <cstdlib>
#include <fstream>
#include <numeric>

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/error.h"
#include "core/process.h"
#include "environment.h"
#include "evaluate/blender_export.h"
#include "evaluate/cycles_runner.h"
#include "evaluate/peers.h"
#include "image/image_io.h"
#include "image/metrics.h"
#include "temporary_folder.h"

namespace bounce {
namespace {

using test::TemporaryFolder;
namespace fs = std::filesystem;

class CyclesTest : public testing::Test {
  protected:
    void SetUp() override {
        const auto found =
            find_program(std::getenv("BLENDER") != nullptr ? std::getenv("BLENDER") : "blender");
        if (!found) {
            GTEST_SKIP() << "Blender is not installed here";
        }
        blender_ = *found;
    }

    // Saves a scene made by the Python statements as scene.blend.
    void make_scene(const std::string& statements) {
        std::ofstream(folder_ / "make.py") << "import bpy\nbpy.ops.wm.read_factory_settings(use_empty=True)\n"
                                           << "scene = bpy.context.scene\n"
                                           << statements
                                           << fmt::format("bpy.ops.wm.save_as_mainfile(filepath='{}')\n",
                                                          (folder_ / "scene.blend").string());
        const ProcessResult result =
            run_process({blender_.string(), "-b", "--factory-startup", "--python-exit-code", "9", "-P",
                         (folder_ / "make.py").string()});
        ASSERT_EQ(result.exit_code, 0) << result.output;
    }

    CyclesReport render(const fs::path& scene, int bounces, int spp, int width = 16, int height = 16) {
        CyclesJob job{scene, width, height, bounces, {}};
        job.renders.push_back({1, spp, 1, 1, folder_ / fmt::format("{}.exr", bounces), 0.0, 0.0, 0, {}});
        return run_cycles(job, blender_);
    }

    TemporaryFolder folder_;
    fs::path blender_;
};

double mean_of(const Image& image) {
    return std::accumulate(image.rgb.begin(), image.rgb.end(), 0.0) / static_cast<double>(image.rgb.size());
}

// A closed furnace: inside a sphere whose wall emits 1 and reflects half of what arrives, every surface
// shows 1 of its own, 1/2 by direct light, 1/4 by the first bounce, and so on.
TEST_F(CyclesTest, BouncesAreCountedAfterDirectLight) {
    make_scene(R"(
bpy.ops.mesh.primitive_ico_sphere_add(subdivisions=3, radius=4)
material = bpy.data.materials.new('wall')
material.use_nodes = True
nodes, links = material.node_tree.nodes, material.node_tree.links
nodes.clear()
diffuse, glow = nodes.new('ShaderNodeBsdfDiffuse'), nodes.new('ShaderNodeEmission')
both, out = nodes.new('ShaderNodeAddShader'), nodes.new('ShaderNodeOutputMaterial')
diffuse.inputs['Color'].default_value = (.5, .5, .5, 1)
links.new(diffuse.outputs[0], both.inputs[0])
links.new(glow.outputs[0], both.inputs[1])
links.new(both.outputs[0], out.inputs['Surface'])
bpy.context.object.data.materials.append(material)
bpy.ops.object.camera_add()
scene.camera = bpy.context.object
scene.cycles.sample_clamp_indirect = 0.01
scene.cycles.max_bounces = 12
scene.render.use_persistent_data = True
)");
    for (const auto& [bounces, expected] : {std::pair{0, 1.5}, std::pair{1, 1.75}, std::pair{2, 1.875}}) {
        const CyclesReport report = render(folder_ / "scene.blend", bounces, 64);
        EXPECT_NEAR(mean_of(read_image(report.renders[0].output)), expected, 0.01) << bounces << " bounces";
        EXPECT_GT(report.renders[0].seconds, 0.0);
        EXPECT_GT(report.renders[0].setup_seconds, 0.0);
        EXPECT_GT(report.startup_seconds, 0.0);
        EXPECT_GE(report.threads, 1);
    }
}

constexpr const char* k_room = R"(
def matte(name, color):
    material = bpy.data.materials.new(name)
    material.use_nodes = True
    shader = material.node_tree.nodes['Principled BSDF']
    shader.inputs['Base Color'].default_value = (*color, 1)
    shader.inputs['Roughness'].default_value = 1
    shader.inputs['Specular'].default_value = 0
    return material
bpy.ops.mesh.primitive_plane_add(size=6)
bpy.context.object.data.materials.append(matte('floor', (.8, .8, .8)))
bpy.ops.mesh.primitive_plane_add(size=6, location=(0, 3, 3), rotation=(1.5708, 0, 0))
bpy.context.object.data.materials.append(matte('wall', (.8, .1, .1)))
bpy.ops.object.light_add(type='SPOT', location=(3, -3, 5), rotation=(.7, 0, .785))
bpy.context.object.data.energy = 1500
bpy.context.object.data.shadow_soft_size = 0
bpy.ops.object.light_add(type='AREA', location=(-1, -1, 4), rotation=(.3, .2, 0))
bpy.context.object.data.energy = 100
bpy.context.object.data.energy = 10
bpy.context.object.data.keyframe_insert('energy', frame=1)
bpy.context.object.data.energy = 500
bpy.context.object.data.keyframe_insert('energy', frame=11)
bpy.ops.object.camera_add(location=(0, -9, 4), rotation=(1.2, 0, 0))
scene.camera = bpy.context.object
scene.world = bpy.data.worlds.new('world')
scene.world.use_nodes = True
scene.world.node_tree.nodes['Background'].inputs['Color'].default_value = (.1, .2, .4, 1)
)";

// The reference of a .glb is the reference of the .blend it came from, at a frame where a light's power
// is on its way.
TEST_F(CyclesTest, AnExportedFileGivesTheSamePicture) {
    if (!fs::exists(fs::path(BOUNCE_SOURCE_DIR) / "blender_addon/export_cli.py")) {
        GTEST_SKIP() << "the add-on is not in this checkout";
    }
    const test::Environment cache("XDG_CACHE_HOME", (folder_ / "cache").string());
    const test::Environment addon("BOUNCE_ADDON", BOUNCE_SOURCE_DIR "/blender_addon");
    make_scene(k_room);
    const fs::path blend = folder_ / "scene.blend";
    const fs::path glb = resolve_scene(blend, {blender_}).gltf;
    std::vector<Image> images;
    for (const fs::path& scene : {blend, glb}) {
        CyclesJob job{scene, 64, 36, 1, {}};
        job.renders.push_back({6, 64, 1, 1, folder_ / "out.exr", 0.0, 0.0, 0, {}});
        const CyclesReport report = run_cycles(job, blender_);
        EXPECT_TRUE(report.notes.empty()) << report.notes.front();
        images.push_back(read_image(folder_ / "out.exr"));
    }
    const Metrics metrics = compare(images[1], images[0], HdrFlip::leave_out);
    EXPECT_LT(std::abs(metrics.bias), 0.01);
    EXPECT_LT(metrics.relmse, 0.005);
}

// One lit plane, off the middle, in a picture that is higher than wide: all three engines must show it in one
// place.
constexpr const char* k_plane = R"(
bpy.ops.mesh.primitive_plane_add(size=2, location=(.6, 0, .9), rotation=(1.3, 0, .2))
material = bpy.data.materials.new('white')
material.use_nodes = True
nodes, links = material.node_tree.nodes, material.node_tree.links
shader = nodes['Principled BSDF']
shader.inputs['Base Color'].default_value = (.8, .8, .8, 1)
shader.inputs['Specular'].default_value = 0
shader.inputs['Roughness'].default_value = 1
bpy.context.object.data.materials.append(material)
bpy.ops.object.light_add(type='POINT', location=(0, -5, 4))
bpy.context.object.data.energy = 500
bpy.context.object.data.shadow_soft_size = 0
bpy.ops.object.camera_add(location=(.2, -9, 2), rotation=(1.4, 0, 0))
bpy.context.object.data.lens = 35
scene.camera = bpy.context.object
)";

// Part of the pixels that one picture lights and the other does not; half of the brightest is the line, so
// that smoothing outlines does not move them.
double mask_difference(const Image& a, const Image& b) {
    const float line_a = 0.5F * *std::max_element(a.rgb.begin(), a.rgb.end());
    const float line_b = 0.5F * *std::max_element(b.rgb.begin(), b.rgb.end());
    size_t differing = 0;
    size_t lit = 0;
    for (size_t i = 0; i < a.rgb.size(); i += 3) {
        const bool in_a = a.rgb[i] > line_a;
        const bool in_b = b.rgb[i] > line_b;
        differing += in_a != in_b ? 1U : 0U;
        lit += in_a ? 1U : 0U;
    }
    return static_cast<double>(differing) / static_cast<double>(std::max<size_t>(lit, 1));
}

TEST_F(CyclesTest, PeersSeeTheSceneFromItsCamera) {
    make_scene(k_plane);
    const CyclesReport cycles = render(folder_ / "scene.blend", 0, 64, 36, 64);
    const Image reference = read_image(cycles.renders[0].output);
    PeerJob job;
    job.scene = folder_ / "scene.blend";
    job.blender = blender_;
    job.width = 36;
    job.height = 64;
    job.cache = folder_ / "cache";
    for (const char* name : {"eevee", "f3d"}) {
        const PeerResult result = run_peer(name, job, [](const std::string&) {});
        if (result.points.empty()) {
            ASSERT_THAT(result.left_out, testing::Contains(testing::HasSubstr("Debian's package"))) << name;
            continue;  // not installed here
        }
        const Image& image = result.points.back().frames[0].render.image;
        // A pixel to the side would be about a fifth.
        EXPECT_LT(mask_difference(reference, image), 0.08) << name;
        EXPECT_GT(result.points.back().frames[0].render.seconds, 0.0);
        if (std::string(name) == "eevee") {
            // Nothing bounces here, so Eevee's light is Cycles' but for its diffuse lobe.
            EXPECT_NEAR(compare(image, reference, HdrFlip::leave_out).bias, 0.0, 0.1);
            EXPECT_EQ(result.points.size(), 3U);
        }
    }
}

TEST_F(CyclesTest, SaysWhatIsWrongWithTheScene) {
    make_scene("");
    try {
        (void)render(folder_ / "scene.blend", 1, 1);
        FAIL() << "rendered";
    } catch (const Error& error) {
        EXPECT_EQ(error.code(), ExitCode::input_refused);
        EXPECT_THAT(error.what(), testing::HasSubstr("the scene has no active camera"));
    }
    std::ofstream(folder_ / "text.blend") << "no .blend";
    EXPECT_THROW((void)render(folder_ / "text.blend", 1, 1), Error);
}

TEST_F(CyclesTest, VersionNamesTheBuild) {
    EXPECT_THAT(blender_version(blender_), testing::StartsWith("Blender "));
}

}  // namespace
}  // namespace bounce
