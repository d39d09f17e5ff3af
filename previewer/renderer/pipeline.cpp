// SPDX-License-Identifier: Apache-2.0
#include "renderer/pipeline.h"

#include <algorithm>

#include "passes/antialias.h"
#include "passes/classic_maps.h"
#include "passes/composite.h"
#include "passes/convolution_shadow.h"
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

passes::IsmInputs ism_inputs(const PipelineInputs& in, const passes::ScenePoints& scene) {
    return {.scene = scene,
            .large_triangles = in.triangles_inside,
            .splat = in.settings.splat,
            .close = in.plan.close_maps,
            .pull_push = {in.settings.pull_push, in.settings.pull_push_levels, in.settings.pull_threshold,
                          in.settings.push_threshold}};
}

// The world's lights and their shadow maps, which are always drawn from disks.
passes::VplSet add_world(FrameGraph& graph, const PipelineInputs& in, const passes::ScenePoints& scene) {
    passes::VplSet world = in.world.lights;
    world.vpls = graph.import_buffer("world lights", *in.world_lights);
    passes::IsmInputs inputs = ism_inputs(in, scene);
    inputs.large_triangles = static_cast<int>(in.points->large_triangles());
    inputs.splat = passes::Splat::disks;
    inputs.close = in.plan.close_world;
    world.atlas = add_ism(graph, in.context, inputs, world).atlas;
    return world;
}

// A bounce's lights with their shadow maps.
void add_lights(FrameGraph& graph, const PipelineInputs& in, const passes::ScenePoints& scene,
                passes::VplSet set, BouncedLights& lit) {
    passes::IsmAtlas maps;
    if (in.plan.occluded && in.settings.visibility == Visibility::shadow_maps) {
        maps.atlas = passes::add_classic_maps(graph, in.context, set);
    } else if (in.plan.occluded) {
        maps = passes::add_ism(graph, in.context, ism_inputs(in, scene), set);
    }
    set.atlas = maps.atlas;
    lit.sets.push_back(set);
    lit.splats.push_back(maps.splats);
}

// The lights of bounce `next`, from what surfaces reflect of the lights of the one before.
passes::VplSet add_next_bounce(FrameGraph& graph, const PipelineInputs& in, const passes::ScenePoints& scene,
                               const passes::VplSet& before, const passes::VplSet& irsms, const Bounce& next,
                               bool slope_bias) {
    using namespace passes;
    VplSet maps = irsms;
    maps.vpls = before.vpls;
    maps.distant = before.distant;
    IrsmSource source{.set = maps,
                      .irsm = {},
                      .atlas = before.atlas,
                      .slope_bias = slope_bias && !before.distant,
                      .scene = scene,
                      .store = in.points};
    if (in.settings.splat_irsms && !before.distant) {
        source.irsm = add_irsm(graph, in.context, scene, maps);
    }
    return add_vpls_from_irsms(graph, in.context, source, next.lights, in.plan.glossy).set;
}

// Bounce by bounce: lights from what the bounce before reflects, and their shadow maps; first of the scene's
// lights, then of the world.
BouncedLights add_bounces(FrameGraph& graph, const PipelineInputs& in,
                          const std::vector<passes::VplSource>& sources, const passes::ScenePoints& scene,
                          const passes::VplSet& world) {
    using namespace passes;
    BouncedLights lit;
    lit.slope_bias = in.settings.visibility == Visibility::ism && in.settings.splat != Splat::disks;
    for (size_t i = 0; i < in.bounces.size(); ++i) {
        if (i == 0) {
            const DrawnVpls drawn =
                add_vpls_from_rsms(graph, in.context, sources, in.bounces[0].lights, in.plan.glossy);
            lit.importance = drawn.importance;
            add_lights(graph, in, scene, drawn.set, lit);
        } else {
            add_lights(graph, in, scene,
                       add_next_bounce(graph, in, scene, lit.sets.back(), in.bounces[i - 1].irsms,
                                       in.bounces[i], lit.slope_bias),
                       lit);
        }
    }
    for (size_t i = 0; i < in.world_bounces.size(); ++i) {
        const bool first = i == 0;
        add_lights(graph, in, scene,
                   add_next_bounce(graph, in, scene, first ? world : lit.sets.back(),
                                   first ? in.world.irsms : in.world_bounces[i - 1].irsms,
                                   in.world_bounces[i], lit.slope_bias),
                   lit);
    }
    return lit;
}

// Light of all bounces at once.
TextureHandle add_bounced_light(FrameGraph& graph, const PipelineInputs& in, const passes::GBuffer& gbuffer,
                                const std::vector<passes::VplSource>& sources, const BouncedLights& lit,
                                const std::vector<passes::VplSet>& world) {
    using namespace passes;
    const PassContext& context = in.context;
    std::vector<VplSet> sets = lit.sets;
    sets.insert(sets.end(), world.begin(), world.end());
    const GatheredLight light = add_vpl_gather(graph, context,
                                               {.gbuffer = gbuffer,
                                                .sets = sets,
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
    const int interleave = sets.front().interleave;
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
        // Those of the scene's lights, then those of the world.
        const size_t first = i < in.bounces.size() ? 0 : in.bounces.size();
        const int bounce = static_cast<int>(i - first) + 1;
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
            const SoftShadow penumbra = !soft ? SoftShadow{}
                                        : light.soft.convolution_order > 0
                                            ? add_convolution_shadow(graph, context, gbuffer, light)
                                            : add_soft_shadow(graph, context, gbuffer, light);
            direct = add_direct_light(graph, context, gbuffer, light, shadow, penumbra, direct);
        }
        if (in.plan.indirect && !in.plan.takes_light[i]) {
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
    const ScenePoints scene =
        in.points != nullptr ? add_point_update(graph, context, *in.points) : ScenePoints{};
    std::vector<VplSet> world;
    if (in.plan.world_occluded) {
        world.push_back(add_world(graph, in, scene));
    }
    const bool lights_bounce = in.plan.vpls || in.plan.world_bounces > 0;
    if (lights_bounce) {
        std::vector<VplSource> sources;
        for (const RsmSource& source : gather.sources) {
            sources.push_back({source.light, source.rsm});
        }
        lit = add_bounces(graph, in, sources, scene, world.empty() ? VplSet{} : world.front());
        if (add_map_layer(graph, in, gbuffer, lit)) {
            return;
        }
        if (!shows_vpl_maps(in.settings.show)) {  // without a map to show there is nothing to be seen
            bounced = add_bounced_light(graph, in, gbuffer, sources, lit, world);
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

    if (!lights_bounce && !world.empty()) {
        bounced = add_bounced_light(graph, in, gbuffer, {}, lit, world);
    }
    const bool whole = in.settings.show == Show::shaded || in.settings.show == Show::vpls;
    TextureHandle picture = add_composite(graph, context,
                                          {.gbuffer = gbuffer,
                                           .direct = direct,
                                           .irradiance = irradiance,
                                           .bounced = bounced,
                                           .world_light = in.plan.world_light && !in.plan.world_occluded,
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
