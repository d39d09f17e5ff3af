// SPDX-License-Identifier: Apache-2.0
#include "cli/option_conflicts.h"

#include <initializer_list>
#include <utility>

#include <fmt/format.h>

#include "renderer/setting_names.h"

namespace bounce::cli {
namespace {

// An option's name and whether it was given.
using Given = std::pair<const char*, bool>;

const char* first_given(std::initializer_list<Given> options) {
    for (const auto& [name, given] : options) {
        if (given) {
            return name;
        }
    }
    return nullptr;
}

// Options of technique rsm alone.
const char* gather_option(const RenderOptions& o) {
    return first_given({{"--rsm-samples", o.samples.has_value()},
                        {"--rsm-pattern", o.pattern.has_value()},
                        {"--rsm-interpolation", o.interpolate.has_value()},
                        {"--rsm-lowres", o.lowres.has_value()}});
}

// Options of how imperfect shadow maps are drawn.
const char* splat_option(const RenderOptions& o) {
    return first_given({{"--points", o.points.has_value()},
                        {"--splat", o.splat.has_value()},
                        {"--large-triangles", o.large_triangles.has_value()},
                        {"--hull", o.hull.has_value()},
                        {"--pull-push", o.pull_push.has_value()},
                        {"--pull-push-levels", o.pull_push_levels.has_value()},
                        {"--pull-threshold", o.pull_threshold.has_value()},
                        {"--push-threshold", o.push_threshold.has_value()}});
}

const char* bounce_option(const RenderOptions& o) {
    return first_given(
        {{"--bounce-vpls", o.bounce_vpls.has_value()}, {"--bounce-source", o.bounce_source.has_value()}});
}

// Options of the approximate visibility grid.
const char* avg_option(const RenderOptions& o) {
    return first_given({{"--avg-size", o.avg_size.has_value()},
                        {"--avg-hits", o.avg_hits.has_value()},
                        {"--avg-paths", o.avg_paths.has_value()}});
}

// Imperfect maps of lights with a size are drawn as those of virtual point lights are, in any technique.
const char* vpl_option(const RenderOptions& o, const Settings& s) {
    const char* maps = first_given({{"--visibility", o.visibility.has_value()},
                                    {"--ism-size", o.ism_size.has_value()},
                                    {"--map-projection", o.map_projection.has_value()}});
    const char* lights = first_given({{"--vpls", o.vpls.has_value()},
                                      {"--bounces", o.bounces.has_value()},
                                      {"--interleave", o.interleave.has_value()},
                                      {"--vpl-sampling", o.vpl_sampling.has_value()},
                                      {"--vpl-importance", o.vpl_importance.has_value()},
                                      {"--importance-pixels", o.importance_pixels.has_value()},
                                      {"--importance-floor", o.importance_floor.has_value()},
                                      {"--vpl-steps", o.vpl_steps.has_value()},
                                      {"--shading", o.shading.has_value()},
                                      {"--simplify", o.simplify.has_value()},
                                      {"--simplify-error", o.simplify_error.has_value()},
                                      {"--near-field", o.near_field.has_value()},
                                      {"--glossy", o.glossy.has_value()}});
    const char* splats = s.direct_shadows == DirectShadows::ism ? nullptr : splat_option(o);
    for (const char* option : {lights, maps, splats, bounce_option(o), avg_option(o)}) {
        if (option != nullptr) {
            return option;
        }
    }
    return nullptr;
}

std::string technique_conflict(const RenderOptions& o, const Settings& s) {
    if (o.technique && o.preset && *o.preset != "auto") {
        return fmt::format("--technique and --preset {} both choose the technique; give one of them",
                           *o.preset);
    }
    if (const char* option = vpl_option(o, s); option != nullptr && s.technique != Technique::ism) {
        return fmt::format("{} is of virtual point lights, which technique {} does not have", option,
                           name_of(s.technique));
    }
    if (const char* option = gather_option(o); option != nullptr && s.technique != Technique::rsm) {
        return fmt::format("{} has no effect with technique {}; it is an option of --technique rsm", option,
                           name_of(s.technique));
    }
    return {};
}

std::string bounce_conflict(const RenderOptions& o, const Settings& s) {
    if (o.bounce_places.value_or(1) > 1 && s.technique == Technique::direct) {
        return "--bounce-places has no effect with --technique direct, which draws no bounced light";
    }
    return {};
}

std::string shadow_conflict(const RenderOptions& o, const Settings& s) {
    const char* option = first_given({{"--shadow-samples", o.shadow_samples.has_value()},
                                      {"--soft-shadow-size", o.soft_shadow_size.has_value()}});
    if (option != nullptr && s.direct_shadows == DirectShadows::hard) {
        return fmt::format("{} has no effect with hard shadows; give --direct-shadows vpl", option);
    }
    if (o.shadow_samples && s.direct_shadows == DirectShadows::convolution) {
        return "--shadow-samples has no effect with --direct-shadows convolution, which has one map a light";
    }
    if (o.convolution_order && s.direct_shadows != DirectShadows::convolution) {
        return fmt::format(
            "--convolution-order has no effect with --direct-shadows {}; give --direct-shadows convolution",
            name_of(s.direct_shadows));
    }
    return {};
}

std::string avg_conflict(const RenderOptions& o, const Settings& s) {
    if (s.technique != Technique::ism) {
        return {};
    }
    if (const char* option = avg_option(o); option != nullptr && !s.uses_avg()) {
        return fmt::format(
            "{} has no effect without the approximate visibility grid; give --bounce-source avg, or "
            "--vpl-sampling avg",
            option);
    }
    if (o.avg_paths && s.bounces == 1 && s.world_vpls == 0 && s.emitter_vpls == 0) {
        return "--avg-paths is of further bounces; give --bounces 2 or more";
    }
    if (o.near_field.value_or(false) && s.traces_first()) {
        return "--near-field on gathers from reflective shadow maps, which --vpl-sampling avg does without";
    }
    return {};
}

// Options of how the first bounce's lights are drawn that are not used.
std::string sampling_conflict(const RenderOptions& o, const Settings& s) {
    if (o.world_sampling && s.world_vpls == 0) {
        return "--world-sampling has no effect with --world-vpls 0";
    }
    if (s.technique != Technique::ism) {
        return {};
    }
    if (o.vpl_steps && !passes::is_chain(s.vpl_sampling)) {
        return fmt::format("--vpl-steps has no effect with --vpl-sampling {}, which runs no chains",
                           name_of(s.vpl_sampling));
    }
    const bool drawn = s.vpl_sampling != VplSampling::uniform && s.vpl_sampling != VplSampling::uniform3 &&
                       s.vpl_sampling != VplSampling::avg;
    const bool world = s.world_sampling == WorldSampling::drawn && s.world_vpls > 0;
    if (o.vpl_importance && !drawn && !world && s.show != Show::importance) {
        return fmt::format("--vpl-importance has no effect with --vpl-sampling {}, which does not ask for it",
                           name_of(s.vpl_sampling));
    }
    const char* option = first_given({{"--importance-pixels", o.importance_pixels.has_value()},
                                      {"--importance-floor", o.importance_floor.has_value()}});
    if (option != nullptr && s.vpl_importance == Importance::flux) {
        return fmt::format("{} has no effect with importance by flux; give --vpl-importance view", option);
    }
    return {};
}

std::string emitter_conflict(const RenderOptions& o, const Settings& s) {
    if (o.emitter_panels.value_or(0) > 0 && s.emitter_vpls == 0) {
        return "--emitter-panels has no effect with --emitter-vpls 0, where emissive surfaces light nothing";
    }
    return {};
}

std::string map_conflict(const RenderOptions& o, const Settings& s) {
    const char* splats = s.direct_shadows == DirectShadows::ism ? nullptr : splat_option(o);
    const char* maps = o.ism_size ? "--ism-size" : splats;
    if (s.visibility == Visibility::none && maps != nullptr) {
        return fmt::format(
            "{} has no effect with --visibility none, which draws no shadow maps of virtual point lights",
            maps);
    }
    if (s.draws_triangle_maps() && splats != nullptr) {
        return fmt::format("{} has no effect with --visibility {}, which draws triangles, not points", splats,
                           name_of(s.visibility));
    }
    if (!s.draws_triangle_maps() && o.map_projection) {
        return fmt::format(
            "--map-projection has no effect with --visibility {}; it is an option of --visibility "
            "shadow-maps "
            "and simplified",
            name_of(s.visibility));
    }
    const char* simplify = first_given(
        {{"--simplify", o.simplify.has_value()}, {"--simplify-error", o.simplify_error.has_value()}});
    if (simplify != nullptr && !s.simplifies()) {
        return fmt::format(
            "{} has no effect without simplified meshes; give --visibility simplified or --shading hybrid",
            simplify);
    }
    return {};
}

// Of how points are splatted.
std::string splat_conflict(const RenderOptions& o, const Settings& s) {
    const bool disks = s.splat == Splat::disks;
    if (!disks && o.large_triangles) {
        return fmt::format(
            "--large-triangles has no effect with --splat {}; it is an option of --splat disks",
            name_of(s.splat));
    }
    const char* pull_push =
        first_given({{"--pull-push", o.pull_push.has_value() && s.pull_push != PullPush::off},
                     {"--pull-push-levels", o.pull_push_levels.has_value()},
                     {"--pull-threshold", o.pull_threshold.has_value()},
                     {"--push-threshold", o.push_threshold.has_value()}});
    if (pull_push != nullptr && disks) {
        return fmt::format("{} needs --splat compute, points or tessellation: disks are drawn without it",
                           pull_push);
    }
    if (pull_push != nullptr && s.pull_push == PullPush::off) {
        return fmt::format("{} has no effect with --pull-push off", pull_push);
    }
    if (o.push_threshold && s.pull_push == PullPush::fill) {
        return "--push-threshold needs --pull-push paper: fill replaces no depth that is there";
    }
    return {};
}

// Options of layers that are not the one shown.
std::string layer_conflict(const RenderOptions& o, const Settings& s) {
    const auto unused = [&](const char* option, const char* layers) {
        return fmt::format("{} has no effect with --show {}; it is an option of {}", option, name_of(s.show),
                           layers);
    };
    if (o.light && !shows_light_map(s.show)) {
        return unused("--light", "the rsm- layers and importance");
    }
    if (o.vpl && !shows_vpl_maps(s.show)) {
        return unused("--vpl", "--show ism, ism-splats and vpl-visibility");
    }
    if (o.bounce && !shows_vpl_maps(s.show) && s.show != Show::vpls) {
        return unused("--bounce", "--show vpls, ism, ism-splats and vpl-visibility");
    }
    return {};
}

// Light of the frames before.
std::string reuse_conflict(const RenderOptions& o, const Settings& s) {
    if (!o.temporal_reuse || !*o.temporal_reuse) {
        return {};
    }
    if (s.technique != Technique::ism) {
        return fmt::format(
            "--temporal-reuse on has no effect with technique {}; it is an option of --technique ism",
            name_of(s.technique));
    }
    if (s.samples > 1) {
        return "--temporal-reuse on cannot go with --samples, whose frames look at other places of their "
               "pixels";
    }
    if (s.shading == Shading::hybrid) {
        return "--temporal-reuse on cannot go with --shading hybrid: what simplified meshes show is not "
               "followed";
    }
    if (s.interleave == 1) {
        return "--temporal-reuse on needs --interleave 2 or more: the interleaved pixels say how far lights "
               "may "
               "differ";
    }
    if (s.show != Show::shaded && s.show != Show::indirect && s.show != Show::vpls) {
        return fmt::format(
            "--temporal-reuse on has no effect with --show {}, which shows one frame's own data",
            name_of(s.show));
    }
    return {};
}

// Options beside several samples a pixel.
std::string samples_conflict(const RenderOptions& o, const Settings& s) {
    if (s.samples == 1) {
        return {};
    }
    if (o.antialias && *o.antialias) {
        return "--antialias on would smooth outlines twice: --samples does so by the same filter";
    }
    if (!shows_light(s.show)) {
        return fmt::format(
            "--samples takes means of light; --show {} shows data, of which a mean says nothing",
            name_of(s.show));
    }
    return {};
}

}  // namespace

std::string option_conflict(const RenderOptions& o, const Settings& s) {
    for (std::string conflict : {technique_conflict(o, s), shadow_conflict(o, s), avg_conflict(o, s),
                                 emitter_conflict(o, s), bounce_conflict(o, s), sampling_conflict(o, s),
                                 layer_conflict(o, s), samples_conflict(o, s), reuse_conflict(o, s)}) {
        if (!conflict.empty()) {
            return conflict;
        }
    }
    if (s.rsm_full_sum && (o.pattern || (o.interpolate && *o.interpolate) || o.lowres)) {
        return "--rsm-samples all evaluates every texel in every pixel: without a pattern and without "
               "interpolation";
    }
    if (o.lowres && !s.interpolate) {
        return "--rsm-lowres has no effect with --rsm-interpolation off";
    }
    if (s.technique != Technique::ism) {
        return splat_conflict(o, s);
    }
    // The world's light and that of emissive surfaces has its lights first, and then bounces.
    const bool bounces = s.bounces > 1 || s.world_vpls > 0 || s.emitter_vpls > 0;
    if (const char* option = bounce_option(o); option != nullptr && !bounces) {
        return fmt::format("{} is of further bounces; give --bounces 2 or more", option);
    }
    const std::string conflict = map_conflict(o, s);
    return conflict.empty() ? splat_conflict(o, s) : conflict;
}

}  // namespace bounce::cli
