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
#include "renderer/plan_details.h"
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

// Brings bounced light into the range of half floats, 6e-5 to 65504: the irradiance that the lights would
// give to a closed box around the scene becomes a sixteenth. That leaves a factor of a thousand for what is
// darker with all its digits, and of a million for what is brighter. Not just the next power of two, so that
// light a million times as strong is the same halves.
float half_scale(const std::vector<double>& fluxes_w, const scene::Bounds& bounds, double world_irradiance) {
    const double box = bounds.surface_m2();
    const double irradiance = std::accumulate(fluxes_w.begin(), fluxes_w.end(), 0.0) / box + world_irradiance;
    if (!(irradiance > 0.0) || !std::isfinite(irradiance)) {
        return 1.0F;
    }
    return static_cast<float>(std::clamp(0x1p-4 / irradiance, 0x1p-120, 0x1p120));
}

constexpr const char* k_unchanged = "what it makes is as in the frame before";

// The first of many pictures is the one that a frame by itself has.
uint32_t seed_of(const OneOfMany* one_of_many) {
    return one_of_many != nullptr ? one_of_many->number - 1 : 0;
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
    struct Only {
        explicit Only(bool& flag) : flag_(flag) { flag_ = true; }
        ~Only() { flag_ = false; }
        Only(const Only&) = delete;
        Only& operator=(const Only&) = delete;
        Only(Only&&) = delete;
        Only& operator=(Only&&) = delete;
        bool& flag_;
    };
    const Only only(plans_only_);
    return render_whole(pose, view, settings, gl::TimingMode::off, nullptr, nullptr);
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
    std::stable_sort(ray_lights.begin(), ray_lights.end(),
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
    if (settings.check_finite && !plans_only_) {
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
