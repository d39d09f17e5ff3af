// SPDX-License-Identifier: Apache-2.0
//
// What textures say of a surface, as Cycles reads them: colour spaces, interpolation, normal maps, levels of
// detail.
#include <algorithm>
#include <cmath>

#include "render_fixture.h"

namespace bounce::test {
namespace {

class Materials : public ::testing::Test {
  protected:
    void SetUp() override { require_context(); }
};

int add_image(scene::Scene& scene, int width, int height, const std::vector<uint8_t>& grey) {
    scene::Image image;
    image.name = "image";
    image.width = width;
    image.height = height;
    image.opaque = true;
    for (const uint8_t value : grey) {
        image.rgba8.insert(image.rgba8.end(), {value, value, value, 255});
    }
    scene.images.push_back(image);
    scene::Texture texture;
    texture.image = static_cast<int>(scene.images.size()) - 1;
    texture.sampler.wrap_u = texture.sampler.wrap_v = scene::Wrap::clamp_to_edge;
    scene.textures.push_back(texture);
    return static_cast<int>(scene.textures.size()) - 1;
}

// A square whose texture coordinates go from 0 to 1 along x and y.
int add_mapped_square(scene::Scene& scene, float size, int material) {
    const int mesh = add_square(scene, size, material);
    scene::Primitive& primitive = scene.meshes.back().primitives.front();
    primitive.uv0 = {{0.0F, 0.0F}, {1.0F, 0.0F}, {1.0F, 1.0F}, {0.0F, 1.0F}};
    primitive.tangents.assign(4, {1.0F, 0.0F, 0.0F, 1.0F});
    return mesh;
}

Settings direct_settings() {
    Settings s;
    s.width = s.height = 33;  // an odd number: one pixel is in the middle
    s.technique = Technique::direct;
    s.antialias = false;
    return s;
}

double from_srgb(double c) {
    return c <= 0.04045 ? c / 12.92 : std::pow((c + 0.055) / 1.055, 2.4);
}

// What a square glows like in its middle, whose left half is black and right half white, or all of one grey.
double glow(const std::vector<uint8_t>& grey, bool from_blender, scene::Encoding encoding) {
    scene::Scene scene;
    scene.from_blender = from_blender;
    const int material = add_diffuse(scene, glm::vec3(0.0F));
    const int texture = add_image(scene, static_cast<int>(grey.size()), 1, grey);
    scene.materials.back().emission = glm::vec3(1.0F);
    scene.materials.back().emission_texture.texture = texture;
    scene.materials.back().emission_texture.encoding = encoding;
    add_mesh_node(scene, add_mapped_square(scene, 2.0F, material), glm::dmat4(1.0));
    return draw(scene, camera_from_above(0.2, 10.0), direct_settings()).at(16, 16).x;
}

// Cycles decodes what it has interpolated; glTF interpolates what it has decoded. An 8-bit texel and a
// filter's eight bits of weight: half of 1/255.
TEST_F(Materials, ColoursAreInterpolatedAsCyclesDoes) {
    const std::vector<uint8_t> step = {0, 255};
    EXPECT_NEAR(glow(step, true, scene::Encoding::by_use), from_srgb(0.5), 0.004);
    EXPECT_NEAR(glow(step, false, scene::Encoding::by_use), 0.5, 0.004);
}

TEST_F(Materials, AColourSpaceThatTheFileNamesCounts) {
    const std::vector<uint8_t> grey = {128, 128};
    const double value = 128.0 / 255.0;
    for (const bool from_blender : {true, false}) {
        EXPECT_NEAR(glow(grey, from_blender, scene::Encoding::by_use), from_srgb(value), 0.002);
        EXPECT_NEAR(glow(grey, from_blender, scene::Encoding::linear), value, 0.002);
        EXPECT_NEAR(glow(grey, from_blender, scene::Encoding::srgb), from_srgb(value), 0.002);
    }
}

// The cosine of a normal map's normal to a sun and a viewer overhead.
double lit_cosine(const glm::u8vec3& texel, float strength, bool from_blender) {
    const auto render = [&](bool mapped) {
        scene::Scene scene;
        scene.from_blender = from_blender;
        const int material = add_diffuse(scene);
        const int texture = add_image(scene, 1, 1, {0});
        std::copy_n(&texel.x, 3, scene.images.back().rgba8.begin());
        if (mapped) {
            scene.materials.back().normal_texture.texture = texture;
            scene.materials.back().normal_scale = strength;
        }
        add_mesh_node(scene, add_mapped_square(scene, 2.0F, material), glm::dmat4(1.0));
        scene::Light light;
        light.name = "sun";
        light.type = scene::LightType::sun;
        light.irradiance_w_m2 = 1.0F;
        add_light(scene, light, glm::dmat4(1.0));
        return draw(scene, camera_from_above(0.2, 10.0), direct_settings()).at(16, 16).x;
    };
    return render(true) / render(false);
}

glm::dvec3 decoded(const glm::u8vec3& texel) {
    return glm::normalize(glm::dvec3(texel) / 255.0 * 2.0 - 1.0);
}

TEST_F(Materials, NormalMapStrengthIsCycles) {
    const glm::u8vec3 texel(165, 128, 232);  // some 19 degrees
    const glm::dvec3 map = decoded(texel);
    for (const float strength : {0.3F, 1.0F, 2.0F}) {
        const glm::dvec3 up(0.0, 0.0, 1.0);
        const glm::dvec3 expected = glm::normalize(up + (map - up) * static_cast<double>(strength));
        EXPECT_NEAR(lit_cosine(texel, strength, true), expected.z, 0.002) << strength;
        const glm::dvec3 khronos =
            glm::normalize(glm::dvec3(texel) / 255.0 * 2.0 - 1.0) * glm::dvec3(strength, strength, 1.0);
        EXPECT_NEAR(lit_cosine(texel, strength, false), glm::normalize(khronos).z, 0.002) << strength;
    }
}

// Seen from above the mirrored view stands out by cos 2a, at least by 0.01.
TEST_F(Materials, ANormalThatMirrorsIntoTheSurfaceIsTurnedBack) {
    const glm::u8vec3 texel(240, 128, 190);  // some 61 degrees
    ASSERT_LT(decoded(texel).z, 0.6);
    EXPECT_NEAR(lit_cosine(texel, 1.0F, true), std::cos(0.5 * std::acos(0.01)), 0.002);
    EXPECT_NEAR(lit_cosine(texel, 1.0F, false), decoded(texel).z, 0.002)
        << "in files from elsewhere it stays";
}

// Light that a wall with a fine checker bounces is that of a wall of its mean, however many squares a texel
// of the map, or a point's area, holds.
TEST_F(Materials, BouncesSeeTheMeanOfAFineTexture) {
    const auto bounced = [](bool checker, int bounces) {
        scene::Scene scene;
        scene.from_blender = true;
        add_mesh_node(scene, add_square(scene, 3.0F, add_diffuse(scene)), glm::dmat4(1.0));
        const int wall = add_diffuse(scene, glm::vec3(checker ? 1.0F : 0.5F));
        std::vector<uint8_t> grey(512 * 512);
        for (size_t i = 0; i < grey.size(); ++i) {
            grey[i] = (i / 512 + i) % 2 == 0 ? 255 : 0;
        }
        if (checker) {
            const int texture = add_image(scene, 512, 512, grey);
            scene.materials[static_cast<size_t>(wall)].base_color_texture.texture = texture;
        }
        add_mesh_node(scene, add_mapped_square(scene, 2.0F, wall),
                      glm::translate(glm::dmat4(1.0), glm::dvec3(-1.0, 0.0, 1.0)) *
                          glm::rotate(glm::dmat4(1.0), 0.5 * pi, glm::dvec3(0.0, 1.0, 0.0)));
        scene::Light light;
        light.name = "light";
        light.type = scene::LightType::spot;
        light.power_w = 100.0F;
        light.cone_angle_rad = 0.6F;
        const glm::dvec3 aim = bounces == 1 ? glm::dvec3(-1.0, 0.0, 1.0) : glm::dvec3(0.3, 0.0, 0.0);
        add_light(scene, light,
                  glm::inverse(glm::lookAt(glm::dvec3(1.5, 0.0, 1.6), aim, glm::dvec3(0.0, 1.0, 0.0))));
        Settings settings;
        settings.width = settings.height = 32;
        settings.show = Show::indirect;
        settings.technique = bounces == 1 ? Technique::rsm : Technique::ism;
        settings.bounces = bounces;
        settings.rsm_full_sum = bounces == 1;
        settings.rsm_size = 64;
        return draw(scene, camera_from_above(1.0, 10.0), settings).mean();
    };
    EXPECT_NEAR(bounced(true, 1) / bounced(false, 1), 1.0, 0.01) << "reflective shadow map";
    EXPECT_NEAR(bounced(true, 2) / bounced(false, 2), 1.0, 0.01) << "points";
}

}  // namespace
}  // namespace bounce::test
