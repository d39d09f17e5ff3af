// SPDX-License-Identifier: Apache-2.0
#include "renderer/bounce_places.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>
#include <glm/gtc/matrix_transform.hpp>

#include "renderer/light_tints.h"
#include "renderer/penumbra.h"

namespace bounce {
namespace {

// The middles of `count` even pieces of -1 to 1, moved outwards until their mean square is that of the whole,
// 1/3: with their symmetry, that integrates every cubic exactly. The two are Gauss and Legendre's.
double along(int index, int count) {
    const double pieces = count;
    const double middle = (2.0 * index + 1.0) / pieces - 1.0;
    return count == 1 ? 0.0 : middle / std::sqrt(1.0 - 1.0 / (pieces * pieces));
}

// How many of `count` lie along the light's X: what makes the longer side of a piece shortest.
int columns_of(int count, double half_x, double half_y) {
    int best = 1;
    double least = 0.0;
    for (int columns = 1; columns <= count; columns *= 2) {
        const double longer = std::max(half_x / columns, half_y * columns / count);
        if (columns == 1 || longer < least) {
            best = columns;
            least = longer;
        }
    }
    return best;
}

}  // namespace

int count_bounce_places(const scene::LightInstance& instance, const scene::Light& light,
                        double scene_diagonal_m, int most) {
    const bool large =
        light.type == scene::LightType::area && scene_diagonal_m > 0.0 &&
        (light.pattern.width > 0 || 2.0 * light_extent(instance, light) >= k_large_light * scene_diagonal_m);
    return large ? most : 1;
}

std::vector<LightSetup> bounce_places(const LightSetup& light, int count,
                                      const scene::LightPattern& pattern) {
    if (count == 1) {
        return {light};
    }
    const auto half_x = static_cast<double>(light.gpu.area.x);
    const auto half_y = static_cast<double>(light.gpu.area.y);
    const int columns = columns_of(count, half_x, half_y);
    const int rows = count / columns;
    // The mean square along an axis of an ellipse is 1/4.
    const double shape = light.gpu.map.w > 0.5F ? std::sqrt(0.75) : 1.0;
    const float size = std::max(std::floor(light.gpu.map.x / std::sqrt(static_cast<float>(count))), 1.0F);
    std::vector<glm::vec3> tints(static_cast<size_t>(count), glm::vec3(1.0F));
    if (pattern.width > 0) {
        std::vector<glm::dvec2> places;
        for (int i = 0; i < count; ++i) {
            places.push_back(shape * glm::dvec2(along(i % columns, columns), along(i / columns, rows)));
        }
        tints = light_tints(pattern, places, light.gpu.map.w > 0.5F);
    }
    std::vector<LightSetup> out;
    for (int i = 0; i < count; ++i) {
        const glm::dvec3 offset =
            shape * (glm::dvec3(glm::vec3(light.gpu.tangent)) * (half_x * along(i % columns, columns)) +
                     glm::dvec3(glm::vec3(light.gpu.bitangent)) * (half_y * along(i / columns, rows)));
        LightSetup place = light;
        place.name = fmt::format("{}, place {} of {}", light.name, i + 1, count);
        place.flux_w /= count;
        place.gpu.position += glm::vec4(glm::vec3(offset), 0.0F);
        place.gpu.intensity = glm::vec4(
            glm::vec3(light.gpu.intensity) * tints[static_cast<size_t>(i)] / static_cast<float>(count),
            light.gpu.intensity.w);
        place.gpu.cone.z = 1.0F / static_cast<float>(count);
        place.gpu.map.x = size;
        for (LightFace& face : place.faces) {
            face.clip_from_render =
                glm::mat4(glm::dmat4(face.clip_from_render) * glm::translate(glm::dmat4(1.0), -offset));
        }
        out.push_back(std::move(place));
    }
    return out;
}

}  // namespace bounce
