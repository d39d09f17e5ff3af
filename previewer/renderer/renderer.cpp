// SPDX-License-Identifier: Apache-2.0
#include "renderer/renderer.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numbers>
#include <numeric>

#include <fmt/format.h>

#include "core/error.h"
#include "gl/debug_output.h"
#include "passes/deform.h"
#include "passes/finite_check.h"
#include "renderer/avg_layout.h"
#include "renderer/bounce_places.h"
#include "renderer/imperfect_setup.h"
#include "renderer/ism_layout.h"
#include "renderer/light_setup.h"
#include "renderer/penumbra.h"
#include "renderer/pipeline.h"
#include "renderer/settings_check.h"
#include "renderer/soft_setup.h"
#include "renderer/world_lights.h"

namespace bounce {
namespace {

gpu::FrameUniforms frame_uniforms(const CameraMatrices& camera, const scene::Scene& scene,
                                  const scene::Pose& pose, const Settings& settings, int samples,
                                  float half_scale) {
    gpu::FrameUniforms frame{};
    frame.render_from_clip = glm::mat4(camera.render_from_clip);
    frame.camera_position = glm::vec4(glm::vec3(camera.position), camera.perspective ? 1.0F : 0.0F);
    frame.camera_forward = glm::vec4(glm::vec3(camera.forward), 0.0F);
    frame.world_radiance = glm::vec4(pose.world.color * pose.world.strength, 0.0F);
    frame.size = {settings.width, settings.height, settings.lowres_step, samples};
    frame.interpolation = {std::cos(glm::radians(settings.interpolation_angle_deg)),
                           settings.interpolation_plane, static_cast<float>(camera.pixel_radius),
                           settings.interpolation_distance};
    const bool whole = settings.show == Show::shaded || settings.show == Show::vpls;
    frame.composite = {scene.render.film_exposure, whole ? 1.0F : 0.0F,
                       1.0F / std::sqrt(static_cast<float>(settings.samples)), half_scale};
    return frame;
}

double box_surface_m2(const scene::Bounds& box) {
    const glm::dvec3 side = box.empty() ? glm::dvec3(0.0) : box.high - box.low;
    return 2.0 * (side.x * side.y + side.y * side.z + side.z * side.x);
}

// Brings bounced light into the range of half floats, 6e-5 to 65504: the irradiance that the lights would
// give to a closed box around the scene becomes a sixteenth. That leaves a factor of a thousand for what is
// darker with all its digits, and of a million for what is brighter. Not just the next power of two, so that
// light a million times as strong is the same halves.
float half_scale(const std::vector<double>& fluxes_w, const scene::Bounds& bounds, double world_irradiance) {
    const double box = box_surface_m2(bounds);
    const double irradiance = std::accumulate(fluxes_w.begin(), fluxes_w.end(), 0.0) / box + world_irradiance;
    if (!(irradiance > 0.0) || !std::isfinite(irradiance)) {
        return 1.0F;
    }
    return static_cast<float>(std::clamp(0x1p-4 / irradiance, 0x1p-120, 0x1p120));
}

// Texels a side of an imperfect reflective shadow map: it decides where the next bounce's lights stand, not
// what they are hidden from.
constexpr int k_irsm_size = 32;

constexpr const char* k_unchanged = "what it makes is as in the frame before";

// Imperfect shadow maps are drawn from points; classic ones from triangles.
bool splats_points(const FramePlan& plan, const Settings& settings) {
    const bool emitters = plan.emitters && plan.emitters_occluded;
    return plan.world_occluded || ((plan.occluded || emitters) && (settings.visibility == Visibility::ism ||
                                                                   settings.technique != Technique::ism));
}

// Further bounces are drawn from points; or traced through the approximate visibility grid.
bool draws_from_points(const FramePlan& plan, const Settings& settings) {
    return settings.bounce_source != BounceSource::avg &&
           (plan.bounces > 1 || plan.world_bounces > 0 || plan.emitter_bounces > 0);
}

bool points_needed(const FramePlan& plan, const Settings& settings) {
    return splats_points(plan, settings) || draws_from_points(plan, settings) || plan.emitters ||
           plan.imperfect_shadows;
}

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

// The first of many pictures is the one that a frame by itself has.
uint32_t seed_of(const OneOfMany* one_of_many) {
    return one_of_many != nullptr ? one_of_many->number - 1 : 0;
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

// What the camera sees of each draw.
std::vector<Region> receivers_in(const gpu::GpuScene& scene, const CameraMatrices& camera) {
    std::vector<gpu::DrawBox> boxes;
    for (const gpu::DrawBatch& batch : scene.batches()) {
        for (uint32_t draw = batch.first_draw; draw < batch.first_draw + batch.draw_count; ++draw) {
            boxes.push_back(scene.draw_box(draw));
        }
    }
    return seen_regions(boxes, gpu::draw_box(scene.bounds(), scene.space()), camera.clip_from_render,
                        camera.render_from_clip);
}

bool is_black(const Image& picture) {
    return std::all_of(picture.rgb.begin(), picture.rgb.end(), [](float value) { return value == 0.0F; });
}

// What a run can be repeated with, beside the settings.
void throw_on_fault(const std::string& fault, const scene::Scene& scene, const scene::Pose& pose,
                    uint32_t seed) {
    if (!fault.empty()) {
        throw Error(ExitCode::failed,
                    fmt::format("{}; scene {}, time {:g} s (frame {:g}), seed {}", fault,
                                scene.name.empty() ? "without a name" : scene.name, pose.time_s,
                                scene.frames.start + pose.time_s * scene.frames.fps, seed));
    }
}

passes::SoftMaps soft_maps(const SoftSetup& setup, gpu::UniformArena& uniforms) {
    passes::SoftMaps out;
    out.map_kind = setup.map_kind;
    out.size = setup.size;
    out.layers = setup.layers;
    for (const SoftFace& face : setup.faces) {
        // ViewUniforms::eye.w
        const auto places = static_cast<int>(setup.views.size());
        const int numbers = face.layer * places / setup.layers + 4096 * places;
        const glm::mat4& clip = face.view.clip_from_render;
        out.faces.push_back(
            {face.layer,
             {uniforms.add(gpu::ViewUniforms{clip, glm::vec4(0.0F, 0.0F, 0.0F, static_cast<float>(numbers))}),
              clip, face.view.mirrored, setup.begins_near}});
    }
    for (size_t first = 0; first < setup.views.size(); first += SHADOW_VIEW_CHUNK) {
        gpu::ShadowViews chunk{};
        std::copy_n(&setup.views[first], std::min<size_t>(SHADOW_VIEW_CHUNK, setup.views.size() - first),
                    chunk.view);
        out.chunks.push_back(uniforms.add(chunk));
    }
    return out;
}

}  // namespace

Renderer::Renderer(const scene::Scene& scene) : scene_(scene), gpu_scene_(scene) {
    if (scene.environment) {
        environment_ = std::make_unique<EnvironmentWorld>(*scene.environment);
    }
}
Renderer::~Renderer() = default;

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
        const double around = plan.world_occluded ? box_surface_m2(points_->first_ground().rest) : hull;
        first.points_a_map = settings.ism_points > 0
                                 ? settings.ism_points
                                 : automatic_points(settings.ism_size, depth_complexity(occluding, around));
        irsm.points_a_map = automatic_points(k_irsm_size, depth_complexity(points_->parts().area_m2(), hull));
        if (draws_from_points(plan, settings)) {
            require_fitting_sums(settings, plan, irsm.points_a_map);
        }
        if (plan.imperfect_shadows) {
            const double complexity =
                depth_complexity(occluding, box_surface_m2(points_->first_ground().rest));
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

const gl::Buffer& Renderer::pattern(passes::RsmPattern kind, int samples) {
    auto found = patterns_.find({kind, samples});
    if (found == patterns_.end()) {
        const std::vector<glm::vec4> points = passes::make_rsm_pattern(kind, samples);
        found = patterns_
                    .emplace(std::pair(kind, samples),
                             gl::Buffer::of("rsm pattern", std::span<const glm::vec4>(points)))
                    .first;
    }
    return found->second;
}

FrameReport Renderer::render(const scene::Pose& pose, const CameraView& view, const Settings& settings,
                             gl::TimingMode timing, const Moment* before) {
    return render_whole(pose, view, settings, timing, before, nullptr);
}

FrameReport Renderer::render_whole(const scene::Pose& pose, const CameraView& view, const Settings& settings,
                                   gl::TimingMode timing, const Moment* before,
                                   const OneOfMany* one_of_many) {
    // Without the lights at infinity all of the image counts as its mean colour, its suns as well.
    if (environment_ && environment_->has_suns() && settings.world_vpls > 0 && pose.world.strength > 0.0F) {
        return render_lit(environment_->with_suns(pose), view, settings, timing, before,
                          pose.light_instances.size(), one_of_many);
    }
    return render_lit(pose, view, settings, timing, before, pose.light_instances.size(), one_of_many);
}

FrameReport Renderer::plan(const scene::Pose& pose, const CameraView& view, const Settings& settings) {
    plans_only_ = true;
    try {
        FrameReport report = render_whole(pose, view, settings, gl::TimingMode::off, nullptr, nullptr);
        plans_only_ = false;
        return report;
    } catch (...) {
        plans_only_ = false;
        throw;
    }
}

FrameReport Renderer::render_one_of_many(const scene::Pose& pose, const CameraView& view,
                                         const Settings& settings, gl::TimingMode timing, uint32_t number,
                                         float extent) {
    if (number == 1) {
        means_.count = 0;
    }
    // What is kept has the sizes of before.
    if (number == 1 || settings.used_rsm_size() != kept_.rsm_size ||
        settings.shadow_size != kept_.shadow_size) {
        kept_.rsm_size = settings.used_rsm_size();
        kept_.shadow_size = settings.shadow_size;
        for (std::vector<gl::Texture>* maps : {&kept_.hard, &kept_.rsms}) {
            for (gl::Texture& map : *maps) {
                if (map) {
                    pool_.release(std::move(map));
                }
            }
            maps->clear();
        }
    }
    const OneOfMany one{.number = number,
                        .extent = extent,
                        .offset = glm::vec2(view.offset_px),
                        .kept = &kept_,
                        .means = &means_};
    return render_whole(pose, view, settings, timing, nullptr, &one);
}

std::vector<glm::vec4> Renderer::resolve_many() {
    passes::resolve_means(programs_, means_, color_);
    gl::throw_on_debug_error("resolve means");
    const auto width = static_cast<size_t>(color_.desc().width);
    std::vector<glm::vec4> pixels(width * static_cast<size_t>(color_.desc().height));
    glMemoryBarrier(GL_TEXTURE_UPDATE_BARRIER_BIT);
    glGetTextureImage(color_.id(), 0, GL_RGBA, GL_FLOAT,
                      static_cast<GLsizei>(pixels.size() * sizeof(glm::vec4)), pixels.data());
    for (size_t low = 0, high = pixels.size(); low + width < high; low += width) {
        high -= width;
        std::swap_ranges(pixels.begin() + static_cast<std::ptrdiff_t>(low),
                         pixels.begin() + static_cast<std::ptrdiff_t>(low + width),
                         pixels.begin() + static_cast<std::ptrdiff_t>(high));
    }
    return pixels;
}

FrameReport Renderer::render_lit(const scene::Pose& of_scene, const CameraView& view,
                                 const Settings& settings, gl::TimingMode timing, const Moment* before,
                                 size_t own_lights, const OneOfMany* one_of_many) {
    FrameReport report;
    const gl::TextureDesc target{.format = GL_RGBA32F, .width = settings.width, .height = settings.height};
    if (color_.desc() != target || !color_) {
        pool_.clear();
        color_ = gl::Texture("color", target);
    }

    pool_.hold_idle(!settings.frees_idle);
    gl::PassTimer timer(timing);
    const Moment still{of_scene, view};
    const Moment& previous = before != nullptr ? *before : still;
    if (settings.show == Show::motion) {
        if (!previous_) {
            previous_ = std::make_unique<PreviousFrameSource>();
        }
        previous_->draw(gpu_scene_, programs_, pool_, uniforms_, previous, settings, timer, report.executed);
    }
    gpu_scene_.force_features(settings.forced != Forced::nothing);
    gpu_scene_.set_pose(of_scene);
    const std::optional<scene::PanelPose> with_panels = light_panels(of_scene, settings);
    const scene::Pose& pose = with_panels ? with_panels->pose : of_scene;
    const std::vector<scene::EmissivePanel> panels =
        with_panels ? with_panels->lit : std::vector<scene::EmissivePanel>{};
    report.triangles = gpu_scene_.triangles_drawn();

    const CameraMatrices camera = camera_matrices(tighten_orthographic_depth(view, gpu_scene_.bounds()),
                                                  settings.width, settings.height, gpu_scene_.space());
    const Sight sight{gpu_scene_.bounds(),
                      finest_pixel_m(view, camera, gpu_scene_.space(), gpu_scene_.bounds()),
                      1.0 / gpu_scene_.space().scale};
    FramePlan plan = plan_frame(scene_, pose, settings, &sight);
    if (plan.emitters && !panels.empty() && panels_.all && panels.size() == panels_.panels.size()) {
        plan.emitters = plan.emitters_occluded = false;
        plan.emitter_bounces = 0;
        plan.occluded = plan.occluded && (plan.vpls || plan.world_bounces > 0);
        plan.left_out.push_back({"emitter lights", "all that emits is drawn as area lights"});
    }
    report.approximations = plan.approximations;
    LightHistory::Continuation continuation;
    LightChoice choice{.seed = seed_of(one_of_many),
                       .image_seed = seed_of(one_of_many),
                       .extent = one_of_many != nullptr ? one_of_many->extent : 1.0F};
    if (plan.temporal_reuse) {
        history_ = history_ ? std::move(history_) : std::make_unique<LightHistory>();
        continuation = history_->continuation(gpu_scene_, pose, settings);
        // Other lights in each frame, for the mean. Light that is in none would only flicker, and means that
        // things which move keep short have too few lights to gain by it.
        choice.middle = true;
        choice.seed = plan.blend_layers > 0 || continuation.moved ? 0 : continuation.number;
    } else {
        history_.reset();
    }
    if (plan.simplified) {
        gpu_scene_.simplify(settings.simplify);
        report.simplified_triangles = gpu_scene_.simplified_triangles();
        report.simplified_error_m = gpu_scene_.simplified_error_m();
    }

    // Everything the passes read from uniform blocks, uploaded at once.
    uniforms_.clear();
    const auto make_view = [&](const glm::mat4& clip_from_render, bool mirrored) {
        return passes::View{uniforms_.add(gpu::ViewUniforms{clip_from_render, glm::vec4(0.0F)}),
                            clip_from_render, mirrored};
    };
    const bool mirrored = glm::determinant(glm::dmat3(view.world_from_camera)) < 0.0;
    const passes::View camera_view = make_view(glm::mat4(camera.clip_from_render), mirrored);

    const auto any_of = [](const std::vector<bool>& flags) {
        return std::find(flags.begin(), flags.end(), true) != flags.end();
    };
    const bool any_soft = any_of(plan.soft) || any_of(plan.veiled);
    // What blended surfaces let through of a light without size is in maps of triangles, however many
    // imperfect ones there are.
    Settings of_triangles = settings;
    if (settings.direct_shadows == DirectShadows::ism) {
        of_triangles.direct_shadows = DirectShadows::vpl;
        of_triangles.shadow_samples = std::min(settings.shadow_samples, k_most_shadow_samples);
        of_triangles.soft_shadow_size = 0;
    }
    const std::vector<Region> receivers = any_soft ? receivers_in(gpu_scene_, camera) : std::vector<Region>{};
    std::vector<passes::LightPass> lights;
    std::vector<Imperfect> imperfect;
    std::vector<BounceStart> bounce_sources;
    std::vector<AvgRayLight> ray_lights;
    std::vector<double> fluxes;         // of the lights
    std::vector<double> source_fluxes;  // of the sources of bounced light
    const auto light_pass = [&](const LightSetup& setup) {
        passes::LightPass pass;
        pass.name = setup.name;
        pass.map_kind = setup.map_kind;
        pass.profile = setup.profile;
        pass.uniforms = uniforms_.add(setup.gpu);
        for (const LightFace& face : setup.faces) {
            pass.faces.push_back(make_view(face.clip_from_render, face.mirrored));
        }
        pass.rsm_size = static_cast<int>(setup.gpu.map.x);
        pass.shadow_size = static_cast<int>(setup.gpu.map.y);
        pass.sized = setup.gpu.intensity.w > 0.0F || setup.gpu.cone.w > 0.0F;
        pass.flux_w = setup.flux_w;
        return pass;
    };
    for (size_t i = 0; i < plan.lights.size(); ++i) {
        const auto index = static_cast<size_t>(plan.lights[i]);
        const scene::LightInstance& instance = pose.light_instances[index];
        LightSetup setup =
            set_up_light(instance, pose.lights[static_cast<size_t>(instance.light)], gpu_scene_.bounds(),
                         gpu_scene_.space(), settings.used_rsm_size(), settings.shadow_size);
        setup.place_seed = seed_of(one_of_many);
        passes::LightPass pass = light_pass(setup);
        pass.flux_w = plan.takes_light[i] ? 0.0 : setup.flux_w;
        // What suns of the world's image reflect is in the image's own reflection; panels come after them.
        pass.glossy = index < own_lights || index >= of_scene.light_instances.size();
        // The light of a spread is cut off within its outline: what a grid of points sees, and no closed
        // form.
        const bool flat = setup.profile == PROFILE_AREA && setup.gpu.area.z < 1e-4F;
        if (plan.direct && pass.glossy && gpu_scene_.has_specular() && (pass.sized || flat)) {
            lobes_ = lobes_ ? std::move(lobes_) : std::make_unique<gpu::LobeTable>();
            pass.lobes = lobes_.get();
        }
        if (plan.soft[i] && settings.direct_shadows == DirectShadows::ism) {
            imperfect.push_back({i, setup, pose.lights[static_cast<size_t>(instance.light)]});
        } else if (plan.soft[i] || plan.veiled[i]) {
            const bool convolved = plan.soft[i] && settings.direct_shadows == DirectShadows::convolution;
            pass.soft = soft_maps(
                set_up_soft_shadow(setup, pose.lights[static_cast<size_t>(instance.light)], receivers,
                                   gpu::draw_box(gpu_scene_.bounds(), gpu_scene_.space()),
                                   convolved ? 1 : of_triangles.used_shadow_samples(),
                                   of_triangles.used_soft_shadow_size()),
                uniforms_);
            pass.soft.blended_only = plan.veiled[i];
            pass.soft.convolution_order = convolved ? settings.convolution_order : 0;
        }
        const scene::Light& described = pose.lights[static_cast<size_t>(instance.light)];
        if (plan.soft[i] && settings.direct_shadows != DirectShadows::convolution &&
            described.pattern.width > 0) {
            pass.tints = place_tints(setup, described, settings.used_shadow_samples());
        }
        lights.push_back(pass);
        fluxes.push_back(pass.flux_w);
        if (plan.traced && !plan.takes_light[i]) {
            ray_lights.push_back({setup, described.pattern});
        }
        for (const LightSetup& place : bounce_places(setup, plan.places[i], described.pattern)) {
            bounce_sources.push_back({i, plan.places[i] == 1 ? pass : light_pass(place), {}, nullptr});
            source_fluxes.push_back(bounce_sources.back().pass.flux_w);
        }
    }
    // As sort_by_name() in pipeline.cpp.
    std::stable_sort(
        ray_lights.begin(), ray_lights.end(),
        [](const AvgRayLight& a, const AvgRayLight& b) { return a.setup.name < b.setup.name; });
    report.lights = static_cast<int>(lights.size());
    const LitBounces bounces = prepare_bounces(pose, panels, settings, plan, report, choice);
    const AvgInputs avg = prepare_avg(ray_lights, settings, plan);
    Settings drawn = settings;
    drawn.splat = bounces.splat;
    const std::vector<passes::ImperfectMaps> imperfect_maps = prepare_imperfect(
        imperfect, receivers, lights.size(), bounces.soft_points, drawn, bounces.soft_tessellated, plan);
    std::vector<double> sent = fluxes;
    sent.push_back(plan.emitters ? emitters_->power_w() : 0.0);
    const glm::vec3 radiance = pose.world.color * pose.world.strength;
    const float scale = half_scale(
        sent, gpu_scene_.bounds(),
        plan.world_occluded ? std::numbers::pi * std::max({radiance.r, radiance.g, radiance.b}) : 0.0);
    const auto frame_slot = [&](int samples) {
        return uniforms_.add(frame_uniforms(camera, scene_, pose, settings, samples, scale));
    };
    const gpu::UniformArena::Slot frame = frame_slot(0);

    const std::vector<int> samples = share_samples(source_fluxes, settings.rsm_samples);
    for (size_t i = 0; i < samples.size(); ++i) {
        bounce_sources[i].gather_frame = frame_slot(samples[i]);
        bounce_sources[i].pattern = &pattern(settings.rsm_pattern, samples[i]);
        report.rsm_samples += plan.indirect && settings.technique == Technique::rsm ? samples[i] : 0;
    }
    passes::WorldImage image;
    if (plan.environment) {
        image.maps = &environment_->maps(*scene_.environment, programs_);
        image.uniforms = uniforms_.add(environment_->uniforms(pose.world));
    }
    LightHistory::Frame light_before;
    if (plan.temporal_reuse) {
        light_before = history_->begin(gpu_scene_, pose, camera, settings, scale, continuation, uniforms_);
        report.reuse.emplace().reason = continuation.reason;
        if (!light_before.before) {
            plan.notes.push_back(
                fmt::format("no light of the frames before is reused: {}", continuation.reason));
        }
    }
    passes::ReusedPixels reused_pixels;
    const passes::PreviousFrame previous_frame =
        plan.motion ? previous_->match(gpu_scene_, pose, previous.pose, uniforms_) : passes::PreviousFrame{};
    uniforms_.upload();
    report.left_out = plan.left_out;
    report.notes = plan.notes;
    float reflected_flux = -1.0F;
    bool anything_seen = true;
    int unpeeled_pixels = 0;
    if (settings.measure_removed && (plan.vpls || plan.emitter_bounces > 0)) {
        report.removed.emplace();
    }

    std::optional<passes::FiniteCheck> check;
    if (settings.check_finite) {
        check.emplace(programs_, settings.width, settings.height);
    }
    if (plans_only_) {
        if (plan.deform) {
            report.executed.emplace_back("deform");
        }
    } else if (plan.deform && !gpu_scene_.vertices().deform_due() && settings.forced == Forced::nothing) {
        report.left_out.push_back({"deform", "joints and morph weights are as in the frame before"});
    } else if (plan.deform) {
        timer.begin("deform");
        passes::run_deform(programs_, gpu_scene_);
        timer.end();
        gl::throw_on_debug_error("deform");
        if (check) {
            check->wrote("deform", "vertex positions", gpu_scene_.vertices().positions(), k_all_floats);
        }
        report.executed.emplace_back("deform");
    }
    FrameGraph graph(pool_);
    build_pipeline(
        graph, {.plan = plan,
                .settings = drawn,
                .context = {.programs = programs_,
                            .scene = gpu_scene_,
                            .uniforms = uniforms_,
                            .frame = frame,
                            .width = settings.width,
                            .height = settings.height,
                            .blends = plan.blends},
                .camera = camera_view,
                .lights = lights,
                .imperfect = imperfect_maps,
                .places = &places_,
                .places_content = places_content_,
                .bounce_sources = bounce_sources,
                .points = points_needed(plan, settings) ? points_.get() : nullptr,
                .bounces = bounces.bounces,
                .world = bounces.world,
                .world_lights = &world_lights_,
                .world_content = world_content_,
                .sphere = bounces.sphere,
                .image = image,
                .world_bounces = bounces.world_bounces,
                .emitter_store = emitters_.get(),
                .emitters = bounces.emitters,
                .emitter_bounces = bounces.emitter_bounces,
                .tessellated = bounces.tessellated,
                .soft_tessellated = bounces.soft_tessellated,
                .avg = avg,
                .triangles_inside = bounces.triangles,
                .previous = previous_frame,
                .kept = light_before.next,
                .light_before = light_before.before,
                .reused_pixels = settings.count_gathered_pixels ? &reused_pixels : nullptr,
                .target = graph.import_texture("color", color_),
                .one_of_many = one_of_many,
                .gathered_pixels = settings.count_gathered_pixels ? &report.gathered_pixels : nullptr,
                .removed = report.removed ? &*report.removed : nullptr,
                .reflected_flux = settings.find_unlit ? &reflected_flux : nullptr,
                .unpeeled_pixels = plan.blend_layers > 0 ? &unpeeled_pixels : nullptr,
                .anything_seen = settings.find_unlit && plan.blend_layers == 0 ? &anything_seen : nullptr});
    const bool keeps = one_of_many == nullptr && settings.forced == Forced::nothing;
    if (plans_only_) {
        const FrameGraph::Forecast forecast = graph.forecast(keeps && contents_.on(), !settings.frees_idle);
        report.executed.insert(report.executed.end(), forecast.passes.begin(), forecast.passes.end());
        for (const std::string& pass : forecast.culled) {
            report.left_out.push_back({pass, "nothing reads what it makes"});
        }
        size_t lasting = gl::allocated_bytes() - pool_.bytes() - contents_.bytes();
        if (points_) {
            lasting += points_->bytes() - points_->allocated_bytes();
        }
        report.memory = {.lasting = lasting, .passes = forecast.peak_bytes};
        return report;
    }
    if (settings.forced != Forced::nothing) {
        graph.ignore_conditions();
    }
    graph.execute(timer, keeps ? &contents_ : nullptr, check ? &*check : nullptr);
    if (check) {
        throw_on_fault(check->fault(), scene_, pose, choice.seed);
    }
    report.executed.insert(report.executed.end(), graph.executed().begin(), graph.executed().end());
    for (const std::string& pass : graph.culled()) {
        report.left_out.push_back({pass, "nothing reads what it makes"});
    }
    for (const std::string& pass : graph.unchanged()) {
        report.left_out.push_back({pass, k_unchanged});
    }
    for (const std::string& pass : graph.skipped()) {
        report.left_out.push_back({pass, "no blended surface is in its layer"});
    }
    if (unpeeled_pixels > 0) {
        report.approximations.push_back(
            fmt::format("{} pixels show more than {} blended surfaces; those behind are left out "
                        "(--transparent-layers)",
                        unpeeled_pixels, plan.blend_layers));
    }
    if (reflected_flux == 0.0F) {
        const std::string reason = "no light reaches a surface that reflects it";
        report.left_out.push_back({"bounced light", reason});
        report.notes.push_back("no bounced light: " + reason);
    }
    if (!anything_seen && !pose.draws.empty()) {
        report.notes.emplace_back("the camera sees no surface of the scene");
    }
    if (settings.find_unlit && report.notes.empty() && shows_light(settings.show) && is_black(read_color())) {
        report.notes.emplace_back("the picture is black: no light reaches what the camera sees of the scene");
    }
    if (report.reuse && settings.count_gathered_pixels) {
        report.reuse->share = reused_pixels.surfaces > 0
                                  ? static_cast<double>(reused_pixels.reused) / reused_pixels.surfaces
                                  : 0.0;
    }
    gl::throw_on_lost_context();
    pool_.end_frame();
    report.passes = timer.collect();
    return report;
}

void Renderer::keep_frame() {
    contents_.keep_frame(pool_);
    if (history_) {
        history_->keep(gpu_scene_);
    }
}

void Renderer::forget_history() {
    history_.reset();
}

Image Renderer::read_color() const {
    Image image(color_.desc().width, color_.desc().height);
    const auto width = static_cast<size_t>(image.width);
    const auto height = static_cast<size_t>(image.height);
    std::vector<float> rgba(width * height * 4);
    glMemoryBarrier(GL_TEXTURE_UPDATE_BARRIER_BIT);
    glGetTextureImage(color_.id(), 0, GL_RGBA, GL_FLOAT, static_cast<GLsizei>(rgba.size() * sizeof(float)),
                      rgba.data());
    for (size_t y = 0; y < height; ++y) {
        const size_t source = (height - 1 - y) * width;
        for (size_t x = 0; x < width; ++x) {
            std::copy_n(&rgba[(source + x) * 4], 3, &image.rgb[(y * width + x) * 3]);
        }
    }
    return image;
}

CameraView scene_camera(const scene::Scene& scene, const scene::Pose& pose, const std::string& name,
                        int width, int height) {
    int node = scene.active_camera_node;
    if (!name.empty()) {
        const auto found =
            std::find_if(scene.topological_order.begin(), scene.topological_order.end(), [&](int i) {
                const scene::Node& candidate = scene.nodes[static_cast<size_t>(i)];
                return candidate.camera != scene::k_none && candidate.name == name;
            });
        if (found == scene.topological_order.end()) {
            throw usage_error(
                fmt::format("{} has no camera named {}; bounce info lists them", scene.name, name));
        }
        node = *found;
    }
    const auto pixel_aspect = static_cast<double>(scene.render.pixel_aspect_x / scene.render.pixel_aspect_y);
    if (node == scene::k_none) {
        const double aspect = static_cast<double>(width) / height;
        const scene::PlacedCamera placed = scene::framing_camera(scene::world_bounds(scene, pose), aspect);
        return {placed.world_from_camera, placed.camera, 1.0};
    }
    const auto index = static_cast<size_t>(node);
    return {pose.world_from_node[index], pose.cameras[static_cast<size_t>(scene.nodes[index].camera)],
            pixel_aspect};
}

}  // namespace bounce
