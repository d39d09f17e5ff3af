// SPDX-License-Identifier: Apache-2.0
#include "renderer/environment_world.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include <fmt/format.h>

#include "passes/environment_prefilter.h"

namespace bounce {
namespace {

// Cells across: 1.4 degrees, half of what a shadow map's texel blurs.
constexpr int k_cells = 256;

glm::dmat3 turn_of(const scene::World& world) {
    return glm::mat3_cast(world.world_from_environment);
}

}  // namespace

scene::Pose EnvironmentWorld::with_suns(const scene::Pose& pose) const {
    scene::Pose out = pose;
    const glm::dmat3 turn = turn_of(pose.world);
    for (size_t i = 0; i < lights_.suns().size(); ++i) {
        const EnvironmentSun& sun = lights_.suns()[i];
        scene::Light light;
        light.name = fmt::format("sun {} of the world's image", i + 1);
        light.type = scene::LightType::sun;
        const double most = std::max({sun.irradiance.r, sun.irradiance.g, sun.irradiance.b});
        light.color = glm::vec3(sun.irradiance / most);
        light.irradiance_w_m2 = static_cast<float>(most * static_cast<double>(pose.world.strength));
        light.angle_rad = static_cast<float>(sun.angle_rad);
        scene::LightInstance instance;
        instance.light = static_cast<int>(out.lights.size());
        // It looks along its -Z.
        const glm::dvec3 z = turn * sun.from;
        const glm::dvec3 other = turn * turned_tangent(sun.from, 0.0);
        instance.world_from_light = glm::dmat4(glm::dmat3(
            glm::normalize(glm::cross(other, z)), glm::cross(z, glm::normalize(glm::cross(other, z))), z));
        out.lights.push_back(light);
        out.light_instances.push_back(instance);
    }
    return out;
}

std::vector<gpu::GpuVpl> EnvironmentWorld::lights(const scene::World& world, const IsmLayout& layout,
                                                  const DistantMaps& maps) {
    const int count = environment_region_count(lights_, layout);
    if (regions_.size() != static_cast<size_t>(count)) {
        regions_ = lights_.regions(count);
    }
    return environment_vpls(lights_, regions_, turn_of(world), world.strength, layout, maps);
}

const SphereCells& EnvironmentWorld::cells() {
    if (cells_.light.empty()) {
        cells_ = lights_.cells(k_cells);
    }
    return cells_;
}

gpu::SphereUniforms EnvironmentWorld::cell_uniforms(const scene::World& world) {
    gpu::SphereUniforms out{};
    const glm::dmat3 turn = turn_of(world);
    for (int row = 0; row < 3; ++row) {
        out.render_from_environment[row] = glm::vec4(turn[0][row], turn[1][row], turn[2][row], 0.0F);
    }
    out.grid = {cells().width, cells().height, 0, 0};
    // Lights' weights are parts of 4 pi, as environment_vpls() has them.
    const double all = lights_.whole_luminance() * static_cast<double>(world.strength);
    out.light = {world.strength, all > 0.0 ? 4.0 * std::numbers::pi / all : 0.0, 0.0F, 0.0F};
    return out;
}

const gpu::EnvironmentMaps& EnvironmentWorld::maps(const scene::Environment& environment,
                                                   gl::ProgramCache& programs) {
    if (!maps_) {
        maps_ = std::make_unique<gpu::EnvironmentMaps>(environment);
        passes::run_environment_prefilter(programs, *maps_);
    }
    return *maps_;
}

gpu::WorldUniforms EnvironmentWorld::uniforms(const scene::World& world) const {
    return maps_->uniforms(turn_of(world), world.strength);
}

}  // namespace bounce
