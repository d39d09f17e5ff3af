// SPDX-License-Identifier: Apache-2.0
#include "cli/render_options.h"

#include <algorithm>
#include <charconv>
#include <map>

#include <fmt/format.h>

#include "cli/frame_list.h"
#include "core/error.h"
#include "scene/pose.h"

namespace bounce::cli {
namespace {

const std::map<std::string, Technique> k_techniques = {
    {"direct", Technique::direct}, {"rsm", Technique::rsm}, {"ism", Technique::ism}};

const std::map<std::string, Visibility> k_visibilities = {
    {"none", Visibility::none}, {"ism", Visibility::ism}, {"shadow-maps", Visibility::shadow_maps}};

const std::map<std::string, Splat> k_splats = {
    {"disks", Splat::disks}, {"compute", Splat::compute}, {"points", Splat::points}};

const std::map<std::string, PullPush> k_pull_push = {
    {"off", PullPush::off}, {"fill", PullPush::fill}, {"paper", PullPush::paper}};

const std::map<std::string, passes::RsmPattern> k_patterns = {
    {"inverse-square", passes::RsmPattern::inverse_square},
    {"uniform-radius", passes::RsmPattern::uniform_radius},
    {"paper-literal", passes::RsmPattern::paper_literal}};

const std::map<std::string, Show> k_shows = {{"shaded", Show::shaded},
                                             {"direct", Show::direct},
                                             {"indirect", Show::indirect},
                                             {"rsm-depth", Show::rsm_depth},
                                             {"rsm-position", Show::rsm_position},
                                             {"rsm-normal", Show::rsm_normal},
                                             {"rsm-flux", Show::rsm_flux},
                                             {"interpolation", Show::interpolation}};

template <typename T>
CLI::IsMember one_of(const std::map<std::string, T>& names) {
    return CLI::IsMember(&names);
}

// The rsm- layers show one light's map: there must be such a light, and maps at all.
void require_shown_map(const RenderOptions& options, const Settings& settings, const scene::Scene& scene) {
    if (!options.show.starts_with("rsm-")) {
        return;
    }
    if (settings.technique != Technique::rsm) {
        throw usage_error(fmt::format("--show {} needs --technique rsm", options.show));
    }
    const auto lights = std::count_if(
        scene.topological_order.begin(), scene.topological_order.end(),
        [&](int node) { return scene.nodes[static_cast<size_t>(node)].light != scene::k_none; });
    if (options.light >= lights) {
        throw usage_error(fmt::format("--light is {}; {} has {} lights, counted from 0", options.light,
                                      scene.name, lights));
    }
}

// One dispatch gathers them all; llvmpipe ends a loop after 65,535 iterations.
constexpr int k_most_samples = 1 << 15;

}  // namespace

void RenderOptions::add_to(CLI::App& command) {
    command.add_option("--size", size,
                       "Width and height in pixels, such as 640x360; the scene's own by default");
    command.add_option("--camera", camera, "Camera node by name; the scene's active camera by default");
    command.add_option("--animation", animation, "Animation clip by name");
    command
        .add_option("--technique", technique,
                    "Light transport: direct, or rsm for one bounce by reflective shadow maps")
        ->check(one_of(k_techniques))
        ->capture_default_str();
    command
        .add_option("--rsm-samples", samples,
                    "Pixel lights gathered at a pixel, over all lights; or all, for every texel")
        ->capture_default_str();
    command.add_option("--rsm-pattern", pattern, "How the gather's samples are spread")
        ->check(one_of(k_patterns))
        ->capture_default_str();
    command
        .add_option("--rsm-interpolation", interpolate,
                    "on or off: gather at low resolution and interpolate where the surface allows it")
        ->transform(CLI::CheckedTransformer(std::map<std::string, bool>{{"on", true}, {"off", false}}));
    command.add_option("--rsm-lowres", lowres, "The low-resolution gather takes one pixel in N x N")
        ->check(CLI::Range(2, 64))
        ->capture_default_str();
    command
        .add_option("--rsm-size", rsm_size,
                    "Side of a reflective shadow map in texels; half of it for a cube's faces")
        ->capture_default_str();
    command.add_option("--vpls", vpls, "Virtual point lights");
    command.add_option("--visibility", visibility, "How virtual point lights are occluded")
        ->check(one_of(k_visibilities));
    command.add_option("--ism-size", ism_size, "Side of an imperfect shadow map in texels");
    command.add_option("--points", points, "Points splatted into each imperfect shadow map");
    command.add_option("--near-field", near_field, "on or off")
        ->transform(CLI::CheckedTransformer(std::map<std::string, bool>{{"on", true}, {"off", false}}));
    command.add_option("--glossy-bounces", glossy_bounces, "on or off")
        ->transform(CLI::CheckedTransformer(std::map<std::string, bool>{{"on", true}, {"off", false}}));
    command.add_option("--bounces", bounces, "bounces");
    command.add_option("--bounce-vpls", bounce_vpls, "of each further bounce");
    command.add_option("--splat", splat, "splat")->check(one_of(k_splats));
    command.add_option("--pull-push", pull_push, "pull push")->check(one_of(k_pull_push));
    command.add_flag("!--no-large-triangles", large_triangles, "");
    command.add_flag("--splat-irsms", splat_irsms, "");
    command.add_flag("!--keep-hull", drop_hull, "");
    command.add_option("--interleave", interleave, "n x n");
    command
        .add_option("--shadow-size", shadow_size,
                    "Side of a shadow map in texels; half of it for a cube's faces")
        ->check(CLI::Range(2, 16384))
        ->capture_default_str();
    command.add_option("--antialias", antialias, "on or off: smooth outlines as Cycles' pixel filter does")
        ->transform(CLI::CheckedTransformer(std::map<std::string, bool>{{"on", true}, {"off", false}}));
    command.add_option("--show", show, "What the picture shows")
        ->check(one_of(k_shows))
        ->capture_default_str();
    command.add_option("--light", light, "Which light's map the rsm- layers show, from 0")
        ->check(CLI::Range(0, 100000));
}

Settings RenderOptions::settings(const scene::Scene& scene) const {
    Settings out;
    out.width = scene.render.width;
    out.height = scene.render.height;
    if (!size.empty()) {
        std::tie(out.width, out.height) = parse_size(size);
    }
    out.technique = k_techniques.at(technique);
    out.rsm_pattern = k_patterns.at(pattern);
    out.show = k_shows.at(show);
    out.shown_light = light;
    out.interpolate = interpolate;
    out.lowres_step = lowres;
    out.rsm_size = rsm_size;
    out.vpls = vpls;
    out.visibility = k_visibilities.at(visibility);
    out.ism_size = ism_size;
    out.ism_points = points;
    out.interleave = interleave;
    out.near_field = near_field;
    out.bounces = bounces;
    out.bounce_vpls = bounce_vpls;
    out.splat = k_splats.at(splat);
    out.pull_push = k_pull_push.at(pull_push);
    out.large_triangles = large_triangles;
    out.drop_hull = drop_hull;
    out.splat_irsms = splat_irsms;
    out.glossy_bounces = glossy_bounces;
    out.antialias = antialias;
    out.shadow_size = shadow_size;
    require_shown_map(*this, out, scene);
    if (samples == "all") {
        out.rsm_full_sum = true;
        return out;
    }
    const auto [end, code] =
        std::from_chars(samples.data(), samples.data() + samples.size(), out.rsm_samples);
    if (code != std::errc() || end != samples.data() + samples.size() || out.rsm_samples < 1 ||
        out.rsm_samples > k_most_samples) {
        throw usage_error(fmt::format("--rsm-samples is '{}'; give a number from 1 to {}, or all", samples,
                                      k_most_samples));
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

}  // namespace bounce::cli
