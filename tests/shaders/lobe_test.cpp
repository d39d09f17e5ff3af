// SPDX-License-Identifier: Apache-2.0
//
// Lobes of flat lights against sums over the lights in doubles.
#include <algorithm>

#include "gpu/environment_brdf.h"
#include "gpu/lobe_table.h"
#include "shader_harness.h"

namespace bounce::test {
namespace {

struct Material {
    double roughness = 0.5;
    double metallic = 1.0;
    double specular = 0.5;
    double base = 1.0;
};

struct Flat {
    glm::dvec3 middle;
    glm::dvec3 x;
    glm::dvec3 y;
    bool round = false;
};

glm::dvec3 at_angle(double degrees, double around = 0.0) {
    const double t = degrees * pi / 180.0;
    return {std::sin(t) * std::cos(around), std::sin(t) * std::sin(around), std::cos(t)};
}

// Exact Fresnel reflectance over that at normal incidence, as a part of the way to 1.
double rise(double cosine, double eta) {
    const auto reflectance = [&](double c) {
        const double g = std::sqrt(eta * eta - 1.0 + c * c);
        const double a = (g - c) / (g + c);
        const double b = (c * (g + c) - 1.0) / (c * (g - c) + 1.0);
        return 0.5 * a * a * (1.0 + b * b);
    };
    return (reflectance(cosine) - reflectance(1.0)) / (1.0 - reflectance(1.0));
}

double law(const Material& m, const glm::dvec3& v, const glm::dvec3& l) {
    if (l.z <= 0.0) {
        return 0.0;
    }
    // The view's azimuth is turned to where gpu/lobe_fit.h has it.
    const double r = std::hypot(v.x, v.y);
    const glm::dvec2 x = r > 0.0 ? glm::dvec2(-v.x, -v.y) / r : glm::dvec2(1.0, 0.0);
    const glm::dvec3 local(l.x * x.x + l.y * x.y, l.y * x.x - l.x * x.y, l.z);
    const glm::dvec3 h = glm::normalize(l + v);
    const double f0 = m.metallic * m.base + (1.0 - m.metallic) * 0.08 * m.specular;
    const double root = std::sqrt(0.08 * m.specular);
    const double f = f0 + (1.0 - f0) * rise(glm::dot(h, v), (1.0 + root) / (1.0 - root));
    return f * gpu::ggx_times_cosine(v.z, m.roughness, local);
}

// What the lobe reflects of the light: over pieces of the light and over directions that the lobe spreads,
// side x side of each, weighed by the sum of both densities (Veach and Guibas 1995). Good to 1e-3 of the
// lobe's albedo.
double reflected_sum(const Material& m, const glm::dvec3& v, const Flat& light, int side) {
    const glm::dvec3 normal = glm::cross(light.x, light.y);
    const double area = (light.round ? pi : 4.0) * glm::length(normal);
    const double alpha = std::max(m.roughness * m.roughness, gpu::k_least_alpha);
    const auto lobe_density = [&](const glm::dvec3& l) {
        const glm::dvec3 h = glm::normalize(l + v);
        const double t = h.z * h.z * alpha * alpha + h.x * h.x + h.y * h.y;
        return alpha * alpha / (pi * t * t) * std::max(h.z, 0.0) / (4.0 * glm::dot(h, v));
    };
    double sum = 0.0;
    for (int i = 0; i < side; ++i) {
        for (int j = 0; j < side; ++j) {
            const glm::dvec2 u((i + 0.5) / side, (j + 0.5) / side);
            const double radius = std::sqrt(u.x);
            const glm::dvec2 at =
                light.round ? radius * glm::dvec2(std::cos(2.0 * pi * u.y), std::sin(2.0 * pi * u.y))
                            : 2.0 * u - 1.0;
            const glm::dvec3 d = light.middle + at.x * light.x + at.y * light.y;
            const double squared = glm::dot(d, d);
            const glm::dvec3 l = d / std::sqrt(squared);
            const double light_density = squared / (area * std::abs(glm::dot(glm::normalize(normal), l)));
            sum += law(m, v, l) / (light_density + lobe_density(l));

            const double cos2 = (1.0 - u.x) / (1.0 + (alpha * alpha - 1.0) * u.x);
            const double sine = std::sqrt(u.x * alpha * alpha / (1.0 + (alpha * alpha - 1.0) * u.x));
            const glm::dvec3 h(sine * std::cos(2.0 * pi * u.y), sine * std::sin(2.0 * pi * u.y),
                               std::sqrt(cos2));
            const glm::dvec3 r = 2.0 * glm::dot(h, v) * h - v;
            const double t = glm::dot(normal, light.middle) / glm::dot(normal, r);
            const glm::dvec3 hit = t * r - light.middle;
            const glm::dvec2 on(glm::dot(hit, light.x) / glm::dot(light.x, light.x),
                                glm::dot(hit, light.y) / glm::dot(light.y, light.y));
            const bool inside =
                light.round ? glm::length(on) < 1.0 : std::abs(on.x) < 1.0 && std::abs(on.y) < 1.0;
            if (t > 0.0 && inside && glm::dot(h, v) > 0.0) {
                const double there = t * t / (area * std::abs(glm::dot(glm::normalize(normal), r)));
                sum += law(m, v, r) / (there + lobe_density(r));
            }
        }
    }
    return sum / (static_cast<double>(side) * side);
}

class LobeGlsl : public ShaderTest {
  protected:
    struct Case {
        Material material;
        glm::dvec3 v;
        Flat light;
    };
    struct Found {
        double radiance;
        double share;
        glm::dvec3 toward;
    };
    static std::vector<Found> shaded(const std::vector<Case>& cases) {
        const gpu::LobeTable table;
        table.bind();
        std::vector<glm::vec4> in;
        for (const Case& c : cases) {
            in.emplace_back(glm::dvec4(glm::dvec3(c.material.base), c.material.roughness));
            in.emplace_back(
                glm::dvec4(c.material.metallic, c.material.specular, c.light.round ? 1.0 : 0.0, 0.0));
            in.emplace_back(glm::dvec4(c.v, 0.0));
            in.emplace_back(glm::dvec4(c.light.middle, 0.0));
            in.emplace_back(glm::dvec4(c.light.x, 0.0));
            in.emplace_back(glm::dvec4(c.light.y, 0.0));
        }
        const std::vector<glm::vec4> out = run("lobe.comp", 6, 2, in);
        std::vector<Found> found;
        for (size_t i = 0; i < cases.size(); ++i) {
            found.push_back({static_cast<double>(out[2 * i].x), static_cast<double>(out[2 * i].w),
                             glm::dvec3(out[2 * i + 1])});
        }
        return found;
    }
    // A light at distance 1 in a direction, turned towards the receiver, of half extents.
    static Flat facing(const glm::dvec3& l, double half_x, double half_y, bool round) {
        const glm::dvec3 x = glm::normalize(
            glm::cross(l, std::abs(l.z) < 0.9 ? glm::dvec3(0.0, 0.0, 1.0) : glm::dvec3(1.0, 0.0, 0.0)));
        return {l, half_x * x, half_y * glm::cross(l, x), round};
    }
};

TEST_F(LobeGlsl, StoredFitsAreWhatTheFitterFinds) {
    // The simplex stops within 1e-9 of the least error, where the widths have moved by less than 1e-3 and the
    // file's digits end at 1e-4.
    for (const int row : {0, 1, 5, 10, 16, 23, 31}) {
        for (const int column : {0, 9, 20, 30}) {
            const double cosine = gpu::lobe_column_cosine(column);
            const double roughness = gpu::lobe_row_roughness(row);
            // From elsewhere than fit_lobes starts.
            const gpu::LobeFit fit = gpu::fit_lobe(cosine, roughness, {1.5, 1.5 * cosine + 0.1, 0.0}).fit;
            const gpu::LobeFit stored = gpu::stored_lobe(column, row);
            EXPECT_NEAR(stored.in_plane, fit.in_plane, 4e-3) << row << ' ' << column;
            EXPECT_NEAR(stored.across, fit.across, 4e-3) << row << ' ' << column;
            EXPECT_NEAR(stored.sin_shift, fit.sin_shift, 1e-3) << row << ' ' << column;
        }
    }
}

TEST_F(LobeGlsl, AFitIsADensityAndNearItsLobe) {
    // (f - g)^2 / (f + g), integrated: 0.01 is a difference of a tenth all over. Lobes that graze are no
    // cosines.
    const gpu::FittedLobe above = gpu::fit_lobe(std::cos(0.5), 0.4, {2.0, 2.0, 0.0});
    EXPECT_LT(above.error, 0.012);
    EXPECT_LT(gpu::fit_lobe(1.0, 0.1, {2.0, 2.0, 0.0}).error, 1e-4);
    EXPECT_LT(gpu::fit_lobe(std::cos(1.3), 1.0, {2.0, 2.0, 0.0}).error, 1e-3);
    double sum = 0.0;
    constexpr int rings = 600;
    for (int i = 0; i < rings; ++i) {
        for (int j = 0; j < rings; ++j) {
            const double z = (i + 0.5) / rings;
            const double phi = 2.0 * pi * (j + 0.5) / rings;
            const double r = std::sqrt(1.0 - z * z);
            sum +=
                gpu::lobe_density(above.fit, std::cos(0.5), 0.4, {r * std::cos(phi), r * std::sin(phi), z});
        }
    }
    EXPECT_NEAR(sum * 2.0 * pi / (rings * rings), 1.0, 1e-3);
}

// Differences as parts of what the lobe reflects of an even world, which is what a picture shows them
// against.
TEST_F(LobeGlsl, FlatLightsAgainstSumsOverThem) {
    for (const double metallic : {1.0, 0.0}) {
        std::vector<Case> cases;
        for (const double roughness : {0.1, 0.3, 0.5, 0.75, 1.0}) {
            for (const double view : {0.0, 40.0, 65.0, 80.0}) {
                for (const double size : {0.02, 0.1, 0.4, 1.5}) {
                    for (const double off : {0.0, 10.0, 25.0, -60.0}) {
                        const bool round = off == 10.0 || off == -60.0;
                        cases.push_back(
                            {{.roughness = roughness, .metallic = metallic},
                             at_angle(view),
                             facing(at_angle(-view - off, 0.1), size, round ? 0.3 * size : size, round)});
                    }
                }
            }
        }
        const std::vector<Found> found = shaded(cases);
        double mean = 0.0;
        for (size_t i = 0; i < cases.size(); ++i) {
            const Case& c = cases[i];
            const glm::dvec2 part = gpu::environment_brdf(c.v.z, c.material.roughness);
            const double albedo = (metallic > 0.0 ? 1.0 : 0.04) * part.x + part.y;
            const double off = (found[i].radiance - reflected_sum(c.material, c.v, c.light, 120)) / albedo;
            mean += std::abs(off) / static_cast<double>(cases.size());
            // Measured: metals 0.055 and 0.0036, dielectrics 0.125 and 0.0082. Worst are views of 80 degrees
            // and lights that stand on the horizon; a dielectric's reflectance rises there, which the fit
            // does not know.
            EXPECT_LT(std::abs(off), metallic > 0.0 ? 0.07 : 0.15)
                << "roughness " << c.material.roughness << ", view " << std::acos(c.v.z) * 180.0 / pi
                << " degrees, light " << glm::length(c.light.x) << " towards " << c.light.middle.x << ' '
                << c.light.middle.z;
        }
        EXPECT_LT(mean, metallic > 0.0 ? 0.005 : 0.01);
    }
}

TEST_F(LobeGlsl, SmallDisksAreTheLightsTheyWereWithoutASize) {
    // Half angles from a millionth of a degree to sixty. Where the light has become a polygon, what its fit
    // has wrong shows (measured: 2.9 % at roughness 0.5). Below, floats: 1e-4.
    for (const double roughness : {0.2, 0.5, 1.0}) {
        std::vector<Case> cases;
        std::vector<double> tangents;
        for (double tangent = 1e-8; tangent < 1.8; tangent *= 1.5) {
            tangents.push_back(tangent);
            cases.push_back({{.roughness = roughness},
                             at_angle(30.0),
                             facing(at_angle(-33.0, 0.02), tangent, tangent, true)});
        }
        const std::vector<Found> found = shaded(cases);
        for (size_t i = 0; i < cases.size(); ++i) {
            const double size = tangents[i];
            const double want =
                size < 1e-5 ? law(cases[i].material, cases[i].v, cases[i].light.middle) * pi * size * size
                            : reflected_sum(cases[i].material, cases[i].v, cases[i].light, 120);
            EXPECT_NEAR(found[i].radiance / want, 1.0, size < 1e-4 ? 2e-4 : 0.035)
                << "roughness " << roughness << ", tangent " << size;
        }
    }
}

TEST_F(LobeGlsl, ALightAllOverTheSkyGivesTheLobesAlbedo) {
    std::vector<Case> cases;
    for (const double roughness : {0.0, 0.1, 0.4, 0.7, 1.0}) {
        for (const double view : {0.0, 30.0, 60.0, 80.0, 88.0}) {
            for (const double metallic : {0.0, 1.0}) {
                cases.push_back({{.roughness = roughness, .metallic = metallic},
                                 at_angle(view, 1.0),
                                 {{0.0, 0.0, 1.0}, {1e5, 0.0, 0.0}, {0.0, 1e5, 0.0}}});
            }
        }
    }
    const std::vector<Found> found = shaded(cases);
    for (size_t i = 0; i < cases.size(); ++i) {
        const Material& m = cases[i].material;
        const glm::dvec2 part = gpu::environment_brdf(cases[i].v.z, m.roughness);
        const double albedo = (m.metallic > 0.0 ? 1.0 : 0.04) * part.x + part.y;
        EXPECT_NEAR(found[i].share, 1.0, 1e-3);
        // Between the table's columns, where the reflectance of dielectrics rises steeply at last.
        EXPECT_NEAR(found[i].radiance / albedo, 1.0, cases[i].v.z < 0.1 ? 0.07 : 0.02)
            << "roughness " << m.roughness << ", view " << cases[i].v.z << ", metallic " << m.metallic;
    }
}

TEST_F(LobeGlsl, NothingComesFromUnderTheHorizonAndNumbersStayFinite) {
    std::vector<Case> cases;
    for (const double roughness : {0.0, 0.03, 0.5, 1.0}) {
        for (const double view : {0.0, 1e-4, 60.0, 89.9, 90.0, 95.0}) {
            for (const double size : {0.0, 1e-20, 1e-7, 0.3, 1e5}) {
                for (const double light : {0.0, -60.0, -90.0, 90.0}) {
                    cases.push_back({{.roughness = roughness},
                                     at_angle(view),
                                     facing(at_angle(light), size, size, view == 60.0)});
                }
                cases.push_back({{.roughness = roughness},
                                 at_angle(view),
                                 {{0.0, 0.0, 0.0}, {size, 0.0, 0.0}, {0.0, size, 0.0}}});
            }
        }
    }
    const size_t finite = cases.size();
    for (const double view : {0.0, 45.0, 85.0}) {
        cases.push_back({{}, at_angle(view), {{0.2, 0.0, -0.5}, {3.0, 0.0, 0.1}, {0.0, 3.0, 0.0}, true}});
        cases.push_back({{}, at_angle(view), facing(at_angle(120.0), 0.4, 0.4, false)});
    }
    const std::vector<Found> found = shaded(cases);
    for (size_t i = 0; i < cases.size(); ++i) {
        EXPECT_TRUE(std::isfinite(found[i].radiance)) << i;
        EXPECT_TRUE(std::isfinite(glm::dot(found[i].toward, found[i].toward))) << i;
        EXPECT_GE(found[i].radiance, 0.0) << i;
        EXPECT_LE(found[i].radiance, 1.2) << i;
        if (i >= finite) {
            EXPECT_EQ(found[i].radiance, 0.0) << i;
        }
    }
}

}  // namespace
}  // namespace bounce::test
