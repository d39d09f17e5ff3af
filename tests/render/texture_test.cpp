// SPDX-License-Identifier: Apache-2.0
//
// Textures land where they belong, at the level of detail they are seen at.
#include <algorithm>

#include "render_fixture.h"

namespace bounce::test {
namespace {

class Textures : public ::testing::Test {
  protected:
    void SetUp() override { require_context(); }

    // A square of side 2 cut into n x n, facing up, its texture coordinates from 0 to 1 in set 0 and all in
    // one point in set 1.
    static int add_grid(scene::Scene& scene, int n, int material) {
        scene::Primitive grid;
        for (int y = 0; y <= n; ++y) {
            for (int x = 0; x <= n; ++x) {
                const glm::vec2 uv(static_cast<float>(x) / static_cast<float>(n),
                                   static_cast<float>(y) / static_cast<float>(n));
                grid.positions.emplace_back(2.0F * uv - 1.0F, 0.0F);
                grid.normals.emplace_back(0.0F, 0.0F, 1.0F);
                grid.uv0.push_back(uv);
                grid.uv1.emplace_back(0.9F, 0.9F);
            }
        }
        const auto at = [n](int x, int y) { return static_cast<uint32_t>(y * (n + 1) + x); };
        for (int y = 0; y < n; ++y) {
            for (int x = 0; x < n; ++x) {
                grid.indices.insert(grid.indices.end(), {at(x, y), at(x + 1, y), at(x + 1, y + 1), at(x, y),
                                                         at(x + 1, y + 1), at(x, y + 1)});
            }
        }
        grid.material = material;
        scene.meshes.push_back({"grid", {grid}, {}});
        return static_cast<int>(scene.meshes.size()) - 1;
    }
    // Left half red, right half blue.
    static scene::Image halves(int size) {
        scene::Image image;
        image.width = image.height = size;
        for (int y = 0; y < size; ++y) {
            for (int x = 0; x < size; ++x) {
                const bool left = x < size / 2;
                image.rgba8.insert(image.rgba8.end(), {static_cast<uint8_t>(left ? 255 : 0), 0,
                                                       static_cast<uint8_t>(left ? 0 : 255), 255});
            }
        }
        return image;
    }
    // The grid under light that makes it show its own colour.
    static scene::Scene textured_scene(const scene::TextureRef& ref, int n) {
        scene::Scene scene;
        scene.from_blender = true;
        scene.world.color = glm::vec3(1.0F);
        scene.images = {halves(256)};
        scene.textures = {{0, {}}};
        const int material = add_diffuse(scene);
        scene.materials[static_cast<size_t>(material)].base_color_texture = ref;
        add_mesh_node(scene, add_grid(scene, n, material), glm::dmat4(1.0));
        return scene;
    }
    static Settings settings() {
        Settings s;
        s.width = s.height = 64;
        s.world_vpls = 0;  // a white surface is 1 to the last bit
        return s;
    }
};

TEST_F(Textures, EveryPixelOfSmallTrianglesHasTheRightLevelOfDetail) {
    // Half of the texture's red half over the whole grid, hundreds of triangles about a pixel large: a pixel
    // whose level of detail were wrong would have some of the blue half in it.
    scene::TextureRef ref;
    ref.texture = 0;
    ref.uv_transform = glm::mat3(0.2F, 0.0F, 0.0F, 0.0F, 0.2F, 0.0F, 0.05F, 0.05F, 1.0F);
    const Rendered r = draw(textured_scene(ref, 60), camera_from_above(2.0, 10.0), settings());
    for (int y = 0; y < 64; ++y) {
        for (int x = 0; x < 64; ++x) {
            ASSERT_NEAR(r.at(x, y).x, 1.0, 2e-3) << x << ' ' << y;
            ASSERT_NEAR(r.at(x, y).z, 0.0, 2e-3) << x << ' ' << y;
        }
    }
}

TEST_F(Textures, LeftIsLeftAndMirroredTextIsNot) {
    scene::TextureRef ref;
    ref.texture = 0;
    const Rendered r = draw(textured_scene(ref, 2), camera_from_above(2.0, 10.0), settings());
    EXPECT_GT(r.at(8, 32).x, 0.9);
    EXPECT_GT(r.at(56, 32).z, 0.9);
}

TEST_F(Textures, TheSecondSetOfCoordinatesIsUsedWhereAskedFor) {
    scene::TextureRef ref;
    ref.texture = 0;
    ref.uv_set = 1;
    const Rendered r = draw(textured_scene(ref, 2), camera_from_above(2.0, 10.0), settings());
    EXPECT_GT(r.at(8, 32).z, 0.9) << "one point of the blue half everywhere";
    EXPECT_LT(r.at(8, 32).x, 0.1);
}

TEST_F(Textures, TheFirstRowOfAnImageIsAtVZero) {
    // glTF's v runs down from the image's top.
    scene::TextureRef ref;
    ref.texture = 0;
    scene::Scene scene = textured_scene(ref, 2);
    scene::Image& image = scene.images[0];
    for (int y = 0; y < 256; ++y) {
        for (int x = 0; x < 256; ++x) {
            const size_t i = static_cast<size_t>(y * 256 + x) * 4;
            image.rgba8[i] = y < 128 ? 255 : 0;
            image.rgba8[i + 2] = y < 128 ? 0 : 255;
        }
    }
    const Rendered r = draw(scene, camera_from_above(2.0, 10.0), settings());
    EXPECT_GT(r.at(32, 56).x, 0.9) << "v = 0 is at the grid's lower edge";
    EXPECT_GT(r.at(32, 8).z, 0.9);
}

TEST_F(Textures, AnAlphaTestCutsTheSameHoleIntoPictureAndShadow) {
    // The blue half is transparent: it shows the floor below, and light falls through it.
    scene::TextureRef ref;
    ref.texture = 0;
    scene::Scene scene = textured_scene(ref, 30);
    scene.world.color = glm::vec3(0.0F);
    scene.materials[0].alpha_mode = scene::AlphaMode::mask;
    for (size_t i = 0; i < scene.images[0].rgba8.size(); i += 4) {
        scene.images[0].rgba8[i + 3] = scene.images[0].rgba8[i];
    }
    add_mesh_node(scene, add_square(scene, 4.0F, add_diffuse(scene)),
                  glm::translate(glm::dmat4(1.0), glm::dvec3(0.0, 0.0, -0.5)));
    scene::Light sun;
    sun.type = scene::LightType::sun;
    sun.irradiance_w_m2 = static_cast<float>(pi);
    add_light(scene, sun, glm::dmat4(1.0));
    Settings s = settings();
    s.technique = Technique::direct;
    const Rendered r = draw(scene, camera_from_above(4.0, 10.0), s);
    // The grid covers the middle half of the frame.
    EXPECT_NEAR(r.at(24, 32).x, 1.0, 2e-2) << "red, lit";
    EXPECT_NEAR(r.at(24, 32).z, 0.0, 2e-2);
    EXPECT_NEAR(r.at(40, 32).z, 1.0, 2e-2) << "the white floor through the hole, lit through it";
    EXPECT_NEAR(r.at(40, 32).x, 1.0, 2e-2);
}

}  // namespace
}  // namespace bounce::test
