// SPDX-License-Identifier: Apache-2.0
//
// What textures and vertex colours say at points.
#include "scene/points/point_materials.h"

#include <algorithm>

#include <gtest/gtest.h>

#include "made_scenes.h"

namespace bounce::scene::test {
namespace {

// Linear value of an sRGB byte (IEC 61966-2-1).
double linear(int byte) {
    const double v = byte / 255.0;
    return v <= 0.04045 ? v / 12.92 : std::pow((v + 0.055) / 1.055, 2.4);
}

// A square of side 1 with coordinates 0 to 1, and a picture on it.
struct Textured {
    Scene scene;
    SurfaceParts parts;

    Textured(int width, int height, const std::vector<glm::u8vec4>& texels) {
        Primitive p = square(1.0F);
        p.uv0 = {{0, 0}, {1, 0}, {1, 1}, {0, 1}};
        p.material = 0;
        scene.materials.resize(1);
        scene.textures.resize(1);
        scene.textures[0].image = 0;
        Image image;
        image.width = width;
        image.height = height;
        for (const glm::u8vec4& texel : texels) {
            image.rgba8.insert(image.rgba8.end(), {texel.r, texel.g, texel.b, texel.a});
        }
        scene.images.push_back(image);
        place_mesh(scene, add_mesh(scene, p));
        parts = surface_parts(scene, k_all_animations);
    }
    Material& material() { return scene.materials[0]; }
    Primitive& primitive() { return scene.meshes[0].primitives[0]; }
};

// The point of the square at (u, v), which stands for a share of its triangle.
PointSample at_uv(float u, float v, float share) {
    PointSample point;
    // Triangle 0: corners (0,0), (1,0), (1,1); triangle 1: (0,0), (1,1), (0,1).
    point.triangle = v <= u ? glm::uvec3(0, 1, 2) : glm::uvec3(0, 2, 3);
    point.second = v <= u ? u - v : u;
    point.third = v <= u ? v : v - u;
    point.share = share;
    return point;
}

TEST(PointMaterials, NearestTexelOfASmallPoint) {
    const std::vector<glm::u8vec4> texels = {
        {255, 0, 0, 255}, {0, 255, 0, 255}, {0, 0, 255, 255}, {128, 64, 32, 255}};
    Textured t(2, 2, texels);
    t.material().base_color_texture.texture = 0;
    for (int i = 0; i < 4; ++i) {
        // Texels' centres: row 0 is v near 0.
        const auto color = point_materials(t.scene, t.parts,
                                           {at_uv(0.25F + 0.5F * static_cast<float>(i % 2),
                                                  0.25F + 0.5F * static_cast<float>(i / 2), 0.01F)})[0]
                               .base_color;
        for (int c = 0; c < 3; ++c) {
            EXPECT_NEAR(color[c], linear(texels[static_cast<size_t>(i)][c]), 1e-5) << i << ' ' << c;
        }
    }
}

TEST(PointMaterials, ALargePointHasTheMeanOfItsArea) {
    // Black and white squares, 64 x 64: a point that stands for all of a triangle sees half of white, in
    // linear light.
    std::vector<glm::u8vec4> texels;
    for (int i = 0; i < 64 * 64; ++i) {
        const auto value = static_cast<uint8_t>((i + i / 64) % 2 == 0 ? 255 : 0);
        texels.emplace_back(value, value, value, 255);
    }
    Textured t(64, 64, texels);
    t.material().base_color_texture.texture = 0;
    for (const float share : {1.0F, 5.0F, 0.1F}) {
        EXPECT_NEAR(point_materials(t.scene, t.parts, {at_uv(0.61F, 0.37F, share)})[0].base_color.r, 0.5F,
                    1e-3F)
            << share;
    }
    const std::vector<PointMaterial> fine = point_materials(
        t.scene, t.parts, {at_uv(10.5F / 64, 8.5F / 64, 1e-5F), at_uv(11.5F / 64, 8.5F / 64, 1e-5F)});
    EXPECT_NEAR(fine[0].base_color.r, 1.0F, 1e-5F) << "a small one sees its square";
    EXPECT_NEAR(fine[1].base_color.r, 0.0F, 1e-5F);
}

TEST(PointMaterials, MeanOverManyPointsIsTheImages) {
    // Noise, not a power of two in size, larger than what is kept: the mean of the points is the mean of the
    // picture.
    std::mt19937 random(5);
    std::vector<glm::u8vec4> texels;
    glm::dvec3 mean(0.0);
    constexpr int width = 600;
    constexpr int height = 37;
    for (int i = 0; i < width * height; ++i) {
        // Brighter to the right.
        const int top = 55 + 200 * (i % width) / width;
        texels.emplace_back(random() % static_cast<unsigned>(top), random() % 256, 200, 255);
        mean += glm::dvec3(linear(texels.back().r), linear(texels.back().g), linear(texels.back().b)) /
                (1.0 * width * height);
    }
    Textured t(width, height, texels);
    t.material().base_color_texture.texture = 0;
    // Points of a map are jittered along a curve: on a ramp 64 of them stray by 2 %, and 4,096 by what few
    // texels of noise each of them sees. Both limits are three times that.
    for (const auto& [count, tolerance] : {std::pair{size_t{64}, 0.06}, std::pair{size_t{4096}, 0.015}}) {
        PointCounts counts;
        counts.reflectors = count;
        counts.reflectors_a_map = count;
        const PointSet set = sample_points(t.parts, {true}, counts);
        glm::dvec3 sum(0.0);
        for (const PointMaterial& material : point_materials(t.scene, t.parts, set.reflectors)) {
            sum += glm::dvec3(material.base_color);
        }
        sum /= static_cast<double>(count);
        for (int c = 0; c < 3; ++c) {
            EXPECT_NEAR(sum[c] / mean[c], 1.0, tolerance) << count << " points, channel " << c;
        }
    }
}

TEST(PointMaterials, RoughnessAndMetallicAreNotGamma) {
    Textured t(1, 1, {{10, 128, 51, 255}});
    t.material().metallic_roughness_texture.texture = 0;
    const PointMaterial material = point_materials(t.scene, t.parts, {at_uv(0.5F, 0.2F, 1.0F)})[0];
    EXPECT_NEAR(material.roughness, 128.0F / 255.0F, 1e-5F);
    EXPECT_NEAR(material.metallic, 51.0F / 255.0F, 1e-5F);
    EXPECT_EQ(material.base_color, glm::vec3(1.0F));
}

TEST(PointMaterials, FactorsAreLeftToThePose) {
    // They may be animated.
    Textured t(1, 1, {{255, 255, 255, 255}});
    t.material().base_color = {0.2F, 0.3F, 0.4F, 1.0F};
    t.material().roughness = 0.1F;
    t.material().metallic = 0.5F;
    const PointMaterial material = point_materials(t.scene, t.parts, {at_uv(0.5F, 0.2F, 1.0F)})[0];
    EXPECT_EQ(material.base_color, glm::vec3(1.0F));
    EXPECT_EQ(material.roughness, 1.0F);
    EXPECT_EQ(material.metallic, 1.0F);
}

TEST(PointMaterials, SixteenBitsAndUvTransform) {
    Textured t(2, 1, {{0, 0, 0, 255}, {0, 0, 0, 255}});
    t.scene.images[0].rgba8.clear();
    t.scene.images[0].rgba16 = {0, 65535, 0, 65535, 0, 16384, 0, 65535};
    t.material().metallic_roughness_texture.texture = 0;
    t.material().metallic_roughness_texture.uv_set = 1;
    t.primitive().uv1 = t.primitive().uv0;
    // u' = u / 2 + 0.5: the right half.
    t.material().metallic_roughness_texture.uv_transform = {{0.5F, 0, 0}, {0, 1, 0}, {0.5F, 0, 1}};
    const PointMaterial material = point_materials(t.scene, t.parts, {at_uv(0.5F, 0.2F, 0.01F)})[0];
    EXPECT_NEAR(material.roughness, 16384.0F / 65535.0F, 1e-5F);
}

TEST(PointMaterials, WrapModes) {
    Textured t(2, 1, {{255, 255, 255, 255}, {0, 0, 0, 255}});
    t.material().base_color_texture.texture = 0;
    for (glm::vec2& uv : t.primitive().uv0) {
        uv.x = uv.x - 1.0F;  // -1 to 0
    }
    const auto value = [&](Wrap wrap) {
        t.scene.textures[0].sampler.wrap_u = wrap;
        return point_materials(t.scene, t.parts, {at_uv(0.25F, 0.1F, 0.01F)})[0].base_color.r;
    };
    EXPECT_NEAR(value(Wrap::repeat), 1.0F, 1e-5F) << "-0.75 is 0.25";
    EXPECT_NEAR(value(Wrap::mirrored_repeat), 0.0F, 1e-5F) << "-0.75 is 0.75";
    EXPECT_NEAR(value(Wrap::clamp_to_edge), 1.0F, 1e-5F);
}

TEST(PointMaterials, VertexColoursAreInterpolatedAndMultiplied) {
    Textured t(1, 1, {{255, 255, 0, 255}});
    t.material().base_color_texture.texture = 0;
    t.primitive().colors = {{1, 0, 0.5F, 1}, {0, 1, 0.5F, 1}, {0, 0, 0.5F, 1}, {0, 0, 0, 1}};
    PointSample point;
    point.triangle = {0, 1, 2};
    point.second = 0.25F;
    point.third = 0.5F;
    point.share = 1.0F;
    const glm::vec3 color = point_materials(t.scene, t.parts, {point})[0].base_color;
    EXPECT_NEAR(color.r, 0.25F, 1e-5F);
    EXPECT_NEAR(color.g, 0.25F, 1e-5F);
    EXPECT_NEAR(color.b, 0.0F, 1e-5F) << "the texture has no blue";
}

TEST(PointMaterials, MissingImagesAndCoordinatesSayNothing) {
    Textured t(1, 1, {{0, 0, 0, 255}});
    t.material().base_color_texture.texture = 0;
    t.primitive().uv0.clear();
    EXPECT_EQ(point_materials(t.scene, t.parts, {at_uv(0.5F, 0.2F, 1.0F)})[0].base_color, glm::vec3(1.0F));
    Textured u(1, 1, {{0, 0, 0, 255}});
    u.material().base_color_texture.texture = 0;
    u.scene.textures[0].image = k_none;
    EXPECT_EQ(point_materials(u.scene, u.parts, {at_uv(0.5F, 0.2F, 1.0F)})[0].base_color, glm::vec3(1.0F));
    Textured v(1, 1, {{0, 0, 0, 255}});
    v.primitive().material = k_none;
    EXPECT_EQ(point_materials(v.scene, v.parts, {at_uv(0.5F, 0.2F, 1.0F)})[0].base_color, glm::vec3(1.0F));
}

// Share of points that are left, of a square whose left half has alpha 0 and whose right half has 153 / 255.
double share_left(AlphaMode mode, float cutoff, float factor, float vertex_alpha) {
    Textured t(2, 1, {{255, 255, 255, 0}, {255, 255, 255, 153}});
    t.scene.textures[0].sampler.wrap_u = Wrap::clamp_to_edge;
    t.material().base_color_texture.texture = 0;
    t.material().alpha_mode = mode;
    t.material().alpha_cutoff = cutoff;
    t.material().base_color.a = factor;
    if (vertex_alpha < 1.0F) {
        t.primitive().colors.assign(4, {1, 1, 1, vertex_alpha});
    }
    PointCounts counts;
    counts.occluders = counts.points_a_map = 4096;
    counts.large_triangles = false;
    PointSet set = sample_points(t.parts, {false}, counts);
    drop_cut_out(t.scene, t.parts, set.occluders);
    double left = 0.0;
    for (const PointSample& point : set.occluders) {
        left += point.share > 0.0F ? 1.0 / 4096.0 : 0.0;
    }
    return left;
}

TEST(PointMaterials, CutOutsHaveNoPoints) {
    // Between the texels' centres alpha runs from 0 to 0.6: at the cut-off c the edge lies at 1/4 + c / 0.6
    // / 2.
    EXPECT_NEAR(share_left(AlphaMode::mask, 0.3F, 1.0F, 1.0F), 1.0 - (0.25 + 0.25), 0.01);
    EXPECT_NEAR(share_left(AlphaMode::mask, 0.45F, 1.0F, 1.0F), 1.0 - (0.25 + 0.375), 0.01);
    EXPECT_NEAR(share_left(AlphaMode::blend, 0.1F, 1.0F, 1.0F), 0.3, 0.01)
        << "of a blended surface a part alpha stays";
    EXPECT_NEAR(share_left(AlphaMode::blend, 0.1F, 0.5F, 1.0F), 0.15, 0.01);
    EXPECT_EQ(share_left(AlphaMode::blend, 0.1F, 0.0F, 1.0F), 0.0);
    EXPECT_EQ(share_left(AlphaMode::mask, 0.31F, 0.5F, 1.0F), 0.0) << "the factor counts";
    EXPECT_EQ(share_left(AlphaMode::mask, 0.31F, 1.0F, 0.5F), 0.0) << "vertex colours count";
    EXPECT_EQ(share_left(AlphaMode::opaque, 0.99F, 0.1F, 1.0F), 1.0) << "an opaque surface has no holes";
}

}  // namespace
}  // namespace bounce::scene::test
