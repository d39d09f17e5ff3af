// SPDX-License-Identifier: Apache-2.0
#include "gpu/lobe_fit.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <numbers>
#include <vector>

namespace bounce::gpu {
namespace {

constexpr double pi = std::numbers::pi;
constexpr int k_rings = 48;   // of samples, for each of the two densities
constexpr int k_around = 24;  // over half a turn: lobes are even about the plane of view and normal
constexpr int k_steps = 400;

double alpha_of(double roughness) {
    return std::max(roughness * roughness, k_least_alpha);
}

glm::dvec3 viewer(double n_dot_v) {
    return {-std::sqrt(std::max(1.0 - n_dot_v * n_dot_v, 0.0)), 0.0, n_dot_v};
}

double ggx_distribution(double alpha, const glm::dvec3& h) {
    const double alpha2 = alpha * alpha;
    const double t = h.z * h.z * alpha2 + h.x * h.x + h.y * h.y;
    return alpha2 / (pi * t * t);
}

struct Matrix {
    double cos_psi, sin_psi, p, c;
    Matrix(const LobeFit& fit, double n_dot_v, double roughness) {
        const double psi = std::acos(n_dot_v) + std::asin(fit.sin_shift);
        cos_psi = std::cos(psi);
        sin_psi = std::sin(psi);
        p = fit.in_plane * alpha_of(roughness);
        c = fit.across * alpha_of(roughness);
    }
    [[nodiscard]] double density(const glm::dvec3& w) const {
        const glm::dvec3 o((cos_psi * w.x - sin_psi * w.z) / p, w.y / c, w.z / cos_psi);
        const double squared = glm::dot(o, o);
        return std::max(o.z, 0.0) / (pi * squared * squared * p * c);
    }
    [[nodiscard]] glm::dvec3 moved(const glm::dvec3& o) const {
        return glm::normalize(glm::dvec3(p / cos_psi * o.x + sin_psi * o.z, c * o.y, cos_psi * o.z));
    }
};

// Directions as the lobe spreads them, fixed while it is fitted.
struct Lobe {
    struct Sample {
        glm::dvec3 to_light;
        double value;  // of the lobe, its integral 1
        double density;
    };
    double n_dot_v;
    double roughness;
    double albedo = 0.0;
    std::vector<Sample> samples;

    // Density of what half_vector_sample() draws.
    [[nodiscard]] double drawn(const glm::dvec3& l) const {
        const glm::dvec3 v = viewer(n_dot_v);
        const glm::dvec3 h = glm::normalize(l + v);
        return ggx_distribution(alpha_of(roughness), h) * h.z / (4.0 * glm::dot(h, v));
    }

    Lobe(double cosine, double rough) : n_dot_v(cosine), roughness(rough) {
        const double alpha2 = alpha_of(roughness) * alpha_of(roughness);
        const glm::dvec3 v = viewer(n_dot_v);
        for (int i = 0; i < k_rings; ++i) {
            const double u = (i + 0.5) / k_rings;
            const double sine = std::sqrt(u * alpha2 / (1.0 + (alpha2 - 1.0) * u));
            const double cos_h = std::sqrt((1.0 - u) / (1.0 + (alpha2 - 1.0) * u));
            for (int j = 0; j < k_around; ++j) {
                const double phi = pi * (j + 0.5) / k_around;
                const glm::dvec3 h(sine * std::cos(phi), sine * std::sin(phi), cos_h);
                const glm::dvec3 l = 2.0 * glm::dot(h, v) * h - v;
                if (l.z > 0.0 && glm::dot(h, v) > 0.0) {
                    samples.push_back({l, ggx_times_cosine(n_dot_v, roughness, l), drawn(l)});
                    albedo += samples.back().value / samples.back().density;
                }
            }
        }
        albedo /= k_rings * k_around;
        for (Sample& sample : samples) {
            sample.value /= albedo;
        }
    }

    [[nodiscard]] double error(const LobeFit& fit) const {
        const Matrix matrix(fit, n_dot_v, roughness);
        if (fit.in_plane <= 1e-3 || fit.across <= 1e-3 || std::abs(fit.sin_shift) > 1.0 ||
            matrix.cos_psi < 1e-3) {
            return 10.0;  // worse than any
        }
        // Both sets of samples together, each weighed by the sum of both densities (Veach and Guibas 1995,
        // "Optimally Combining Sampling Techniques for Monte Carlo Rendering").
        double sum = 0.0;
        const auto add = [&](double f, double g, double density_f) {
            const double difference = f - g;
            sum += difference * difference / ((f + g) * std::max(density_f + g, 1e-300));
        };
        for (const Sample& sample : samples) {
            add(sample.value, matrix.density(sample.to_light), sample.density);
        }
        for (int i = 0; i < k_rings; ++i) {
            const double u = (i + 0.5) / k_rings;
            for (int j = 0; j < k_around; ++j) {
                const double phi = pi * (j + 0.5) / k_around;
                const double r = std::sqrt(u);
                const glm::dvec3 w = matrix.moved({r * std::cos(phi), r * std::sin(phi), std::sqrt(1.0 - u)});
                const double g = matrix.density(w);
                add(ggx_times_cosine(n_dot_v, roughness, w) / albedo, g, drawn(w));
            }
        }
        return sum / (k_rings * k_around);
    }
};

constexpr size_t k_parameters = 3;
using Point = std::array<double, k_parameters>;

LobeFit fit_at(const Point& at) {
    return {std::exp(at[0]), std::exp(at[1]), at[2]};
}

}  // namespace

double ggx_times_cosine(double n_dot_v, double roughness, const glm::dvec3& to_light) {
    if (to_light.z <= 0.0) {
        return 0.0;
    }
    const double alpha = alpha_of(roughness);
    const auto smith = [&](double cosine) {
        return cosine + std::sqrt(cosine * cosine * (1.0 - alpha * alpha) + alpha * alpha);
    };
    const glm::dvec3 h = glm::normalize(to_light + viewer(n_dot_v));
    return ggx_distribution(alpha, h) * to_light.z / (smith(to_light.z) * smith(n_dot_v));
}

double lobe_density(const LobeFit& fit, double n_dot_v, double roughness, const glm::dvec3& to_light) {
    return Matrix(fit, n_dot_v, roughness).density(to_light);
}

FittedLobe fit_lobe(double n_dot_v, double roughness, const LobeFit& start) {
    const Lobe lobe(n_dot_v, roughness);
    struct Corner {
        Point at;
        double error;
    };
    const auto corner = [&](const Point& at) { return Corner{at, lobe.error(fit_at(at))}; };
    const Point first{std::log(start.in_plane), std::log(start.across), start.sin_shift};
    const Point step{0.1, 0.1, 0.5 * std::min(alpha_of(roughness), 0.1)};
    std::array<Corner, k_parameters + 1> simplex;
    simplex[0] = corner(first);
    for (size_t i = 0; i < k_parameters; ++i) {
        Point at = first;
        at[i] -= step[i];  // a shift upwards could put the axis under the horizon
        simplex[i + 1] = corner(at);
    }
    const auto less = [](const Corner& a, const Corner& b) { return a.error < b.error; };
    for (int i = 0; i < k_steps; ++i) {
        std::sort(simplex.begin(), simplex.end(), less);
        if (simplex.back().error - simplex.front().error < 1e-9) {
            break;
        }
        Point middle{};
        for (size_t k = 0; k < k_parameters; ++k) {
            for (size_t j = 0; j < k_parameters; ++j) {
                middle[j] += simplex[k].at[j] / static_cast<double>(k_parameters);
            }
        }
        const auto along = [&](double t) {
            Point at;
            for (size_t j = 0; j < k_parameters; ++j) {
                at[j] = middle[j] + t * (simplex.back().at[j] - middle[j]);
            }
            return corner(at);
        };
        const Corner reflected = along(-1.0);
        if (less(reflected, simplex.front())) {
            const Corner further = along(-2.0);
            simplex.back() = less(further, reflected) ? further : reflected;
        } else if (less(reflected, simplex[k_parameters - 1])) {
            simplex.back() = reflected;
        } else {
            const Corner nearer = along(less(reflected, simplex.back()) ? -0.5 : 0.5);
            if (nearer.error < std::min(reflected.error, simplex.back().error)) {
                simplex.back() = nearer;
            } else {
                for (size_t k = 1; k <= k_parameters; ++k) {
                    Point at;
                    for (size_t j = 0; j < k_parameters; ++j) {
                        at[j] = 0.5 * (simplex[k].at[j] + simplex[0].at[j]);
                    }
                    simplex[k] = corner(at);
                }
            }
        }
    }
    std::sort(simplex.begin(), simplex.end(), less);
    return {fit_at(simplex.front().at), simplex.front().error};
}

}  // namespace bounce::gpu
