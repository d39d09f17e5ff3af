// SPDX-License-Identifier: Apache-2.0
//
// The options of RenderOptions as --help has them, group by group.
#include "cli/render_option_groups.h"

#include <map>
#include <string>
#include <utility>

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include "cli/render_options.h"
#include "renderer/presets.h"
#include "renderer/setting_names.h"
#include "renderer/settings_check.h"

namespace bounce::cli {
namespace {

// A number above 0 and at most `most`; others are refused in words.
CLI::Validator above_zero(double most) {
    return CLI::Validator(
        [most](const std::string& text) {
            double value = 0.0;
            const bool number = CLI::detail::lexical_cast(text, value);
            return number && value > 0.0 && value <= most
                       ? std::string()
                       : fmt::format("{} is no number above 0 and up to {:g}", text, most);
        },
        "ABOVE 0");
}

// Options that take one of a few names, or on and off, in a group of the help.
class Group {
  public:
    Group(CLI::App& command, std::string name) : command_(command), name_(std::move(name)) {}

    template <typename T>
    CLI::Option* number(const char* option, T& value, const std::string& text, const std::string& standard) {
        return command_.add_option(option, value, text)->default_str(standard)->group(name_);
    }
    template <typename T>
    void one_of(const char* option, std::optional<std::string>& value, const std::map<std::string, T>& names,
                const std::string& text, const std::string& standard) {
        number(option, value, text, standard)->check(CLI::IsMember(&names));
    }
    void on_off(const char* option, std::optional<bool>& value, const std::string& text,
                const std::string& standard = "on") {
        number(option, value, text, standard)->type_name("TEXT")->check(CLI::IsMember({"off", "on"}));
    }

  private:
    CLI::App& command_;
    std::string name_;
};

void add_rsm_options(CLI::App& command, RenderOptions& o) {
    const Settings d;
    Group group(command, k_rsm_group);
    group.number("--rsm-size", o.rsm_size,
                 "Side of a reflective shadow map in texels, half of it for a cube's faces; or auto: 512 for "
                 "technique rsm, 256 for ism",
                 "auto");
    group.number("--rsm-samples", o.samples,
                 "Technique rsm: pixel lights gathered at a pixel, over all lights; or all, for every texel",
                 std::to_string(d.rsm_samples));
    group.one_of("--rsm-pattern", o.pattern, setting_names<passes::RsmPattern>(),
                 "Technique rsm: how the gather's samples are spread", name_of(d.rsm_pattern));
    group.on_off(
        "--rsm-interpolation", o.interpolate,
        "Technique rsm: the gather is done at low resolution and interpolated where the surface allows it");
    group.number("--rsm-lowres", o.lowres,
                 "Technique rsm: the low-resolution gather takes one pixel in N x N, 2 to 64",
                 std::to_string(d.lowres_step));
}

void add_vpl_options(CLI::App& command, RenderOptions& o) {
    const Settings d;
    Group group(command, k_vpl_group);
    group.number("--vpls", o.vpls,
                 fmt::format("Virtual point lights of the first bounce, 1 to {}; rounded up to whole "
                             "interleaved blocks",
                             k_most_vpls),
                 std::to_string(d.vpls));
    group.number("--bounces", o.bounces, "Bounces of light, 1 to 4", std::to_string(d.bounces));
    group.number("--bounce-vpls", o.bounce_vpls,
                 fmt::format("Virtual point lights of each further bounce, 1 to {}", k_most_vpls),
                 std::to_string(d.bounce_vpls));
    group.one_of("--bounce-source,--bounces-by", o.bounce_source, setting_names<BounceSource>(),
                 "What lights of further bounces are drawn from: points that the bounce before lights; irsm: "
                 "these points splatted into imperfect reflective shadow maps, as in the 2008 paper; avg: "
                 "where rays from the lights before meet the approximate visibility grid, as in the 2012 "
                 "paper",
                 name_of(d.bounce_source));
    group.number("--avg-size", o.avg_size,
                 fmt::format("Voxels of that grid along the scene's longest side, {} to {}", k_least_avg_size,
                             k_most_avg_size),
                 std::to_string(d.avg_size));
    group.one_of("--avg-hits", o.avg_hits, setting_names<AvgHits>(),
                 "Where a ray through it ends: slabs: where it enters what bounds a voxel's surface; voxels: "
                 "in the first voxel that holds one, some way into it, as in the 2012 paper",
                 name_of(d.avg_hits));
    group.one_of("--avg-paths", o.avg_paths, setting_names<AvgPaths>(),
                 "How rays of a bounce are shared out among the lights before: roulette: by what they "
                 "reflect; fixed: evenly, each weighed by what its light reflects",
                 name_of(d.avg_paths));
    group.one_of(
        "--vpl-sampling", o.vpl_sampling, setting_names<VplSampling>(),
        "How those of the first bounce are drawn from the reflective shadow maps: one for each cell of "
        "equal flux, or texels at the points of the Halton sequence, as in the 2009 paper; avg: without "
        "these maps, where rays from the lights meet the approximate visibility grid, as in the 2012 paper; "
        "the others choose texels of all lights as in the 2013 paper: evenly with three numbers, by inverse "
        "transform with two or three, by Metropolis' chains weighed as the paper does, by their first "
        "proposal or with their start-up bias, or by chains that resample",
        name_of(d.vpl_sampling));
    group.one_of(
        "--vpl-importance", o.vpl_importance, setting_names<Importance>(),
        "What these are drawn by: the flux that a texel reflects, or what the view shows of it, "
        "unhidden, as in the 2013 paper; preset auto takes the view where it shows little of what is lit",
        name_of(d.vpl_importance));
    group.number("--importance-pixels", o.importance_pixels,
                 "Pixels that the view is judged by, per cent of the picture's, above 0 to 10; at least 64 "
                 "of them and at most 16,384",
                 fmt::format("{:g}", d.importance_pixels));
    group.number("--importance-floor", o.importance_floor,
                 "What a light counts for at least there, of what it would show on white across the whole "
                 "scene, 0 to 1; with 0 what no pixel of these shows is never drawn, as in the paper",
                 fmt::format("{:g}", d.importance_floor));
    group.number(
        "--vpl-steps", o.vpl_steps,
        fmt::format("Proposals of each chain of Metropolis' and resampling, 1 to {}", k_most_vpl_steps),
        std::to_string(d.vpl_steps));
    group.one_of(
        "--shading", o.shading, setting_names<Shading>(),
        "Bounced light is gathered on what the camera sees, or, as by the 2009 paper's hybrid method, on "
        "what it would see of the simplified meshes",
        name_of(d.shading));
    group.number(
        "--simplify", o.simplify,
        fmt::format("Share of their triangles that simplified meshes keep, above 0 to 1; or auto: what "
                    "leaves the scene {} triangles",
                    scene::k_simplified_triangles),
        "auto");
    group.number("--simplify-error", o.simplify_error,
                 "How far their surface may move, as a part of a mesh's extent, above 0 to 1",
                 fmt::format("{:g}", d.simplify.error));
    group.number(
        "--interleave", o.interleave,
        "1, 2, 4, 8 or 16: of N x N neighbouring pixels each gathers from another part of the lights",
        std::to_string(d.interleave));
    group.on_off(
        "--temporal-reuse", o.temporal_reuse,
        "Bounced light is a running mean over consecutive frames, where the frame before saw the same "
        "surface under the same lights: a frame then depends on those before it",
        "off");
    group.on_off("--near-field", o.near_field,
                 "Light from surfaces nearer than a virtual point light can stand for is gathered from the "
                 "reflective shadow maps");
    group.on_off("--glossy", o.glossy, "Glossy lobes of virtual point lights and of what they light");
}

void add_ism_options(CLI::App& command, RenderOptions& o) {
    const Settings d;
    Group group(command, k_ism_group);
    group.one_of("--visibility", o.visibility, setting_names<Visibility>(),
                 "What hides them: nothing, imperfect shadow maps of points, maps drawn from triangles "
                 "(the reference; slow), or maps of simplified meshes",
                 name_of(d.visibility));
    group.one_of("--map-projection", o.map_projection, setting_names<MapProjection>(),
                 "Maps drawn from triangles: through five faces of a cube, which is exact, or once by the "
                 "paraboloid's own projection, which bends edges, as in the 2009 paper",
                 name_of(d.map_projection));
    group.number("--ism-size", o.ism_size,
                 "Side of each map in texels: 32, 64, 128 or 256; also 512 or 1024 where it is drawn from "
                 "triangles",
                 std::to_string(d.ism_size));
    group.number("--points", o.points,
                 fmt::format("Points splatted into each map, 1 to {}; or auto: by the maps' size and the "
                             "scene's depth complexity",
                             k_most_points_a_map),
                 "auto");
    group.one_of(
        "--splat", o.splat, setting_names<Splat>(),
        "How: oriented disks with the plane's depth at each texel; squares of one depth in a compute "
        "shader; the same as GL_POINTS, as in the 2008 paper; the same of points that tessellation makes on "
        "the triangles (Barak et al. 2013); or auto: compute or tessellation, by the counts of triangles "
        "and splats",
        name_of(d.splat));
    group.on_off("--large-triangles", o.large_triangles,
                 "With disks, triangles that would take many points are drawn as triangles");
    group.one_of("--hull", o.hull, hull_names(),
                 "Surfaces on the scene's convex hull, which hide nothing from anything: drop or splat them",
                 "drop");
    group.one_of(
        "--pull-push", o.pull_push, setting_names<PullPush>(),
        "After squares: leave holes, fill them, or also replace what lies far behind what fills them, "
        "as in the 2008 paper",
        name_of(d.pull_push));
    group.number("--pull-push-levels", o.pull_push_levels, "Levels of its pyramid, 1 to 3",
                 std::to_string(d.pull_push_levels));
    group.number("--pull-threshold", o.pull_threshold,
                 "Depths that differ by less are averaged, as a part of the scene's extent, 0 to 1",
                 fmt::format("{:g}", d.pull_threshold));
    group.number("--push-threshold", o.push_threshold,
                 "Pull-push paper: depths that lie farther behind are replaced, as a part of the scene's "
                 "extent, 0 to 1",
                 fmt::format("{:g}", d.push_threshold));
}

void add_layer_options(CLI::App& command, RenderOptions& o) {
    Group group(command, "What the picture shows");
    group.one_of(
        "--show,--layer", o.show, setting_names<Show>(),
        "The picture, a part of its light, or what is inside: rsm- a light's reflective shadow map; vpls the "
        "virtual point lights; ism their shadow maps, ism-splats before pull-push; vpl-visibility what one "
        "of "
        "them lights and what its map hides; unblurred indirect light before the blur; removed what bounding "
        "the lights' kernels takes away; interpolation where technique rsm gathered in full",
        "shaded");
    group.number("--light", o.light, "Whose map the rsm- layers show, counted from 0", "0")
        ->check(CLI::Range(0, 100000));
    group.number("--vpl", o.vpl,
                 "Whose map the layers ism, ism-splats and vpl-visibility show, counted from 0",
                 "all, the first");
    group.number("--bounce", o.bounce, "Of which bounce the lights are that a layer shows, counted from 1",
                 "all, the first");
}

}  // namespace

const std::map<std::string, bool>& hull_names() {
    static const std::map<std::string, bool> names = {{"drop", true}, {"splat", false}};
    return names;
}

void RenderOptions::add_to(CLI::App& command) {
    command.add_option("--size", size,
                       "Width and height in pixels, such as 640x360; the scene's own by default");
    command.add_option("--camera", camera, "Camera node by name; the scene's active camera by default");
    command.add_option("--animation", animation, "Animation clip by name");
    Group group(command, k_light_transport_group);
    group.one_of(
        "--technique", technique, setting_names<Technique>(),
        "direct light only; rsm: one bounce gathered from reflective shadow maps, which nothing hides; ism: "
        "bounces by virtual point lights with imperfect shadow maps",
        name_of(Settings{}.technique));
    group.one_of(
        "--preset", preset, preset_names(),
        "Settings that belong together, from which single options may differ: auto chooses by the scene "
        "(--explain says what), the others are as in the papers",
        "auto");
    group.number(
        "--world-vpls", world_vpls,
        fmt::format(
            "Lights at infinity that stand for the world's light, each with an imperfect shadow map, in any "
            "technique, 0 to {}; 0: it reaches every surface as if nothing stood in its way, and does "
            "not bounce",
            k_most_vpls),
        std::to_string(Settings{}.world_vpls));
    group.one_of("--world-sampling", world_sampling, setting_names<WorldSampling>(),
                 "How these are chosen: one for each part of the world's image, or evenly where it has none; "
                 "drawn: from cells of the sphere, as --vpl-sampling and --vpl-importance draw those of a "
                 "first bounce from texels",
                 name_of(Settings{}.world_sampling));
    group.number(
        "--emitter-vpls", emitter_vpls,
        fmt::format("Virtual point lights that stand for emissive surfaces, each with a shadow map, in any "
                    "technique, 0 to {}; 0: what emits is seen but lights nothing",
                    k_most_vpls),
        std::to_string(Settings{}.emitter_vpls));
    group.number(
        "--emitter-panels", emitter_panels,
        fmt::format(
            "Sides of flat rectangles that emit evenly, those with the most light, which are drawn as "
            "area lights instead, 0 to {}",
            k_most_emitter_panels),
        std::to_string(Settings{}.emitter_panels));
    group.number(
        "--bounce-places", bounce_places,
        fmt::format(
            "Places on a large area light that its bounced light starts from, with a reflective shadow "
            "map each, 1 to {}, a power of two; 1: its centre",
            k_most_bounce_places),
        std::to_string(Settings{}.bounce_places));
    group.number("--shadow-size", shadow_size,
                 "Side of a light's shadow map in texels, 2 to 16384; half of it for a cube's faces",
                 std::to_string(Settings{}.shadow_size));
    group.one_of(
        "--direct-shadows", direct_shadows, setting_names<DirectShadows>(),
        "Shadows of lights with a size: hard, from the light's centre; vpl: soft, from many places on "
        "it, with a shadow map each; convolution: soft, from one map of the centre, approximated; ism: soft, "
        "from many places with an imperfect shadow map each, approximated",
        name_of(Settings{}.direct_shadows));
    const Settings imperfect{.direct_shadows = DirectShadows::ism};
    group.number("--transparent-layers", transparent_layers,
                 fmt::format("Blended surfaces that a pixel shows at most, from the camera on, 0 to {}; 0: "
                             "cut out at one half",
                             k_most_transparent_layers),
                 std::to_string(Settings{}.transparent_layers));
    group.number("--shadow-samples", shadow_samples,
                 fmt::format("Soft shadows: places on a light, {} to {}, with imperfect maps to {}, a power "
                             "of two",
                             k_least_shadow_samples, k_most_shadow_samples, k_most_imperfect_samples),
                 fmt::format("{}, with imperfect maps {}", Settings{}.used_shadow_samples(),
                             imperfect.used_shadow_samples()));
    group.number(
        "--soft-shadow-size", soft_shadow_size,
        fmt::format("Soft shadows: side of the map at each of them in texels, 2 to 16384; half of it for a "
                    "cube's faces; of an imperfect one a power of two, {} to {}",
                    k_least_ism_size, k_most_ism_size),
        fmt::format("{}, of an imperfect one {}", Settings{}.used_soft_shadow_size(),
                    imperfect.used_soft_shadow_size()));
    group.number(
        "--convolution-order", convolution_order,
        fmt::format("Convolution shadows: terms of the Fourier series of a depth comparison, 1 to {}",
                    k_most_convolution_order),
        std::to_string(Settings{}.convolution_order));
    const char* measured = "Settings by a budget (preset auto)";
    command
        .add_option(
            "--budget-ms", budget_ms,
            "The best settings for so many milliseconds a frame, by curves measured on other scenes; with "
            "--tuning by those of this one")
        ->check(above_zero(1e9))
        ->group(measured);
    command
        .add_option("--tuning", tuning,
                    "The file tuning.json that bounce evaluate writes of a scene, for --budget-ms")
        ->group(measured);
    command
        .add_option(
            "--machine-speed", machine_speed,
            "How many times as fast this machine is as the one that auto's times are of (docs/auto.md), "
            "for --budget-ms: the same settings again. Without it a few frames on trial tell")
        ->check(CLI::PositiveNumber)
        ->group(measured);
    command.add_flag("--explain", explain, "Says in words what preset auto has chosen, and why")
        ->group(measured);
    group.one_of(
        "--force", force, setting_names<Forced>(),
        "Do what the scene does not need, to see what leaving it out saves: exact, all that leaves the "
        "picture the same to the bit; all, estimates as well",
        "nothing");
    group.on_off("--antialias", antialias, "Outlines smoothed as by Cycles' pixel filter");
    add_vpl_options(command, *this);
    add_ism_options(command, *this);
    add_rsm_options(command, *this);
    add_layer_options(command, *this);
}

void RenderOptions::add_still_to(CLI::App& command) {
    Group group(command, k_light_transport_group);
    group.number(
        "--samples", samples_a_pixel,
        fmt::format(
            "The mean of N frames, 1 to {}, that look at different places in and around each pixel, by "
            "Cycles' pixel filter; N times as slow. More than 1 takes the place of --antialias",
            k_most_samples),
        std::to_string(Settings{}.samples));
    command
        .add_option(
            "--memory-limit", memory_limit_mib,
            "GPU memory that frames may take, MiB: settings are lowered until they fit, and what was given "
            "up is said")
        ->check(above_zero(1e9))
        ->group(k_light_transport_group);
}

}  // namespace bounce::cli
