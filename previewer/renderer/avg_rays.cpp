// SPDX-License-Identifier: Apache-2.0
#include "renderer/avg_rays.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <numeric>

#include "renderer/light_tints.h"
#include "scene/points/sobol.h"

namespace bounce {
namespace {

constexpr double pi = std::numbers::pi;

constexpr uint32_t k_place_seed = 0x2545f491U;
constexpr uint32_t k_direction_seed = 0x8f1bbcdcU;

// Steps of a profile's integral over the cosine to the axis.
constexpr int k_steps = 4096;

// Emission towards a cosine to the axis, relative to the axis: light_profile() of shaders/lib/light.glsl.
double profile_at(const LightSetup& light, double z) {
    const glm::dvec4 cone(light.gpu.cone);
    const glm::dvec4 area(light.gpu.area);
    const auto edge = [&] {
        const double within = cone.x - (1.0 - z);
        return cone.y > 0.0 ? std::clamp(within * cone.y, 0.0, 1.0) : (within > 0.0 ? 1.0 : 0.0);
    };
    switch (light.profile) {
        case PROFILE_SPOT_CYCLES_3: {
            const double t = edge();
            return std::max(z, 0.0) * t * t * (3.0 - 2.0 * t);
        }
        case PROFILE_SPOT_CYCLES_4: {
            const double t = edge();
            return t * t * (3.0 - 2.0 * t);
        }
        case PROFILE_SPOT_KHRONOS: {
            const double t = std::clamp(z * cone.x + cone.y, 0.0, 1.0);
            return t * t;
        }
        case PROFILE_AREA:
            return std::max(z - std::sqrt(std::max(1.0 - z * z, 0.0)) * area.z, 0.0) * area.w;
        default:
            return 1.0;
    }
}

// The least cosine at which a light sends anything.
double least_cosine(const LightSetup& light) {
    switch (light.profile) {
        case PROFILE_SPOT_CYCLES_3:
        case PROFILE_SPOT_CYCLES_4:
            return 1.0 - static_cast<double>(light.gpu.cone.x);
        case PROFILE_SPOT_KHRONOS:
            return std::clamp(-static_cast<double>(light.gpu.cone.y) / static_cast<double>(light.gpu.cone.x),
                              -1.0, 1.0);
        case PROFILE_AREA: {
            const auto slats = static_cast<double>(light.gpu.area.z);
            return slats / std::sqrt(1.0 + slats * slats);
        }
        default:
            return -1.0;
    }
}

// What a light sends by the cosine to its axis, summed up.
class Emission {
  public:
    explicit Emission(const LightSetup& light) : least_(least_cosine(light)), sums_(k_steps) {
        double sum = 0.0;
        for (int i = 0; i < k_steps; ++i) {
            sum += profile_at(light, cosine(i + 0.5)) * (1.0 - least_) / k_steps;
            sums_[static_cast<size_t>(i)] = sum;
        }
    }
    // Of the whole sphere, sr.
    [[nodiscard]] double solid_angle() const { return 2.0 * pi * sums_.back(); }
    // The cosine below which a part u of it is sent.
    [[nodiscard]] double cosine_at(double u) const {
        const double wanted = u * sums_.back();
        const auto found = std::upper_bound(sums_.begin(), sums_.end() - 1, wanted);
        const auto i = static_cast<size_t>(found - sums_.begin());
        const double before = i == 0 ? 0.0 : sums_[i - 1];
        const double step = sums_[i] - before;
        return cosine(static_cast<double>(i) + (step > 0.0 ? (wanted - before) / step : 0.5));
    }

  private:
    [[nodiscard]] double cosine(double step) const { return least_ + (1.0 - least_) * step / k_steps; }
    double least_;
    std::vector<double> sums_;
};

glm::dvec2 on_disk(double u, double v) {
    const double radius = std::sqrt(u);
    return {radius * std::cos(2.0 * pi * v), radius * std::sin(2.0 * pi * v)};
}

double radical_inverse(uint32_t base, uint32_t i) {
    double digit = 1.0 / base;
    double value = 0.0;
    for (; i > 0; i /= base, digit /= base) {
        value += (i % base) * digit;
    }
    return value;
}

glm::dvec3 xyz(const glm::vec4& v) {
    return glm::dvec3(glm::vec3(v));
}

double luminance(const glm::dvec3& c) {
    return glm::dot(c, glm::dvec3(0.2126, 0.7152, 0.0722));
}

// How many of `all` rays each light has.
std::vector<int> share_rays(const std::vector<double>& fluxes, int all) {
    const double sum = std::accumulate(fluxes.begin(), fluxes.end(), 0.0);
    std::vector<int> out(fluxes.size(), 0);
    std::vector<size_t> order;
    for (size_t i = 0; i < fluxes.size(); ++i) {
        if (fluxes[i] > 0.0) order.push_back(i);
    }
    if (order.empty()) {
        return out;
    }
    // The brightest first, so that these are lit where there are more lights than rays.
    std::stable_sort(order.begin(), order.end(), [&](size_t a, size_t b) { return fluxes[a] > fluxes[b]; });
    order.resize(std::min(order.size(), static_cast<size_t>(all)));
    int left = all - static_cast<int>(order.size());
    const int shared = left;
    for (const size_t i : order) {
        const int more = static_cast<int>(std::floor(fluxes[i] / sum * shared));
        out[i] = 1 + more;
        left -= more;
    }
    for (size_t k = 0; left > 0; k = (k + 1) % order.size(), --left) {
        ++out[order[k]];
    }
    return out;
}

struct Start {
    glm::dvec3 origin;
    glm::dvec3 direction;
    glm::dvec2 place{0.0};  // on an area light, -1 to 1
};

Start start_of(const LightSetup& light, const Emission& emission, const glm::dvec2& place,
               const glm::dvec2& way) {
    const gpu::GpuLight& gpu = light.gpu;
    const glm::dvec3 tangent = xyz(gpu.tangent);
    const glm::dvec3 bitangent = xyz(gpu.bitangent);
    const glm::dvec3 axis = xyz(gpu.axis);
    Start out{xyz(gpu.position), axis};
    if (light.map_kind == MAP_ORTHOGRAPHIC) {
        const glm::dvec2 at = place * 2.0 - 1.0;
        out.origin += tangent * (at.x * static_cast<double>(gpu.tangent.w)) +
                      bitangent * (at.y * static_cast<double>(gpu.bitangent.w));
        const glm::dvec2 disk = on_disk(way.x, way.y) * static_cast<double>(gpu.cone.w);
        out.direction = glm::normalize(axis + tangent * disk.x + bitangent * disk.y);
        return out;
    }
    if (light.profile == PROFILE_AREA) {
        out.place = gpu.map.w > 0.5F ? on_disk(place.x, place.y) : place * 2.0 - 1.0;
        out.origin += tangent * (out.place.x * static_cast<double>(gpu.area.x)) +
                      bitangent * (out.place.y * static_cast<double>(gpu.area.y));
    }
    const double z = std::clamp(emission.cosine_at(way.x), -1.0, 1.0);
    const double across = std::sqrt(std::max(1.0 - z * z, 0.0));
    out.direction = glm::normalize(tangent * (across * std::cos(2.0 * pi * way.y)) +
                                   bitangent * (across * std::sin(2.0 * pi * way.y)) + axis * z);
    return out;
}

}  // namespace

glm::dvec3 avg_flux(const LightSetup& light) {
    const double measure =
        light.map_kind == MAP_ORTHOGRAPHIC
            ? 4.0 * static_cast<double>(light.gpu.tangent.w) * static_cast<double>(light.gpu.bitangent.w)
            : Emission(light).solid_angle();
    return xyz(light.gpu.intensity) * measure;
}

std::vector<glm::vec4> avg_numbers(int count) {
    constexpr std::array<std::array<uint32_t, 2>, k_avg_sequences> bases = {
        {{3, 5}, {7, 11}, {13, 17}, {19, 23}}};
    std::vector<glm::vec4> out;
    out.reserve(static_cast<size_t>(count) * bases.size());
    for (size_t k = 0; k < bases.size(); ++k) {
        for (uint32_t i = 0; i < static_cast<uint32_t>(count); ++i) {
            const auto seed = k_place_seed + static_cast<uint32_t>(k) * 0x9e3779b9U;
            const glm::dvec3 rest = scene::sobol_point(i, seed);
            const glm::dvec4 numbers(radical_inverse(bases[k][0], i), radical_inverse(bases[k][1], i), rest.y,
                                     rest.z);
            // A double just below 1 would round up to it.
            out.push_back(glm::min(glm::vec4(numbers), glm::vec4(0.99999994F)));
        }
    }
    return out;
}

std::vector<gpu::GpuAvgRay> avg_rays(std::span<const AvgRayLight> lights, const IsmLayout& layout) {
    std::vector<glm::dvec3> fluxes;
    std::vector<double> worth;
    std::vector<Emission> emissions;
    for (const AvgRayLight& light : lights) {
        emissions.emplace_back(light.setup);
        fluxes.push_back(avg_flux(light.setup));
        worth.push_back(std::max(luminance(fluxes.back()), 0.0));
    }
    std::vector<gpu::GpuAvgRay> out(static_cast<size_t>(layout.vpls));
    for (gpu::GpuAvgRay& ray : out) {
        ray.direction = glm::vec4(0.0F, 0.0F, 1.0F, 0.0F);
    }
    const std::vector<int> shares = share_rays(worth, layout.vpls);
    int before = 0;
    for (size_t l = 0; l < lights.size(); ++l) {
        const LightSetup& light = lights[l].setup;
        const bool area = light.profile == PROFILE_AREA && light.map_kind != MAP_ORTHOGRAPHIC;
        std::vector<size_t> own;
        std::vector<glm::dvec2> places;
        for (int step = before; step < before + shares[l]; ++step) {
            // Subsets take turns, as in shaders/passes/avg_trace.comp.
            const int subsets = layout.interleave * layout.interleave;
            const auto index = static_cast<uint32_t>(step % subsets * layout.subset + step / subsets);
            const glm::dvec2 place(scene::sobol_point(index, k_place_seed));
            const glm::dvec2 way(scene::sobol_point(index, k_direction_seed));
            const Start start = start_of(light, emissions[l], place, way);
            gpu::GpuAvgRay& ray = out[index];
            ray.origin = glm::vec4(glm::vec3(start.origin), area ? 1.0F : 0.0F);
            // The light's radius weakens it near by (shaders/passes/rsm.frag).
            ray.direction = glm::vec4(glm::vec3(start.direction),
                                      light.map_kind == MAP_ORTHOGRAPHIC ? 0.0F : light.gpu.intensity.w);
            ray.flux = glm::vec4(glm::vec3(fluxes[l] / static_cast<double>(shares[l])), 0.0F);
            ray.leaving = glm::vec4(glm::vec3(light.gpu.axis), 0.0F);
            own.push_back(index);
            places.push_back(start.place);
        }
        before += shares[l];
        if (area && lights[l].pattern.width > 0 && !own.empty()) {
            const std::vector<glm::vec3> tints =
                light_tints(lights[l].pattern, places, light.gpu.map.w > 0.5F);
            for (size_t i = 0; i < own.size(); ++i) {
                out[own[i]].flux *= glm::vec4(tints[i], 0.0F);
            }
        }
    }
    return out;
}

}  // namespace bounce
