// SPDX-License-Identifier: Apache-2.0
#include "renderer/penumbra.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

namespace bounce {

double light_extent(const scene::LightInstance& instance, const scene::Light& light) {
    switch (light.type) {
        case scene::LightType::sun:
            // Beyond some 160 degrees a disk of directions is no sun any more.
            return std::tan(0.5 *
                            std::clamp(static_cast<double>(light.angle_rad), 0.0, 0.9 * std::numbers::pi));
        case scene::LightType::area:
            return 0.5 * std::hypot(light.size_x_m * glm::length(glm::dvec3(instance.world_from_light[0])),
                                    light.size_y_m * glm::length(glm::dvec3(instance.world_from_light[1])));
        case scene::LightType::point:
        case scene::LightType::spot:
            break;
    }
    return std::max(static_cast<double>(light.radius_m), 0.0);
}

double widest_penumbra_m(const scene::LightInstance& instance, const scene::Light& light,
                         const scene::Bounds& bounds) {
    const double extent = light_extent(instance, light);
    if (!(extent > 0.0) || bounds.empty()) {
        return 0.0;
    }
    if (light.type == scene::LightType::sun) {
        return 2.0 * extent * bounds.diagonal();
    }
    const glm::dvec3 place(instance.world_from_light[3]);
    const double nearest = glm::length(place - glm::clamp(place, bounds.low, bounds.high)) - extent;
    // Occluder at `nearest`, receiver at most the bounds' diagonal behind it.
    return nearest > 0.0 ? 2.0 * extent * bounds.diagonal() / nearest
                         : std::numeric_limits<double>::infinity();
}

double finest_pixel_m(const CameraView& view, const CameraMatrices& camera, const gpu::RenderSpace& space,
                      const scene::Bounds& bounds) {
    if (!camera.perspective) {
        return 2.0 * camera.pixel_radius / space.scale;
    }
    const glm::dvec3 eye(view.world_from_camera[3]);
    const double middle = glm::dot(bounds.center() - eye, camera.forward);
    const double reach = 0.5 * glm::dot(bounds.high - bounds.low, glm::abs(camera.forward));
    return 2.0 * camera.pixel_radius * std::max(middle - reach, static_cast<double>(view.camera.near_m));
}

}  // namespace bounce
