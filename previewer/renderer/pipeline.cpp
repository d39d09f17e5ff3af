// SPDX-License-Identifier: Apache-2.0
#include "renderer/pipeline.h"

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
#include "passes/vpl_gather.h"
#include "passes/vpl_sampling.h"

namespace bounce {
namespace {

bool shows_rsm_layer(Show show) {
    return show == Show::rsm_depth || show == Show::rsm_position || show == Show::rsm_normal ||
           show == Show::rsm_flux;
}

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

// Bounce by bounce: lights from what the bounce before reflects, their shadow maps; then all of them at once.
TextureHandle add_bounced_light(FrameGraph& graph, const PipelineInputs& in, const passes::GBuffer& gbuffer,
                                const std::vector<passes::VplSource>& sources) {
    using namespace passes;
    const PassContext& context = in.context;
    const ScenePoints scene =
        in.points != nullptr ? add_point_update(graph, context, *in.points) : ScenePoints{};
    VplGatherInputs lit{
        .gbuffer = gbuffer,
        .sets = {},
        .slope_bias = in.settings.visibility == Visibility::ism && in.settings.splat != Splat::disks,
        .near_field = in.plan.near_field,
        .glossy = in.plan.glossy,
        .removed = false};
    VplImportance importance;
    for (size_t bounce = 0; bounce < in.bounces.size(); ++bounce) {
        DrawnVpls drawn;
        if (bounce == 0) {
            drawn = add_vpls_from_rsms(graph, context, sources, in.bounces[bounce].lights, in.plan.glossy);
            importance = drawn.importance;
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
        if (in.plan.occluded && in.settings.visibility == Visibility::shadow_maps) {
            drawn.set.atlas = add_classic_maps(graph, context, drawn.set);
        } else if (in.plan.occluded) {
            drawn.set.atlas = add_ism(graph, context,
                                      {.scene = scene,
                                       .large_triangles = static_cast<int>(in.points->large_triangles()),
                                       .splat = in.settings.splat,
                                       .pull_push = {in.settings.pull_push, in.settings.pull_push_levels,
                                                     in.settings.pull_threshold, in.settings.push_threshold}},
                                      drawn.set)
                                  .atlas;
        }
        lit.sets.push_back(drawn.set);
    }
    const GatheredLight light = add_vpl_gather(graph, context, lit);
    TextureHandle bounced = light.bounced;
    if (in.plan.near_field) {
        bounced = add_near_field(graph, context,
                                 {.gbuffer = gbuffer,
                                  .sources = sources,
                                  .importance = importance,
                                  .uniforms = lit.sets.front().uniforms,
                                  .glossy = in.plan.glossy},
                                 light);
    }
    const int interleave = lit.sets.front().interleave;
    return interleave > 1 ? add_bounced_blur(graph, context, gbuffer, bounced, interleave) : bounced;
}

}  // namespace

void build_pipeline(FrameGraph& graph, const PipelineInputs& in) {
    using namespace passes;
    const PassContext& context = in.context;
    const GBuffer gbuffer = add_gbuffer(graph, context, in.camera);

    TextureHandle direct;
    GatherInputs gather{.gbuffer = gbuffer, .sources = {}, .full_sum = in.settings.rsm_full_sum};
    for (size_t i = 0; i < in.lights.size(); ++i) {
        const LightPass& light = in.lights[i];
        if (in.plan.direct) {
            const TextureHandle shadow =
                in.plan.shadows[i] ? add_shadow_map(graph, context, light) : TextureHandle{};
            direct = add_direct_light(graph, context, gbuffer, light, shadow, direct);
        }
        if (in.plan.indirect) {
            gather.sources.push_back(
                {light, add_rsm(graph, context, light), in.gather_frames[i], in.patterns[i]});
        }
    }

    const auto shown = static_cast<size_t>(in.settings.shown_light);
    if (shows_rsm_layer(in.settings.show) && shown < gather.sources.size()) {
        add_rsm_layer_view(graph, context, gather.sources[shown], layer_of(in.settings.show), in.target);
        return;
    }

    TextureHandle irradiance;
    TextureHandle bounced;
    if (in.plan.vpls) {
        std::vector<VplSource> sources;
        for (const RsmSource& source : gather.sources) {
            sources.push_back({source.light, source.rsm});
        }
        bounced = add_bounced_light(graph, in, gbuffer, sources);
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

    const TextureHandle picture =
        add_composite(graph, context,
                      {.gbuffer = gbuffer,
                       .direct = direct,
                       .irradiance = irradiance,
                       .bounced = bounced,
                       .world_light = in.plan.world_light,
                       .emission = in.plan.emission && in.settings.show == Show::shaded},
                      in.plan.antialias ? TextureHandle{} : in.target);
    if (in.plan.antialias) {
        add_antialias(graph, context, gbuffer, in.camera, picture, in.target);
    }
}

}  // namespace bounce
