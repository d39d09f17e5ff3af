// SPDX-License-Identifier: Apache-2.0
//
// What a frame's lights and bounces stand on, before its passes are wired: points, emitters, cells of the world,
// places on lights, the visibility grid, and how many maps of what size there are.
#include <algorithm>
#include <cmath>
#include <numbers>

#include <fmt/format.h>

#include "core/error.h"
#include "renderer/avg_layout.h"
#include "renderer/imperfect_setup.h"
#include "renderer/ism_layout.h"
#include "renderer/plan_details.h"
#include "renderer/renderer.h"
#include "renderer/settings_check.h"
#include "renderer/world_lights.h"

namespace bounce {
namespace {

// Texels a side of an imperfect reflective shadow map: it decides where the next bounce's lights stand, not
// what they are hidden from.
constexpr int k_irsm_size = 32;

// Lights with imperfect maps, which are drawn from disks where they are suns and as the settings have it
// where they are not.
struct SoftLights {
    int suns = 0;
    int others = 0;
};

SoftLights imperfect_lights(const FramePlan& plan, const scene::Pose& pose) {
    SoftLights out;
    for (size_t i = 0; plan.imperfect_shadows && i < plan.lights.size(); ++i) {
        const scene::LightInstance& instance = pose.light_instances[static_cast<size_t>(plan.lights[i])];
        const bool sun = pose.lights[static_cast<size_t>(instance.light)].type == scene::LightType::sun;
        out.suns += plan.soft[i] && sun ? 1 : 0;
        out.others += plan.soft[i] && !sun ? 1 : 0;
    }
    return out;
}

passes::VplSet vpl_set(const IsmLayout& layout) {
    passes::VplSet set;
    set.maps = layout.vpls;
    set.map_size = layout.map_size;
    set.columns = layout.columns;
    set.rows = layout.rows();
    set.points_a_map = layout.points_a_map;
    set.interleave = layout.interleave;
    set.subset = layout.subset;
    set.cell_columns = layout.cell_columns;
    return set;
}

// Maps that hold all of a box from wherever they look, and half a hundredth more for what touches its
// corners.
DistantMaps distant_maps(const scene::Bounds& box, const gpu::RenderSpace& space) {
    return {glm::vec3(space.point(box.center())),
            static_cast<float>(std::max(0.505 * box.diagonal() * space.scale, 1e-6))};
}

// Lights of further bounces are drawn from a table of every lighted point, which must fit into one block of
// what shaders read.
void require_fitting_sums(const Settings& settings, const FramePlan& plan, int points_a_map) {
    const bool tables = settings.bounce_source == BounceSource::points;  // of lights within the scene
    int lights = plan.world_bounces > 0 ? settings.world_vpls : 0;
    const char* option = "--world-vpls";
    for (const auto& [count, name] :
         {std::pair(tables && plan.bounces > 1 ? settings.vpls : 0, "--vpls"),
          std::pair(tables && plan.emitter_bounces > 0 ? settings.emitter_vpls : 0, "--emitter-vpls"),
          std::pair(tables && (plan.bounces > 2 || plan.world_bounces > 1 || plan.emitter_bounces > 1)
                        ? settings.bounce_vpls
                        : 0,
                    "--bounce-vpls")}) {
        option = count > lights ? name : option;
        lights = std::max(lights, count);
    }
    GLint64 most = 0;
    glGetInteger64v(GL_MAX_SHADER_STORAGE_BLOCK_SIZE, &most);
    const int64_t bytes = int64_t{lights} * points_a_map * int64_t{sizeof(float)};
    if (bytes > most) {
        throw usage_error(fmt::format(
            "{} virtual point lights with {} points each are too many for this OpenGL driver to draw further "
            "bounces from: lower {} to {}, or give --bounces 1",
            lights, points_a_map, option, most / (int64_t{sizeof(float)} * points_a_map)));
    }
}

}  // namespace

// How far before its surface the light of an emissive panel stands, of the scene's diagonal: ten roundings of
// a place in a float.
constexpr double k_panel_offset = 1e-6;

std::optional<scene::PanelPose> Renderer::light_panels(const scene::Pose& pose, const Settings& settings) {
    if (settings.emitter_vpls == 0 || settings.show == Show::motion) {
        return std::nullopt;
    }
    if (settings.emitter_panels != most_panels_) {
        panels_ = scene::find_emissive_panels(scene_, static_cast<size_t>(settings.emitter_panels));
        most_panels_ = settings.emitter_panels;
    }
    if (panels_.panels.empty()) {
        return std::nullopt;
    }
    return scene::with_panel_lights(scene_, pose, panels_.panels,
                                    k_panel_offset * gpu_scene_.bounds().diagonal());
}

void Renderer::place_emitters(const scene::Pose& pose, std::span<const scene::EmissivePanel> panels,
                              const Settings& settings, FramePlan& plan, uint32_t seed) {
    if (!emitters_) {
        emitters_ = std::make_unique<gpu::EmitterStore>(scene_, *points_);
    }
    emitters_->set_pose(pose, gpu_scene_.vertices(), static_cast<size_t>(emitter_layout(settings, 0).vpls),
                        panels, seed);
    if (emitters_->lights() == 0) {
        plan.emitters = plan.emitters_occluded = false;
        plan.emitter_bounces = 0;
        plan.occluded = plan.occluded && (plan.vpls || plan.world_bounces > 0);
        plan.left_out.push_back({"emitter lights", panels.empty()
                                                       ? "the textures of what emits are black"
                                                       : "all that emits is drawn as area lights"});
    }
}

passes::SphereSource Renderer::prepare_sphere(const scene::World& world) {
    const glm::vec3 radiance = environment_ ? glm::vec3(0.0F) : world.color * world.strength;
    if (!sphere_cells_ || radiance != sphere_radiance_) {
        const SphereCells& cells = environment_ ? environment_->cells() : even_cells(radiance);
        sphere_cells_ = gl::Buffer::of("sphere cells", std::span<const glm::vec4>(cells.light));
        sphere_radiance_ = radiance;
        sphere_grid_ = {cells.width, cells.height};
        sphere_content_ = ContentHash().add_all(std::span<const glm::vec4>(cells.light)).key();
    }
    gpu::SphereUniforms uniforms{};
    if (environment_) {
        uniforms = environment_->cell_uniforms(world);
    } else {
        for (int row = 0; row < 3; ++row) {
            uniforms.render_from_environment[row][row] = 1.0F;
        }
        uniforms.grid = {sphere_grid_, 0, 0};
        uniforms.light = {1.0F, 0.0F, 0.0F, 0.0F};  // without an image nothing averages visibility
    }
    return {&sphere_cells_, sphere_content_, uniforms_.add(uniforms),
            sphere_grid_.x, sphere_grid_.y,  environment_ && environment_->has_suns()};
}

SplatChoice Renderer::chosen_splat(const Settings& settings, const FramePlan& plan, int points_a_map,
                                   int soft_lights, int soft_points) const {
    const auto maps = [](int count) { return static_cast<size_t>(std::max(count, 0)); };
    const size_t first = maps(ism_layout(settings, 1, 0).vpls);
    const size_t next = maps(ism_layout(settings, 2, 0).vpls);
    size_t inside = plan.emitters_occluded ? maps(emitter_layout(settings, 0).vpls) : 0;
    if (plan.occluded) {
        inside += (plan.bounces > 0 ? first : 0) +
                  next * maps(std::max(plan.bounces - 1, 0) + plan.world_bounces + plan.emitter_bounces);
    }
    return choose_splat(
        {.triangles = gpu_scene_.triangles_drawn(),
         .splats = inside * maps(points_a_map) +
                   maps(soft_lights) * maps(settings.used_shadow_samples()) * maps(soft_points),
         .software = gl::is_software_driver(),
         .can_tessellate = can_tessellate(gl::current_limits())});
}

Renderer::LitBounces Renderer::prepare_bounces(const scene::Pose& pose,
                                               std::span<const scene::EmissivePanel> panels,
                                               const Settings& asked, FramePlan& plan, FrameReport& report,
                                               const LightChoice& chosen) {
    Settings settings = asked;
    LitBounces out;
    out.splat = settings.splat;
    if (points_needed(plan, settings) && !points_) {
        points_ = std::make_unique<gpu::PointStore>(scene_, scene::default_animation(scene_));
    }
    if (plan.emitters) {
        place_emitters(pose, panels, settings, plan, chosen.seed);
    }
    const bool splats = splats_points(plan, settings);
    const bool needs_points = points_needed(plan, settings);
    settings.drop_hull = settings.drop_hull && settings.forced != Forced::all;
    IsmLayout first = ism_layout(settings, 1, 0);
    IsmLayout irsm = first;
    irsm.map_size = k_irsm_size;
    double mean_radius = 0.0;
    double occluding_m2 = 0.0;  // of what may hide something within the scene
    const SoftLights soft_lights = imperfect_lights(plan, pose);
    const double scale = gpu_scene_.space().scale;
    if (needs_points) {
        // Of the animation, not of this frame: points stay the same ones while things move.
        const double hull = points_->parts().box_surface_m2;
        // Pull-push takes every texel without a surface for a hole in one: it needs the walls behind, or it
        // spreads what stands before them.
        const bool fills = settings.splat != Splat::disks && settings.pull_push != PullPush::off;
        const bool drop_hull = settings.drop_hull && !fills;
        const double occluding = points_->occluding_area_m2(pose, drop_hull);
        // Lines through what stands on a wide ground meet more of it than lines through the box around both.
        const double around = plan.world_occluded ? points_->first_ground().rest.surface_m2() : hull;
        first.points_a_map = settings.ism_points > 0
                                 ? settings.ism_points
                                 : automatic_points(settings.ism_size, depth_complexity(occluding, around));
        irsm.points_a_map = automatic_points(k_irsm_size, depth_complexity(points_->parts().area_m2(), hull));
        if (draws_from_points(plan, settings)) {
            require_fitting_sums(settings, plan, irsm.points_a_map);
        }
        if (plan.imperfect_shadows) {
            const double complexity =
                depth_complexity(occluding, points_->first_ground().rest.surface_m2());
            out.soft_points = settings.ism_points > 0
                                  ? settings.ism_points
                                  : automatic_points(settings.used_soft_shadow_size(), complexity);
        }
        if (settings.splat == Splat::automatic) {
            const bool used = soft_lights.others > 0 || plan.occluded || plan.emitters_occluded;
            const SplatChoice choice =
                chosen_splat(settings, plan, first.points_a_map, soft_lights.others, out.soft_points);
            out.splat = settings.splat = choice.splat;
            if (used) {
                report.splat = choice;
            }
        }
        const bool tessellates = settings.splat == Splat::tessellation;
        const bool stores = plan.world_occluded || (splats && !tessellates);
        const bool stores_soft = plan.imperfect_shadows && (!tessellates || soft_lights.suns > 0);
        const IsmLayout soft = imperfect_layout(settings, settings.used_shadow_samples(), out.soft_points);
        scene::PointCounts counts;
        counts.points_a_map = static_cast<size_t>(
            std::max(splats || !plan.imperfect_shadows ? first.points_a_map : 0, out.soft_points));
        counts.occluders = std::max(stores ? points_in_all(first) : 0, stores_soft ? points_in_all(soft) : 0);
        counts.reflectors_a_map = static_cast<size_t>(irsm.points_a_map);
        IsmLayout most = irsm;
        most.vpls = std::max({most.vpls, plan.world_bounces > 0 ? settings.world_vpls : 0,
                              plan.emitter_bounces > 0 ? emitter_layout(settings, 0).vpls : 0});
        const bool reflected = draws_from_points(plan, settings);
        counts.reflectors = reflected ? points_in_all(most) : 0;
        counts.large_triangles = settings.large_triangles && settings.splat == Splat::disks;
        // What is on the hull hides no place of the scene from another, but the world from both.
        // Nor do lights of the scene all stand within it.
        counts.hull_hides = plan.world_occluded || plan.imperfect_shadows;
        points_->plan_only(plans_only_);
        points_->set_pose(pose, gpu_scene_.space(), gpu_scene_.vertices(), counts, drop_hull,
                          plan.world_bounces > 0);
        out.triangles =
            static_cast<int>(drop_hull ? points_->large_triangles_inside() : points_->large_triangles());
        occluding_m2 = tessellates ? occluding : points_->occluder_area_m2();
        mean_radius = std::sqrt(occluding_m2 / (std::numbers::pi * first.points_a_map)) * scale;
        if (tessellates) {
            patches_ = patches_ ? std::move(patches_) : std::make_unique<gpu::TrianglePatches>();
            patches_->set_pose(pose, gpu_scene_, *points_, drop_hull);
            out.tessellated = {patches_.get(), occluding * scale * scale,
                               drop_hull ? gpu::PatchCover::inside : gpu::PatchCover::all};
            out.soft_tessellated = {patches_.get(), points_->parts().area_m2() * scale * scale,
                                    gpu::PatchCover::all};
            if (counts.occluders == 0 && counts.reflectors == 0) {
                plan.left_out.push_back(
                    {"points", "tessellation makes them as they are drawn, and nothing else needs any"});
            }
        }
        const bool nothing_hides =
            tessellates ? !(occluding > 0.0) : points_->occluders() == 0 && out.triangles == 0;
        if (splats && nothing_hides) {
            plan.occluded = plan.emitters_occluded = false;
            plan.left_out.push_back(
                {"ism", "nothing stands between two places of the scene: all surfaces are on its hull"});
            if (shows_vpl_maps(settings.show)) {
                plan.notes.emplace_back(
                    "there are no shadow maps to show: nothing stands between two places of the scene");
            }
        }
        if (reflected && points_->reflectors() == 0) {
            plan.bounces = std::min(plan.bounces, 1);
            plan.world_bounces = plan.emitter_bounces = 0;
            plan.left_out.push_back({"further bounces", "no surface has an area, so none has a point"});
            plan.notes.emplace_back("no further bounces: no surface has an area");
        }
    }
    if (needs_points) {
        report.points = points_->occluders();
        report.points_a_map = plan.occluded || plan.emitters_occluded ? first.points_a_map : 0;
        report.large_triangles = points_->large_triangles();
        report.shadow_points_a_map = out.soft_points;
    }
    if (plan.occluded) {
        report.map_size = first.map_size;
        report.atlas_width = first.atlas_width();
        report.atlas_height = first.atlas_height();
    }
    const size_t occluders = needs_points ? points_->occluders() : 0;
    const size_t reflectors = needs_points ? points_->reflectors() : 0;
    const double dense_area = needs_points ? points_->dense_reflector_area_m2() * scale * scale : 0.0;
    const auto make_bounce = [&](const IsmLayout& layout, const Settings& of, uint32_t seed) {
        Bounce bounce;
        bounce.lights = vpl_set(layout);
        gpu::IsmUniforms uniforms = ism_uniforms(layout, of, occluders, mean_radius);
        bounce.lights.seed = seed;
        bounce.lights.middle = chosen.middle;
        bounce.lights.extent = chosen.extent;
        // Maps take the points of others, far from their own.
        uniforms.points.w = static_cast<int>(seed * 0x9e3779b9U % static_cast<uint32_t>(layout.vpls));
        bounce.lights.uniforms = uniforms_.add(uniforms);
        IsmLayout maps = layout;
        maps.map_size = irsm.map_size;
        maps.points_a_map = irsm.points_a_map;
        maps.shadow_map_size = layout.map_size;
        bounce.irsms = vpl_set(maps);
        bounce.irsms.uniforms =
            uniforms_.add(irsm_uniforms(maps, of, reflectors, occluders, mean_radius, dense_area));
        report.vpls += layout.vpls;
        return bounce;
    };
    for (int bounce = 1; bounce <= plan.bounces; ++bounce) {
        out.bounces.push_back(
            make_bounce(ism_layout(settings, bounce, first.points_a_map), settings, chosen.seed));
    }
    if (plan.world_occluded) {
        const IsmLayout layout = world_layout(settings, first.points_a_map);
        const DistantMaps maps = distant_maps(points_->ground(pose).rest, gpu_scene_.space());
        const std::vector<gpu::GpuVpl> made =
            environment_ ? environment_->lights(pose.world, layout, maps)
                         : world_lights(pose.world.color * pose.world.strength, layout, maps, chosen.seed);
        const ContentKey content = ContentHash().add_all(std::span<const gpu::GpuVpl>(made)).key();
        if (content != world_content_) {
            world_lights_ = gl::Buffer::of("world lights", std::span<const gpu::GpuVpl>(made));
            world_content_ = content;
        }
        // Orthographic maps are drawn from disks, and bounces drawn from points, whatever those of the others
        // are.
        Settings disks = settings;
        disks.splat = passes::Splat::disks;
        disks.bounce_source = BounceSource::points;
        out.world = make_bounce(layout, disks, environment_ ? chosen.image_seed : chosen.seed);
        out.world.lights.distant = true;
        // Parts of an image are always the same; pictures whose mean is sought have other lights each.
        if (settings.world_sampling == WorldSampling::drawn || (environment_ && chosen.image_seed != 0)) {
            out.sphere = prepare_sphere(pose.world);
        }
        out.world.lights.image = environment_ != nullptr;
    }
    for (int bounce = 1; bounce <= plan.world_bounces; ++bounce) {
        out.world_bounces.push_back(
            make_bounce(ism_layout(settings, 2, first.points_a_map), settings, chosen.seed));
    }
    if (plan.emitters) {
        out.emitters = make_bounce(emitter_layout(settings, first.points_a_map), settings, chosen.seed);
    }
    for (int bounce = 1; bounce <= plan.emitter_bounces; ++bounce) {
        out.emitter_bounces.push_back(
            make_bounce(ism_layout(settings, 2, first.points_a_map), settings, chosen.seed));
    }
    return out;
}

std::vector<passes::ImperfectMaps> Renderer::prepare_imperfect(
    const std::vector<Imperfect>& imperfect, const std::vector<Region>& receivers, size_t lights, int points,
    const Settings& settings, const passes::TessellatedPoints& tessellated, FramePlan& plan) {
    std::vector<passes::ImperfectMaps> out(lights);
    places_.clear();
    places_.resize(lights);
    places_content_.assign(lights, {});
    for (const Imperfect& light : imperfect) {
        const bool tessellates =
            settings.splat == Splat::tessellation && light.of.type != scene::LightType::sun;
        if (tessellates ? !(tessellated.area > 0.0)
                        : points_->occluders() == 0 && points_->large_triangles() == 0) {
            plan.left_out.push_back({"soft shadow: " + light.of.name, "no surface has an area"});
            continue;
        }
        const int places = settings.used_shadow_samples();
        const IsmLayout layout = imperfect_layout(
            settings, places * imperfect_maps_a_place(light.setup, light.of, receivers), points);
        const ImperfectSetup made = set_up_imperfect_shadow(light.setup, light.of, receivers, places, layout);
        places_[light.light] = gl::Buffer::of("places on a light", std::span<const gpu::GpuVpl>(made.maps));
        places_content_[light.light] = ContentHash().add_all(std::span<const gpu::GpuVpl>(made.maps)).key();
        passes::ImperfectMaps& maps = out[light.light];
        maps.places = places;
        maps.set = vpl_set(layout);
        maps.set.distant = made.distant;
        maps.set.window = !made.distant;
        maps.set.both_sides = made.both_sides;
        Settings of = settings;
        of.splat = made.distant ? passes::Splat::disks : settings.splat;  // as the world's
        maps.slope_bias = of.splat != passes::Splat::disks;
        const double scale = gpu_scene_.space().scale;
        const double area = tessellates ? tessellated.area : points_->occluder_area_m2() * scale * scale;
        const double mean_radius = std::sqrt(area / (std::numbers::pi * points));
        gpu::IsmUniforms uniforms = imperfect_uniforms(layout, of, points_->occluders(), mean_radius);
        if (!tessellates && points_->occluders() == 0) {  // all surfaces are large triangles
            maps.set.points_a_map = uniforms.atlas.w = 0;
        }
        maps.set.uniforms = uniforms_.add(uniforms);
    }
    return out;
}

AvgInputs Renderer::prepare_avg(const std::vector<AvgRayLight>& lights, const Settings& settings,
                                const FramePlan& plan) {
    AvgInputs out;
    if (!plan.avg) {
        return out;
    }
    if (first_bounds_.empty()) {
        first_bounds_ = scene::world_bounds(scene_, scene::evaluate_pose(scene_, 0.0));
    }
    GLint64 block_bytes = 0;
    glGetInteger64v(GL_MAX_SHADER_STORAGE_BLOCK_SIZE, &block_bytes);
    out.grid.layout = avg_layout(first_bounds_, gpu_scene_.bounds(), gpu_scene_.space(), settings.avg_size,
                                 static_cast<long long>(block_bytes));
    out.grid.uniforms = uniforms_.add(out.grid.layout);
    const IsmLayout first = ism_layout(settings, 1, 0);
    const int most = std::max(first.vpls, ism_layout(settings, 2, 0).vpls);
    if (avg_numbers_.bytes() < static_cast<size_t>(most) * k_avg_sequences * sizeof(glm::vec4)) {
        const std::vector<glm::vec4> numbers = avg_numbers(most);
        avg_numbers_ = gl::Buffer::of("avg numbers", std::span<const glm::vec4>(numbers));
    }
    out.numbers = &avg_numbers_;
    if (plan.traced) {
        const std::vector<gpu::GpuAvgRay> rays = avg_rays(lights, first);
        avg_rays_ = gl::Buffer::of("avg rays", std::span<const gpu::GpuAvgRay>(rays));
        out.rays = &avg_rays_;
        out.rays_content = ContentHash().add_all(std::span<const gpu::GpuAvgRay>(rays)).key();
    }
    return out;
}

}  // namespace bounce
