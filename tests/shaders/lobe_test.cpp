// SPDX-License-Identifier: Apache-2.0
//
// Lobes of flat lights against sums over the lights in doubles.
#include <algorithm>
#include <cstdio>
#include <map>

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

// What the lobe reflects of the light: over pieces of the light and over directions that the lobe spreads, side x side of
// each, weighed by the sum of both densities (Veach and Guibas 1995). Good to 1e-3 of the lobe's albedo.
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
            const glm::dvec2 at = light.round
                                      ? radius * glm::dvec2(std::cos(2.0 * pi * u.y), std::sin(2.0 * pi * u.y))
                                      : 2.0 * u - 1.0;
            const glm::dvec3 d = light.middle + at.x * light.x + at.y * light.y;
            const double squared = glm::dot(d, d);
            const glm::dvec3 l = d / std::sqrt(squared);
            const double light_density =
                squared / (area * std::abs(glm::dot(glm::normalize(normal), l)));
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
            const bool inside = light.round ? glm::length(on) < 1.0 : std::abs(on.x) < 1.0 && std::abs(on.y) < 1.0;
            if (t > 0.0 && inside && glm::dot(h, v) > 0.0) {
                const double there =
                    t * t / (area * std::abs(glm::dot(glm::normalize(normal), r)));
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
        const double want = reflected_sum(cases[i].material, cases[i].v, cases[i].light, 250);
        double a = 0; 
        const Material& m = cases[i].material;
        const double f0 = m.metallic * m.base + (1.0 - m.metallic) * 0.08 * m.specular;
        const glm::dvec2 part = gpu::environment_brdf(cases[i].v.z, m.roughness);
        a = f0 * part.x + part.y;
        static std::map<std::pair<double,double>, gpu::LobeFit> fits;
        const double view = std::acos(cases[i].v.z);
        if (!fits.count({view, m.roughness})) fits[{view, m.roughness}] = gpu::fit_lobe(cases[i].v.z, m.roughness, {2.0, 2.0*cases[i].v.z, 0.0}).fit;
        const gpu::LobeFit fit = fits[{view, m.roughness}];
        const auto g = [&](const glm::dvec3& l) { return l.z <= 0.0 ? 0.0 : gpu::lobe_density(fit, cases[i].v.z, m.roughness, glm::dvec3(-l.x, -l.y, l.z)); };
        const auto grid = [&](int side) { double sf = 0, sg = 0; for (int q = 0; q < side*side; ++q) {
            glm::dvec2 u((q % side + 0.5)/side, (q / side + 0.5)/side);
            const Flat& light = cases[i].light;
            double ang = 2*pi*(u.y + 0.5*u.x);
            glm::dvec2 at = light.round ? std::sqrt(u.x)*glm::dvec2(std::cos(ang), std::sin(ang)) : 2.0*u - 1.0;
            glm::dvec3 d = light.middle + at.x*light.x + at.y*light.y; double sq = glm::dot(d,d); glm::dvec3 l = d/std::sqrt(sq);
            double w = std::abs(glm::dot(glm::cross(light.x, light.y), l))/sq;
            sf += w*law(m, cases[i].v, l); sg += w*g(l); }
            return glm::dvec2(sf, sg); };
        const auto g2 = grid(2), g3 = grid(3), g4 = grid(4);
        const double psi = view + std::asin(fit.sin_shift), al = std::max(m.roughness*m.roughness, 1e-3);
        const double P = fit.in_plane*al, C = fit.across*al;
        const auto mapped = [&](const glm::dvec3& l) { return glm::normalize(glm::dvec3((std::cos(psi)*-l.x - std::sin(psi)*l.z)/P, -l.y/C, l.z/std::cos(psi))); };
        const auto back = [&](const glm::dvec3& o) { glm::dvec3 q(P/std::cos(psi)*o.x + std::sin(psi)*o.z, C*o.y, std::cos(psi)*o.z); q = glm::normalize(q); return glm::dvec3(-q.x, -q.y, q.z); };
        glm::dvec3 mean(0.0), mean1(0.0); double zmin = 1, zmax = 0;
        for (int q = 0; q < 200*200; ++q) { glm::dvec2 u((q % 200 + 0.5)/200, (q / 200 + 0.5)/200);
            const Flat& light = cases[i].light;
            glm::dvec2 at = light.round ? std::sqrt(u.x)*glm::dvec2(std::cos(2*pi*u.y), std::sin(2*pi*u.y)) : 2.0*u - 1.0;
            glm::dvec3 d = light.middle + at.x*light.x + at.y*light.y; double sq = glm::dot(d,d); glm::dvec3 l = d/std::sqrt(sq);
            if (l.z <= 0) continue;
            double w = std::abs(glm::dot(glm::cross(light.x, light.y), l))/sq*g(l);
            const glm::dvec3 o = mapped(l);
            mean += w*o; mean1 += w/o.z*o; zmin = std::min(zmin, o.z); zmax = std::max(zmax, o.z); }
        if (mean.z <= 0) mean = mean1 = glm::dvec3(0,0,1);
        const glm::dvec3 tc = back(mean); 
        glm::dvec3 m1 = glm::normalize(mean1); double z2 = std::min(m1.z + (zmax-zmin)*(zmax-zmin)/(12*m1.z), 1.0);
        const double k2 = std::sqrt((1-z2*z2)/std::max(1-m1.z*m1.z,1e-12));
        const glm::dvec3 ta = back({m1.x*k2, m1.y*k2, z2});
        const glm::dvec3 t = found[i].toward;
        std::printf("EX %s want %.6g got %.6g rel %.4f share %.5f ofalbedo %.5f A %.5g F %.5g %.5g %.5g %.5g %.5g %.5g %.5g %.5g %.5g %.5g %.5g %.5g %.5g %.5g\n", names[i].c_str(), want, found[i].radiance,
                    found[i].radiance / want - 1.0, found[i].share, (found[i].radiance - want) / a, a,
                    law(m, cases[i].v, t), g(t), g2.x, g2.y, g3.x, g3.y, g4.x, g4.y, law(m, cases[i].v, tc), g(tc), law(m, cases[i].v, ta), g(ta), law({.roughness = m.roughness}, cases[i].v, ta), part.x + part.y);
    }
}

}  // namespace
}  // namespace bounce::test
