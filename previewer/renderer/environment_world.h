// SPDX-License-Identifier: Apache-2.0
//
// An image of the world as the renderer needs it: its lights and its textures, made when they are first asked
// for.
#pragma once

#include <memory>
#include <vector>

#include "gl/program.h"
#include "gpu/environment_maps.h"
#include "renderer/environment_lights.h"
#include "scene/pose.h"

namespace bounce {

class EnvironmentWorld {
  public:
    explicit EnvironmentWorld(const scene::Environment& environment) : lights_(environment) {}

    // The pose with a sun for each compact source of the image, behind its own lights.
    [[nodiscard]] scene::Pose with_suns(const scene::Pose& pose) const;
    [[nodiscard]] bool has_suns() const { return !lights_.suns().empty(); }

    // The rest of the image as layout.vpls lights.
    [[nodiscard]] std::vector<gpu::GpuVpl> lights(const scene::World& world, const IsmLayout& layout,
                                                  const DistantMaps& maps);

    // The same light as cells of the sphere, made on the first call, and what shaders need to know of them.
    [[nodiscard]] const SphereCells& cells();
    [[nodiscard]] gpu::SphereUniforms cell_uniforms(const scene::World& world);

    // Textures of the image, drawn on the first call.
    [[nodiscard]] const gpu::EnvironmentMaps& maps(const scene::Environment& environment,
                                                   gl::ProgramCache& programs);
    [[nodiscard]] gpu::WorldUniforms uniforms(const scene::World& world) const;

  private:
    EnvironmentLights lights_;
    std::vector<EnvironmentRegion> regions_;
    SphereCells cells_;
    std::unique_ptr<gpu::EnvironmentMaps> maps_;
};

}  // namespace bounce
