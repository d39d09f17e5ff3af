// SPDX-License-Identifier: Apache-2.0
#include "cli/render_options.h"

#include <algorithm>
#include <charconv>
#include <initializer_list>
#include <limits>
#include <map>
#include <tuple>

#include <fmt/format.h>

#include "cli/frame_list.h"
#include "cli/option_conflicts.h"
#include "cli/render_option_groups.h"
#include "core/error.h"
#include "renderer/auto_scene.h"
#include "renderer/presets.h"
#include "renderer/setting_names.h"
#include "renderer/settings_check.h"
#include "scene/pose.h"
#include "scene/scene_features.h"

namespace bounce::cli {
namespace {

// A number, or `word`, which gives nothing.
std::optional<int> number_or(const std::string& text, const char* word, const char* option) {
    if (text == word) {
        return std::nullopt;
    }
    int value = 0;
    const auto [end, code] = std::from_chars(text.data(), text.data() + text.size(), value);
    if (code == std::errc::result_out_of_range) {
        return std::numeric_limits<int>::max();  // settings_refusal() knows the setting's range
    }
    if (code != std::errc() || end != text.data() + text.size()) {
        throw usage_error(fmt::format("{} is '{}'; give a whole number, or {}", option, text, word));
    }
    return value;
}

// Like number_or, but 0 stands for `word` in the settings and so is no number to give.
int number_or_zero(const std::string& text, const char* word, const char* option) {
    const std::optional<int> value = number_or(text, word, option);
    if (value == 0) {
        throw usage_error(fmt::format("{} is 0; give a number from 1, or {}", option, word));
    }
    return value.value_or(0);
}

// A share above 0, or auto, for which the settings have 0.
double share_or_auto(const std::string& text, const char* option) {
    if (text == "auto") {
        return 0.0;
    }
    double value = 0.0;
    const auto [end, code] = std::from_chars(text.data(), text.data() + text.size(), value);
    if (code != std::errc() || end != text.data() + text.size()) {
        throw usage_error(fmt::format("{} is '{}'; give a number, or auto", option, text));
    }
    if (value == 0.0) {
        throw usage_error(fmt::format("{} is 0; give a number above 0 to 1, or auto", option));
    }
    return value;
}

template <typename T, typename U>
void set(const std::optional<T>& given, U& setting) {
    if (given) {
        setting = *given;
    }
}

template <typename T>
void set(const std::optional<std::string>& given, const std::map<std::string, T>& names, T& setting) {
    if (given) {
        setting = names.at(*given);
    }
}

// Some layers show one light's map: there must be such a light.
void require_shown_light(const Settings& settings, const scene::Scene& scene) {
    if (!shows_light_map(settings.show)) {
        return;
    }
    const auto lights = std::count_if(
        scene.topological_order.begin(), scene.topological_order.end(),
        [&](int node) { return scene.nodes[static_cast<size_t>(node)].light != scene::k_none; });
    if (settings.shown_light >= lights) {
        throw usage_error(fmt::format("--light is {}; {} has {} lights, counted from 0", settings.shown_light,
                                      scene.name, lights));
    }
}

void throw_if_refused(const std::string& refusal) {
    if (!refusal.empty()) {
        throw usage_error(refusal);
    }
}

}  // namespace

Settings RenderOptions::settings_without_scene() const {
    Settings out = preset_settings(preset ? preset_names().at(*preset) : Preset::automatic);
    set(technique, setting_names<Technique>(), out.technique);
    set(pattern, setting_names<passes::RsmPattern>(), out.rsm_pattern);
    set(interpolate, out.interpolate);
    set(lowres, out.lowres_step);
    set(vpls, out.vpls);
    set(bounces, out.bounces);
    set(bounce_vpls, out.bounce_vpls);
    set(world_vpls, out.world_vpls);
    set(world_sampling, setting_names<WorldSampling>(), out.world_sampling);
    set(emitter_vpls, out.emitter_vpls);
    set(emitter_panels, out.emitter_panels);
    set(bounce_places, out.bounce_places);
    set(bounce_source, setting_names<BounceSource>(), out.bounce_source);
    set(avg_size, out.avg_size);
    set(avg_hits, setting_names<AvgHits>(), out.avg_hits);
    set(avg_paths, setting_names<AvgPaths>(), out.avg_paths);
    set(interleave, out.interleave);
    set(vpl_sampling, setting_names<VplSampling>(), out.vpl_sampling);
    set(vpl_importance, setting_names<Importance>(), out.vpl_importance);
    set(importance_pixels, out.importance_pixels);
    set(importance_floor, out.importance_floor);
    set(vpl_steps, out.vpl_steps);
    set(shading, setting_names<Shading>(), out.shading);
    set(simplify_error, out.simplify.error);
    set(map_projection, setting_names<MapProjection>(), out.map_projection);
    set(near_field, out.near_field);
    set(temporal_reuse, out.temporal_reuse);
    set(glossy, out.glossy_bounces);
    set(visibility, setting_names<Visibility>(), out.visibility);
    set(ism_size, out.ism_size);
    set(splat, setting_names<Splat>(), out.splat);
    set(large_triangles, out.large_triangles);
    set(hull, hull_names(), out.drop_hull);
    set(pull_push, setting_names<PullPush>(), out.pull_push);
    set(pull_push_levels, out.pull_push_levels);
    set(pull_threshold, out.pull_threshold);
    set(push_threshold, out.push_threshold);
    set(samples_a_pixel, out.samples);
    out.antialias = out.antialias && out.samples == 1;
    set(antialias, out.antialias);
    set(shadow_size, out.shadow_size);
    set(direct_shadows, setting_names<DirectShadows>(), out.direct_shadows);
    set(transparent_layers, out.transparent_layers);
    set(shadow_samples, out.shadow_samples);
    set(soft_shadow_size, out.soft_shadow_size);
    set(convolution_order, out.convolution_order);
    set(force, setting_names<Forced>(), out.forced);
    set(show, setting_names<Show>(), out.show);
    set(light, out.shown_light);
    set(vpl, out.shown_vpl);
    set(bounce, out.shown_bounce);
    // 0 is the settings' word for what a kind of shadow has by default.
    for (const auto& [name, given, least] :
         {std::tuple("--shadow-samples", shadow_samples, k_least_shadow_samples),
          std::tuple("--soft-shadow-size", soft_shadow_size, k_least_map_size)}) {
        if (given && *given == 0) {
            throw usage_error(fmt::format("{} is 0; give a number from {}", name, least));
        }
    }
    if (vpl && *vpl < 0) {
        throw usage_error(fmt::format("--vpl is {}; lights are counted from 0", *vpl));
    }
    if (bounce && *bounce < 1) {
        throw usage_error(fmt::format("--bounce is {}; bounces are counted from 1", *bounce));
    }
    if (rsm_size) {
        out.rsm_size = number_or_zero(*rsm_size, "auto", "--rsm-size");
    }
    if (simplify) {
        out.simplify.ratio = share_or_auto(*simplify, "--simplify");
    }
    if (points) {
        out.ism_points = number_or_zero(*points, "auto", "--points");
    }
    if (samples) {
        const std::optional<int> count = number_or(*samples, "all", "--rsm-samples");
        out.rsm_full_sum = !count.has_value();
        out.rsm_samples = count.value_or(out.rsm_samples);
    }
    return out;
}

void RenderOptions::check() const {
    const Settings out = settings_without_scene();
    if (!size.empty()) {
        (void)parse_size(size);
    }
    throw_if_refused(settings_refusal(out));
    throw_if_refused(option_conflict(*this, out));
    if (!automatic() && explain) {
        throw usage_error(tuning.empty()
                              ? fmt::format("--explain is of preset auto; --preset {} chooses nothing "
                                            "by the scene",
                                            *preset)
                              : std::string("--explain is of what preset auto chooses by itself; "
                                            "--tuning has the settings"));
    }
    if (machine_speed && !(budget_ms && tuning.empty())) {
        throw usage_error("--machine-speed says what a budget is worth; give --budget-ms, without --tuning");
    }
    if (const std::string refusal = layer_refusal(out); !refusal.empty()) {
        throw usage_error(fmt::format("--show {}: {}", name_of(out.show), refusal));
    }
}

bool RenderOptions::automatic() const {
    return (!preset || preset_names().at(*preset) == Preset::automatic) && tuning.empty();
}

FixedKnobs RenderOptions::fixed_knobs() const {
    FixedKnobs out;
    const auto fix = [&](bool given, std::initializer_list<Knob> knobs) {
        for (const Knob knob : knobs) {
            out.set(bit_of(knob), out.test(bit_of(knob)) || given);
        }
    };
    // Layers show what a technique makes, not only what it looks like.
    fix(technique || (show && *show != name_of(Show::shaded)), {Knob::technique});
    // Whoever turns one technique's own settings wants that technique.
    const bool of_lights = vpls || bounce_vpls || interleave || near_field || glossy || bounce_source ||
                           avg_size || avg_hits || avg_paths || vpl_sampling || vpl_importance ||
                           importance_pixels || importance_floor || vpl_steps || shading || simplify ||
                           simplify_error || visibility || ism_size || map_projection || points || splat ||
                           large_triangles || hull || pull_push || pull_push_levels || pull_threshold ||
                           push_threshold || temporal_reuse || bounces;
    fix(of_lights || bounce_places, {Knob::technique});
    fix(vpls.has_value(), {Knob::vpls});
    fix(vpl_importance || vpl_sampling || importance_pixels || importance_floor, {Knob::importance});
    fix(ism_size || map_projection || visibility || points, {Knob::ism_size});
    fix(interleave || temporal_reuse, {Knob::interleave});
    fix(antialias || samples_a_pixel, {Knob::antialias});
    fix(shadow_size.has_value(), {Knob::shadow_size});
    fix(rsm_size.has_value(), {Knob::rsm_size});
    fix(samples.has_value(), {Knob::rsm_samples});
    fix(world_vpls || world_sampling, {Knob::world_vpls});
    fix(bounce_vpls || bounce_source, {Knob::bounce_vpls});
    fix(emitter_vpls.has_value(), {Knob::emitter_vpls});
    fix(shadow_samples || direct_shadows, {Knob::shadow_samples});
    fix(soft_shadow_size || direct_shadows, {Knob::soft_shadow_size});
    return out;
}

AutoRequest RenderOptions::auto_request(const scene::Scene& scene) const {
    return {.base = typed_settings(scene),
            .fixed = fixed_knobs(),
            .budget_ms = budget_ms,
            .target_relmse = std::nullopt,
            .machine_speed = machine_speed.value_or(1.0)};
}

AutoScene RenderOptions::described(const scene::Scene& scene, const Settings& settings) const {
    return describe_scene(scene, animation_index(scene), camera, settings.width, settings.height);
}

AutoChoice RenderOptions::choice(const scene::Scene& scene, const AutoRequest& request) const {
    return choose_settings(described(scene, request.base), request);
}

Settings RenderOptions::settings(const scene::Scene& scene) const {
    return automatic() ? choice(scene, auto_request(scene)).settings : typed_settings(scene);
}

Settings RenderOptions::typed_settings(const scene::Scene& scene) const {
    Settings out = settings_without_scene();
    out.width = scene.render.width;
    out.height = scene.render.height;
    if (!size.empty()) {
        std::tie(out.width, out.height) = parse_size(size);
    }
    require_shown_light(out, scene);
    if (out.technique == Technique::ism && out.bounces > 1) {
        const scene::SceneFeatures features = scene::scene_features(scene);
        if (features.triangles > 0 && !features.reflects) {
            throw usage_error(fmt::format(
                "--bounces is {}, but no surface of {} reflects light: every base colour is black",
                out.bounces, scene.name));
        }
    }
    return out;
}

int RenderOptions::animation_index(const scene::Scene& scene) const {
    if (animation.empty()) {
        return scene::default_animation(scene);
    }
    const auto found = std::find_if(scene.animations.begin(), scene.animations.end(),
                                    [&](const scene::Animation& clip) { return clip.name == animation; });
    if (found == scene.animations.end()) {
        throw usage_error(
            fmt::format("{} has no animation named {}; bounce info lists them", scene.name, animation));
    }
    return static_cast<int>(found - scene.animations.begin());
}

void require_within(const gl::DeviceLimits& limits, const Settings& settings) {
    throw_if_refused(limits_refusal(settings, limits));
}

}  // namespace bounce::cli
