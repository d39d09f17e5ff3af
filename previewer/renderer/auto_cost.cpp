// SPDX-License-Identifier: Apache-2.0
#include "renderer/auto_cost.h"

#include <algorithm>
#include <cmath>
#include <cstdint>

#include "renderer/ism_layout.h"

namespace bounce {
namespace {

// Milliseconds a unit: the least of seven renders of each pass, on two cores of llvmpipe (docs/auto.md,
// "What a unit costs").
constexpr double k_frame_ms = 3.0;             // passes that do next to nothing, one by one
constexpr double k_triangle_ms = 1.6e-4;       // through one view
constexpr double k_shadow_texel_ms = 1.2e-6;   // of a light's shadow map
constexpr double k_rsm_texel_ms = 2.0e-5;      // of a reflective one, with its running sums
constexpr double k_pixel_ms = 1.0e-4;          // shaded by the camera, and composed
constexpr double k_light_pixel_ms = 1.2e-4;    // lit by one light through one map
constexpr double k_edge_triangle_ms = 4.2e-4;  // at the several samples that smooth outlines
constexpr double k_edge_pixel_ms = 1.5e-4;     // the same
constexpr double k_map_ms = 0.05;              // a shadow map of a virtual light, whatever is in it
constexpr double k_map_point_ms = 1.1e-4;      // a point in it
constexpr double k_map_texel_ms = 2.0e-5;      // a texel of it
constexpr double k_gather_ms = 2.0e-5;         // one virtual light in one pixel
constexpr double k_bounced_pixel_ms = 4.0e-4;  // blurred, and what is near gathered
constexpr double k_next_point_ms = 5.0e-5;     // a point of surface lit by one light, for the next bounce
constexpr double k_view_texel_ms = 6.0e-4;     // a texel of a reflective map judged by what the camera sees
constexpr double k_sample_ms = 1.0e-5;         // technique rsm: a sample at a pixel, where it is interpolated
constexpr double k_full_sample_ms = 2.5e-5;    // and where not

// Of a cube, that a triangle touches: the passes of table's point light take no longer than its spot's.
constexpr double k_touched_faces = 1.2;

double squared(double value) {
    return value * value;
}

class Work {
  public:
    void add(std::string_view name, double units, double ms_a_unit) {
        if (units > 0.0) {
            items_.push_back({name, units, units * ms_a_unit});
        }
    }
    std::vector<WorkItem> take() { return std::move(items_); }

  private:
    std::vector<WorkItem> items_;
};

// Maps of virtual lights.
struct Maps {
    double count = 0.0;     // with shadow maps
    double gathered = 0.0;  // lights that a pixel gathers from
    double next = 0.0;      // lights that points of surface are lit by, for lights of the next bounce
};

Maps count_maps(const AutoScene& scene, const Settings& settings) {
    Maps out;
    const double subsets = squared(settings.interleave);
    const auto lights = [&](double wanted) { return std::ceil(wanted / subsets) * subsets; };
    const bool ism = settings.technique == Technique::ism;
    const auto add = [&](double wanted, bool occluded) {
        out.count += occluded ? lights(wanted) : 0.0;
        out.gathered += lights(wanted) / subsets;
    };
    const bool hidden = settings.visibility != Visibility::none;
    if (ism && scene.lights() > 0) {
        add(settings.vpls, hidden);
        for (int bounce = 2; bounce <= settings.bounces; ++bounce) {
            out.next += lights(bounce == 2 ? settings.vpls : settings.bounce_vpls);
            add(settings.bounce_vpls, hidden);
        }
    }
    const auto add_source = [&](int wanted, bool occluded) {
        add(wanted, occluded);
        for (int bounce = 1; ism && bounce <= settings.bounces; ++bounce) {
            out.next += lights(bounce == 1 ? wanted : settings.bounce_vpls);
            add(settings.bounce_vpls, hidden);
        }
    };
    if (scene.world() && settings.world_vpls > 0) {
        add_source(settings.world_vpls, true);
    }
    if (scene.emitters && settings.emitter_vpls > 0) {
        add_source(settings.emitter_vpls, !ism || hidden);
    }
    return out;
}

}  // namespace

std::vector<WorkItem> frame_work(const AutoScene& scene, const Settings& settings) {
    Work work;
    const auto triangles = static_cast<double>(scene.features.triangles);
    const double pixels = static_cast<double>(settings.width) * settings.height;
    const double samples = std::max(settings.samples, 1);
    // A cube has six faces of half the side; a triangle is drawn into those that it touches.
    const double faces = scene.planar_lights + k_touched_faces * scene.cube_lights;
    const double squares = scene.planar_lights + 1.5 * scene.cube_lights;
    const double soft_maps = settings.direct_shadows == DirectShadows::vpl
                                 ? settings.used_shadow_samples()
                                 : (settings.direct_shadows == DirectShadows::convolution ? 1.0 : 0.0);
    const double sized = scene.sized_planar + scene.sized_cube;
    const double hard = std::max(scene.lights() - sized, 0.0);
    const bool bounced = settings.technique != Technique::direct && scene.lights() > 0;

    work.add("the frame itself", samples, k_frame_ms);
    work.add("triangles before the camera", triangles * (scene.blends ? 2.0 : 1.0), k_triangle_ms);
    work.add("pixels", pixels, k_pixel_ms);
    work.add("triangles before the lights", triangles * faces * (1.0 + (bounced ? 1.0 : 0.0)), k_triangle_ms);
    work.add("shadow maps", squares * squared(settings.shadow_size), k_shadow_texel_ms);
    const double soft_faces = soft_maps * (scene.sized_planar + k_touched_faces * scene.sized_cube);
    const double soft_squares = soft_maps * (scene.sized_planar + 1.5 * scene.sized_cube);
    work.add("triangles of soft shadows", triangles * soft_faces, k_triangle_ms);
    work.add("maps of soft shadows", soft_squares * squared(settings.used_soft_shadow_size()),
             k_shadow_texel_ms);
    if (settings.direct_shadows == DirectShadows::ism) {
        const double size = settings.used_soft_shadow_size();
        const double maps = settings.used_shadow_samples() * sized;
        work.add("points of soft shadows",
                 maps * automatic_points(settings.used_soft_shadow_size(), scene.depth_complexity),
                 k_map_point_ms);
        work.add("maps of soft shadows", maps * squared(size), k_map_texel_ms);
    }
    work.add("direct light", pixels * (hard + sized * std::max(soft_maps, 1.0)), k_light_pixel_ms);
    if (settings.antialias && settings.samples == 1) {
        work.add("outlines: triangles", triangles, k_edge_triangle_ms);
        work.add("outlines: pixels", pixels, k_edge_pixel_ms);
    }
    if (bounced) {
        const double texels = squares * squared(settings.used_rsm_size());
        work.add("reflective shadow maps", texels, k_rsm_texel_ms);
        if (settings.technique == Technique::ism && settings.vpl_importance == Importance::view) {
            work.add("what the camera sees of them", texels, k_view_texel_ms);
        }
    }
    if (settings.technique == Technique::rsm && bounced) {
        const double count =
            settings.rsm_full_sum ? squares * squared(settings.used_rsm_size()) : settings.rsm_samples;
        const bool interpolates = settings.interpolate && !settings.rsm_full_sum;
        work.add("gathered samples", pixels * count, interpolates ? k_sample_ms : k_full_sample_ms);
    }
    const Maps maps = count_maps(scene, settings);
    const double points = settings.ism_points > 0
                              ? settings.ism_points
                              : automatic_points(settings.ism_size, scene.depth_complexity);
    work.add("shadow maps of bounced light", maps.count, k_map_ms);
    work.add("points in them", maps.count * points, k_map_point_ms);
    work.add("texels of them", maps.count * squared(settings.ism_size), k_map_texel_ms);
    work.add("bounced light in pixels", maps.gathered * pixels, k_gather_ms);
    if (maps.gathered > 0.0) {
        work.add("blur and near light", pixels, k_bounced_pixel_ms);
    }
    work.add("light for the next bounce", maps.next * automatic_points(32, scene.depth_complexity),
             k_next_point_ms);
    return work.take();
}

double frame_cost_ms(const AutoScene& scene, const Settings& settings) {
    double ms = 0.0;
    for (const WorkItem& item : frame_work(scene, settings)) {
        ms += item.ms;
    }
    return ms;
}

}  // namespace bounce
