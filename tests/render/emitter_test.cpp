// SPDX-License-Identifier: Apache-2.0
//
// Surfaces that emit and what they light, against closed forms.
#include <gmock/gmock.h>

#include "ism_fixture.h"

namespace bounce::test {
namespace {

using ::testing::Contains;
using ::testing::HasSubstr;
using ::testing::Not;

// Form factor from a place to a rectangle that lies parallel over it at a height c, with corners at (x1, y1)
// and (x2, y2) from the place (Howell's catalogue, B-4 by superposition).
double form_factor(double x1, double x2, double y1, double y2, double c) {
    const auto part = [&](double x, double y) {
        const double rx = std::hypot(x, c);
        const double ry = std::hypot(y, c);
        return (x / rx * std::atan(y / rx) + y / ry * std::atan(x / ry)) / (2.0 * pi);
    };
    return part(x2, y2) - part(x1, y2) - part(x2, y1) + part(x1, y1);
}

class EmitterLight : public ::testing::Test {
  protected:
    static constexpr int size = 32;
    void SetUp() override { require_context(); }

    // Black, and sends the radiance to both sides.
    static int add_emission(scene::Scene& scene, const glm::vec3& radiance) {
        const int material = add_diffuse(scene, glm::vec3(0.0F));
        scene.materials.back().emission = radiance;
        return material;
    }
    // A white floor and a square of side 1 at a height over its middle, turned about X.
    static scene::Scene under_square(double height, const glm::vec3& radiance = glm::vec3(2.0F),
                                     double turned = 180.0) {
        scene::Scene scene;
        scene.from_blender = true;
        add_mesh_node(scene, add_square(scene, 6.0F, add_diffuse(scene)), glm::dmat4(1.0));
        add_mesh_node(scene, add_square(scene, 1.0F, add_emission(scene, radiance)),
                      rotated(turned, {1.0, 0.0, 0.0}, {0.0, 0.0, height}));
        return scene;
    }
    // 2 cm of the floor around (x, 0), seen from under the square.
    static CameraView floor_at(double x, double under) {
        CameraView camera = camera_from_above(0.02, 0.5 * under);
        camera.world_from_camera = moved({x, 0.0, 0.0}) * camera.world_from_camera;
        camera.camera.near_m = static_cast<float>(1e-3 * under);
        return camera;
    }
    static Settings lit(int vpls, int panels) {
        Settings settings;
        settings.width = settings.height = size;
        settings.technique = Technique::direct;
        settings.emitter_vpls = vpls;
        settings.emitter_panels = panels;
        settings.antialias = false;
        return settings;
    }
    static double middle(const Rendered& r) {
        double sum = 0.0;
        int count = 0;
        for (int y = size / 4; y < 3 * size / 4; ++y) {
            for (int x = size / 4; x < 3 * size / 4; ++x) {
                sum += r.at(x, y).x;
                ++count;
            }
        }
        return sum / count;
    }
};

TEST_F(EmitterLight, ASquareOverAPlaneIsItsFormFactor) {
    // As an area light: a closed form, half a per cent for 64 shadow maps that hide nothing.
    for (const double height : {0.01, 0.1, 1.0, 3.0}) {
        for (const double x : {0.0, 0.3, 0.8, 2.0}) {
            const double expected = 2.0 * form_factor(-0.5 - x, 0.5 - x, -0.5, 0.5, height);
            const Rendered r = draw(under_square(height), floor_at(x, height), lit(256, 2));
            EXPECT_THAT(r.report.executed, Not(Contains("emitter lights")));
            EXPECT_NEAR(middle(r), expected, 0.005 * expected + 1e-5) << height << ' ' << x;
        }
    }
}

TEST_F(EmitterLight, PointsOnASquareAreItsFormFactorFromItsOwnSideAway) {
    for (const double height : {1.0, 3.0}) {
        for (const double x : {0.0, 0.3, 0.8, 2.0}) {
            const double expected = 2.0 * form_factor(-0.5 - x, 0.5 - x, -0.5, 0.5, height);
            const Rendered r = draw(under_square(height), floor_at(x, height), lit(1024, 0));
            EXPECT_THAT(r.report.executed, Contains("emitter lights"));
            // 512 of them on this side: stratified, so a per cent.
            EXPECT_NEAR(middle(r), expected, 0.01 * expected) << height << ' ' << x;
        }
    }
}

TEST_F(EmitterLight, PointsNearAPlaneStayBounded) {
    // A centimetre away from points that stand 9 cm apart a piece is as bright as the square itself at most,
    // and with those around it up to 2.2 times; and `removed` says how much is missing between them.
    Settings settings = lit(256, 0);
    settings.technique = Technique::ism;
    settings.measure_removed = true;
    scene::Scene scene = under_square(0.01);
    CameraView camera = camera_from_above(0.8, 0.009);
    camera.camera.near_m = 1e-4F;
    const Rendered r = draw(scene, camera, settings);
    EXPECT_LT(*std::max_element(r.image.rgb.begin(), r.image.rgb.end()), 2.0F * 2.5F);
    EXPECT_GT(r.mean(), 0.0);
    ASSERT_TRUE(r.report.removed.has_value());
    EXPECT_GT(r.report.removed->removed, 0.0);
}

TEST_F(EmitterLight, BothSidesSend) {
    for (const int panels : {0, 2}) {
        const double down = middle(draw(under_square(1.0), floor_at(0.2, 1.0), lit(1024, panels)));
        const double up =
            middle(draw(under_square(1.0, glm::vec3(2.0F), 0.0), floor_at(0.2, 1.0), lit(1024, panels)));
        EXPECT_NEAR(up, down, 0.02 * down) << panels;
    }
}

TEST_F(EmitterLight, ABodySendsByItsOutsideAlone) {
    // A cube of side 0.4 with its lower face at height 1 is, from the middle below, that face.
    for (const int panels : {0, 6}) {
        scene::Scene scene;
        scene.from_blender = true;
        add_mesh_node(scene, add_square(scene, 6.0F, add_diffuse(scene)), glm::dmat4(1.0));
        add_mesh_node(scene, add_box(scene, glm::vec3(0.2F), add_emission(scene, glm::vec3(5.0F))),
                      moved({0.0, 0.0, 1.2}));
        const double expected = 5.0 * form_factor(-0.2, 0.2, -0.2, 0.2, 1.0);
        EXPECT_NEAR(middle(draw(scene, floor_at(0.0, 1.0), lit(1024, panels))), expected, 0.02 * expected)
            << panels;
    }
}

TEST_F(EmitterLight, ARoomThatEmitsSeesItself) {
    // A closed ball of radiance 1 and albedo 0 is 1 all over; with an albedo of a half every place reflects a
    // half of it once more (and the half of that with a bounce).
    for (const float albedo : {0.0F, 0.5F}) {
        scene::Scene scene;
        scene.from_blender = true;
        const int material = add_diffuse(scene, glm::vec3(albedo));
        scene.materials.back().emission = glm::vec3(1.0F);
        add_mesh_node(scene, add_ball(scene, material, 1.0F), glm::dmat4(1.0));
        CameraView camera = camera_from_above(1.0, 0.5);
        camera.camera.far_m = 10.0F;
        Settings settings = lit(1024, 2);
        const double direct = middle(draw(scene, camera, settings));
        // What the bound takes where points lie beside the receiver: 1 % with 1,024 of them.
        EXPECT_NEAR(direct, 1.0 + albedo, albedo > 0.0F ? 0.015 : 1e-6) << albedo;
        settings.technique = Technique::ism;
        settings.bounce_vpls = 512;
        EXPECT_NEAR(middle(draw(scene, camera, settings)), 1.0 + albedo + albedo * albedo,
                    albedo > 0.0F ? 0.03 : 1e-6)
            << albedo;
    }
}

TEST_F(EmitterLight, ATextureSaysWhereLightComesFrom) {
    // The half of the square with x < 0 is black.
    scene::Scene scene = under_square(1.0, glm::vec3(2.0F), 0.0);
    scene.meshes[1].primitives[0].uv0 = {{0.0F, 0.0F}, {1.0F, 0.0F}, {1.0F, 1.0F}, {0.0F, 1.0F}};
    scene::Image image;
    image.width = 64;
    image.height = 1;
    for (int x = 0; x < 64; ++x) {
        const auto value = static_cast<uint8_t>(x < 32 ? 0 : 255);
        image.rgba8.insert(image.rgba8.end(), {value, value, value, uint8_t{255}});
    }
    scene.images.push_back(image);
    scene.textures.resize(1);
    scene.textures[0].image = 0;
    scene.textures[0].sampler.wrap_u = scene.textures[0].sampler.wrap_v = scene::Wrap::clamp_to_edge;
    scene.materials[1].emission_texture.texture = 0;
    for (const double x : {-0.6, 0.0, 0.6}) {
        const double expected = 2.0 * form_factor(-x, 0.5 - x, -0.5, 0.5, 1.0);
        // A point's texel is a mean over what it stands for, and the edge falls within some of these.
        EXPECT_NEAR(middle(draw(scene, floor_at(x, 1.0), lit(1024, 2))), expected, 0.03 * expected) << x;
    }
}

TEST_F(EmitterLight, SomethingInTheWayHidesIt) {
    for (const int panels : {0, 2}) {
        scene::Scene scene = under_square(2.0);
        add_mesh_node(scene,
                      add_box(scene, glm::vec3(0.9F, 0.9F, 0.05F), add_diffuse(scene, glm::vec3(0.0F))),
                      moved({0.0, 0.0, 1.0}));
        const double open = middle(draw(under_square(2.0), floor_at(0.0, 0.9), lit(256, panels)));
        // The box covers all of the square from here.
        EXPECT_LT(middle(draw(scene, floor_at(0.0, 0.9), lit(256, panels))), 0.01 * open) << panels;
    }
}

// The material's strength goes from 1 to 3 in two seconds.
scene::Scene animated(scene::Scene scene, int material) {
    scene::Animation animation;
    animation.samplers.push_back({scene::Interpolation::linear, 1, {0.0F, 2.0F}, {1.0F, 3.0F}});
    animation.duration_s = 2.0F;
    animation.channels.push_back({scene::Property::material_emission_strength, material, 0});
    scene.animations.push_back(animation);
    scene.frames = {1, 49, 24.0};
    return scene;
}

TEST_F(EmitterLight, AnimatedEmissionScalesLinearly) {
    for (const int panels : {0, 2}) {
        const scene::Scene scene = animated(under_square(1.0), 1);
        const double first = middle(draw(scene, floor_at(0.2, 1.0), lit(256, panels), 0.0));
        // The same points, so it is the same number times the strength but for half floats' digits.
        EXPECT_NEAR(middle(draw(scene, floor_at(0.2, 1.0), lit(256, panels), 1.0)), 2.0 * first,
                    2e-3 * first);
        EXPECT_NEAR(middle(draw(scene, floor_at(0.2, 1.0), lit(256, panels), 2.0)), 3.0 * first,
                    3e-3 * first);
    }
}

TEST_F(EmitterLight, LightMovesWithItsSurface) {
    // No points stand on these two surfaces, as neither hides the other from anything.
    const scene::Scene scene = under_square(1.0);
    Renderer renderer(scene);
    const auto light_at = [&](double x, int panels) {
        scene::Pose pose = scene::evaluate_pose(scene, 0.0);
        for (scene::DrawInstance& draw : pose.draws) {
            if (draw.node == 1) {
                draw.world_from_model = pose.world_from_node[1] =
                    moved({x, 0.0, 0.0}) * draw.world_from_model;
            }
        }
        Rendered out;
        out.report = renderer.render(pose, floor_at(0.0, 1.0), lit(1024, panels));
        out.image = renderer.read_color();
        return middle(out);
    };
    for (const int panels : {0, 2}) {
        for (const double x : {0.0, 0.7, 1.4}) {
            const double expected = 2.0 * form_factor(x - 0.5, x + 0.5, -0.5, 0.5, 1.0);
            EXPECT_NEAR(light_at(x, panels), expected, 0.01 * expected) << panels << ' ' << x;
        }
    }
}

TEST_F(EmitterLight, AnythingBetweenDimAndBrightStaysFinite) {
    const double one = middle(draw(under_square(1.0, glm::vec3(1.0F)), floor_at(0.2, 1.0), lit(256, 0)));
    for (const int panels : {0, 2}) {
        for (const float radiance : {1e-6F, 1e6F}) {
            const double found =
                middle(draw(under_square(1.0, glm::vec3(radiance)), floor_at(0.2, 1.0), lit(256, panels)));
            EXPECT_NEAR(found / static_cast<double>(radiance), one, 0.03 * one) << panels << ' ' << radiance;
        }
    }
}

TEST_F(EmitterLight, BouncesAsAnAreaLightOfThePowerDoes) {
    // A wall and a floor, and a small square that faces the wall alone: all of the floor's light has bounced.
    scene::Scene scene = corner_scene();
    scene::Scene with_area = corner_scene();
    const glm::dmat4 place = rotated(-90.0, {0.0, 1.0, 0.0}, {-1.0, 0.0, 1.5});
    add_mesh_node(scene, add_square(scene, 0.3F, add_emission(scene, glm::vec3(50.0F))), place);
    Settings settings = lit(256, 0);
    settings.technique = Technique::ism;
    settings.bounce_vpls = 256;
    Settings once = settings;
    once.technique = Technique::direct;
    const Rendered all = draw(scene, floor_camera(), settings);
    const Rendered direct = draw(scene, floor_camera(), once);
    scene::Light area = light_of(scene::LightType::area);
    area.power_w = 4.0F * 0.3F * 0.3F * 50.0F;
    // Along its -Z: towards the wall, and towards the other side.
    add_light(with_area, area, rotated(90.0, {0.0, 1.0, 0.0}, {-1.001, 0.0, 1.5}));
    add_light(with_area, area, rotated(-90.0, {0.0, 1.0, 0.0}, {-0.999, 0.0, 1.5}));
    Settings indirect = bounced(size);
    const double expected = draw(with_area, floor_camera(), indirect).mean();
    // From the light's middle against from all of it, and 256 points against reflective maps: several per
    // cent.
    EXPECT_NEAR(all.mean() - direct.mean(), expected, 0.06 * expected);
    EXPECT_GT(expected, 0.01);
}

TEST_F(EmitterLight, CostsNothingWhereNothingEmits) {
    scene::Scene scene = corner_scene();
    add_wall_spot(scene);
    Settings settings = bounced(size);
    settings.show = Show::shaded;
    const Rendered with = draw(scene, floor_camera(), settings);
    settings.emitter_vpls = 0;
    const Rendered without = draw(scene, floor_camera(), settings);
    EXPECT_EQ(with.image.rgb, without.image.rgb);
    EXPECT_EQ(with.report.executed, without.report.executed);
    EXPECT_EQ(with.report.vpls, without.report.vpls);
    EXPECT_THAT(with.report.executed, Not(Contains("emitter lights")));
}

TEST_F(EmitterLight, ABlackTextureIsSaidToLightNothing) {
    scene::Scene scene = under_square(1.0);
    scene.meshes[1].primitives[0].uv0.assign(4, glm::vec2(0.5F));
    scene::Image image;
    image.width = image.height = 1;
    image.rgba8 = {0, 0, 0, 255};
    scene.images.push_back(image);
    scene.textures.resize(1);
    scene.textures[0].image = 0;
    scene.materials[1].emission_texture.texture = 0;
    const Rendered r = draw(scene, floor_at(0.0, 1.0), lit(256, 2));
    EXPECT_THAT(r.report.executed, Not(Contains("emitter lights")));
    EXPECT_THAT(r.report.left_out,
                Contains(::testing::Field(&LeftOut::reason, HasSubstr("textures of what emits are black"))));
    EXPECT_EQ(middle(r), 0.0);
}

}  // namespace
}  // namespace bounce::test
