// SPDX-License-Identifier: Apache-2.0
//
// Shadows: where they must be, and where they must not.
#include "render_fixture.h"

namespace bounce::test {
namespace {

class Shadows : public ::testing::Test {
  protected:
    void SetUp() override { require_context(); }

    // A floor of 4 m with a square of 1 m floating 0.5 m over its middle; camera sees the floor from below
    // the square's level, straight down, through nothing: the square is seen too.
    static scene::Scene scene_with(const scene::Light& light, const glm::dmat4& world_from_light,
                                   bool occluder) {
        scene::Scene scene;
        scene.from_blender = true;
        const int material = add_diffuse(scene);
        add_mesh_node(scene, add_square(scene, 4.0F, material), glm::dmat4(1.0));
        if (occluder) {
            add_mesh_node(scene, add_square(scene, 1.0F, material),
                          glm::translate(glm::dmat4(1.0), glm::dvec3(0.0, 0.0, 0.5)));
        }
        add_light(scene, light, world_from_light);
        return scene;
    }
    static Settings settings() {
        Settings s;
        s.width = s.height = 101;
        s.technique = Technique::direct;
        return s;
    }
};

scene::Light light_of(scene::LightType type) {
    scene::Light light;
    light.type = type;
    light.power_w = 100.0F;
    light.irradiance_w_m2 = 2.0F;
    light.cone_angle_rad = 1.6F;
    light.size_x_m = light.size_y_m = 0.01F;
    return light;
}

TEST_F(Shadows, EveryKindOfMapPutsTheShadowInTheSamePlace) {
    // From 3 m above x = 1.5 the square's shadow on the floor runs from x = -0.9 to 0.3 (stretched by 3/2.5).
    for (const auto type : {scene::LightType::spot, scene::LightType::point, scene::LightType::area}) {
        const glm::dmat4 at = glm::translate(glm::dmat4(1.0), glm::dvec3(1.5, 0.0, 3.0));
        const CameraView camera = camera_from_above(4.0, 10.0);
        const Rendered lit = draw(scene_with(light_of(type), at, false), camera, settings());
        const Rendered shaded = draw(scene_with(light_of(type), at, true), camera, settings());
        const auto pixel = [](double x) { return static_cast<int>((x + 2.0) / 4.0 * 101.0); };
        const int type_number = static_cast<int>(type);
        EXPECT_EQ(shaded.at(pixel(-0.7), 50).x, 0.0) << "in the shadow, type " << type_number;
        EXPECT_NEAR(shaded.at(pixel(-1.0), 50).x / lit.at(pixel(-1.0), 50).x, 1.0, 1e-3)
            << "left of it, type " << type_number;
        EXPECT_NEAR(shaded.at(pixel(0.8), 50).x / lit.at(pixel(0.8), 50).x, 1.0, 1e-3)
            << "right of it, type " << type_number;
    }
}

TEST_F(Shadows, ASunPutsItWhereItsRaysGo) {
    // At 45 degrees from +x the square, half a metre up, throws its shadow half a metre to -x: from -1 to 0.
    const glm::dmat4 tilted = glm::rotate(glm::dmat4(1.0), 0.25 * pi, glm::dvec3(0.0, 1.0, 0.0));
    const CameraView camera = camera_from_above(4.0, 10.0);
    const Rendered lit = draw(scene_with(light_of(scene::LightType::sun), tilted, false), camera, settings());
    const Rendered shaded =
        draw(scene_with(light_of(scene::LightType::sun), tilted, true), camera, settings());
    const auto pixel = [](double x) { return static_cast<int>((x + 2.0) / 4.0 * 101.0); };
    EXPECT_EQ(shaded.at(pixel(-0.75), 50).x, 0.0);
    EXPECT_NEAR(shaded.at(pixel(-1.1), 50).x / lit.at(pixel(-1.1), 50).x, 1.0, 1e-3);
    EXPECT_NEAR(shaded.at(pixel(0.8), 50).x / lit.at(pixel(0.8), 50).x, 1.0, 1e-3);
}

TEST_F(Shadows, AFarClipPlaneAndADomeOfKilometresChangeNothing) {
    for (const auto type : {scene::LightType::spot, scene::LightType::point}) {
        const glm::dmat4 at = glm::translate(glm::dmat4(1.0), glm::dvec3(1.5, 0.0, 3.0));
        scene::Scene scene = scene_with(light_of(type), at, true);
        const CameraView near_camera = camera_from_above(4.0, 10.0);
        const Rendered expected = draw(scene, near_camera, settings());
        CameraView far_camera = near_camera;
        far_camera.camera.far_m = 1e5F;
        // Two squares far to both sides make the scene twenty kilometres wide.
        const int square = add_square(scene, 1.0F, 0);
        for (const double x : {-1e4, 1e4}) {
            add_mesh_node(scene, square, glm::translate(glm::dmat4(1.0), glm::dvec3(x, 0.0, 0.0)));
        }
        const Rendered got = draw(scene, far_camera, settings());
        // Nearly every pixel: along the shadow's edge the map's texels may fall a little differently, and
        // positions are rounded to a float of twenty kilometres (a millimetre).
        int wrong = 0;
        for (size_t i = 0; i < got.image.rgb.size(); i += 3) {
            wrong +=
                std::abs(got.image.rgb[i] - expected.image.rgb[i]) > 0.01F * std::abs(expected.image.rgb[i])
                    ? 1
                    : 0;
        }
        EXPECT_LT(wrong, 101 * 101 / 50) << "type " << static_cast<int>(type);
    }
}

TEST_F(Shadows, SmoothShadingDoesNotShadowItself) {
    // Normals bent by 30 degrees away from the triangle's own, as smooth shading and normal maps do: whatever
    // the light does to the shading, the flat floor throws no shadow on itself.
    for (const auto type : {scene::LightType::spot, scene::LightType::point, scene::LightType::sun}) {
        scene::Light light = light_of(type);
        const glm::dmat4 at = glm::rotate(glm::translate(glm::dmat4(1.0), glm::dvec3(2.0, 0.0, 2.5)), 0.6,
                                          glm::dvec3(0.0, 1.0, 0.0));
        scene::Scene scene = scene_with(light, at, false);
        scene.meshes[0].primitives[0].normals.assign(4, glm::vec3(0.0F, 0.5F, 0.866F));
        const CameraView camera = camera_from_above(4.0, 10.0);
        const Rendered with_shadow = draw(scene, camera, settings());
        scene.lights[0].cast_shadow = false;
        const Rendered without = draw(scene, camera, settings());
        EXPECT_GT(without.mean(), 0.0);
        EXPECT_NEAR(with_shadow.mean() / without.mean(), 1.0, 1e-5) << "type " << static_cast<int>(type);
    }
}

TEST_F(Shadows, NothingShadowsItself) {
    // One floor and no occluder: at every incidence and for every kind of map the picture equals the one
    // without shadows. 1e-6: the same arithmetic but for the shadow's factor.
    for (const auto type : {scene::LightType::spot, scene::LightType::point, scene::LightType::sun}) {
        for (const double degrees : {0.0, 30.0, 60.0, 80.0, 87.0}) {
            scene::Light light = light_of(type);
            const glm::dmat4 tilted =
                glm::rotate(glm::dmat4(1.0), degrees * pi / 180.0, glm::dvec3(0.0, 1.0, 0.0));
            const glm::dmat4 at = glm::translate(tilted, glm::dvec3(0.0, 0.0, 3.0));
            const CameraView camera = camera_from_above(4.0, 10.0);
            const Rendered with_shadow = draw(scene_with(light, at, false), camera, settings());
            light.cast_shadow = false;
            const Rendered without = draw(scene_with(light, at, false), camera, settings());
            int wrong = 0;
            for (size_t i = 0; i < without.image.rgb.size(); ++i) {
                wrong +=
                    std::abs(with_shadow.image.rgb[i] - without.image.rgb[i]) > 1e-6F * without.image.rgb[i]
                        ? 1
                        : 0;
            }
            EXPECT_EQ(wrong, 0) << "type " << static_cast<int>(type) << " at " << degrees << " degrees";
        }
    }
}

TEST_F(Shadows, AreaLightIsOneSided) {
    const glm::dmat4 upside_down = glm::rotate(glm::translate(glm::dmat4(1.0), glm::dvec3(0.0, 0.0, 2.0)), pi,
                                               glm::dvec3(1.0, 0.0, 0.0));
    EXPECT_EQ(draw(scene_with(light_of(scene::LightType::area), upside_down, false),
                   camera_from_above(4.0, 10.0), settings())
                  .mean(),
              0.0);
}

}  // namespace
}  // namespace bounce::test
