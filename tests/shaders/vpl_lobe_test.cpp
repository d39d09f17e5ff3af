// SPDX-License-Identifier: Apache-2.0
#include <algorithm>

#include "shader_harness.h"

namespace bounce::test {
namespace {

class VplLobeGlsl : public ShaderTest {
  protected:
    struct Values {
        double receiver = 0.0;
        double light = 0.0;
    };
    static void add(std::vector<glm::vec4>& in, double roughness, double widening, const glm::dvec3& l,
                    const glm::dvec3& v) {
        in.emplace_back(glm::dvec4(roughness, widening, 0.0, 0.0));
        in.emplace_back(glm::vec3(l), 0.0F);
        in.emplace_back(glm::vec3(v), 0.0F);
    }
    static glm::dvec3 at_angle(double degrees) {
        const double t = degrees * pi / 180.0;
        return {std::sin(t), 0.0, std::cos(t)};
    }
    // What is reflected of the same light from everywhere: the integral over the hemisphere of l, on a grid
    // of equal solid angles.
    static Values albedo(double roughness, double widening, const glm::dvec3& v) {
        constexpr int rings = 512;
        constexpr int around = 512;
        std::vector<glm::vec4> in;
        for (int i = 0; i < rings; ++i) {
            const double z = (i + 0.5) / rings;
            for (int j = 0; j < around; ++j) {
                const double phi = 2.0 * pi * (j + 0.5) / around;
                const double r = std::sqrt(1.0 - z * z);
                add(in, roughness, widening, {r * std::cos(phi), r * std::sin(phi), z}, v);
            }
        }
        Values sum;
        for (const glm::vec4& value : run("vpl_lobe.comp", 3, 1, in)) {
            sum.receiver += value.x;
            sum.light += value.y;
        }
        const double solid_angle = 2.0 * pi / (static_cast<double>(rings) * around);
        return {sum.receiver * solid_angle, sum.light * solid_angle};
    }
};

// D is 1 / (pi alpha^2) where h is the normal, and Smith's terms do not change with the widening. The lobe
// then gains what it would lose below the horizon, 1.2 of the widening.
TEST_F(VplLobeGlsl, WideningLowersThePeakByTheRatioOfAlphaSquared) {
    const double roughness = 0.4;
    const double alpha2 = std::pow(roughness, 4.0);
    for (const double widening : {0.01, 0.05}) {
        std::vector<glm::vec4> in;
        add(in, roughness, 0.0, at_angle(30.0), at_angle(-30.0));
        add(in, roughness, widening, at_angle(30.0), at_angle(-30.0));
        const std::vector<glm::vec4> out = run("vpl_lobe.comp", 3, 1, in);
        const double expected = (1.0 + 1.2 * widening) * alpha2 / (alpha2 + widening);
        EXPECT_NEAR(out[1].x / out[0].x, expected, 1e-4 * expected) << "receiver, widening " << widening;
        EXPECT_NEAR(out[1].y / out[0].y, expected, 1e-4 * expected) << "light, widening " << widening;
    }
}

// A lobe that is spread out reflects as much in all. Without the gain it loses 3 % here.
TEST_F(VplLobeGlsl, WideningKeepsTheEnergy) {
    for (const double degrees : {0.0, 40.0}) {
        const Values narrow = albedo(0.4, 0.0, at_angle(degrees));
        // Single scattering loses something at any roughness, but no more than this at 0.4.
        EXPECT_NEAR(narrow.receiver, 0.96, 0.01) << degrees;
        EXPECT_NEAR(narrow.light, 0.96, 0.01) << degrees;
        const Values wide = albedo(0.4, 0.03, at_angle(degrees));
        EXPECT_NEAR(wide.receiver, narrow.receiver, 0.006) << degrees;
        EXPECT_NEAR(wide.light, narrow.light, 0.006) << degrees;
    }
}

}  // namespace
}  // namespace bounce::test
