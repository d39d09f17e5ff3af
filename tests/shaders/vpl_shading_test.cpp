// SPDX-License-Identifier: Apache-2.0
//
// Virtual point lights and their receivers: few instructions against the whole functions of lib/brdf.glsl.
#include "shader_harness.h"

namespace bounce::test {
namespace {

struct Material {
    glm::vec3 color{1.0F};
    double roughness = 0.5;
    double metallic = 0.0;
    double specular = 0.0;
    bool disney = false;
};

struct Reflected {
    glm::dvec3 light, light_exact;        // BRDF
    glm::dvec3 receiver, receiver_exact;  // times the cosine
};

class VplShading : public ShaderTest {
  protected:
    using Pair = std::pair<glm::dvec3, glm::dvec3>;

    static glm::dvec3 at_angle(double degrees, double around = 0.0) {
        const double t = degrees * pi / 180.0;
        return {std::sin(t) * std::cos(around), std::sin(t) * std::sin(around), std::cos(t)};
    }
    static std::vector<Pair> pairs() {
        std::vector<Pair> out;
        for (const double a : {0.0, 20.0, 45.0, 70.0, 85.0}) {
            for (const double b : {0.0, 20.0, 45.0, 70.0, 85.0}) {
                for (const double around : {0.0, 1.0, 2.5, pi}) {
                    out.emplace_back(at_angle(a), at_angle(b, around));
                }
            }
        }
        return out;
    }
    static std::vector<Reflected> reflect(const Material& m, const std::vector<Pair>& directions,
                                          const gl::Defines& defines) {
        std::vector<glm::vec4> in;
        for (const auto& [l, v] : directions) {
            in.emplace_back(m.color, static_cast<float>(m.roughness));
            in.emplace_back(glm::dvec4(m.metallic, m.specular, m.disney ? 1.0 : 0.0, 1.0));
            in.emplace_back(glm::vec3(l), 0.0F);
            in.emplace_back(glm::vec3(v), 0.0F);
        }
        const std::vector<glm::vec4> out = run("vpl_shading.comp", 4, 6, in, defines);
        std::vector<Reflected> reflected;
        for (size_t i = 0; i < out.size(); i += 6) {
            const auto rgb = [&](size_t k) { return glm::dvec3(glm::vec3(out[i + k])); };
            reflected.push_back({rgb(0), rgb(1), rgb(2), rgb(3)});
        }
        return reflected;
    }
    static void expect_same(const Material& m, const gl::Defines& defines, double tolerance) {
        const std::vector<Pair> directions = pairs();
        const std::vector<Reflected> all = reflect(m, directions, defines);
        for (size_t i = 0; i < all.size(); ++i) {
            for (int c = 0; c < 3; ++c) {
                EXPECT_GT(all[i].light_exact[c], 0.0);
                EXPECT_NEAR(all[i].light[c] / all[i].light_exact[c], 1.0, tolerance)
                    << "light, pair " << i << ", roughness " << m.roughness;
                EXPECT_NEAR(all[i].receiver[c] / all[i].receiver_exact[c], 1.0, tolerance)
                    << "receiver, pair " << i << ", roughness " << m.roughness;
            }
        }
    }
};

const gl::Defines k_disney = {{"DISNEY", "1"}};
const gl::Defines k_glossy = {{"GLOSSY", "1"}};
const gl::Defines k_both = {{"DISNEY", "1"}, {"GLOSSY", "1"}};

TEST_F(VplShading, Lambert) {
    // By hand: albedo / pi, whatever the directions and whatever else is compiled in.
    for (const gl::Defines& defines : {gl::Defines{}, k_disney, k_both}) {
        for (const Reflected& r :
             reflect({.color = {0.8F, 0.4F, 0.1F}, .roughness = 0.9}, pairs(), defines)) {
            EXPECT_NEAR(r.light.x, 0.8 / pi, 1e-6);
            EXPECT_NEAR(r.light.z, 0.1 / pi, 1e-6);
        }
        expect_same({.color = {0.8F, 0.4F, 0.1F}, .roughness = 0.0}, defines, 1e-5);
    }
}

TEST_F(VplShading, PartOfTheLightIsLostToMetal) {
    const std::vector<Reflected> metal = reflect({.metallic = 0.25}, pairs(), {});
    for (const Reflected& r : metal) {
        EXPECT_NEAR(r.light.x, 0.75 / pi, 1e-6);
    }
}

TEST_F(VplShading, DisneyIsTheWholeLobe) {
    for (const double roughness : {0.01, 0.3, 0.5, 1.0}) {
        for (const gl::Defines& defines : {k_disney, k_both}) {
            expect_same({.color = {0.8F, 0.4F, 0.1F}, .roughness = roughness, .disney = true}, defines, 1e-4);
        }
    }
    // Without roughness it is still Disney's: dark at grazing angles.
    const std::vector<Reflected> smooth =
        reflect({.roughness = 0.0, .disney = true}, {{at_angle(80.0), at_angle(0.0)}}, k_disney);
    EXPECT_NEAR(smooth[0].light.x * pi, 0.807, 2e-3) << "as measured in Cycles";
    EXPECT_NEAR(smooth[0].receiver.x * pi / std::cos(80.0 * pi / 180.0), 0.807, 2e-3);
}

TEST_F(VplShading, GgxIsTheWholeLobe) {
    // A white metal: reflectance is 1 from every side, so that only distribution and masking count.
    for (const double roughness : {0.25, 0.4, 0.7, 1.0}) {
        expect_same({.roughness = roughness, .metallic = 1.0}, k_glossy, 3e-3);
        expect_same({.roughness = roughness, .metallic = 1.0, .disney = true}, k_both, 3e-3);
    }
}

TEST_F(VplShading, NarrowLobesAreAsWideAsPointLightsAllow) {
    const std::vector<Reflected> least =
        reflect({.roughness = std::sqrt(0.05), .metallic = 1.0}, pairs(), k_glossy);
    for (const double roughness : {0.0, 0.1, 0.22}) {
        const std::vector<Reflected> narrow =
            reflect({.roughness = roughness, .metallic = 1.0}, pairs(), k_glossy);
        for (size_t i = 0; i < least.size(); ++i) {
            EXPECT_NEAR(narrow[i].light.x / least[i].light.x, 1.0, 1e-3);
            EXPECT_NEAR(narrow[i].receiver.x / least[i].receiver.x, 1.0, 1e-3);
        }
    }
}

TEST_F(VplShading, DielectricsRiseAsFresnelSays) {
    // The fit against Fresnel's own rise from normal to grazing incidence for F0 = 0.04: at its ends exact,
    // in between within 0.02 (Schlick's curve: 0.037), and within 0.5 % in the mean over the hemisphere.
    std::vector<glm::vec4> in;
    for (int i = 0; i <= 100; ++i) {
        in.emplace_back(1.0F);
        in.emplace_back(glm::dvec4(0.0, 0.5, 0.0, -1.0 + 0.02 * i));
        in.emplace_back(0.0F, 0.0F, 1.0F, 0.0F);
        in.emplace_back(0.0F, 0.0F, 1.0F, 0.0F);
    }
    const std::vector<glm::vec4> out = run("vpl_shading.comp", 4, 6, in, k_glossy);
    double fitted = 0.0;
    double exact = 0.0;
    for (size_t i = 0; i <= 100; ++i) {
        const glm::vec4 rise = out[6 * i + 4];
        EXPECT_NEAR(rise.x, rise.y, 0.02F) << i;
        // cos dcos is a quarter of the step of the cosine between the two directions.
        fitted += static_cast<double>(rise.x) * (i % 100 == 0 ? 0.5 : 1.0);
        exact += static_cast<double>(rise.y) * (i % 100 == 0 ? 0.5 : 1.0);
    }
    EXPECT_NEAR(fitted / exact, 1.0, 0.005);
    EXPECT_EQ(out[4].x, 1.0F) << "grazing";
    EXPECT_EQ(out[6 * 100 + 4].x, 0.0F) << "along the normal";
}

TEST_F(VplShading, DielectricsAndCoatedMetals) {
    // With one curve for Fresnel's at all indices the sum of both lobes is within 16 % of the whole
    // functions': so far only where both directions graze; exact where nothing rises.
    for (const double specular : {0.25, 0.5, 1.0}) {
        for (const double metallic : {0.0, 0.5, 1.0}) {
            const Material m{{0.7F, 0.4F, 0.2F}, 0.5, metallic, specular, false};
            expect_same(m, k_glossy, 0.16);
            const Reflected straight = reflect(m, {{at_angle(0.0), at_angle(0.0)}}, k_glossy)[0];
            EXPECT_NEAR(straight.light.x / straight.light_exact.x, 1.0, 1e-4);
            EXPECT_NEAR(straight.receiver.y / straight.receiver_exact.y, 1.0, 1e-4);
        }
    }
}

TEST_F(VplShading, NoSpecularNoRise) {
    const Material m{{0.7F, 0.4F, 0.2F}, 0.5, 0.0, 0.0, false};
    for (const Reflected& r : reflect(m, {{at_angle(88.0), at_angle(88.0, pi)}}, k_glossy)) {
        EXPECT_NEAR(r.light.x, static_cast<double>(0.7F) / pi, 1e-6);
        EXPECT_NEAR(r.receiver.x, static_cast<double>(0.7F) / pi * std::cos(88.0 * pi / 180.0), 1e-6);
    }
}

TEST_F(VplShading, LightsAndReceiversAreReciprocal) {
    for (const Material& m : {Material{{0.9F, 0.5F, 0.1F}, 0.4, 0.0, 0.5, true},
                              {{0.9F, 0.5F, 0.1F}, 0.3, 1.0, 0.5, false},
                              {{0.9F, 0.5F, 0.1F}, 0.8, 0.5, 1.0, true}}) {
        std::vector<Pair> there = pairs();
        std::vector<Pair> back;
        for (const auto& [l, v] : there) {
            back.emplace_back(v, l);
        }
        const std::vector<Reflected> a = reflect(m, there, k_both);
        const std::vector<Reflected> b = reflect(m, back, k_both);
        for (size_t i = 0; i < a.size(); ++i) {
            for (int c = 0; c < 3; ++c) {
                EXPECT_NEAR(a[i].light[c] / b[i].light[c], 1.0, 1e-4) << i;
                // A receiver sees what a light sends out.
                EXPECT_NEAR(a[i].receiver[c] / there[i].first.z / a[i].light[c], 1.0, 1e-4) << i;
            }
        }
    }
}

TEST_F(VplShading, NearShareTakesTheSingularityAway) {
    std::vector<glm::vec4> in;
    for (int i = 0; i <= 200; ++i) {
        const double d = i * 0.01;
        in.emplace_back(glm::dvec4(d * d, 1.0 / 0.25, 0.0, 0.0));  // radius 0.5
        in.emplace_back(0.0F);
        in.emplace_back(0.0F);
    }
    const std::vector<glm::vec4> out = run("near_share.comp", 3, 1, in);
    EXPECT_EQ(out[0].x, 1.0F) << "at the light all of it is near";
    float before = 1.0F;
    for (size_t i = 0; i <= 200; ++i) {
        const double d = 0.01 * static_cast<double>(i);
        EXPECT_LE(out[i].x, before) << "falls";
        before = out[i].x;
        const double share = d < 0.5 ? std::pow(1.0 - d * d / 0.25, 2.0) : 0.0;
        EXPECT_NEAR(out[i].x, share, 1e-5) << d;
        if (i > 5) {
            // The far field's kernel stays below that of the near radius, 2 / r^2.
            EXPECT_LE((1.0 - static_cast<double>(out[i].x)) / (d * d), 2.0 / 0.25 * (1.0 + 1e-3)) << d;
        }
    }
    EXPECT_EQ(out[50].x, 0.0F) << "at its radius it ends";
    EXPECT_GT(out[49].x, 0.0F);
    EXPECT_LT(out[49].x - out[50].x, 0.002F) << "without an edge";
}

TEST_F(VplShading, ImportanceIsTheLuminanceReflected) {
    const std::vector<glm::vec4> in = {
        {0, 1, 0, 0}, {1, 1, 1, 0},        {2, 2, 2, 0},      // white under white
        {0, 1, 0, 0}, {0.5F, 0.25F, 0, 0}, {1, 4, 100, 0},    // coloured under coloured
        {0, 1, 0, 0}, {1, 1, 1, 0},        {2, 2, 2, 0.75F},  // mostly metal
        {0, 1, 0, 0}, {-1, -1, -1, 0},     {2, 2, 2, 0},      // never below 0
    };
    const std::vector<glm::vec4> diffuse = run("near_share.comp", 3, 1, in);
    EXPECT_NEAR(diffuse[0].y, 2.0F, 1e-5F);
    EXPECT_NEAR(diffuse[1].y, 0.2126F * 0.5F + 0.7152F, 1e-5F);
    EXPECT_NEAR(diffuse[2].y, 0.5F, 1e-5F);
    EXPECT_EQ(diffuse[3].y, 0.0F);
    const std::vector<glm::vec4> glossy = run("near_share.comp", 3, 1, in, k_glossy);
    EXPECT_NEAR(glossy[2].y, 2.0F, 1e-5F) << "with glossy lobes metal reflects as well";
}

}  // namespace
}  // namespace bounce::test
