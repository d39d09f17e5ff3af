// SPDX-License-Identifier: Apache-2.0
#include "renderer/auto_scene.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <span>
#include <utility>
#include <vector>

#include "renderer/camera_view.h"
#include "renderer/ism_layout.h"
#include "renderer/penumbra.h"
#include "renderer/renderer.h"
#include "renderer/settings.h"
#include "scene/emissive_panels.h"
#include "scene/transparency.h"

namespace bounce {
namespace {

// Places on surfaces. Of what lights send, every so many of them are looked at; of what the camera sees, so
// many that stand for as many pixels each.
constexpr size_t k_places = 8192;
constexpr size_t k_stride = 4;
constexpr size_t k_seen = 64;
// Moments of the animation that it is judged at.
constexpr int k_moments = 5;
// Up to here a spot has one map; light_setup.cpp.
constexpr double k_widest_planar_cone_rad = 120.0 * std::numbers::pi / 180.0;

struct Corners {
    glm::dvec3 a, b, c;
    [[nodiscard]] glm::dvec3 cross() const { return glm::cross(b - a, c - a); }
    [[nodiscard]] double area() const { return 0.5 * glm::length(cross()); }
};

struct Place {
    glm::dvec3 position;
    glm::dvec3 normal;
};

// Every triangle of the pose, in world space; what is skinned or morphs as it is at rest.
template <typename Visit>
void for_each_triangle(const scene::Scene& scene, const scene::Pose& pose, Visit&& visit) {
    for (const scene::DrawInstance& draw : pose.draws) {
        const glm::dmat4 world_from_model = draw.skin == scene::k_none
                                                ? draw.world_from_model
                                                : pose.world_from_node[static_cast<size_t>(draw.node)];
        for (const scene::Primitive& primitive : scene.meshes[static_cast<size_t>(draw.mesh)].primitives) {
            const auto corner = [&](size_t i) {
                return glm::dvec3(world_from_model *
                                  glm::dvec4(glm::dvec3(primitive.positions[primitive.indices[i]]), 1.0));
            };
            for (size_t i = 0; i + 2 < primitive.indices.size(); i += 3) {
                visit(Corners{corner(i), corner(i + 1), corner(i + 2)});
            }
        }
    }
}

double area_of(const scene::Scene& scene, const scene::Pose& pose) {
    double area = 0.0;
    for_each_triangle(scene, pose, [&](const Corners& triangle) { area += triangle.area(); });
    return area;
}

// Places that stand for the same area each: every one of k_places equal steps of the running area falls into
// a triangle, and within it they follow the R2 sequence (Roberts 2018).
std::vector<Place> spread_places(const scene::Scene& scene, const scene::Pose& pose, double area) {
    std::vector<Place> places;
    if (!(area > 0.0) || !std::isfinite(area)) {
        return places;
    }
    const double step = area / static_cast<double>(k_places);
    double before = 0.0;
    for_each_triangle(scene, pose, [&](const Corners& triangle) {
        const glm::dvec3 cross = triangle.cross();
        before += triangle.area();
        while ((static_cast<double>(places.size()) + 0.5) * step < before && places.size() < k_places) {
            const auto n = static_cast<double>(places.size());
            double u = std::fmod(0.5 + 0.7548776662466927 * n, 1.0);
            double v = std::fmod(0.5 + 0.5698402909980532 * n, 1.0);
            if (u + v > 1.0) {
                u = 1.0 - u;
                v = 1.0 - v;
            }
            places.push_back({triangle.a + u * (triangle.b - triangle.a) + v * (triangle.c - triangle.a),
                              glm::normalize(cross)});
        }
    });
    return places;
}

// Irradiance by the light's law without size and shadow, luminance; both sides of a surface count.
double falls_on(const Place& place, const scene::LightInstance& instance, const scene::Light& light) {
    const double luminance = glm::dot(glm::dvec3(light.color), glm::dvec3(0.2126, 0.7152, 0.0722));
    const glm::dvec3 axis = -glm::normalize(glm::dvec3(instance.world_from_light[2]));
    if (light.type == scene::LightType::sun) {
        return luminance * light.irradiance_w_m2 * std::abs(glm::dot(place.normal, axis));
    }
    const glm::dvec3 to = place.position - glm::dvec3(instance.world_from_light[3]);
    const double distance2 = std::max(glm::dot(to, to), 1e-12);
    const glm::dvec3 direction = to / std::sqrt(distance2);
    const double off_axis = glm::dot(direction, axis);
    double sent = 1.0 / (4.0 * std::numbers::pi);
    if (light.type == scene::LightType::spot && off_axis < std::cos(0.5 * light.cone_angle_rad)) {
        sent = 0.0;
    } else if (light.type == scene::LightType::area) {
        sent = std::max(off_axis, 0.0) / std::numbers::pi;
    }
    return luminance * light.power_w * sent * std::abs(glm::dot(direction, place.normal)) / distance2;
}

bool in_frame(const CameraMatrices& camera, const glm::dvec3& render) {
    const glm::dvec4 clip = camera.clip_from_render * glm::dvec4(render, 1.0);
    return clip.w > 0.0 && std::abs(clip.x) <= clip.w && std::abs(clip.y) <= clip.w && clip.z >= 0.0;
}

// Moments spread over the animation, the first frame first.
std::vector<double> moments(const scene::Scene& scene, bool animated) {
    std::vector<double> times;
    const int count = animated && scene.frames.end > scene.frames.start ? k_moments : 1;
    for (int i = 0; i < count; ++i) {
        const double frame =
            scene.frames.start +
            (count > 1 ? static_cast<double>(i) * (scene.frames.end - scene.frames.start) / (count - 1)
                       : 0.0);
        times.push_back(scene::time_of_frame(scene.frames, frame));
    }
    return times;
}

// The camera's pixels, as places in its frame that each stand for as many of them, unhidden.
std::vector<Place> seen_places(const scene::Scene& scene, const scene::Pose& pose,
                               const std::vector<Place>& places, const gpu::RenderSpace& space,
                               const std::string& camera, int width, int height) {
    const CameraView view = scene_camera(scene, pose, camera, width, height);
    const CameraMatrices matrices = camera_matrices(view, width, height, space);
    std::vector<double> running(places.size());
    double sum = 0.0;
    for (size_t i = 0; i < places.size(); ++i) {
        const glm::dvec3 render = space.point(places[i].position);
        if (in_frame(matrices, render)) {
            const glm::dvec3 to = matrices.perspective ? render - matrices.position : matrices.forward;
            const double distance2 = std::max(glm::dot(to, to), 1e-8);
            sum += std::abs(glm::dot(to, places[i].normal)) / (distance2 * std::sqrt(distance2));
        }
        running[i] = sum;
    }
    std::vector<Place> seen;
    for (size_t pixel = 0, i = 0; sum > 0.0 && pixel < k_seen; ++pixel) {
        while (running[i] < sum * (static_cast<double>(pixel) + 0.5) / k_seen) {
            ++i;
        }
        seen.push_back(places[i]);
    }
    return seen;
}

// What a watt that the place reflects shows at the camera's pixels; bounded where it lies nearer to one than
// `near2`, as the lights' kernels are.
double shows(const Place& place, const std::vector<Place>& seen, double near2) {
    double sum = 0.0;
    for (const Place& pixel : seen) {
        const glm::dvec3 to = pixel.position - place.position;
        const double distance2 = std::max(glm::dot(to, to), 1e-12);
        sum += std::abs(glm::dot(to, place.normal) * glm::dot(to, pixel.normal)) /
               (distance2 * std::max(distance2, near2));
    }
    return sum;
}

double counting_share(const scene::Scene& scene, const std::vector<scene::Pose>& poses,
                      const std::vector<Place>& places, double area, const std::string& camera, int width,
                      int height) {
    const scene::Pose& first = poses.front();
    std::vector<double> light(places.size(), 0.0);
    double all = 0.0;
    for (size_t i = 0; i < places.size(); ++i) {
        for (const scene::LightInstance& instance : first.light_instances) {
            light[i] += falls_on(places[i], instance, first.lights[static_cast<size_t>(instance.light)]);
        }
        all += light[i];
    }
    if (!(all > 0.0) || !std::isfinite(all)) {
        return 1.0;
    }
    const gpu::RenderSpace space = gpu::RenderSpace::around(scene::world_bounds(scene, first));
    const double near2 = area / (std::numbers::pi * Settings{}.vpls);
    double shares = 0.0;
    for (const scene::Pose& pose : poses) {
        const std::vector<Place> seen = seen_places(scene, pose, places, space, camera, width, height);
        double mean = 0.0;
        double squares = 0.0;
        for (size_t i = 0; i < places.size(); i += k_stride) {
            const double shown = light[i] > 0.0 ? shows(places[i], seen, near2) : 0.0;
            mean += light[i] * shown;
            squares += light[i] * shown * shown;
        }
        double sent = 0.0;
        for (size_t i = 0; i < places.size(); i += k_stride) {
            sent += light[i];
        }
        shares += squares > 0.0 && sent > 0.0 ? mean * mean / (squares * sent) : 1.0;
    }
    return shares / static_cast<double>(poses.size());
}

// Counts the lights that send light in some of the poses.
void count_lights(const std::vector<scene::Pose>& poses, AutoScene& out) {
    const scene::Pose& first = poses.front();
    for (const scene::LightInstance& instance : first.light_instances) {
        const auto at = static_cast<size_t>(instance.light);
        const bool sends = std::any_of(poses.begin(), poses.end(), [&](const scene::Pose& pose) {
            const scene::Light& light = pose.lights[at];
            return (light.type == scene::LightType::sun ? light.irradiance_w_m2 : light.power_w) > 0.0F;
        });
        if (!sends) {
            continue;
        }
        const scene::Light& light = first.lights[at];
        const bool planar =
            light.type == scene::LightType::sun ||
            (light.type == scene::LightType::spot && light.cone_angle_rad <= k_widest_planar_cone_rad);
        const bool sized = light.cast_shadow && light_extent(instance, light) > 0.0;
        (planar ? out.planar_lights : out.cube_lights) += 1;
        (planar ? out.sized_planar : out.sized_cube) += sized ? 1 : 0;
    }
}

}  // namespace

AutoScene describe_scene(const scene::Scene& scene, int animation, const std::string& camera, int width,
                         int height) {
    AutoScene out;
    out.features = scene::scene_features(scene, animation);
    std::vector<scene::Pose> poses;
    for (const double time : moments(scene, out.features.animated())) {
        poses.push_back(scene::evaluate_pose(scene, time, animation));
    }
    count_lights(poses, out);
    if (out.features.emissive) {
        const scene::EmissivePanels panels =
            scene::find_emissive_panels(scene, static_cast<size_t>(Settings{}.emitter_panels));
        for (const scene::EmissivePanel& panel : panels.panels) {
            const int sides = (panel.sides.front ? 1 : 0) + (panel.sides.back ? 1 : 0);
            out.cube_lights += sides;
            out.sized_cube += sides;
        }
        out.emitters = panels.panels.empty() || !panels.all;
    }
    out.blends = scene::draws_blended(scene, poses.front());
    const double area = area_of(scene, poses.front());
    const scene::Bounds bounds = scene::world_bounds(scene, poses.front());
    if (!bounds.empty()) {
        const glm::dvec3 side = bounds.high - bounds.low;
        out.depth_complexity =
            depth_complexity(area, 2.0 * (side.x * side.y + side.y * side.z + side.z * side.x));
    }
    out.seen_share =
        counting_share(scene, poses, spread_places(scene, poses.front(), area), area, camera, width, height);
    return out;
}

}  // namespace bounce
