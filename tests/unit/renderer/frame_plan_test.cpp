// SPDX-License-Identifier: Apache-2.0
//
// What a frame does and leaves out, and what it says about it. No OpenGL.
#include "renderer/frame_plan.h"

#include <string>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace bounce {
namespace {

using testing::Contains;
using testing::HasSubstr;
using testing::Not;

// A square of diffuse white under one spot: a frame with everything that matters in it.
class FramePlanTest : public testing::Test {
  protected:
    void SetUp() override {
        scene::Material white;
        white.metallic = 0.0F;
        scene_.materials = {white};
        scene::Primitive square;
        square.positions = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}};
        square.normals.assign(4, {0, 0, 1});
        square.indices = {0, 1, 2, 0, 2, 3};
        square.material = 0;
        scene_.meshes = {{"square", {square}, {}}};
        scene::Node mesh;
        mesh.mesh = 0;
        add_node(mesh);
        add_light("Key", scene::LightType::spot);
        settings_.technique = Technique::rsm;
    }
    void add_node(const scene::Node& node) {
        scene_.topological_order.push_back(static_cast<int>(scene_.nodes.size()));
        scene_.roots.push_back(static_cast<int>(scene_.nodes.size()));
        scene_.nodes.push_back(node);
    }
    scene::Light& add_light(const std::string& name, scene::LightType type) {
        scene::Light light;
        light.name = name;
        light.type = type;
        light.power_w = 10.0F;
        light.irradiance_w_m2 = 1.0F;
        light.cone_angle_rad = 1.0F;
        scene_.lights.push_back(light);
        scene::Node node;
        node.light = static_cast<int>(scene_.lights.size()) - 1;
        add_node(node);
        return scene_.lights.back();
    }
    [[nodiscard]] FramePlan plan() const {
        return plan_frame(scene_, scene::evaluate_pose(scene_, 0.0), settings_);
    }
    // The reason for leaving a pass out, or nothing where it is not left out.
    [[nodiscard]] static std::string reason(const FramePlan& plan, const std::string& pass) {
        for (const LeftOut& item : plan.left_out) {
            if (item.pass == pass) {
                return item.reason;
            }
        }
        return {};
    }
    scene::Scene scene_;
    Settings settings_;
};

TEST_F(FramePlanTest, ALitSurfaceIsShadedWithOneBounce) {
    settings_ = {};
    const FramePlan p = plan();
    EXPECT_TRUE(p.direct);
    EXPECT_TRUE(p.indirect);
    EXPECT_TRUE(p.vpls);
    EXPECT_TRUE(p.occluded);
    EXPECT_EQ(p.bounces, 1);
    EXPECT_FALSE(p.interpolate) << "that is for light gathered from reflective shadow maps";
    EXPECT_EQ(p.lights, std::vector<int>{0});
    EXPECT_EQ(p.shadows, std::vector<bool>{true});
    EXPECT_EQ(reason(p, "bounced light"), "");
    EXPECT_EQ(reason(p, "rsm interpolate"), "");
    EXPECT_TRUE(p.near_field);
    EXPECT_TRUE(p.approximations.empty());
}

TEST_F(FramePlanTest, NothingIsSimplifiedUnlessAskedFor) {
    settings_ = {};
    settings_.simplify = {.ratio = 0.1, .error = 0.1};
    EXPECT_FALSE(plan().simplified);
    EXPECT_FALSE(plan().hybrid);
    EXPECT_EQ(reason(plan(), "simplified meshes"), "");
    settings_.visibility = Visibility::shadow_maps;
    EXPECT_FALSE(plan().simplified);
    settings_.visibility = Visibility::simplified;
    EXPECT_TRUE(plan().simplified);
    EXPECT_FALSE(plan().hybrid);
    settings_.visibility = Visibility::none;
    EXPECT_FALSE(plan().simplified);
    settings_.shading = Shading::hybrid;
    EXPECT_TRUE(plan().simplified);
    EXPECT_TRUE(plan().hybrid);
}

TEST_F(FramePlanTest, SimplifiedMeshesAreLeftOutWhereNothingBounces) {
    settings_ = {};
    settings_.visibility = Visibility::simplified;
    settings_.shading = Shading::hybrid;
    scene_.lights[0].power_w = 0.0F;
    EXPECT_FALSE(plan().simplified);
    EXPECT_FALSE(plan().hybrid);
    EXPECT_THAT(reason(plan(), "simplified meshes"), HasSubstr("bounced light"));
    scene_.lights[0].power_w = 10.0F;
    settings_.show = Show::direct;
    EXPECT_FALSE(plan().simplified);
}

TEST_F(FramePlanTest, TheReflectiveShadowMapAloneIsInterpolated) {
    settings_.bounces = 3;
    const FramePlan p = plan();
    EXPECT_TRUE(p.indirect);
    EXPECT_TRUE(p.interpolate);
    EXPECT_FALSE(p.vpls);
    EXPECT_FALSE(p.occluded);
    EXPECT_FALSE(p.near_field);
    EXPECT_EQ(p.bounces, 0) << "of virtual point lights";
    EXPECT_EQ(reason(p, "rsm interpolate"), "");
}

TEST_F(FramePlanTest, DirectTechniqueLeavesTheBounceOutAsAskedFor) {
    settings_.technique = Technique::direct;
    const FramePlan p = plan();
    EXPECT_TRUE(p.direct);
    EXPECT_FALSE(p.indirect);
    EXPECT_FALSE(p.vpls);
    EXPECT_FALSE(p.interpolate);
    EXPECT_THAT(reason(p, "bounced light"), HasSubstr("asked for"));
}

TEST_F(FramePlanTest, ShowingOneKindOfLightLeavesTheOtherOut) {
    settings_.show = Show::direct;
    EXPECT_TRUE(plan().direct);
    EXPECT_FALSE(plan().indirect);
    settings_.show = Show::indirect;
    EXPECT_FALSE(plan().direct);
    EXPECT_TRUE(plan().indirect);
    EXPECT_EQ(plan().shadows, std::vector<bool>{false}) << "no direct light, no shadow map";
    settings_.show = Show::rsm_flux;
    EXPECT_FALSE(plan().direct);
    EXPECT_TRUE(plan().indirect);
}

TEST_F(FramePlanTest, DarkLightsAreLeftOutByName) {
    add_light("Off", scene::LightType::point).power_w = 0.0F;
    add_light("Night", scene::LightType::sun).irradiance_w_m2 = 0.0F;
    add_light("Black", scene::LightType::area).color = glm::vec3(0.0F);
    const FramePlan p = plan();
    EXPECT_EQ(p.lights, std::vector<int>{0});
    for (const char* name : {"light: Off", "light: Night", "light: Black"}) {
        EXPECT_THAT(reason(p, name), HasSubstr("sends no light")) << name;
    }
}

TEST_F(FramePlanTest, ASunShinesByIrradianceNotByPower) {
    add_light("Sun", scene::LightType::sun).power_w = 0.0F;
    EXPECT_EQ(plan().lights, (std::vector<int>{0, 1}));
}

TEST_F(FramePlanTest, WithoutLightThereIsNothingToBounce) {
    scene_.lights[0].power_w = 0.0F;
    const FramePlan p = plan();
    EXPECT_FALSE(p.direct);
    EXPECT_FALSE(p.indirect);
    EXPECT_FALSE(p.interpolate);
    EXPECT_FALSE(p.vpls);
    EXPECT_EQ(p.bounces, 0);
    EXPECT_THAT(reason(p, "bounced light"), HasSubstr("no light"));
    settings_.technique = Technique::rsm;
    EXPECT_THAT(reason(plan(), "bounced light"), HasSubstr("no light"));
}

TEST_F(FramePlanTest, ALightThatCastsNoShadowHasNoMap) {
    scene_.lights[0].cast_shadow = false;
    const FramePlan p = plan();
    EXPECT_EQ(p.shadows, std::vector<bool>{false});
    EXPECT_THAT(reason(p, "shadow map: Key"), HasSubstr("casts no shadow"));
    settings_.show = Show::indirect;
    EXPECT_EQ(reason(plan(), "shadow map: Key"), "")
        << "no direct light, so nothing was left out for the lamp's sake";
}

TEST_F(FramePlanTest, SurfacesThatReflectNothingDiffuselyBounceNothing) {
    const auto refuses = [&](auto change) {
        const scene::Material before = scene_.materials[0];
        change(scene_.materials[0]);
        const FramePlan p = plan();
        EXPECT_FALSE(p.indirect);
        EXPECT_TRUE(p.direct);
        EXPECT_THAT(reason(p, "bounced light"), HasSubstr("reflects diffusely"));
        scene_.materials[0] = before;
    };
    refuses([](scene::Material& m) { m.base_color = glm::vec4(0.0F, 0.0F, 0.0F, 1.0F); });
    refuses([](scene::Material& m) { m.metallic = 1.0F; });
    refuses([](scene::Material& m) { m.unlit = true; });
    scene_.meshes[0].primitives[0].material = scene::k_none;  // glTF's default is white metal
    EXPECT_FALSE(plan().indirect);
}

TEST_F(FramePlanTest, VirtualPointLightsNeedWhatTheirSettingsSay) {
    settings_ = {.bounces = 3};
    FramePlan p = plan();
    EXPECT_TRUE(p.vpls && p.occluded && p.near_field && p.glossy);
    EXPECT_FALSE(p.interpolate);
    EXPECT_EQ(p.bounces, 3);
    EXPECT_TRUE(p.notes.empty());
    settings_ = {.visibility = Visibility::none, .near_field = false, .glossy_bounces = false};
    p = plan();
    EXPECT_TRUE(p.vpls);
    EXPECT_FALSE(p.occluded || p.near_field || p.glossy);
    settings_ = {.show = Show::rsm_flux};
    EXPECT_TRUE(plan().indirect);
    EXPECT_FALSE(plan().vpls) << "a layer of maps alone needs no lights drawn from them";
}

TEST_F(FramePlanTest, LayersLeaveOutTheLightThatTheyDoNotShow) {
    for (const Show show :
         {Show::ism, Show::ism_splats, Show::vpl_visibility, Show::unblurred, Show::removed}) {
        settings_ = {.show = show};
        EXPECT_FALSE(plan().direct);
        EXPECT_TRUE(plan().vpls);
        EXPECT_FALSE(plan().world_light);
    }
    settings_ = {.show = Show::vpls};
    EXPECT_TRUE(plan().direct) << "the picture under the dots";
}

TEST_F(FramePlanTest, MotionNeedsNoLight) {
    settings_.technique = Technique::ism;
    settings_.show = Show::motion;
    const FramePlan found = plan();
    EXPECT_TRUE(found.motion);
    EXPECT_FALSE(found.direct || found.indirect || found.vpls || found.antialias || found.world_light);
    EXPECT_TRUE(found.lights.empty());
    EXPECT_TRUE(found.notes.empty()) << "nothing that was asked for is missing";
    EXPECT_EQ(reason(found, "light"), "the layer shows motion alone");
    settings_.show = Show::shaded;
    EXPECT_FALSE(plan().motion);
}

TEST_F(FramePlanTest, SaysWhyThereIsNoBouncedLight) {
    const auto note = [&] {
        const FramePlan p = plan();
        EXPECT_FALSE(p.indirect);
        EXPECT_TRUE(p.direct || p.lights.empty());
        return p.notes.empty() ? std::string() : p.notes.front();
    };
    settings_ = {.bounces = 4};
    scene_.lights[0].power_w = 0.0F;
    EXPECT_THAT(note(), HasSubstr("no light sends light"));
    scene_.lights[0].power_w = 10.0F;
    const scene::Scene whole = scene_;
    scene_.nodes[0].visible = false;
    EXPECT_THAT(note(), HasSubstr("has a triangle"));
    scene_ = whole;
    scene_.meshes[0].primitives[0].indices.clear();
    EXPECT_THAT(note(), HasSubstr("has a triangle"));
    scene_ = whole;
    scene_.materials[0].base_color = glm::vec4(0.0F, 0.0F, 0.0F, 1.0F);
    EXPECT_THAT(note(), HasSubstr("reflects light"));
    settings_.show = Show::direct;
    EXPECT_EQ(note(), "") << "nobody asked for it";
}

TEST_F(FramePlanTest, NarrowLobesAreThoseOfMetalsAndSmoothSurfaces) {
    settings_ = {};
    scene_.materials[0].metallic = 0.0F;
    scene_.materials[0].roughness = 0.5F;
    EXPECT_FALSE(plan().narrow_lobes);
    scene_.materials[0].roughness = 0.4F;
    EXPECT_TRUE(plan().narrow_lobes);
    scene_.materials[0].roughness = 0.9F;
    scene_.materials[0].metallic = 0.5F;
    EXPECT_TRUE(plan().narrow_lobes);
    settings_.glossy_bounces = false;
    EXPECT_FALSE(plan().narrow_lobes);
}

TEST_F(FramePlanTest, MetalsBounceLightByTheirGlossyLobes) {
    settings_ = {};
    scene_.materials[0].metallic = 1.0F;
    EXPECT_TRUE(plan().vpls);
    settings_.glossy_bounces = false;
    EXPECT_FALSE(plan().vpls) << "metal reflects nothing diffusely";
    settings_.glossy_bounces = true;
    scene_.meshes[0].primitives[0].material = scene::k_none;
    EXPECT_TRUE(plan().vpls) << "glTF's default is white metal";
}

TEST_F(FramePlanTest, AMetallicTextureMayLeaveDiffuseParts) {
    // glTF multiplies the factor 1 (its default) by the texture: most textured models have it.
    scene_.materials[0].metallic = 1.0F;
    scene_.materials[0].metallic_roughness_texture.texture = 0;
    EXPECT_TRUE(plan().indirect) << "the texture decides, not the factor";
}

TEST_F(FramePlanTest, MapsAreNotClosedOverHoles) {
    settings_ = {};
    EXPECT_TRUE(plan().close_maps);
    EXPECT_EQ(reason(plan(), "ism close"), "");
    scene_.materials[0].alpha_mode = scene::AlphaMode::mask;
    EXPECT_FALSE(plan().close_maps);
    EXPECT_THAT(reason(plan(), "ism close"), HasSubstr("holes"));
    settings_.technique = Technique::direct;
    EXPECT_EQ(reason(plan(), "ism close"), "") << "there are no maps to close";
    settings_.technique = Technique::ism;
    scene_.materials[0].alpha_mode = scene::AlphaMode::opaque;
    settings_.splat = Splat::compute;
    EXPECT_FALSE(plan().close_maps) << "squares are closed by pull-push";
}

TEST_F(FramePlanTest, InterpolationIsOffWhereEveryPixelIsAskedFor) {
    const auto is_off = [&](const Settings& settings) {
        settings_ = settings;
        settings_.technique = Technique::rsm;
        const FramePlan p = plan();
        EXPECT_TRUE(p.indirect);
        EXPECT_FALSE(p.interpolate);
        EXPECT_THAT(reason(p, "rsm interpolate"), HasSubstr("every pixel"));
    };
    is_off({.technique = Technique::rsm, .interpolate = false});
    is_off({.technique = Technique::rsm, .lowres_step = 1});
    is_off({.technique = Technique::rsm, .rsm_full_sum = true});
}

TEST_F(FramePlanTest, NothingDeformsWithoutSkinOrMorph) {
    EXPECT_FALSE(plan().deform);
    EXPECT_THAT(reason(plan(), "deform"), HasSubstr("skinned or morphs"));
    scene::MorphTarget target;
    target.positions.assign(4, glm::vec3(1.0F));
    scene_.meshes[0].primitives[0].targets = {target};
    EXPECT_TRUE(plan().deform);
    EXPECT_EQ(reason(plan(), "deform"), "");
}

TEST_F(FramePlanTest, ASkinDeformsOnlyWhatHasJoints) {
    scene::Skin skin;
    skin.joints = {0};
    skin.joint_from_mesh = {glm::mat4(1.0F)};
    scene_.skins = {skin};
    scene_.nodes[0].skin = 0;
    EXPECT_FALSE(plan().deform) << "no vertex is bound to a joint";
    scene_.meshes[0].primitives[0].joints.assign(4, glm::u16vec4(0));
    scene_.meshes[0].primitives[0].weights.assign(4, glm::vec4(1, 0, 0, 0));
    EXPECT_TRUE(plan().deform);
    scene_.nodes[0].visible = false;
    EXPECT_FALSE(plan().deform) << "hidden";
}

TEST_F(FramePlanTest, EmissionIsDrawnWhereASurfaceShines) {
    EXPECT_FALSE(plan().emission);
    EXPECT_THAT(reason(plan(), "emission"), HasSubstr("no visible surface emits"));
    scene_.materials[0].emission = glm::vec3(0.0F, 2.0F, 0.0F);
    EXPECT_TRUE(plan().emission);
    EXPECT_EQ(reason(plan(), "emission"), "");
    scene_.materials[0].emission_strength = 0.0F;
    EXPECT_FALSE(plan().emission);
    scene_.materials[0].unlit = true;
    EXPECT_TRUE(plan().emission) << "unlit surfaces show their colour as emission";
}

TEST_F(FramePlanTest, AnUnlitSurfaceIsNotSaidToLackLight) {
    // By its definition an unlit surface lights nothing (KHR_materials_unlit), so that is no approximation.
    scene_.materials[0].unlit = true;
    EXPECT_THAT(plan().approximations, Not(Contains(HasSubstr("emissive surfaces"))));
}

TEST_F(FramePlanTest, EmissiveSurfacesLightOthers) {
    EXPECT_FALSE(plan().emitters);
    EXPECT_THAT(reason(plan(), "emitter lights"), HasSubstr("no visible surface emits"));
    scene_.materials[0].emission = glm::vec3(0.0F, 2.0F, 0.0F);
    settings_.technique = Technique::ism;
    settings_.bounces = 2;
    EXPECT_TRUE(plan().emitters);
    EXPECT_TRUE(plan().emitters_occluded);
    EXPECT_EQ(plan().emitter_bounces, 2);
    EXPECT_EQ(reason(plan(), "emitter lights"), "");
    EXPECT_TRUE(plan().approximations.empty());
    settings_.show = Show::indirect;
    EXPECT_FALSE(plan().emitters);
    EXPECT_THAT(reason(plan(), "emitter lights"), HasSubstr("layer"));
    settings_.show = Show::shaded;
    scene_.materials[0].emission_strength = 0.0F;
    EXPECT_FALSE(plan().emitters) << "dark in this frame";
    scene_.materials[0].emission_strength = 1.0F;
    settings_.emitter_vpls = 0;
    EXPECT_FALSE(plan().emitters);
    EXPECT_EQ(plan().emitter_bounces, 0);
    EXPECT_THAT(reason(plan(), "emitter lights"), HasSubstr("asked"));
    EXPECT_THAT(plan().approximations, Contains(HasSubstr("emissive surfaces")));
}

TEST_F(FramePlanTest, WhatReflectsNothingIsNotLitByEmitters) {
    scene_.materials[0].emission = glm::vec3(1.0F);
    scene_.materials[0].base_color = glm::vec4(0.0F, 0.0F, 0.0F, 1.0F);
    scene_.materials[0].specular = 0.0F;
    EXPECT_FALSE(plan().emitters);
    EXPECT_THAT(reason(plan(), "emitter lights"), HasSubstr("no surface reflects light"));
    scene_.materials[0].specular = 0.5F;
    EXPECT_TRUE(plan().emitters);
}

TEST_F(FramePlanTest, EmittersAloneBounceWithoutAnyLight) {
    scene_.materials[0].emission = glm::vec3(1.0F);
    scene_.lights[0].power_w = 0.0F;
    settings_.technique = Technique::ism;
    EXPECT_EQ(plan().emitter_bounces, 1);
    EXPECT_TRUE(plan().notes.empty()) << "it would not be true that nothing bounces";
    EXPECT_TRUE(plan().occluded);
    settings_.visibility = Visibility::none;
    EXPECT_FALSE(plan().occluded);
    EXPECT_FALSE(plan().emitters_occluded);
    settings_.technique = Technique::direct;
    EXPECT_TRUE(plan().emitters);
    EXPECT_TRUE(plan().emitters_occluded) << "the setting is one of technique ism";
    EXPECT_EQ(plan().emitter_bounces, 0);
    EXPECT_TRUE(plan().glossy);
}

TEST_F(FramePlanTest, TheWorldLightsTheShadedPictureAlone) {
    EXPECT_FALSE(plan().world_light);
    EXPECT_THAT(reason(plan(), "world light"), HasSubstr("black"));
    scene_.world.color = glm::vec3(0.5F);
    EXPECT_TRUE(plan().world_light);
    EXPECT_EQ(reason(plan(), "world light"), "");
    settings_.show = Show::indirect;
    EXPECT_FALSE(plan().world_light);
    EXPECT_EQ(reason(plan(), "world light"), "") << "not shown is not the same as black";
}

TEST_F(FramePlanTest, LightsStandForTheWorldOnlyWhereItShines) {
    EXPECT_FALSE(plan().world_occluded);
    EXPECT_EQ(plan().world_bounces, 0);
    EXPECT_THAT(reason(plan(), "world lights"), HasSubstr("black"));
    scene_.world.color = glm::vec3(0.5F);
    settings_.technique = Technique::ism;
    settings_.bounces = 2;
    EXPECT_TRUE(plan().world_occluded);
    EXPECT_EQ(plan().world_bounces, 2);
    EXPECT_EQ(reason(plan(), "world lights"), "");
    EXPECT_THAT(plan().approximations, Not(Contains(HasSubstr("world's light"))));
    settings_.show = Show::indirect;
    EXPECT_FALSE(plan().world_occluded);
    EXPECT_EQ(plan().world_bounces, 0);
    EXPECT_THAT(reason(plan(), "world lights"), HasSubstr("layer"));
}

TEST_F(FramePlanTest, WithoutLightsTheWorldIsNotOccluded) {
    scene_.world.color = glm::vec3(0.5F);
    settings_.world_vpls = 0;
    EXPECT_TRUE(plan().world_light);
    EXPECT_FALSE(plan().world_occluded);
    EXPECT_EQ(plan().world_bounces, 0);
    EXPECT_THAT(reason(plan(), "world lights"), HasSubstr("asked for"));
    EXPECT_THAT(plan().approximations, Contains(HasSubstr("world's light")));
}

TEST_F(FramePlanTest, TheWorldBouncesByVirtualPointLightsAlone) {
    scene_.world.color = glm::vec3(0.5F);
    for (const Technique technique : {Technique::direct, Technique::rsm}) {
        settings_.technique = technique;
        EXPECT_TRUE(plan().world_occluded);
        EXPECT_EQ(plan().world_bounces, 0);
        EXPECT_TRUE(plan().glossy) << "what reflects the world directly has both lobes";
    }
    settings_.technique = Technique::ism;
    EXPECT_TRUE(plan().occluded) << "maps of its bounces";
    settings_.visibility = Visibility::none;
    EXPECT_FALSE(plan().occluded);
    EXPECT_TRUE(plan().world_occluded) << "its own are another setting";
}

TEST_F(FramePlanTest, SaysWhereThePictureDiffersFromCycles) {
    scene_.lights[0].radius_m = 0.1F;
    EXPECT_TRUE(plan().approximations.empty()) << "its shadow is soft";
    settings_.direct_shadows = DirectShadows::hard;
    EXPECT_THAT(plan().approximations, Contains(HasSubstr("light Key: drawn with a hard shadow")));
    settings_.show = Show::indirect;
    EXPECT_TRUE(plan().approximations.empty()) << "no shadow is drawn";
    settings_.show = Show::shaded;
    scene_.lights[0].radius_m = 0.0F;
    scene::Light& panel = add_light("Panel", scene::LightType::area);
    panel.size_x_m = panel.size_y_m = 1.0F;
    EXPECT_THAT(plan().approximations, Contains(HasSubstr("area light Panel")));
    scene_.materials[0].alpha_mode = scene::AlphaMode::blend;
    scene_.materials[0].base_color.a = 0.5F;
    EXPECT_THAT(plan().approximations, Contains(HasSubstr("cut-outs at one half: hard shadows")));
    settings_.transparent_layers = 0;
    EXPECT_THAT(plan().approximations, Contains(HasSubstr("blended transparency")));
}

TEST_F(FramePlanTest, BlendedSurfacesHaveLayersAndVeiledLights) {
    EXPECT_THAT(reason(plan(), "transparent layers"), HasSubstr("no visible surface is blended"));
    scene_.materials[0].alpha_mode = scene::AlphaMode::blend;
    EXPECT_EQ(plan().blend_layers, 0) << "its alpha is 1 everywhere";
    EXPECT_EQ(plan().veiled, std::vector<bool>{false});
    scene_.materials[0].base_color.a = 0.5F;
    FramePlan p = plan();
    EXPECT_EQ(p.blend_layers, settings_.transparent_layers);
    EXPECT_EQ(p.veiled, std::vector<bool>{true}) << "a light without size";
    EXPECT_EQ(reason(p, "transparent layers"), "");
    scene_.lights[0].radius_m = 0.1F;
    EXPECT_EQ(plan().veiled, std::vector<bool>{false}) << "its soft shadow holds them";
    scene_.materials[0].base_color.a = 0.0F;
    EXPECT_EQ(plan().blend_layers, 0) << "nothing is there";
    scene_.materials[0].base_color.a = 0.5F;
    settings_.show = Show::rsm_flux;
    EXPECT_EQ(plan().blend_layers, 0);
}

TEST_F(FramePlanTest, ALightWithASizeHasASoftShadow) {
    add_light("Sun", scene::LightType::sun).angle_rad = 0.01F;
    scene::Light& panel = add_light("Panel", scene::LightType::area);
    panel.size_x_m = panel.size_y_m = 1.0F;
    add_light("Point", scene::LightType::point).radius_m = 0.1F;
    const FramePlan p = plan();
    EXPECT_EQ(p.soft, (std::vector<bool>{false, true, true, true}));
    EXPECT_THAT(reason(p, "soft shadow: Key"), HasSubstr("no size"));
    EXPECT_EQ(reason(p, "soft shadow: Sun"), "");
}

TEST_F(FramePlanTest, HardShadowsAreLeftAsAskedFor) {
    scene_.lights[0].radius_m = 0.1F;
    settings_.direct_shadows = DirectShadows::hard;
    const FramePlan p = plan();
    EXPECT_EQ(p.soft, std::vector<bool>{false});
    EXPECT_EQ(p.shadows, std::vector<bool>{true});
    EXPECT_THAT(reason(p, "soft shadow: Key"), HasSubstr("asked for"));
}

TEST_F(FramePlanTest, APenumbraThatCannotBeSeenIsLeftOut) {
    scene_.lights[0].type = scene::LightType::sun;
    scene_.lights[0].angle_rad = 0.01F;
    const scene::Pose pose = scene::evaluate_pose(scene_, 0.0);
    // 0.01 over the square's diagonal of 1.41 m: 14 mm at most.
    const Sight fine{scene::world_bounds(scene_, pose), 0.027};
    const Sight coarse{scene::world_bounds(scene_, pose), 0.03};
    EXPECT_EQ(plan_frame(scene_, pose, settings_, &fine).soft, std::vector<bool>{true});
    const FramePlan p = plan_frame(scene_, pose, settings_, &coarse);
    EXPECT_EQ(p.soft, std::vector<bool>{false});
    EXPECT_EQ(p.shadows, std::vector<bool>{true});
    EXPECT_THAT(reason(p, "soft shadow: Key"), HasSubstr("half a pixel"));
    EXPECT_TRUE(p.approximations.empty());
}

TEST_F(FramePlanTest, ALightWithoutShadowHasNoPenumbra) {
    scene_.lights[0].radius_m = 0.1F;
    scene_.lights[0].cast_shadow = false;
    EXPECT_EQ(plan().soft, std::vector<bool>{false});
    EXPECT_THAT(plan().approximations, Not(Contains(HasSubstr("hard shadow"))));
}

TEST_F(FramePlanTest, AConvolvedShadowIsNamedAndHardLightsHaveNone) {
    settings_.direct_shadows = DirectShadows::convolution;
    EXPECT_TRUE(plan().approximations.empty()) << "a light without size";
    EXPECT_EQ(plan().soft, std::vector<bool>{false});
    scene_.lights[0].radius_m = 0.1F;
    EXPECT_EQ(plan().soft, std::vector<bool>{true});
    EXPECT_THAT(plan().approximations, Contains(HasSubstr("light Key: its soft shadow is convolved")));
}

TEST_F(FramePlanTest, AnImperfectShadowIsNamedAndHardLightsHaveNone) {
    settings_.direct_shadows = DirectShadows::ism;
    EXPECT_TRUE(plan().approximations.empty()) << "a light without size";
    EXPECT_FALSE(plan().imperfect_shadows);
    EXPECT_THAT(reason(plan(), "soft shadow: Key"), HasSubstr("no size"));
    scene_.lights[0].radius_m = 0.1F;
    EXPECT_EQ(plan().soft, std::vector<bool>{true});
    EXPECT_TRUE(plan().imperfect_shadows);
    EXPECT_THAT(plan().approximations,
                Contains(HasSubstr("light Key: its soft shadow is of imperfect maps")));
    settings_.direct_shadows = DirectShadows::vpl;
    EXPECT_FALSE(plan().imperfect_shadows);
}

TEST_F(FramePlanTest, ALightBelowZeroTakesDirectLightAlone) {
    scene_.lights[0].power_w = -5.0F;
    const FramePlan p = plan();
    EXPECT_EQ(p.lights, std::vector<int>{0});
    EXPECT_EQ(p.takes_light, std::vector<bool>{true});
    EXPECT_FALSE(p.indirect);
    EXPECT_THAT(p.approximations, Contains(HasSubstr("takes light away")));
    scene_.lights[0].power_w = 5.0F;
    EXPECT_EQ(plan().takes_light, std::vector<bool>{false});
}

TEST_F(FramePlanTest, AnAreaLightWithoutAreaSendsNoLight) {
    scene::Light& panel = add_light("Panel", scene::LightType::area);
    panel.size_x_m = 1.0F;
    panel.size_y_m = 0.0F;
    EXPECT_EQ(plan().lights.size(), 1U);
    EXPECT_THAT(reason(plan(), "light: Panel"), HasSubstr("no light"));
    scene_.lights.back().size_y_m = 1.0F;
    EXPECT_EQ(plan().lights.size(), 2U);
}

}  // namespace
}  // namespace bounce
