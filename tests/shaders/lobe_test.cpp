// SPDX-License-Identifier: Apache-2.0
//
// Lobes of flat lights against sums over the lights in doubles.
#include <algorithm>
#include <cstdio>

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

// Over `side` x `side` pieces of the light.
double reflected_sum(const Material& m, const glm::dvec3& v, const Flat& light, int side) {
    double sum = 0.0;
    const glm::dvec3 normal = glm::cross(light.x, light.y);
    for (int i = 0; i < side; ++i) {
        for (int j = 0; j < side; ++j) {
            glm::dvec2 u((i + 0.5) / side, (j + 0.5) / side);
            const double radius = std::sqrt(u.x);
            u = light.round ? radius * glm::dvec2(std::cos(2.0 * pi * u.y), std::sin(2.0 * pi * u.y))
                            : 2.0 * u - 1.0;
            const glm::dvec3 d = light.middle + u.x * light.x + u.y * light.y;
            const double squared = glm::dot(d, d);
            const glm::dvec3 l = d / std::sqrt(squared);
            sum += law(m, v, l) * std::abs(glm::dot(normal, l)) / squared;
        }
    }
    return sum * (light.round ? pi : 4.0) / (static_cast<double>(side) * side);
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

TEST_F(LobeGlsl, Explore) {
    std::vector<Case> cases;
    std::vector<std::string> names;
    for (const double roughness : {0.1, 0.2, 0.35, 0.5, 0.75, 1.0}) {
        for (const double view : {0.0, 40.0, 65.0, 80.0}) {
            for (const double size : {0.02, 0.1, 0.4, 1.5}) {
                for (const double off : {0.0, 10.0, 25.0, -60.0}) {
                    for (const int kind : {0, 1}) {
                        const double a = -view - off;
                        cases.push_back({{.roughness = roughness, .metallic = kind == 0 ? 1.0 : 0.0},
                                         at_angle(view),
                                         facing(at_angle(a, 0.1), size, kind == 0 ? size : 0.3 * size, kind == 1)});
                        names.push_back("r " + std::to_string(roughness) + " view " + std::to_string(view) +
                                        " size " + std::to_string(size) + " off " + std::to_string(off) +
                                        " kind " + std::to_string(kind));
                    }
                }
            }
        }
    }
    const std::vector<Found> found = shaded(cases);
    for (size_t i = 0; i < cases.size(); ++i) {
        const double want = reflected_sum(cases[i].material, cases[i].v, cases[i].light, 300);
        double a = 0; 
        const Material& m = cases[i].material;
        const double f0 = m.metallic * m.base + (1.0 - m.metallic) * 0.08 * m.specular;
        const glm::dvec2 part = gpu::environment_brdf(cases[i].v.z, m.roughness);
        a = f0 * part.x + part.y;
        std::printf("EX %s want %.6g got %.6g rel %.4f share %.3f ofalbedo %.5f\n", names[i].c_str(), want, found[i].radiance,
                    found[i].radiance / want - 1.0, found[i].share, (found[i].radiance - want) / a);
    }
}

}  // namespace
}  // namespace bounce::test
