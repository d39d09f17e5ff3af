// SPDX-License-Identifier: Apache-2.0
#include "renderer/presets.h"

namespace bounce {

const std::map<std::string, Preset>& preset_names() {
    static const std::map<std::string, Preset> names = {
        {"auto", Preset::automatic},  {"rsm2005", Preset::rsm2005},
        {"ism2008", Preset::ism2008}, {"lv2009", Preset::lv2009},
        {"avg2012", Preset::avg2012}, {"metropolis2013", Preset::metropolis2013}};
    return names;
}

Settings preset_settings(Preset preset) {
    Settings out;
    switch (preset) {
        case Preset::automatic:
            break;
        case Preset::rsm2005:
            out.technique = Technique::rsm;
            out.world_vpls = 0;                         // the paper has no light from all around
            out.emitter_panels = out.emitter_vpls = 0;  // and none from surfaces
            out.direct_shadows = DirectShadows::hard;
            out.bounce_places = 1;  // its lights are points
            break;
        case Preset::ism2008:
            // Sections 3.2 and 5: 1,024 lights and 256 of each further bounce, maps of 128 x 128 texels with
            // 4,096 points (P = N_res / 4 of the whole square), two levels and 5 % of the scene's extent; of
            // Table 1's blocks the one of 4 x 4 pixels. Section 5.1: an environment map of 1,024 lights.
            out.technique = Technique::ism;
            out.vpls = 1024;
            out.bounce_vpls = 256;
            out.world_vpls = 1024;
            out.ism_size = 128;
            out.ism_points = 4096;
            out.splat = Splat::points;
            out.pull_push = PullPush::paper;
            out.pull_push_levels = 2;
            out.pull_threshold = out.push_threshold = 0.05F;
            out.interleave = 4;
            out.bounce_source = BounceSource::irsm;
            out.bounce_places = 1;
            out.large_triangles = false;
            out.drop_hull = false;
            out.near_field = false;
            out.glossy_bounces = false;
            break;
        case Preset::lv2009:
            // Section IV.B: 256 lights with maps of 256 x 256 texels. Section III: one bounce of what
            // surfaces reflect diffusely, from texels of maps of 512 x 512 at the points of the Halton
            // sequence, with paraboloid maps of simplified meshes, in every pixel; its better one of two ways
            // to shade. Direct light's maps have 512 x 512 as well.
            out.technique = Technique::ism;
            out.vpls = 256;
            out.vpl_sampling = VplSampling::uniform;
            out.visibility = Visibility::simplified;
            out.map_projection = MapProjection::paraboloid;
            out.ism_size = 256;
            out.rsm_size = 512;
            out.shading = Shading::deferred;
            out.soft_shadow_size = 512;
            out.bounce_places = 1;
            out.interleave = 1;
            out.world_vpls = 0;                         // the paper has no light from all around
            out.emitter_panels = out.emitter_vpls = 0;  // and none from surfaces
            out.near_field = false;
            out.glossy_bounces = false;
            break;
        case Preset::avg2012:
            // Section IV: 1,024 lights of three bounces in all, a grid of 64 x 64 x 64 voxels, Lambert's
            // reflection, and a paraboloid map of triangles for each light (of its scenes with large ones a
            // traditional map, of one view as well: what lies outside of that view hides nothing); Section
            // III: all traced through the grid, from the lights on, some way into each voxel; of 16 subsets
            // of the pixels each gathers from its own lights, filtered by a box of 4 x 4 pixels.
            out.technique = Technique::ism;
            out.vpls = 352;
            out.bounces = 3;
            out.bounce_vpls = 336;
            out.vpl_sampling = VplSampling::avg;
            out.bounce_source = BounceSource::avg;
            out.avg_size = 64;
            out.avg_hits = AvgHits::voxels;
            out.avg_paths = AvgPaths::fixed;
            out.visibility = Visibility::shadow_maps;
            out.map_projection = MapProjection::paraboloid;
            out.interleave = 4;
            out.world_vpls = 0;                         // the paper has no light from all around
            out.emitter_panels = out.emitter_vpls = 0;  // and none from surfaces
            out.bounce_places = 1;
            out.near_field = false;
            out.glossy_bounces = false;
            break;
        case Preset::metropolis2013:
            // Section 6: 1,024 lights in an atlas of 2,048 x 2,048, so maps of 64 x 64, of which a pixel
            // gathers 128 (ours are n x n subsets: 64 each with n = 4); section 4: chains of uniform
            // proposals by what 0.1 % of the pixels show, five of them being enough (4.3.2); section 5:
            // points made by tessellation, splatted with one depth, and holes filled by pull-push.
            out.technique = Technique::ism;
            out.vpls = 1024;
            out.world_vpls = 1024;  // "VPLs are generated on the sphere to simulate environment map lighting"
            out.world_sampling = WorldSampling::drawn;
            out.vpl_sampling = VplSampling::metropolis;
            out.vpl_importance = Importance::view;
            out.importance_pixels = 0.1F;
            out.importance_floor = 0.0F;
            out.vpl_steps = 5;
            out.ism_size = 64;
            out.splat = Splat::tessellation;
            out.pull_push = PullPush::fill;
            out.interleave = 4;
            out.emitter_panels = out.emitter_vpls = 0;  // the paper has no light from surfaces
            out.bounce_places = 1;
            out.large_triangles = false;
            out.drop_hull = false;
            out.near_field = false;
            break;
    }
    return out;
}

}  // namespace bounce
