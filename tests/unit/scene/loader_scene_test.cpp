// SPDX-License-Identifier: Apache-2.0
//
// Nodes, cameras, lights, materials and settings.
#include <cmath>

#include <gtest/gtest.h>

#include "gltf_builder.h"
#include "scene/pose.h"

namespace bounce::scene::test {
namespace {

using nlohmann::json;

constexpr float k_pi = 3.14159265F;

// A file with Blender's description of one scene.
GltfBuilder blender_file() {
    GltfBuilder builder;
    builder.use_extension("BOUNCE_scene");
    builder.triangle_node();
    builder.root["extensions"]["BOUNCE_scene"] = {
        {"version", 1},
        {"generator", {{"blender", {3, 4, 1}}, {"addon", "0.1.0"}}},
        {"frames", {{"start", 10}, {"end", 20}, {"fps", 25}}},
        {"render",
         {{"width", 640},
          {"height", 480},
          {"pixel_aspect_x", 1.0},
          {"pixel_aspect_y", 2.0},
          {"film_exposure", 1.5}}},
        {"view",
         {{"display_device", "sRGB"},
          {"view_transform", "Filmic"},
          {"look", "None"},
          {"exposure", 0.5},
          {"gamma", 1.25}}},
        {"world", {{"color", {0.1, 0.2, 0.3}}, {"strength", 2.0}}},
        {"lights", json::array()},
        {"unsupported", {{{"object", "Smoke"}, {"what", "volumes"}}}}};
    return builder;
}

TEST(LoaderScene, BlenderSettings) {
    GltfBuilder builder = blender_file();
    builder.add("cameras", {{"type", "perspective"},
                            {"perspective", {{"yfov", 0.7}, {"znear", 0.1}}},
                            {"extensions",
                             {{"BOUNCE_scene",
                               {{"sensor_fit", "vertical"},
                                {"sensor_width_mm", 32},
                                {"sensor_height_mm", 18},
                                {"focal_length_mm", 35},
                                {"shift_x", 0.1},
                                {"shift_y", -0.2}}}}}});
    const int camera = builder.node({{"camera", 0}, {"name", "Camera"}});
    builder.root["extensions"]["BOUNCE_scene"]["camera"] = camera;
    const Scene scene = builder.load().scene;
    EXPECT_TRUE(scene.from_blender);
    EXPECT_EQ(scene.blender_version, (std::vector<int>{3, 4, 1}));
    EXPECT_EQ(scene.frames.start, 10);
    EXPECT_EQ(scene.frames.end, 20);
    EXPECT_DOUBLE_EQ(time_of_frame(scene.frames, 15), 0.2);
    EXPECT_EQ(scene.render.width, 640);
    EXPECT_EQ(scene.render.pixel_aspect_y, 2.0F);
    EXPECT_EQ(scene.render.film_exposure, 1.5F);
    EXPECT_EQ(scene.view.view_transform, "Filmic");
    EXPECT_EQ(scene.view.gamma, 1.25F);
    EXPECT_EQ(scene.world.color, glm::vec3(0.1F, 0.2F, 0.3F));
    EXPECT_EQ(scene.world.strength, 2.0F);
    EXPECT_EQ(scene.active_camera_node, camera);
    ASSERT_EQ(scene.unsupported.size(), 1U);
    EXPECT_EQ(scene.unsupported[0].object, "Smoke");
    ASSERT_TRUE(scene.cameras[0].sensor.has_value());
    EXPECT_EQ(scene.cameras[0].sensor->fit, SensorFit::vertical);
    EXPECT_EQ(scene.cameras[0].sensor->focal_length_mm, 35.0F);
    EXPECT_EQ(scene.cameras[0].sensor->shift_y, -0.2F);
    EXPECT_TRUE(std::isinf(scene.cameras[0].far_m));
}

TEST(LoaderScene, BlenderWithoutAWorldIsBlack) {
    GltfBuilder builder = blender_file();
    builder.root["extensions"]["BOUNCE_scene"].erase("world");
    const Scene scene = builder.load().scene;
    EXPECT_EQ(scene.world.color * scene.world.strength, glm::vec3(0.0F));
    EXPECT_EQ(scene.active_camera_node, k_none);
}

TEST(LoaderScene, BlenderLightsWinOverPunctualOnes) {
    GltfBuilder builder = blender_file();
    builder.use_extension("KHR_lights_punctual");
    builder.root["extensions"]["KHR_lights_punctual"]["lights"] = {
        {{"type", "point"}, {"intensity", 683}}, {{"type", "directional"}, {"intensity", 1366}}};
    builder.root["extensions"]["BOUNCE_scene"]["lights"] = {{{"name", "Key"},
                                                             {"type", "area"},
                                                             {"color", {1, 0.5, 0.25}},
                                                             {"power_w", 40},
                                                             {"shape", "rectangle"},
                                                             {"size_x_m", 2},
                                                             {"size_y_m", 0.5},
                                                             {"spread_rad", 1},
                                                             {"cast_shadow", false}},
                                                            {{"name", "Spot"},
                                                             {"type", "spot"},
                                                             {"power_w", 10},
                                                             {"radius_m", 0.1},
                                                             {"cone_angle_rad", 1},
                                                             {"blend", 0.15}}};
    const int both = builder.node(
        {{"extensions", {{"KHR_lights_punctual", {{"light", 0}}}, {"BOUNCE_scene", {{"light", 0}}}}}});
    const int spot = builder.node({{"extensions", {{"BOUNCE_scene", {{"light", 1}}}}}});
    const int sun = builder.node({{"extensions", {{"KHR_lights_punctual", {{"light", 1}}}}}});
    const Scene scene = builder.load().scene;
    // The point light is described by Blender's area light, so it is not there.
    ASSERT_EQ(scene.lights.size(), 3U);
    const Light& key = scene.lights[static_cast<size_t>(scene.nodes[static_cast<size_t>(both)].light)];
    EXPECT_EQ(key.type, LightType::area);
    EXPECT_EQ(key.power_w, 40.0F);
    EXPECT_EQ(key.shape, AreaShape::rectangle);
    EXPECT_EQ(key.size_y_m, 0.5F);
    EXPECT_FALSE(key.cast_shadow);
    const Light& cone = scene.lights[static_cast<size_t>(scene.nodes[static_cast<size_t>(spot)].light)];
    EXPECT_EQ(cone.profile, SpotProfile::cycles_3);
    EXPECT_EQ(cone.blend, 0.15F);
    const Light& punctual = scene.lights[static_cast<size_t>(scene.nodes[static_cast<size_t>(sun)].light)];
    EXPECT_EQ(punctual.type, LightType::sun);
    EXPECT_FLOAT_EQ(punctual.irradiance_w_m2, 2.0F);
    EXPECT_EQ(punctual.profile, SpotProfile::khronos);
}

TEST(LoaderScene, AreaLightsMayHaveAPattern) {
    GltfBuilder builder = blender_file();
    const nlohmann::json pattern{{"width", 2}, {"height", 1}, {"rgb", {0.5, 1, 2, 1.5, 1, 0}}};
    builder.root["extensions"]["BOUNCE_scene"]["lights"] = {
        {{"type", "area"}, {"power_w", 1}, {"size_x_m", 1}, {"pattern", pattern}},
        {{"type", "area"}, {"power_w", 1}, {"size_x_m", 1}}};
    const Scene scene = builder.load().scene;
    const LightPattern& found = scene.lights.at(0).pattern;
    EXPECT_EQ(found.width, 2);
    EXPECT_EQ(found.height, 1);
    EXPECT_EQ(found.cells, (std::vector<glm::vec3>{{0.5F, 1.0F, 2.0F}, {1.5F, 1.0F, 0.0F}}));
    EXPECT_EQ(scene.lights.at(1).pattern.width, 0);
}

TEST(LoaderScene, SpotProfileFollowsTheBlenderVersion) {
    GltfBuilder builder = blender_file();
    builder.root["extensions"]["BOUNCE_scene"]["generator"]["blender"] = {4, 1, 0};
    builder.root["extensions"]["BOUNCE_scene"]["lights"] = {
        {{"type", "spot"}, {"power_w", 1}, {"cone_angle_rad", 1}}};
    EXPECT_EQ(builder.load().scene.lights.at(0).profile, SpotProfile::cycles_4);
}

TEST(LoaderScene, PunctualUnits) {
    GltfBuilder builder;
    builder.use_extension("KHR_lights_punctual");
    builder.root["extensions"]["KHR_lights_punctual"]["lights"] = {
        {{"type", "point"}, {"intensity", 683}, {"color", {1, 0, 0}}},
        {{"type", "spot"},
         {"intensity", 54.35},
         {"spot", {{"innerConeAngle", 0.2}, {"outerConeAngle", 0.5}}}},
        {{"type", "spot"}}};
    for (int i = 0; i < 3; ++i) {
        builder.node({{"extensions", {{"KHR_lights_punctual", {{"light", i}}}}}});
    }
    const Scene scene = builder.load().scene;
    // 1 W/sr in every direction is 4 pi watts.
    EXPECT_NEAR(scene.lights[0].power_w, 4.0F * k_pi, 1e-4F);
    EXPECT_EQ(scene.lights[0].color, glm::vec3(1, 0, 0));
    EXPECT_NEAR(scene.lights[1].power_w, 1.0F, 1e-4F);
    EXPECT_EQ(scene.lights[1].cone_angle_rad, 1.0F);
    EXPECT_EQ(scene.lights[1].inner_cone_rad, 0.2F);
    EXPECT_NEAR(scene.lights[2].cone_angle_rad, 0.5F * k_pi, 1e-6F);
    // A scene with lights of its own needs no neutral sky.
    EXPECT_EQ(scene.world.strength, 0.0F);
}

TEST(LoaderScene, DefaultsForOtherFiles) {
    GltfBuilder builder;
    builder.triangle_node();
    const int times = builder.accessor<float>({0, 2}, "SCALAR");
    const int values = builder.accessor<float>({0, 0, 0, 1, 0, 0}, "VEC3");
    builder.add("animations",
                {{"samplers", {{{"input", times}, {"output", values}}}},
                 {"channels", {{{"sampler", 0}, {"target", {{"node", 0}, {"path", "translation"}}}}}}});
    const Scene scene = builder.load().scene;
    EXPECT_FALSE(scene.from_blender);
    EXPECT_EQ(scene.frames.start, 1);
    EXPECT_EQ(scene.frames.end, 49);
    EXPECT_EQ(scene.frames.fps, 24.0);
    EXPECT_EQ(time_of_frame(scene.frames, 1), 0.0);
    EXPECT_EQ(scene.world.color, glm::vec3(1.0F));
    EXPECT_EQ(scene.world.strength, 0.5F);
    EXPECT_EQ(scene.view.view_transform, "Standard");
    EXPECT_EQ(default_animation(scene), 0);
}

TEST(LoaderScene, AStrongEmitterIsALampAndNeedsNoSky) {
    GltfBuilder builder;
    builder.triangle_node();
    builder.root["meshes"][0]["primitives"][0]["material"] = builder.add(
        "materials", {{"emissiveFactor", {1, 1, 1}},
                      {"extensions", {{"KHR_materials_emissive_strength", {{"emissiveStrength", 12}}}}}});
    const Scene scene = builder.load().scene;
    EXPECT_EQ(scene.world.strength, 0.0F);
    EXPECT_EQ(scene.materials[0].emission_strength, 12.0F);
    EXPECT_EQ(evaluate_pose(scene, 0.0).materials[0].emission, glm::vec3(12.0F));
}

TEST(LoaderScene, Materials) {
    GltfBuilder builder;
    builder.add(
        "materials",
        {{"name", "Paint"},
         {"pbrMetallicRoughness",
          {{"baseColorFactor", {0.1, 0.2, 0.3, 0.4}}, {"metallicFactor", 0.25}, {"roughnessFactor", 0.75}}},
         {"alphaMode", "MASK"},
         {"alphaCutoff", 0.3},
         {"doubleSided", true},
         {"extensions", {{"KHR_materials_specular", {{"specularFactor", 0.5}}}}}});
    builder.add("materials",
                {{"alphaMode", "BLEND"}, {"extensions", {{"KHR_materials_unlit", json::object()}}}});
    builder.add("materials", {{"extensions", {{"KHR_materials_ior", {{"ior", 2.0}}}}}});
    builder.add("materials", {{"extensions",
                               {{"BOUNCE_scene", {{"diffuse", "disney"}, {"specular", 0.7}}},
                                {"KHR_materials_specular", {{"specularFactor", 0.1}}}}}});
    const Scene scene = builder.load().scene;
    const Material& paint = scene.materials[0];
    EXPECT_EQ(paint.base_color, glm::vec4(0.1F, 0.2F, 0.3F, 0.4F));
    EXPECT_EQ(paint.metallic, 0.25F);
    EXPECT_EQ(paint.roughness, 0.75F);
    EXPECT_EQ(paint.specular, 0.25F);
    EXPECT_EQ(paint.alpha_mode, AlphaMode::mask);
    EXPECT_EQ(paint.alpha_cutoff, 0.3F);
    EXPECT_TRUE(paint.double_sided);
    EXPECT_EQ(paint.diffuse, DiffuseModel::lambert);
    EXPECT_EQ(scene.materials[1].alpha_mode, AlphaMode::blend);
    EXPECT_TRUE(scene.materials[1].unlit);
    EXPECT_EQ(scene.materials[1].specular, 0.5F);
    // F0 of an index of 2 is 1/9.
    EXPECT_NEAR(scene.materials[2].specular * 0.08F, 1.0F / 9.0F, 1e-6F);
    EXPECT_EQ(scene.materials[3].diffuse, DiffuseModel::disney);
    EXPECT_EQ(scene.materials[3].specular, 0.7F);
}

TEST(LoaderScene, NodesComposeFromTransformsAndMatrices) {
    GltfBuilder builder;
    const int leaf = builder.node({{"translation", {1, 0, 0}}}, false);
    // Column-major: doubles, and moves by (0, 5, 0).
    const int middle = builder.node(
        {{"matrix", {2, 0, 0, 0, 0, 2, 0, 0, 0, 0, 2, 0, 0, 5, 0, 1}}, {"children", {leaf}}}, false);
    const float half = std::sqrt(0.5F);
    builder.node({{"rotation", {0, 0, half, half}}, {"scale", {1, 1, 3}}, {"children", {middle}}});
    const Scene scene = builder.load().scene;
    EXPECT_EQ(scene.nodes[static_cast<size_t>(leaf)].parent, middle);
    EXPECT_EQ(scene.topological_order, (std::vector<int>{2, 1, 0}));
    const Pose pose = evaluate_pose(scene, 0.0);
    // (0,0,0) -> (1,0,0) -> (2,5,0) -> turned a quarter about z: (-5,2,0).
    const glm::dvec4 origin = pose.world_from_node[0][3];
    EXPECT_NEAR(origin.x, -5.0, 1e-6);
    EXPECT_NEAR(origin.y, 2.0, 1e-6);
    EXPECT_NEAR(pose.world_from_node[0][2].z, 6.0, 1e-6);
}

TEST(LoaderScene, PlacesFarFromTheOriginKeepTheirDigits) {
    GltfBuilder builder;
    builder.node({{"translation", {1000000.000123456, -1e6, 1e6}}});
    builder.node({{"matrix", {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 1000000.000123456, 0, 0, 1}}});
    const Pose pose = evaluate_pose(builder.load().scene, 0.0);
    EXPECT_EQ(pose.world_from_node[0][3].x, 1000000.000123456);
    EXPECT_EQ(pose.world_from_node[1][3].x, 1000000.000123456);
}

TEST(LoaderScene, OnlyTheShownSceneIsInTheOrder) {
    GltfBuilder builder;
    builder.triangle_node();
    builder.node({{"name", "elsewhere"}}, false);
    builder.add("scenes", {{"nodes", {1}}});
    EXPECT_EQ(builder.load().scene.topological_order, (std::vector<int>{0}));
    builder.root["scene"] = 1;
    EXPECT_EQ(builder.load().scene.topological_order, (std::vector<int>{1}));
    builder.root.erase("scene");
    builder.root.erase("scenes");
    EXPECT_EQ(builder.load().scene.topological_order.size(), 2U);
}

TEST(LoaderScene, Instancing) {
    GltfBuilder builder;
    builder.use_extension("EXT_mesh_gpu_instancing");
    const int translations = builder.accessor<float>({0, 0, 0, 10, 0, 0}, "VEC3");
    const int scales = builder.accessor<float>({1, 1, 1, 2, 2, 2}, "VEC3");
    builder.node({{"mesh", builder.triangle_mesh()},
                  {"translation", {0, 0, 7}},
                  {"extensions",
                   {{"EXT_mesh_gpu_instancing",
                     {{"attributes", {{"TRANSLATION", translations}, {"SCALE", scales}}}}}}}});
    const Scene scene = builder.load().scene;
    const Pose pose = evaluate_pose(scene, 0.0);
    ASSERT_EQ(pose.draws.size(), 2U);
    EXPECT_EQ(pose.draws[1].world_from_model[3], glm::dvec4(10, 0, 7, 1));
    EXPECT_EQ(pose.draws[1].world_from_model[0].x, 2.0);
}

TEST(LoaderScene, DeepChainsAreNoRecursion) {
    GltfBuilder builder;
    constexpr int depth = 100000;
    for (int i = 0; i < depth; ++i) {
        json description{{"translation", {0, 0, 1}}};
        if (i + 1 < depth) {
            description["children"] = {i + 1};
        }
        builder.node(std::move(description), i == 0);
    }
    const Scene scene = builder.load().scene;
    EXPECT_EQ(evaluate_pose(scene, 0.0).world_from_node.back()[3].z, static_cast<double>(depth));
}

TEST(LoaderScene, VisibilityHidesChildrenAndLights) {
    GltfBuilder builder;
    builder.use_extension("KHR_node_visibility");
    builder.use_extension("KHR_lights_punctual");
    builder.root["extensions"]["KHR_lights_punctual"]["lights"] = {{{"type", "point"}}};
    const int child = builder.node(
        {{"mesh", builder.triangle_mesh()}, {"extensions", {{"KHR_lights_punctual", {{"light", 0}}}}}},
        false);
    builder.node({{"children", {child}}, {"extensions", {{"KHR_node_visibility", {{"visible", false}}}}}});
    const Pose pose = evaluate_pose(builder.load().scene, 0.0);
    EXPECT_TRUE(pose.draws.empty());
    EXPECT_TRUE(pose.light_instances.empty());
}

TEST(LoaderScene, UnknownAndPartlyCarriedExtensionsWarnOnce) {
    GltfBuilder builder;
    builder.triangle_node();
    builder.use_extension("KHR_materials_transmission");
    builder.use_extension("ACME_rainbows");
    const LoadResult result = builder.load();
    ASSERT_EQ(result.warnings.size(), 2U);
    EXPECT_TRUE(says(result.warnings[0], "KHR_materials_transmission"));
    EXPECT_TRUE(says(result.warnings[1], "ACME_rainbows"));
    EXPECT_EQ(result.extensions_used.size(), 2U);
}

}  // namespace
}  // namespace bounce::scene::test
