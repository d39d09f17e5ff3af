// SPDX-License-Identifier: Apache-2.0
#include <algorithm>

#include "shader_harness.h"

namespace bounce::test {
namespace {

class BrdfGlsl : public ShaderTest {
  protected:
    struct Value {
        double disney, fresnel;
    };
    static Value diffuse_fresnel(const glm::vec4& disney, double cos_i, double eta) {
        const glm::vec4 out =
            run("diffuse_fresnel.comp", 2, 1, {disney, glm::vec4(glm::dvec4(cos_i, eta, 0.0, 0.0))})[0];
        return {out.x, out.y};
    }
    struct Material {
        glm::vec3 base_color{1.0F};
        double roughness = 0.5;
        double metallic = 1.0;
        double specular = 0.5;
    };
    static void add(std::vector<glm::vec4>& in, const Material& m, const glm::dvec3& l, const glm::dvec3& v) {
        in.emplace_back(m.base_color, static_cast<float>(m.roughness));
        in.emplace_back(glm::dvec4(m.metallic, m.specular, 0.0, 0.0));
        in.emplace_back(glm::vec3(l), 0.0F);
        in.emplace_back(glm::vec3(v), 0.0F);
    }
    static glm::dvec3 at_angle(double degrees, double around = 0.0) {
        const double t = degrees * pi / 180.0;
        return {std::sin(t) * std::cos(around), std::sin(t) * std::sin(around), std::cos(t)};
    }
    // Share of the light that a surface reflects towards anywhere: the integral of BRDF times cosine over l,
    // for a viewer at v. Half vectors are drawn as GGX spreads them, on a regular grid.
    static double albedo(const Material& m, const glm::dvec3& v) {
        constexpr int rings = 400;
        constexpr int around = 128;
        const double alpha = std::max(m.roughness * m.roughness, 1e-3);
        std::vector<glm::vec4> in;
        std::vector<double> densities;
        for (int i = 0; i < rings; ++i) {
            const double u = (i + 0.5) / rings;
            const double cos_h = std::sqrt((1.0 - u) / (1.0 + (alpha * alpha - 1.0) * u));
            const double sin_h = std::sqrt(1.0 - cos_h * cos_h);
            for (int j = 0; j < around; ++j) {
                const double phi = 2.0 * pi * (j + 0.5) / around;
                const glm::dvec3 h(sin_h * std::cos(phi), sin_h * std::sin(phi), cos_h);
                const glm::dvec3 l = 2.0 * glm::dot(h, v) * h - v;
                if (l.z <= 0.0 || glm::dot(h, v) <= 0.0) {
                    continue;  // light from below: nothing reflects there
                }
                const double t = 1.0 + cos_h * cos_h * (alpha * alpha - 1.0);
                const double distribution = alpha * alpha / (pi * t * t);
                densities.push_back(distribution * cos_h / (4.0 * glm::dot(h, v)));
                add(in, m, l, v);
            }
        }
        const std::vector<glm::vec4> out = run("brdf.comp", 4, 1, in);
        double sum = 0.0;
        for (size_t i = 0; i < out.size(); ++i) {
            EXPECT_TRUE(std::isfinite(out[i].x));
            EXPECT_GE(out[i].x, 0.0F);
            sum += static_cast<double>(out[i].x) / densities[i];
        }
        return sum / (rings * around);
    }
};

TEST_F(BrdfGlsl, DisneyDiffuseAsMeasuredInCycles) {
    // Blender 3.4's Principled BSDF, specular 0, seen from straight above, light at an angle; factor over
    // Lambert, measured to three digits.
    const double roughness[] = {0.0, 0.5, 0.9, 1.0};
    const double degrees[] = {0.0, 30.0, 60.0, 80.0};
    const double measured[4][4] = {
        {1, 1, .984, .807}, {1, 1, 1.008, 1.034}, {1, 1, 1.027, 1.214}, {1, 1, 1.031, 1.260}};
    for (size_t i = 0; i < 4; ++i) {
        for (size_t j = 0; j < 4; ++j) {
            const double c = std::cos(degrees[j] * pi / 180.0);
            const double factor =
                diffuse_fresnel(glm::vec4(glm::dvec4(c, 1.0, c, roughness[i])), 1.0, 1.5).disney;
            EXPECT_NEAR(factor, measured[i][j], 2e-3)
                << "roughness " << roughness[i] << ", " << degrees[j] << " degrees";
        }
    }
}

TEST_F(BrdfGlsl, DisneyDiffuseIsReciprocal) {
    const double there = diffuse_fresnel(glm::vec4(0.2F, 0.7F, 0.4F, 0.8F), 1.0, 1.5).disney;
    const double back = diffuse_fresnel(glm::vec4(0.7F, 0.2F, 0.4F, 0.8F), 1.0, 1.5).disney;
    EXPECT_NEAR(there, back, 1e-6);
    EXPECT_GT(std::abs(there - 1.0), 0.05) << "a case that tells";
}

// Fresnel's equations by angles, as in any optics book.
double fresnel_by_angles(double cos_i, double eta) {
    const double i = std::acos(cos_i);
    const double t = std::asin(std::sin(i) / eta);
    const double s = (std::cos(i) - eta * std::cos(t)) / (std::cos(i) + eta * std::cos(t));
    const double p = (eta * std::cos(i) - std::cos(t)) / (eta * std::cos(i) + std::cos(t));
    return 0.5 * (s * s + p * p);
}

TEST_F(BrdfGlsl, DielectricFresnel) {
    const glm::vec4 any(1.0F, 1.0F, 1.0F, 0.5F);
    for (const double eta : {1.1, 1.5, 2.4}) {
        EXPECT_NEAR(diffuse_fresnel(any, 1.0, eta).fresnel, std::pow((eta - 1.0) / (eta + 1.0), 2.0), 1e-6)
            << eta;
        EXPECT_NEAR(diffuse_fresnel(any, 0.0, eta).fresnel, 1.0, 1e-6) << "grazing";
        for (const double cos_i : {0.05, 0.3, 0.5547, 0.8, 0.95}) {
            EXPECT_NEAR(diffuse_fresnel(any, cos_i, eta).fresnel, fresnel_by_angles(cos_i, eta), 1e-5)
                << eta << ' ' << cos_i;
        }
    }
    // From glass to air beyond the critical angle (41.8 degrees) everything is reflected.
    EXPECT_EQ(diffuse_fresnel(any, std::cos(50.0 * pi / 180.0), 1.0 / 1.5).fresnel, 1.0);
    EXPECT_LT(diffuse_fresnel(any, std::cos(30.0 * pi / 180.0), 1.0 / 1.5).fresnel, 0.2);
}

TEST_F(BrdfGlsl, AWhiteMetalNeverGivesBackMoreThanItGets) {
    for (const double roughness : {0.0, 0.1, 0.3, 0.6, 1.0}) {
        for (const double view : {0.0, 30.0, 60.0, 80.0, 88.0}) {
            const double share = albedo({.roughness = roughness}, at_angle(view));
            EXPECT_LE(share, 1.0 + 2e-3) << "roughness " << roughness << ", view at " << view;
            EXPECT_GE(share, 0.3) << "roughness " << roughness << ", view at " << view;
            if (roughness <= 0.1 && view <= 60.0) {
                EXPECT_GE(share, 0.99)
                    << "a mirror loses nothing; roughness " << roughness << ", view at " << view;
            }
        }
    }
}

TEST_F(BrdfGlsl, RoughMetalLosesWhatOneScatteringLoses) {
    // GGX with a white metal, masking towards light and viewer independent as in Cycles before 4.0, by
    // another integrator over another variable, from the published form of the masking (Walter et al. 2007,
    // eq. 23 and 34) in place of the shader's folded one.
    const auto reference = [](double alpha, double cos_v) {
        // Uniform over the hemisphere of l, midpoint rule, all in doubles.
        constexpr int steps = 1000;
        constexpr int around = 500;
        double sum = 0.0;
        const glm::dvec3 v(std::sqrt(1.0 - cos_v * cos_v), 0.0, cos_v);
        const auto lambda = [&](double c) {
            return 0.5 * (std::sqrt(1.0 + alpha * alpha * (1.0 / (c * c) - 1.0)) - 1.0);
        };
        for (int i = 0; i < steps; ++i) {
            const double z = (i + 0.5) / steps;
            for (int j = 0; j < around; ++j) {
                const double phi = pi * (j + 0.5) / around;  // symmetric about the plane of v
                const double r = std::sqrt(1.0 - z * z);
                const glm::dvec3 l(r * std::cos(phi), r * std::sin(phi), z);
                const glm::dvec3 h = glm::normalize(l + v);
                const double t = h.z * h.z * (alpha * alpha - 1.0) + 1.0;
                const double d = alpha * alpha / (pi * t * t);
                const double g = 1.0 / ((1.0 + lambda(cos_v)) * (1.0 + lambda(z)));
                sum += d * g / (4.0 * cos_v);
            }
        }
        return sum * 2.0 * pi / (steps * around);
    };
    for (const double roughness : {0.7, 1.0}) {
        for (const double view : {0.0, 60.0}) {
            EXPECT_NEAR(albedo({.roughness = roughness}, at_angle(view)),
                        reference(roughness * roughness, std::cos(view * pi / 180.0)), 3e-3)
                << roughness << ' ' << view;
        }
    }
}

TEST_F(BrdfGlsl, SpecularIsReciprocal) {
    std::vector<glm::vec4> in;
    std::vector<double> cosines;
    for (const double metallic : {0.0, 0.4, 1.0}) {
        for (const double roughness : {0.2, 0.5, 1.0}) {
            const Material m{{0.9F, 0.5F, 0.1F}, roughness, metallic, 0.5};
            const glm::dvec3 a = at_angle(20.0);
            const glm::dvec3 b = at_angle(65.0, 2.0);
            add(in, m, a, b);
            add(in, m, b, a);
            cosines.insert(cosines.end(), {a.z, b.z});
        }
    }
    const std::vector<glm::vec4> out = run("brdf.comp", 4, 1, in);
    for (size_t i = 0; i < out.size(); i += 2) {
        for (int channel = 0; channel < 3; ++channel) {
            const double there = static_cast<double>(out[i][channel]) / cosines[i];
            const double back = static_cast<double>(out[i + 1][channel]) / cosines[i + 1];
            EXPECT_GT(there, 0.0);
            EXPECT_NEAR(there / back, 1.0, 1e-4);
        }
    }
}

TEST_F(BrdfGlsl, MirrorReflectanceAtNormalIncidence) {
    // At roughness 1 along the normal, D is 1/pi and the masking 1/(4 l.n v.n): the value is F0 / (4 pi).
    std::vector<glm::vec4> in;
    const glm::dvec3 up(0.0, 0.0, 1.0);
    add(in, {{0.2F, 0.4F, 0.6F}, 1.0, 0.0, 0.5}, up, up);  // F0 = 0.04
    add(in, {{0.2F, 0.4F, 0.6F}, 1.0, 1.0, 0.5}, up, up);  // F0 = the base colour
    add(in, {{0.2F, 0.4F, 0.6F}, 1.0, 0.0, 0.0}, up, up);  // Specular 0: none
    add(in, {{0.2F, 0.4F, 0.6F}, 0.5, 0.0, 0.0}, at_angle(89.0), at_angle(89.0, pi));
    add(in, {{0.2F, 0.4F, 0.6F}, 0.5, 1.0, 0.5}, at_angle(100.0), up);  // light from below
    const std::vector<glm::vec4> out = run("brdf.comp", 4, 1, in);
    EXPECT_NEAR(out[0].x, 0.04 / (4.0 * pi), 1e-6);
    for (int channel = 0; channel < 3; ++channel) {
        EXPECT_NEAR(out[1][channel], 0.2 * (channel + 1) / (4.0 * pi), 1e-6);
    }
    EXPECT_EQ(glm::vec3(out[2]), glm::vec3(0.0F));
    EXPECT_EQ(glm::vec3(out[3]), glm::vec3(0.0F));
    EXPECT_EQ(glm::vec3(out[4]), glm::vec3(0.0F));
}

}  // namespace
}  // namespace bounce::test
