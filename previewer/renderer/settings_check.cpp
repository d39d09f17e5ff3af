// SPDX-License-Identifier: Apache-2.0
#include "renderer/settings_check.h"

#include <algorithm>
#include <bit>

#include <fmt/format.h>

#include "renderer/avg_layout.h"
#include "renderer/imperfect_setup.h"
#include "renderer/ism_layout.h"
#include "renderer/setting_names.h"

namespace bounce {
namespace {

// Of passes/ism_tessellation.vert: draws, positions, indices, what is left out, materials, places on
// textures, colours.
constexpr int k_patch_storage_blocks = 7;

// The sentence where a value lies outside low to high.
std::string out_of(const char* setting, int value, int low, int high, const char* what) {
    if (value >= low && value <= high) {
        return {};
    }
    return fmt::format("{} is {}; {} from {} to {}", setting, value, what, low, high);
}

std::string threshold_refusal(const char* setting, float value) {
    if (value >= 0.0F && value <= 1.0F) {
        return {};
    }
    return fmt::format("{} is {:g}; give a part of the scene's extent from 0 to 1", setting, value);
}

std::string map_size_refusal(const char* setting, int size) {
    return out_of(setting, size, k_least_map_size, k_most_map_size, "give a number");
}

std::string bounce_places_refusal(int places) {
    if (places >= 1 && places <= k_most_bounce_places && std::has_single_bit(static_cast<unsigned>(places))) {
        return {};
    }
    return fmt::format("--bounce-places is {}; give a power of two from 1 to {}", places,
                       k_most_bounce_places);
}

bool is_ism_size(int size, int most) {
    return size >= k_least_ism_size && size <= most && std::has_single_bit(static_cast<unsigned>(size));
}

std::string shadow_samples_refusal(const Settings& s) {
    const int samples = s.used_shadow_samples();
    const int most =
        s.direct_shadows == DirectShadows::ism ? k_most_imperfect_samples : k_most_shadow_samples;
    if (samples >= k_least_shadow_samples && samples <= most &&
        std::has_single_bit(static_cast<unsigned>(samples))) {
        return {};
    }
    const bool with_ism = samples == k_most_imperfect_samples;
    return fmt::format("--shadow-samples is {}; give a power of two from {} to {}{}", samples,
                       k_least_shadow_samples, most, with_ism ? ", or --direct-shadows ism" : "");
}

std::string soft_shadow_size_refusal(const Settings& s) {
    const int size = s.used_soft_shadow_size();
    if (s.direct_shadows == DirectShadows::ism && !is_ism_size(size, k_most_ism_size)) {
        return fmt::format(
            "--soft-shadow-size is {}; with --direct-shadows ism give a power of two from {} to {}", size,
            k_least_ism_size, k_most_ism_size);
    }
    return map_size_refusal("--soft-shadow-size", size);
}

std::string importance_refusal(const Settings& s) {
    // NaN is refused, too.
    if (!(s.importance_pixels > 0.0F && s.importance_pixels <= k_most_importance_pixels)) {
        return fmt::format(
            "--importance-pixels is {:g}; give a number above 0 and up to {:g}, per cent of the picture's",
            s.importance_pixels, k_most_importance_pixels);
    }
    if (!(s.importance_floor >= 0.0F && s.importance_floor <= 1.0F)) {
        return fmt::format("--importance-floor is {:g}; give a number from 0 to 1", s.importance_floor);
    }
    return {};
}

std::string ism_refusal(const Settings& s) {
    for (const std::string& refusal :
         {out_of("--vpls", s.vpls, 1, k_most_vpls, "give a number"),
          out_of("--bounces", s.bounces, 1, k_most_bounces, "give a number"),
          out_of("--bounce-vpls", s.bounce_vpls, 1, k_most_vpls, "give a number"),
          out_of("--avg-size", s.avg_size, k_least_avg_size, k_most_avg_size, "give a number")}) {
        if (!refusal.empty()) {
            return refusal;
        }
    }
    const int most_size = s.draws_triangle_maps() ? k_most_triangle_map_size : k_most_ism_size;
    if (!is_ism_size(s.ism_size, most_size)) {
        return fmt::format("--ism-size is {}; give a power of two from {} to {}", s.ism_size,
                           k_least_ism_size, most_size);
    }
    if (s.ism_size > k_most_ism_size && s.world_vpls > 0) {
        return fmt::format(
            "--ism-size is {}, but the world's maps, which are drawn from points, have {} at most; give "
            "--world-vpls 0",
            s.ism_size, k_most_ism_size);
    }
    // NaN is refused, too.
    if (!(s.simplify.ratio >= 0.0 && s.simplify.ratio <= 1.0)) {
        return fmt::format("--simplify is {:g}; give a share of the triangles above 0 to 1, or auto",
                           s.simplify.ratio);
    }
    if (!(s.simplify.error > 0.0 && s.simplify.error <= 1.0)) {
        return fmt::format("--simplify-error is {:g}; give a part of a mesh's extent above 0 to 1",
                           s.simplify.error);
    }
    if (s.ism_points < 0 || s.ism_points > k_most_points_a_map) {
        return fmt::format("--points is {}; give a number from 1 to {}, or auto", s.ism_points,
                           k_most_points_a_map);
    }
    if (s.interleave < 1 || s.interleave > 16 || !std::has_single_bit(static_cast<unsigned>(s.interleave))) {
        return fmt::format("--interleave is {}; it may be 1, 2, 4, 8 or 16", s.interleave);
    }
    for (const std::string& refusal :
         {out_of("--pull-push-levels", s.pull_push_levels, 1, 3, "give a number"),
          threshold_refusal("--pull-threshold", s.pull_threshold),
          threshold_refusal("--push-threshold", s.push_threshold)}) {
        if (!refusal.empty()) {
            return refusal;
        }
    }
    return {};
}

// The largest map size at which an atlas of so many maps fits; 0 where none does.
int fitting_size(int columns, int texture_size) {
    int size = k_most_triangle_map_size;
    while (size >= k_least_ism_size && columns * size > texture_size) {
        size /= 2;
    }
    return size >= k_least_ism_size ? size : 0;
}

std::string atlas_refusal(const Settings& settings, const char* lights, const IsmLayout& layout,
                          const gl::DeviceLimits& limits) {
    if (layout.atlas_width() <= limits.texture_size) {  // no atlas is higher than wide
        return {};
    }
    const int columns = limits.texture_size / settings.ism_size;
    const int size = fitting_size(layout.columns, limits.texture_size);
    return fmt::format(
        "{} {} with --ism-size {} makes an atlas {} texels wide; this OpenGL driver holds {}: lower {} to "
        "{}{}",
        lights, layout.vpls, settings.ism_size, layout.atlas_width(), limits.texture_size, lights,
        columns * columns, size > 0 ? fmt::format(", or --ism-size to {}", size) : std::string());
}

}  // namespace

std::string settings_refusal(const Settings& s) {
    if (!s.rsm_full_sum && (s.rsm_samples < 1 || s.rsm_samples > k_most_rsm_samples)) {
        return fmt::format("--rsm-samples is {}; give a number from 1 to {}, or all", s.rsm_samples,
                           k_most_rsm_samples);
    }
    for (const std::string& refusal :
         {out_of("--rsm-lowres", s.lowres_step, 2, 64, "give a number"),
          s.rsm_size == 0 ? std::string() : map_size_refusal("--rsm-size", s.rsm_size),
          map_size_refusal("--shadow-size", s.shadow_size), shadow_samples_refusal(s),
          soft_shadow_size_refusal(s),
          out_of("--transparent-layers", s.transparent_layers, 0, k_most_transparent_layers, "give a number"),
          out_of("--convolution-order", s.convolution_order, 1, k_most_convolution_order, "give a number"),
          s.direct_shadows == DirectShadows::convolution && s.soft_shadow_size > k_most_convolution_size
              ? fmt::format(
                    "--soft-shadow-size is {}; with --direct-shadows convolution it may be {} at most",
                    s.soft_shadow_size, k_most_convolution_size)
              : std::string(),
          out_of("--vpl-steps", s.vpl_steps, 1, k_most_vpl_steps, "give a number"), importance_refusal(s),
          out_of("--samples", s.samples, 1, k_most_samples, "give a number"),
          out_of("--world-vpls", s.world_vpls, 0, k_most_vpls, "give a number"),
          out_of("--emitter-vpls", s.emitter_vpls, 0, k_most_vpls, "give a number"),
          bounce_places_refusal(s.bounce_places),
          out_of("--emitter-panels", s.emitter_panels, 0, k_most_emitter_panels, "give a number"),
          ism_refusal(s),
          s.shown_bounce == 0 ? std::string()
                              : out_of("--bounce", s.shown_bounce, 1, s.bounces, "bounces are counted")}) {
        if (!refusal.empty()) {
            return refusal;
        }
    }
    const int vpls = ism_layout(s, std::max(s.shown_bounce, 1), 0).vpls;
    return s.shown_vpl < 0 ? std::string()
                           : out_of("--vpl", s.shown_vpl, 0, vpls - 1, "this bounce's lights are counted");
}

std::string limits_refusal(const Settings& settings, const gl::DeviceLimits& limits) {
    const auto too_large = [&](const char* setting, int size) {
        return size > limits.texture_size ? fmt::format("{} is {}; this OpenGL driver holds {} at most",
                                                        setting, size, limits.texture_size)
                                          : std::string();
    };
    std::string refusal = too_large("the picture's longer side", std::max(settings.width, settings.height));
    if (refusal.empty() && settings.technique != Technique::direct) {
        refusal = too_large("--rsm-size", settings.used_rsm_size());
    }
    if (refusal.empty()) {
        refusal = too_large("--shadow-size", settings.shadow_size);
    }
    if (refusal.empty() && settings.direct_shadows != DirectShadows::hard) {
        refusal = too_large("--soft-shadow-size", settings.used_soft_shadow_size());
    }
    if (refusal.empty() && settings.direct_shadows == DirectShadows::ism) {
        // A light among what it lights has two maps a place.
        const IsmLayout maps = imperfect_layout(settings, 2 * settings.used_shadow_samples(), 0);
        if (maps.atlas_width() > limits.texture_size) {
            refusal = fmt::format(
                "--shadow-samples {} with --soft-shadow-size {} makes an atlas {} texels wide; this OpenGL "
                "driver "
                "holds {}: lower one of them",
                settings.used_shadow_samples(), maps.map_size, maps.atlas_width(), limits.texture_size);
        }
    }
    if (refusal.empty() && settings.splat == Splat::tessellation && !can_tessellate(limits)) {
        refusal = fmt::format(
            "--splat tessellation needs storage buffers in vertex and tessellation shaders, {} and 1; this "
            "OpenGL driver has {} and {}: give --splat compute or disks",
            k_patch_storage_blocks, limits.vertex_storage_blocks, limits.evaluation_storage_blocks);
    }
    if (refusal.empty() && settings.uses_avg()) {
        const int most = most_avg_size(limits.storage_block_bytes);
        if (settings.avg_size > most) {
            refusal = fmt::format(
                "--avg-size is {}; this OpenGL driver's buffers of {} MiB hold the surfaces of a grid of {} "
                "at "
                "most",
                settings.avg_size, limits.storage_block_bytes >> 20, most);
        }
    }
    const bool maps = settings.technique == Technique::ism && settings.visibility != Visibility::none;
    for (int bounce = 1; maps && refusal.empty() && bounce <= settings.bounces; ++bounce) {
        refusal = atlas_refusal(settings, bounce == 1 ? "--vpls" : "--bounce-vpls",
                                ism_layout(settings, bounce, 0), limits);
    }
    if (refusal.empty() && settings.world_vpls > 0) {
        refusal = atlas_refusal(settings, "--world-vpls", world_layout(settings, 0), limits);
    }
    if (refusal.empty() && settings.emitter_vpls > 0) {
        refusal = atlas_refusal(settings, "--emitter-vpls", emitter_layout(settings, 0), limits);
    }
    return refusal;
}

bool can_tessellate(const gl::DeviceLimits& limits) {
    return limits.vertex_storage_blocks >= k_patch_storage_blocks && limits.evaluation_storage_blocks >= 1;
}

std::string layer_refusal(const Settings& s) {
    if (s.show == Show::shaded || s.show == Show::direct || s.show == Show::motion) {
        return {};
    }
    if (s.technique == Technique::direct) {
        return shows_rsm(s.show) ? "technique direct has no reflective shadow maps"
                                 : "technique direct has no indirect light";
    }
    if (s.show == Show::indirect || shows_rsm(s.show)) {
        return {};
    }
    if (s.show == Show::interpolation) {
        if (s.technique != Technique::rsm) {
            return "only technique rsm interpolates indirect light";
        }
        return s.interpolate && !s.rsm_full_sum ? "" : "interpolation is off";
    }
    if (s.technique != Technique::ism) {
        return fmt::format("technique {} has no virtual point lights", name_of(s.technique));
    }
    if (s.show == Show::importance && s.traces_first()) {
        return "lights of --vpl-sampling avg are drawn from no map";
    }
    const bool of_maps = s.show == Show::ism || s.show == Show::ism_splats || s.show == Show::vpl_visibility;
    if (of_maps && s.visibility == Visibility::none) {
        return "visibility none has no shadow maps of virtual point lights";
    }
    if (s.show == Show::ism_splats && s.draws_triangle_maps()) {
        return fmt::format("visibility {} splats nothing", name_of(s.visibility));
    }
    if (s.show == Show::ism_splats && s.splat == Splat::disks) {
        return "disks are drawn without pull-push, so there is nothing to be seen before it; layer ism is "
               "what they draw";
    }
    if (s.show == Show::unblurred && s.interleave == 1) {
        return "with interleave 1 nothing is blurred; layer indirect is the same";
    }
    if (s.show == Show::removed && s.near_field && s.bounces == 1) {
        return "the near field gathers what bounding would take from the first bounce; switch it off, or "
               "render more bounces";
    }
    return {};
}

}  // namespace bounce
