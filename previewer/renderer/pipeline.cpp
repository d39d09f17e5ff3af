// SPDX-License-Identifier: Apache-2.0
#include "renderer/pipeline.h"

#include <algorithm>

#include "passes/antialias.h"
#include "passes/classic_maps.h"
#include "passes/composite.h"
#include "passes/direct_light.h"
#include "passes/gbuffer.h"
#include "passes/irsm.h"
#include "passes/ism.h"
#include "passes/layer_view.h"
#include "passes/near_field.h"
#include "passes/point_update.h"
#include "passes/rsm.h"
#include "passes/rsm_gather.h"
#include "passes/shadow_map.h"
#include "passes/soft_shadow.h"
#include "passes/vpl_gather.h"
#include "passes/vpl_sampling.h"
#include "passes/vpl_view.h"

namespace bounce {
namespace {

passes::Layer layer_of(Show show) {
    switch (show) {
        case Show::rsm_position:
            return passes::Layer::rsm_position;
        case Show::rsm_normal:
            return passes::Layer::rsm_normal;
        case Show::rsm_flux:
            return passes::Layer::rsm_flux;
        default:
            return passes::Layer::rsm_depth;
    }
}

void count_gathered_pixels(FrameGraph& graph, BufferHandle counts, int* result) {
    graph.add_pass("count gathered pixels", [&](PassBuilder& builder) {
        builder.read(counts);
        builder.side_effect();
        return [counts, result](const PassResources& resources) {
            *result = static_cast<int>(resources.buffer(counts).read<GLuint>(4)[3]);
        };
    });
}

// All bounces' lights with their shadow maps.
struct BouncedLights {
    std::vector<passes::VplSet> sets;
    std::vector<TextureHandle> splats;  // their atlases before pull-push; invalid where there is none
    passes::VplImportance importance;   // of what the first bounce's are drawn from
    bool slope_bias = false;            // the shadow maps' splats have one depth each
};

// Bounce by bounce: lights from what the bounce before reflects, and their shadow maps.
BouncedLights add_bounces(FrameGraph& graph, const PipelineInputs& in,
                          const std::vector<passes::VplSource>& sources) {
    using namespace passes;
    const PassContext& context = in.context;
    const ScenePoints scene =
        in.points != nullptr ? add_point_update(graph, context, *in.points) : ScenePoints{};
    BouncedLights lit;
    lit.slope_bias = in.settings.visibility == Visibility::ism && in.settings.splat != Splat::disks;
    for (size_t bounce = 0; bounce < in.bounces.size(); ++bounce) {
        DrawnVpls drawn;
        if (bounce == 0) {
            drawn = add_vpls_from_rsms(graph, context, sources, in.bounces[bounce].lights, in.plan.glossy);
            lit.importance = drawn.importance;
        } else {
            VplSet maps = in.bounces[bounce - 1].irsms;
            maps.vpls = lit.sets.back().vpls;
            IrsmSource source{.set = maps,
                              .irsm = {},
                              .atlas = lit.sets.back().atlas,
                              .slope_bias = lit.slope_bias,
                              .scene = scene,
                              .store = in.points};
            if (in.settings.splat_irsms) {
                source.irsm = add_irsm(graph, context, scene, maps);
            }
            drawn = add_vpls_from_irsms(graph, context, source, in.bounces[bounce].lights, in.plan.glossy);
        }
        IsmAtlas maps;
        if (in.plan.occluded && in.settings.visibility == Visibility::shadow_maps) {
            maps.atlas = add_classic_maps(graph, context, drawn.set);
        } else if (in.plan.occluded) {
            maps = add_ism(graph, context,
                           {.scene = scene,
                            .large_triangles = static_cast<int>(in.points->large_triangles()),
                            .splat = in.settings.splat,
                            .close = in.plan.close_maps,
                            .pull_push = {in.settings.pull_push, in.settings.pull_push_levels,
                                          in.settings.pull_threshold, in.settings.push_threshold}},
                           drawn.set);
        }
        drawn.set.atlas = maps.atlas;
        lit.sets.push_back(drawn.set);
        lit.splats.push_back(maps.splats);
    }
    return lit;
}

// Light of all bounces at once.
TextureHandle add_bounced_light(FrameGraph& graph, const PipelineInputs& in, const passes::GBuffer& gbuffer,
                                const std::vector<passes::VplSource>& sources, const BouncedLights& lit) {
    using namespace passes;
    const PassContext& context = in.context;
    const GatheredLight light = add_vpl_gather(graph, context,
                                               {.gbuffer = gbuffer,
                                                .sets = lit.sets,
                                                .slope_bias = lit.slope_bias,
                                                .near_field = in.plan.near_field,
                                                .glossy = in.plan.glossy,
                                                .removed = false});
    TextureHandle bounced = light.bounced;
    if (in.plan.near_field) {
        bounced = add_near_field(graph, context,
                                 {.gbuffer = gbuffer,
                                  .sources = sources,
                                  .importance = lit.importance,
                                  .uniforms = lit.sets.front().uniforms,
                                  .interleave = lit.sets.front().interleave,
                                  .glossy = in.plan.glossy},
                                 light);
    }
    const int interleave = lit.sets.front().interleave;
    if (interleave == 1 || in.settings.show == Show::unblurred) {
        return bounced;
    }
    return add_bounced_blur(graph, context, gbuffer, bounced, interleave, in.plan.narrow_lobes);
}

// What bounding takes from that light; invalid where nothing is bounded: the near field gathers the first
// bounce's light near its sources from the reflective shadow maps.
TextureHandle add_removed(FrameGraph& graph, const PipelineInputs& in, const passes::GBuffer& gbuffer,
                          const BouncedLights& lit) {
    using namespace passes;
    VplGatherInputs bounded{.gbuffer = gbuffer,
                            .sets = lit.sets,
                            .slope_bias = lit.slope_bias,
                            .near_field = false,
                            .glossy = in.plan.glossy,
                            .removed = true};
    if (in.plan.near_field) {
        bounded.sets.erase(bounded.sets.begin());
    }
    return bounded.sets.empty() ? TextureHandle{} : add_vpl_gather(graph, in.context, bounded).bounced;
}

// The layers that show maps instead of a picture. False where the settings ask for none.
bool add_map_layer(FrameGraph& graph, const PipelineInputs& in, const passes::GBuffer& gbuffer,
                   const BouncedLights& lit) {
    using namespace passes;
    const Settings& settings = in.settings;
    const size_t bounce =
        std::min(static_cast<size_t>(std::max(settings.shown_bounce, 1)), lit.sets.size()) - 1;
    const VplSet& set = lit.sets[bounce];
    if (settings.show == Show::vpl_visibility) {
        const int shown = std::clamp(settings.shown_vpl, 0, set.maps - 1);
        const TextureHandle picture =
            add_vpl_visibility_view(graph, in.context, gbuffer, set, lit.slope_bias, shown, in.target);
        add_vpl_dots(graph, in.context, gbuffer, in.camera, {{set, static_cast<int>(bounce) + 1, shown}},
                     picture);
        return true;
    }
    const bool splats = settings.show == Show::ism_splats;
    const TextureHandle atlas = splats ? lit.splats[bounce] : set.atlas;
    if ((!splats && settings.show != Show::ism) || !atlas.valid()) {
        return false;
    }
    add_ism_view(graph, in.context, set, atlas, settings.shown_vpl, in.target);
    return true;
}

void add_all_dots(FrameGraph& graph, const PipelineInputs& in, const passes::GBuffer& gbuffer,
                  const BouncedLights& lit, TextureHandle picture) {
    std::vector<passes::VplDots> dots;
    for (size_t i = 0; i < lit.sets.size(); ++i) {
        const int bounce = static_cast<int>(i) + 1;
        if (in.settings.shown_bounce == 0 || in.settings.shown_bounce == bounce) {
            dots.push_back({lit.sets[i], bounce});
        }
    }
    passes::add_vpl_dots(graph, in.context, gbuffer, in.camera, dots,
                         passes::add_dimmed(graph, in.context, picture));
}

void read_reflected_flux(FrameGraph& graph, const passes::VplImportance& importance, float* result) {
    graph.add_pass("reflected flux", [&](PassBuilder& builder) {
        builder.read(importance.rows);
        builder.side_effect();
        return [importance, result](const PassResources& resources) {
            const auto last = static_cast<size_t>(importance.row_count) - 1;
            *result = resources.buffer(importance.rows).read<float>(1, last * sizeof(float))[0];
        };
    });
}

}  // namespace

void build_pipeline(FrameGraph& graph, const PipelineInputs& in) {
    using namespace passes;
    const PassContext& context = in.context;
    if (in.plan.motion) {
        add_motion(graph, context, in.camera, in.previous, in.target);
        return;
    }
    const GBuffer gbuffer = add_gbuffer(graph, context, in.camera, in.anything_seen);

    TextureHandle direct;
    GatherInputs gather{.gbuffer = gbuffer, .sources = {}, .full_sum = in.settings.rsm_full_sum};
    for (size_t i = 0; i < in.lights.size(); ++i) {
        const LightPass& light = in.lights[i];
        if (in.plan.direct) {
            const bool soft = !light.soft.empty();
            const TextureHandle shadow =
                in.plan.shadows[i] && !soft ? add_shadow_map(graph, context, light) : TextureHandle{};
            const SoftShadow penumbra = soft ? add_soft_shadow(graph, context, gbuffer, light) : SoftShadow{};
            direct = add_direct_light(graph, context, gbuffer, light, shadow, penumbra, direct);
        }
        if (in.plan.indirect) {
            gather.sources.push_back(
                {light, add_rsm(graph, context, light), in.gather_frames[i], in.patterns[i]});
        }
    }

    const auto shown = static_cast<size_t>(in.settings.shown_light);
    if (shows_rsm(in.settings.show) && shown < gather.sources.size()) {
        add_rsm_layer_view(graph, context, gather.sources[shown], layer_of(in.settings.show), in.target);
        return;
    }

    TextureHandle irradiance;
    TextureHandle bounced;
    BouncedLights lit;
    if (in.plan.vpls) {
        std::vector<VplSource> sources;
        for (const RsmSource& source : gather.sources) {
            sources.push_back({source.light, source.rsm});
        }
        lit = add_bounces(graph, in, sources);
        if (add_map_layer(graph, in, gbuffer, lit)) {
            return;
        }
        if (!shows_vpl_maps(in.settings.show)) {  // without a map to show there is nothing to be seen
            bounced = add_bounced_light(graph, in, gbuffer, sources, lit);
        }
        if (in.settings.show == Show::removed || in.removed != nullptr) {
            const TextureHandle removed = add_removed(graph, in, gbuffer, lit);
            if (in.removed != nullptr && bounced.valid()) {
                add_removed_light(graph, context, gbuffer, bounced, removed, in.removed);
            }
            const int interleave = lit.sets.front().interleave;
            if (in.settings.show == Show::removed) {
                bounced =
                    removed.valid() && interleave > 1
                        ? add_bounced_blur(graph, context, gbuffer, removed, interleave, in.plan.narrow_lobes)
                        : removed;
            }
        }
    } else if (in.plan.indirect && in.plan.interpolate) {
        const InterpolatedGather result =
            add_rsm_gather_interpolated(graph, context, gather, in.settings.lowres_step);
        irradiance = result.irradiance;
        if (in.gathered_pixels != nullptr) {
            count_gathered_pixels(graph, result.counts, in.gathered_pixels);
        }
        if (in.settings.show == Show::interpolation) {
            add_interpolation_view(graph, context, gbuffer, irradiance, in.target);
            return;
        }
    } else if (in.plan.indirect) {
        irradiance = add_rsm_gather(graph, context, gather);
    }

    const bool whole = in.settings.show == Show::shaded || in.settings.show == Show::vpls;
    TextureHandle picture = add_composite(graph, context,
                                          {.gbuffer = gbuffer,
                                           .direct = direct,
                                           .irradiance = irradiance,
                                           .bounced = bounced,
                                           .world_light = in.plan.world_light,
                                           .emission = in.plan.emission && whole},
                                          in.plan.antialias ? TextureHandle{} : in.target);
    if (in.plan.antialias) {
        picture = add_antialias(graph, context, gbuffer, in.camera, picture, in.target);
    }
    if (in.settings.show == Show::vpls && !lit.sets.empty()) {
        add_all_dots(graph, in, gbuffer, lit, picture);
    }
    if (in.reflected_flux != nullptr && lit.importance.row_count > 0) {
        read_reflected_flux(graph, lit.importance, in.reflected_flux);
    }
}

}  // namespace bounce
