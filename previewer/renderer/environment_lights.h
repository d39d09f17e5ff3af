// SPDX-License-Identifier: Apache-2.0
//
// An image of the world as lights: the few small sources that throw hard shadows as suns, the rest as virtual
// point lights at infinity, each with the light of its part of the image. Together they have all of its
// light, channel by channel. Everything here is in the image's own axes and for a strength of 1.
#pragma once

#include <vector>

#include <glm/glm.hpp>

#include "renderer/world_lights.h"
#include "scene/scene.h"

namespace bounce {

struct EnvironmentSun {
    glm::dvec3 from{0.0};        // unit, where it is seen
    glm::dvec3 irradiance{0.0};  // rgb, W/m^2 on a facing plane
    double angle_rad = 0.0;      // diameter
};

// A part of the image, or one of several lights that share it.
struct EnvironmentRegion {
    glm::dvec3 from{0.0};        // unit, where the middle of its light is seen
    glm::dvec3 irradiance{0.0};  // rgb, W/m^2 on a plane that faces it: radiance times solid angle
    double solid_angle = 0.0;    // of the part
};

class EnvironmentLights {
  public:
    explicit EnvironmentLights(const scene::Environment& environment);

    // Compact sources with a good part of the image's light, most of it first; at most k_most_suns. Their
    // light is in no region.
    static constexpr size_t k_most_suns = 4;
    [[nodiscard]] const std::vector<EnvironmentSun>& suns() const { return suns_; }

    // The image without its suns, cut into `count` parts. Neighbours in this order are mostly neighbours in
    // the image. Parts are cut where light and extent are largest (after Viriyothai and Debevec 2009,
    // "Variance Minimization Light Probe Sampling"); a bright one that is too small to be worth cutting is
    // shared by several lights.
    [[nodiscard]] std::vector<EnvironmentRegion> regions(int count) const;

    // The image without its suns as cells of the sphere, at most `across` times half as many.
    [[nodiscard]] SphereCells cells(int across) const;
    // Luminance of all of it, with its suns.
    [[nodiscard]] double whole_luminance() const;

  private:
    // Sums over the cells above and to the left.
    struct Sums {
        double weight = 0.0;     // what parts are cut by
        glm::dvec3 moment{0.0};  // weight times direction
        glm::dvec3 irradiance{0.0};
        glm::dvec3 light_moment{0.0};  // luminance times direction
        double luminance = 0.0;
        double solid_angle = 0.0;
    };
    struct Part;
    [[nodiscard]] const Sums& at(int x, int y) const;
    [[nodiscard]] Sums sums(int x0, int y0, int x1, int y1) const;
    [[nodiscard]] Part make_part(int x0, int y0, int x1, int y1) const;
    [[nodiscard]] bool cut(const Part& part, Part& first, Part& second) const;

    int width_ = 0;  // of the grid of cells
    int height_ = 0;
    std::vector<Sums> table_;
    std::vector<EnvironmentSun> suns_;
};

// The lights of an image as world_lights() makes those of a constant colour: layout.vpls of them, dealt out
// so that each subset of the interleaved gather has its part of every side. incident.w is what a light weighs
// where its visibility is averaged for reflections, which the suns take part in: one in each subset stands
// for one of them and lights nothing. render_from_environment: the image's turn.
[[nodiscard]] std::vector<gpu::GpuVpl> environment_vpls(const EnvironmentLights& environment,
                                                        const std::vector<EnvironmentRegion>& regions,
                                                        const glm::dmat3& render_from_environment,
                                                        double strength, const IsmLayout& layout,
                                                        const DistantMaps& maps);

// How many regions environment_vpls() takes.
[[nodiscard]] int environment_region_count(const EnvironmentLights& environment, const IsmLayout& layout);

}  // namespace bounce
