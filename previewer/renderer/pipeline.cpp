// SPDX-License-Identifier: Apache-2.0
#include "renderer/pipeline.h"

#include "passes/composite.h"
#include "passes/direct_light.h"
#include "passes/gbuffer.h"
#include "passes/layer_view.h"
#include "passes/rsm.h"
#include "passes/rsm_gather.h"
#include "passes/shadow_map.h"

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
    if (in.plan.indirect && in.plan.interpolate) {
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

    add_composite(graph, context,
                  {.gbuffer = gbuffer,
                   .direct = direct,
                   .irradiance = irradiance,
                   .world_light = in.plan.world_light,
                   .emission = in.plan.emission && in.settings.show == Show::shaded},
                  in.target);
}

}  // namespace bounce
