// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "passes/ism.h"
#include "passes/rsm_pattern.h"
#include "passes/vpl_maps.h"
#include "scene/simplify.h"

namespace bounce {

enum class Technique {
    direct,
    rsm,  // one bounce gathered from reflective shadow maps, unoccluded
    ism,  // bounces by virtual point lights and imperfect shadow maps
};

// How virtual point lights are hidden from what they light.
enum class Visibility {
    none,
    ism,          // imperfect shadow maps
    shadow_maps,  // maps of the same size drawn from triangles: the reference, slow
    simplified,   // the same, from fewer triangles (scene/simplify.h)
};

// What bounced light is gathered on.
enum class Shading {
    deferred,  // what the camera sees
    hybrid,    // what it would see of the simplified meshes (Lv et al. 2009)
};

// How lights with a size throw shadows.
enum class DirectShadows {
    hard,         // from their centres
    vpl,          // from many places on them, a map each
    convolution,  // from one map of the centre, filtered as wide as its blockers make the penumbra
    ism,          // from many places on them, an imperfect shadow map each
};

// What is done although the scene does not need it, to see what leaving out saves.
enum class Forced {
    nothing,
    exact,  // all that leaves the picture the same, to the bit
    all,    // and what is left out by an estimate: the picture differs within docs/leaving_out.md's bounds
};

using Splat = passes::Splat;
using PullPush = passes::PullPush;
using VplSampling = passes::VplSampling;
using BounceSource = passes::BounceSource;
using Importance = passes::Importance;
using WorldSampling = passes::WorldSampling;
using AvgHits = passes::AvgHits;
using AvgPaths = passes::AvgPaths;
using MapProjection = passes::MapProjection;

// What the colour target shows.
enum class Show {
    shaded,
    direct,
    indirect,
    rsm_depth,
    rsm_position,
    rsm_normal,
    rsm_flux,
    importance,      // what each texel of a light's reflective shadow map counts for, over the mean
    interpolation,   // red where the indirect light was evaluated in full
    vpls,            // the picture, dimmed, with a dot for each virtual point light
    ism_splats,      // the atlas before pull-push
    ism,             // the atlas as it is used
    vpl_visibility,  // what one light's map leaves lit
    unblurred,       // indirect light before the blur
    removed,         // light that bounding the lights' kernels takes away
    motion,          // where each pixel's point of surface was in the frame before
    avg,             // the approximate visibility grid: colour and normal of its voxels
};

// Light, to be seen through the scene's view transform; the other layers are data.
[[nodiscard]] inline bool shows_light(Show show) {
    return show == Show::shaded || show == Show::direct || show == Show::indirect ||
           show == Show::unblurred || show == Show::removed;
}

[[nodiscard]] inline bool shows_rsm(Show show) {
    return show == Show::rsm_depth || show == Show::rsm_position || show == Show::rsm_normal ||
           show == Show::rsm_flux;
}

// One light's reflective shadow map, or what its texels count for.
[[nodiscard]] inline bool shows_light_map(Show show) {
    return shows_rsm(show) || show == Show::importance;
}

// Shadow maps of virtual point lights, or what they leave lit.
[[nodiscard]] inline bool shows_vpl_maps(Show show) {
    return show == Show::ism_splats || show == Show::ism || show == Show::vpl_visibility;
}

struct Settings {
    int width = 960;
    int height = 540;
    Technique technique = Technique::ism;
    Show show = Show::shaded;
    int shown_light = 0;   // whose RSM the rsm_ layers show
    int shown_vpl = -1;    // whose map vpl_visibility (-1: the first) and the atlases (-1: all) show
    int shown_bounce = 0;  // whose lights and maps the layers of both show; 0: all lights, the first's maps

    // Over all lights; each gets its part by the light it sends out. 224 is the middle of the paper's range.
    int rsm_samples = 224;
    passes::RsmPattern rsm_pattern = passes::RsmPattern::uniform_radius;
    bool rsm_full_sum = false;  // every texel: the reference, slow
    int rsm_size = 0;           // a cube's faces have half of it; 0: 512 for rsm, 256 for ism

    // Screen-space interpolation (section 4 of the paper).
    bool interpolate = true;
    int lowres_step = 4;  // one sample in step x step pixels
    // A low-resolution sample is suitable where its normal differs by less than this angle, ...
    float interpolation_angle_deg = 15.0F;
    // ... it lies within this part of a low-resolution cell's width of the pixel's tangent plane, ...
    float interpolation_plane = 0.25F;
    // ... and within this many cell widths of the pixel, as the cell stretches over the tilted surface.
    float interpolation_distance = 2.0F;

    // Virtual point lights and imperfect shadow maps.
    int bounces = 1;
    int vpls = 256;         // of the first bounce
    int bounce_vpls = 128;  // of each further one
    int world_vpls = 256;   // that stand for the world, in any technique; 0: its light is not occluded
    WorldSampling world_sampling = WorldSampling::parts;
    int emitter_vpls = 256;  // that stand for emissive surfaces, in any technique; 0: these light nothing
    int bounce_places = 4;   // on a large area light, that its bounced light starts from; a power of two
    int emitter_panels = 2;  // sides of flat rectangles that emit: drawn as area lights instead, at most
    VplSampling vpl_sampling = VplSampling::inverse_transform;  // of the first bounce
    Importance vpl_importance = Importance::flux;               // that these are drawn by
    float importance_pixels = 0.1F;  // of the picture's pixels that a light's view is judged by, per cent
    // What a light counts for at least, of what it would show on white across the whole scene.
    float importance_floor = 0.05F;
    // Proposals of a chain, where lights are drawn by chains: these lie at most so many times as densely as
    // even ones (docs/papers/temporally_coherent_sampling.md).
    int vpl_steps = 100;
    Shading shading = Shading::deferred;
    scene::Simplification simplify{};  // of meshes that are drawn simplified
    Visibility visibility = Visibility::ism;
    MapProjection map_projection = MapProjection::faces;  // of maps drawn from triangles
    Splat splat = Splat::disks;
    BounceSource bounce_source = BounceSource::points;
    // The approximate visibility grid, where something is traced through it or it is shown.
    int avg_size = 64;  // voxels along the scene's longest side
    AvgHits avg_hits = AvgHits::slabs;
    AvgPaths avg_paths = AvgPaths::roulette;
    int ism_size = 64;  // texels a side of each map
    int ism_points =
        0;  // points splatted into each map; 0 chooses by the maps' size and the depth complexity
    bool large_triangles = true;         // with disks: what would take many points is drawn as triangles
    bool drop_hull = true;               // what lies on the scene's hull hides nothing, so it is not splatted
    PullPush pull_push = PullPush::off;  // with one depth a splat
    int pull_push_levels = 2;
    float pull_threshold = 0.05F;  // of the scene's extent
    float push_threshold = 0.05F;
    int interleave = 4;          // n: each of n x n pixels gathers from another n x n-th of the lights
    bool near_field = true;      // what lies near the lights is gathered from the RSMs
    bool glossy_bounces = true;  // glossy lobes of lights and receivers count

    bool antialias = true;  // outlines are smoothed as by Cycles' pixel filter
    // Frames whose mean the picture is (render_samples()); more than one filter outlines themselves, so
    // antialias is off. A frame of several smooths the outlines of shadows over its part of a pixel alone.
    int samples = 1;
    // Blended surfaces that a pixel shows at most, from the camera on; 0: they are cut out at one half.
    int transparent_layers = 4;
    // Bounced light of the frames before goes on where it still holds (passes/temporal_reuse.h): a frame then
    // depends on those before.
    bool temporal_reuse = false;
    int shadow_size = 2048;  // a cube's faces have half of it
    DirectShadows direct_shadows = DirectShadows::vpl;
    int shadow_samples = 0;     // places on a light, a power of two; 0: 64, or 256 with imperfect maps
    int soft_shadow_size = 0;   // of the map at each; a cube's faces have half of it; 0: 512, imperfect: 128
    int convolution_order = 4;  // terms of the Fourier series, as in the paper

    Forced forced = Forced::nothing;
    bool frees_idle = false;  // textures are freed between passes: less memory, more time

    bool count_gathered_pixels = false;  // reads a counter back after the frame; costs a wait
    // Searches what each pass writes for NaN and infinities, and fails the frame where it finds any, naming
    // the first pass that left one; costs a read of everything written, and a wait.
    bool check_finite = false;
    bool measure_removed = false;  // reports the light that bounding takes away; costs a wait
    bool find_unlit =
        false;  // says where nothing is seen, and where nothing that reflects is lit; costs a wait

    // Maps of virtual point lights are drawn from triangles.
    [[nodiscard]] bool draws_triangle_maps() const {
        return visibility == Visibility::shadow_maps || visibility == Visibility::simplified;
    }
    // Rays may be traced through the approximate visibility grid: the plan says whether any are.
    [[nodiscard]] bool traces_first() const {
        return technique == Technique::ism && vpl_sampling == VplSampling::avg;
    }
    [[nodiscard]] bool uses_avg() const {
        return technique == Technique::ism &&
               (vpl_sampling == VplSampling::avg || bounce_source == BounceSource::avg || show == Show::avg);
    }
    // Some pass of virtual point lights draws simplified meshes.
    [[nodiscard]] bool simplifies() const {
        return technique == Technique::ism &&
               (visibility == Visibility::simplified || shading == Shading::hybrid);
    }
    [[nodiscard]] int used_shadow_samples() const {
        return shadow_samples > 0 ? shadow_samples : direct_shadows == DirectShadows::ism ? 256 : 64;
    }
    [[nodiscard]] int used_soft_shadow_size() const {
        return soft_shadow_size > 0 ? soft_shadow_size : direct_shadows == DirectShadows::ism ? 128 : 512;
    }
    [[nodiscard]] int used_rsm_size() const {
        return rsm_size > 0 ? rsm_size : technique == Technique::ism ? 256 : 512;
    }
};

}  // namespace bounce
