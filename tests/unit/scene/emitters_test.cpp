// SPDX-License-Identifier: Apache-2.0
#include "scene/points/emitters.h"

#include <gtest/gtest.h>

#include "point_samples.h"
#include "scene/emission.h"

namespace bounce::scene::test {
namespace {

// Squares of 1 m and of 2 m and a box, each of a material of its own.
struct Emitting {
    Scene scene;
    SurfaceParts parts;
    std::vector<glm::vec3> radiance{{1, 1, 1}, {1, 1, 1}, {1, 1, 1}};

    Emitting() {
        scene.materials.resize(3);
        const std::array<Primitive, 3> shapes{square(1.0F), square(2.0F), box({0.5F, 0.5F, 0.5F})};
        for (size_t i = 0; i < shapes.size(); ++i) {
            Primitive shape = shapes.at(i);
            shape.material = static_cast<int>(i);
            scene.materials[i].emission = glm::vec3(1.0F);
            place_mesh(scene, add_mesh(scene, shape), moved({4.0 * static_cast<double>(i), 0.0, 0.0}));
        }
        parts = surface_parts(scene, k_none);
    }

    [[nodiscard]] std::vector<EmitterSample> sample(size_t count) const {
        return Emitters(scene, parts).sample(radiance, std::vector<bool>(parts.surfaces.size(), true), count);
    }

    // Power over pi of the samples on a material, by their own areas.
    [[nodiscard]] double sent(const std::vector<EmitterSample>& samples, int material, bool back) const {
        double sum = 0.0;
        for (const EmitterSample& s : samples) {
            if (primitive_of(scene, parts, s.point.surface).material == material && s.back == back) {
                const double area =
                    area_of(corners(scene, parts, s.point.surface, s.point.triangle)) * s.point.share;
                sum += area * (radiance[static_cast<size_t>(material)] * s.texture).g;
            }
        }
        return sum;
    }
};

double area_of_material(const Emitting& e, int material) {
    double area = 0.0;
    for (const SurfacePart& part : e.parts.parts) {
        area += primitive_of(e.scene, e.parts, part.surface).material == material ? part.area_m2 : 0.0;
    }
    return area;
}

// Samples are a whole number for each surface, so what they stand for is off by less than one of them.
TEST(Emitters, StandForAllThatIsSentByBothSidesOfSheetsAndTheOutsideOfBodies) {
    Emitting e;
    e.radiance = {{4, 4, 4}, {1, 1, 1}, {0.5, 0.5, 0.5}};
    const auto samples = e.sample(1024);
    ASSERT_EQ(samples.size(), 1024U);
    double all = 0.0;
    for (int material = 0; material < 3; ++material) {
        const double power = area_of_material(e, material) * e.radiance[static_cast<size_t>(material)].g;
        all += power * (material == 2 ? 1.0 : 2.0);
    }
    for (int material = 0; material < 3; ++material) {
        const double power = area_of_material(e, material) * e.radiance[static_cast<size_t>(material)].g;
        for (const bool back : {false, true}) {
            const double expected = back && material == 2 ? 0.0 : power;
            EXPECT_NEAR(e.sent(samples, material, back), expected, 2.0 * all / 1024) << material << back;
        }
    }
}

TEST(Emitters, AFactorForAllChangesNothing) {
    Emitting e;
    const auto before = e.sample(256);
    for (glm::vec3& radiance : e.radiance) radiance *= 1e-6F;
    const auto after = e.sample(256);
    ASSERT_EQ(before.size(), after.size());
    for (size_t i = 0; i < before.size(); ++i) {
        EXPECT_EQ(before[i].point.surface, after[i].point.surface);
        EXPECT_NEAR(before[i].point.second, after[i].point.second, 1e-6);
        EXPECT_NEAR(before[i].point.share, after[i].point.share, 1e-5 * before[i].point.share);
    }
}

TEST(Emitters, NothingThatIsDarkOrHiddenIsSampled) {
    Emitting e;
    std::vector<bool> shown(e.parts.surfaces.size(), true);
    e.radiance[0] = glm::vec3(0.0F);
    for (size_t i = 0; i < shown.size(); ++i) {
        shown[i] = primitive_of(e.scene, e.parts, static_cast<uint32_t>(i)).material != 1;
    }
    for (const EmitterSample& s : Emitters(e.scene, e.parts).sample(e.radiance, shown, 64)) {
        EXPECT_EQ(primitive_of(e.scene, e.parts, s.point.surface).material, 2);
    }
    e.radiance = {{0, 0, 0}, {0, 0, 0}, {0, 0, 0}};
    EXPECT_TRUE(e.sample(64).empty());
    for (Material& material : e.scene.materials) material.emission = glm::vec3(0.0F);
    EXPECT_TRUE(Emitters(e.scene, e.parts).empty());
}

TEST(Emitters, PanelsAreLeftToOthers) {
    Emitting e;
    const EmissivePanels found = find_emissive_panels(e.scene, 64);
    ASSERT_EQ(found.panels.size(), 8U) << "two sheets and six faces";
    EXPECT_TRUE(found.all);
    const std::vector<bool> shown(e.parts.surfaces.size(), true);
    const Emitters emitters(e.scene, e.parts);
    EXPECT_TRUE(emitters.sample(e.radiance, shown, 64, found.panels).empty());
    const auto rest = emitters.sample(e.radiance, shown, 64, std::span(found.panels).first(1));
    ASSERT_EQ(rest.size(), 64U);
    for (const EmitterSample& s : rest) {
        EXPECT_NE(primitive_of(e.scene, e.parts, s.point.surface).material, 1) << "the larger sheet";
    }
}

TEST(Emitters, SamplesAreSpreadByWhatSurfacesSendAtTheirBrightest) {
    Scene scene;
    scene.materials.resize(2);
    scene.materials[0].emission = scene.materials[1].emission = glm::vec3(2.0F);
    scene.materials[1].unlit = true;
    Animation animation;
    animation.samplers.push_back({Interpolation::linear, 1, {0.0F, 0.5F, 1.0F}, {0.0F, 7.0F, 0.0F}});
    animation.channels.push_back({Property::material_emission_strength, 0, 0});
    animation.duration_s = 1.0F;
    scene.animations.push_back(animation);
    scene.frames = {1, 25, 24.0};
    const std::vector<glm::vec3> peak = peak_radiance(scene, 0);
    EXPECT_NEAR(peak[0].r, 14.0F, 1e-3F);
    EXPECT_EQ(peak[1].r, 0.0F) << "unlit";
}

// Two frames of two hundred, between any moments that are spread evenly.
TEST(Emitters, AFlashIsAsBrightAsItsKey) {
    Scene scene;
    scene.materials.resize(1);
    scene.materials[0].emission = glm::vec3(2.0F);
    scene.materials[0].emission_strength = 0.0F;
    Animation animation;
    const auto at_frame = [](int frame) { return static_cast<float>((frame - 1) / 24.0); };
    animation.samplers.push_back(
        {Interpolation::step, 1, {0.0F, at_frame(52), at_frame(54)}, {0.0F, 7.0F, 0.0F}});
    animation.channels.push_back({Property::material_emission_strength, 0, 0});
    animation.duration_s = at_frame(200);
    scene.animations.push_back(animation);
    scene.frames = {1, 200, 24.0};
    EXPECT_NEAR(peak_radiance(scene, 0)[0].r, 14.0F, 1e-3F);
}

TEST(Emitters, AMaterialThatIsLitLaterIsKept) {
    Emitting e;
    for (Material& material : e.scene.materials) material.emission_strength = 0.0F;
    EXPECT_TRUE(Emitters(e.scene, e.parts).empty());
    Animation animation;
    animation.samplers.push_back({Interpolation::linear, 1, {0.0F}, {1.0F}});
    animation.channels.push_back({Property::material_emission_strength, 1, 0});
    e.scene.animations.push_back(animation);
    EXPECT_FALSE(Emitters(e.scene, e.parts).empty());
    e.scene.materials[1].unlit = true;
    EXPECT_TRUE(Emitters(e.scene, e.parts).empty()) << "it is shown as it is and sends nothing";
}

// Left half black, right half red: all samples of the square lie on the right, and say red.
TEST(Emitters, TexturesDecideWhereTheyLie) {
    Scene scene;
    Primitive p;
    for (int x = 0; x <= 8; ++x) {
        for (const float y : {0.0F, 1.0F}) {
            p.positions.emplace_back(static_cast<float>(x) / 8.0F, y, 0.0F);
            p.uv0.emplace_back(static_cast<float>(x) / 8.0F, y);
        }
    }
    for (uint32_t x = 0; x < 8; ++x) {
        const uint32_t i = 2 * x;
        p.indices.insert(p.indices.end(), {i, i + 2, i + 3, i, i + 3, i + 1});
    }
    p.material = 0;
    scene.materials.resize(1);
    scene.materials[0].emission = glm::vec3(1.0F);
    scene.materials[0].emission_texture.texture = 0;
    scene.textures.resize(1);
    scene.textures[0].image = 0;
    scene.textures[0].sampler.wrap_u = scene.textures[0].sampler.wrap_v = Wrap::clamp_to_edge;
    Image image;
    image.width = 64;
    image.height = 1;
    for (int x = 0; x < 64; ++x) {
        const auto red = static_cast<uint8_t>(x < 32 ? 0 : 255);
        image.rgba8.insert(image.rgba8.end(), {red, uint8_t{0}, uint8_t{0}, uint8_t{255}});
    }
    scene.images.push_back(image);
    place_mesh(scene, add_mesh(scene, p));
    const SurfaceParts parts = surface_parts(scene, k_none);
    const std::vector<glm::vec3> radiance{glm::vec3(1.0F)};
    const auto samples = Emitters(scene, parts).sample(radiance, {true}, 128);
    ASSERT_EQ(samples.size(), 128U);
    size_t left = 0;
    for (const EmitterSample& s : samples) {
        const auto c = corners(scene, parts, s.point.surface, s.point.triangle);
        const double x = c[0].x + (c[1].x - c[0].x) * s.point.second + (c[2].x - c[0].x) * s.point.third;
        left += x < 0.45 ? 1 : 0;
        if (x > 0.6) {
            EXPECT_NEAR(s.texture.r, 1.0F, 1e-3F);
            EXPECT_NEAR(s.texture.g, 0.0F, 1e-6F);
        }
    }
    EXPECT_EQ(left, 0U);
}

}  // namespace
}  // namespace bounce::scene::test
