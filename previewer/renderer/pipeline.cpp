// SPDX-License-Identifier: Apache-2.0
#include "renderer/pipeline.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include <fmt/format.h>

#include "passes/antialias.h"
#include "passes/classic_maps.h"
#include "passes/composite.h"
#include "passes/convolution_shadow.h"
#include "passes/direct_light.h"
#include "passes/emitter_lights.h"
#include "passes/float_layouts.h"
#include "passes/gbuffer.h"
#include "passes/irsm.h"
#include "passes/ism.h"
#include "passes/layer_view.h"
#include "passes/near_field.h"
#include "passes/peel.h"
#include "passes/point_update.h"
#include "passes/rsm.h"
#include "passes/rsm_gather.h"
#include "passes/shadow_map.h"
#include "passes/soft_shadow.h"
#include "passes/vpl_gather.h"
#include "passes/vpl_sampling.h"
#include "passes/vpl_view.h"
#include "renderer/avg_rays.h"

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

// What each light's shadows are looked up in; parallel to PipelineInputs::lights, invalid where there is
// none.
struct ShadowMaps {
    TextureHandle hard;
    TextureHandle soft;
    passes::ImperfectMaps imperfect;
};

// One light on a G-buffer's surfaces, added to `sum`.
TextureHandle add_light_of(FrameGraph& graph, const PipelineInputs& in, const passes::GBuffer& gbuffer,
                           const passes::LightPass& light, const ShadowMaps& maps, TextureHandle sum) {
    using namespace passes;
    const SoftShadow penumbra = !maps.imperfect.empty()
                                    ? add_imperfect_shadow(graph, in.context, gbuffer, light, maps.imperfect)
                                : !maps.soft.valid() ? SoftShadow{}
                                : light.soft.convolution_order > 0
                                    ? add_convolution_shadow(graph, in.context, gbuffer, light, maps.soft)
                                    : add_soft_shadow(graph, in.context, gbuffer, light, maps.soft);
    return add_direct_light(graph, in.context, gbuffer, light, maps.hard, penumbra, sum);
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
            .tessellated = in.tessellated,
            .large_triangles = in.triangles_inside,
            .splat = in.settings.splat,
            .close = in.plan.close_maps,
            .pull_push = {in.settings.pull_push, in.settings.pull_push_levels, in.settings.pull_threshold,
                          in.settings.push_threshold}};
}

// Every texel of every map looks at each of the pixels that importance is judged by; llvmpipe ends a loop
// after 65,535 iterations.
constexpr double k_most_viewed_pixels = 16384.0;
// In a small picture a thousandth of the pixels would say nothing of the others.
constexpr double k_least_viewed_pixels = 64.0;

// How lights are drawn from maps and from the sphere. gbuffer: where they are gathered.
passes::Drawing drawing(const PipelineInputs& in, const passes::GBuffer& gbuffer, uint32_t seed) {
    const Settings& settings = in.settings;
    passes::Drawing out{.glossy = in.plan.glossy,
                        .sampling = settings.vpl_sampling,
                        .steps = settings.vpl_steps,
                        .map = settings.show == Show::importance,
                        .view = {}};
    if (settings.vpl_importance == Importance::view) {
        const double pixels = static_cast<double>(in.context.width) * in.context.height;
        out.view = {.gbuffer = gbuffer,
                    .pixels = static_cast<int>(
                        std::clamp(std::ceil(0.01 * static_cast<double>(settings.importance_pixels) * pixels),
                                   k_least_viewed_pixels, k_most_viewed_pixels)),
                    .floor = settings.importance_floor,
                    .seed = seed};
    }
    return out;
}

// The world's lights and their shadow maps, which are always drawn from disks.
passes::VplSet add_world(FrameGraph& graph, const PipelineInputs& in, const passes::GBuffer& gbuffer,
                         const passes::ScenePoints& scene) {
    passes::VplSet world = in.world.lights;
    world.vpls =
        graph.import_buffer("world lights", *in.world_lights, passes::k_vpl_floats, in.world_content);
    if (in.sphere.cells != nullptr) {
        world = add_vpls_from_sphere(graph, in.context, in.sphere, world, drawing(in, gbuffer, world.seed));
    }
    passes::IsmInputs inputs = ism_inputs(in, scene);
    inputs.large_triangles = static_cast<int>(in.points->large_triangles());
    inputs.splat = passes::Splat::disks;
    inputs.close = in.plan.close_world;
    world.atlas = add_ism(graph, in.context, inputs, world).atlas;
    return world;
}

// Shadow maps of lights within the scene, as the settings have them.
passes::IsmAtlas add_maps(FrameGraph& graph, const PipelineInputs& in, const passes::ScenePoints& scene,
                          const passes::VplSet& set) {
    passes::IsmAtlas maps;
    if (in.settings.technique == Technique::ism && in.settings.draws_triangle_maps()) {
        const bool simplified = in.settings.visibility == Visibility::simplified;
        maps.atlas = passes::add_classic_maps(graph, in.context, set,
                                              simplified ? gpu::Geometry::simplified : gpu::Geometry::whole,
                                              in.settings.map_projection);
    } else {
        maps = passes::add_ism(graph, in.context, ism_inputs(in, scene), set);
    }
    return maps;
}

// Imperfect maps of places on a light with a size. The light may stand outside of the scene's hull, so that
// what is on it hides, too.
passes::ImperfectMaps add_imperfect_maps(FrameGraph& graph, const PipelineInputs& in,
                                         const passes::ScenePoints& scene, size_t light) {
    passes::ImperfectMaps maps = in.imperfect[light];
    maps.set.vpls = graph.import_buffer("places: " + in.lights[light].name, (*in.places)[light],
                                        passes::k_vpl_floats, in.places_content[light]);
    passes::IsmInputs inputs = ism_inputs(in, scene);
    inputs.large_triangles = static_cast<int>(in.points->large_triangles());
    inputs.splat = maps.set.distant ? passes::Splat::disks : in.settings.splat;
    inputs.tessellated = in.soft_tessellated;
    inputs.close = in.plan.close_world;
    maps.set.atlas = add_ism(graph, in.context, inputs, maps.set).atlas;
    return maps;
}

// The lights on emissive surfaces and their shadow maps.
passes::VplSet add_emitters(FrameGraph& graph, const PipelineInputs& in, const passes::ScenePoints& scene) {
    passes::VplSet emitters = passes::add_emitter_lights(graph, in.context, *in.emitter_store,
                                                         in.points->content(), in.emitters.lights);
    if (in.plan.emitters_occluded) {
        emitters.atlas = add_maps(graph, in, scene, emitters).atlas;
    }
    return emitters;
}

// A bounce's lights with their shadow maps.
void add_lights(FrameGraph& graph, const PipelineInputs& in, const passes::ScenePoints& scene,
                passes::VplSet set, BouncedLights& lit) {
    passes::IsmAtlas maps;
    if (in.plan.occluded) {
        maps = add_maps(graph, in, scene, set);
    }
    set.atlas = maps.atlas;
    lit.sets.push_back(set);
    lit.splats.push_back(maps.splats);
}

passes::AvgTraceInputs trace_inputs(const PipelineInputs& in, const passes::AvgGrid& grid, int number) {
    return {.grid = grid,
            .hits = in.settings.avg_hits,
            .paths = in.settings.avg_paths,
            .numbers = in.avg.numbers,
            .sequences = k_avg_sequences,
            .bounce = number,
            .glossy = in.plan.glossy,
            .rays = in.avg.rays_content};
}

// The lights of bounce `next`, from what surfaces reflect of the lights of the one before.
passes::VplSet add_next_bounce(FrameGraph& graph, const PipelineInputs& in, const passes::ScenePoints& scene,
                               const passes::VplSet& before, const passes::VplSet& irsms, const Bounce& next,
                               const passes::AvgGrid& grid, BouncedLights& lit) {
    using namespace passes;
    if (in.settings.bounce_source == BounceSource::avg) {
        return add_vpls_from_avg(graph, in.context, trace_inputs(in, grid, static_cast<int>(lit.sets.size())),
                                 before, next.lights);
    }
    VplSet maps = irsms;
    maps.vpls = before.vpls;
    maps.distant = before.distant;
    IrsmSource source{.set = maps,
                      .irsm = {},
                      .atlas = before.atlas,
                      .slope_bias = lit.slope_bias && !before.distant,
                      .scene = scene,
                      .store = in.points};
    if (in.settings.bounce_source == BounceSource::irsm && !before.distant) {
        source.irsm = add_irsm(graph, in.context, scene, maps);
    }
    return add_vpls_from_irsms(graph, in.context, source, next.lights, in.plan.glossy).set;
}

// Lights that are there before any bounce, and what their bounces are drawn from.
struct Emitted {
    passes::VplSet world;  // without maps where there is none
    passes::VplSet emitters;
    [[nodiscard]] std::vector<passes::VplSet> sets() const {
        std::vector<passes::VplSet> out;
        for (const passes::VplSet& set : {world, emitters}) {
            if (set.maps > 0) {
                out.push_back(set);
            }
        }
        return out;
    }
};

void add_further_bounces(FrameGraph& graph, const PipelineInputs& in, const passes::ScenePoints& scene,
                         const passes::VplSet& source, const passes::VplSet& irsms,
                         const std::vector<Bounce>& bounces, const passes::AvgGrid& grid,
                         BouncedLights& lit) {
    for (size_t i = 0; i < bounces.size(); ++i) {
        const bool first = i == 0;
        add_lights(graph, in, scene,
                   add_next_bounce(graph, in, scene, first ? source : lit.sets.back(),
                                   first ? irsms : bounces[i - 1].irsms, bounces[i], grid, lit),
                   lit);
    }
}

// Bounce by bounce: lights from what the bounce before reflects, and their shadow maps; first of the scene's
// lights, then of the world, then of emissive surfaces.
BouncedLights add_bounces(FrameGraph& graph, const PipelineInputs& in, const passes::GBuffer& gbuffer,
                          const std::vector<passes::VplSource>& sources, const passes::ScenePoints& scene,
                          const Emitted& emitted) {
    using namespace passes;
    BouncedLights lit;
    lit.slope_bias = in.settings.visibility == Visibility::ism && in.settings.splat != Splat::disks;
    const AvgGrid grid = in.plan.avg ? add_avg_grid(graph, in.context, in.avg.grid) : AvgGrid{};
    for (size_t i = 0; i < in.bounces.size(); ++i) {
        if (i == 0 && in.plan.traced) {
            add_lights(graph, in, scene,
                       add_vpls_from_rays(graph, in.context, trace_inputs(in, grid, k_avg_sequences - 1),
                                          *in.avg.rays, in.bounces[0].lights),
                       lit);
        } else if (i == 0) {
            const DrawnVpls drawn = add_vpls_from_rsms(graph, in.context, sources, in.bounces[0].lights,
                                                       drawing(in, gbuffer, in.bounces[0].lights.seed));
            lit.importance = drawn.importance;
            add_lights(graph, in, scene, drawn.set, lit);
        } else {
            add_lights(graph, in, scene,
                       add_next_bounce(graph, in, scene, lit.sets.back(), in.bounces[i - 1].irsms,
                                       in.bounces[i], grid, lit),
                       lit);
        }
    }
    add_further_bounces(graph, in, scene, emitted.world, in.world.irsms, in.world_bounces, grid, lit);
    add_further_bounces(graph, in, scene, emitted.emitters, in.emitters.irsms, in.emitter_bounces, grid, lit);
    return lit;
}

// What the gather makes, filtered.
struct FilteredLight {
    TextureHandle bounced;
    TextureHandle lobes;
    // Before the blur; invalid where there is none.
    TextureHandle sharp_bounced;
    TextureHandle sharp_lobes;
};

// Light of all bounces at once.
FilteredLight add_bounced_light(FrameGraph& graph, const PipelineInputs& in, const passes::GBuffer& gbuffer,
                                const std::vector<passes::VplSource>& sources, const BouncedLights& lit,
                                const Emitted& emitted) {
    using namespace passes;
    const PassContext& context = in.context;
    std::vector<VplSet> sets = lit.sets;
    const std::vector<VplSet> first = emitted.sets();
    sets.insert(sets.end(), first.begin(), first.end());
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
                                  .seed = lit.sets.front().seed,
                                  .extent = lit.sets.front().extent,
                                  .glossy = in.plan.glossy},
                                 light);
    }
    const int interleave = sets.front().interleave;
    if (interleave == 1 || in.settings.show == Show::unblurred) {
        return {bounced, light.lobes, {}, {}};
    }
    const auto blur = [&](TextureHandle of) {
        return of.valid() ? add_bounced_blur(graph, context, gbuffer, of, interleave, in.plan.narrow_lobes)
                          : of;
    };
    return {blur(bounced), blur(light.lobes), bounced, light.lobes};
}

// The light of the frames before goes on in it, where the plan says so.
TextureHandle add_reuse(FrameGraph& graph, const PipelineInputs& in, const passes::GBuffer& gbuffer,
                        const FilteredLight& light, int interleave) {
    if (!in.plan.temporal_reuse || !light.sharp_bounced.valid()) {
        return light.bounced;
    }
    return passes::add_temporal_reuse(graph, in.context,
                                      {.gbuffer = gbuffer,
                                       .camera = in.camera,
                                       .unblurred = light.sharp_bounced,
                                       .bounced = light.bounced,
                                       .interleave = interleave,
                                       .before = in.light_before,
                                       .next = in.kept},
                                      in.reused_pixels);
}

// What lights a G-buffer's surfaces, as the composite takes it; invalid where there is none.
struct Light {
    TextureHandle direct;
    TextureHandle irradiance;
    TextureHandle bounced;
    TextureHandle lobes;     // GatheredLight::lobes
    TextureHandle radiance;  // as it leaves the surfaces
};

passes::CompositeInputs composite_inputs(const PipelineInputs& in, const passes::GBuffer& gbuffer,
                                         const Light& light) {
    const bool whole = in.settings.show == Show::shaded || in.settings.show == Show::vpls;
    return {.gbuffer = gbuffer,
            .direct = light.direct,
            .irradiance = light.irradiance,
            .bounced = light.bounced,
            .lobes = light.lobes,
            .image = in.image,
            .radiance = light.radiance,
            .world_light = in.plan.world_light && !in.plan.world_occluded,
            .emission = in.plan.emission && whole};
}

// What was made for the solid surfaces and serves the blended ones as well.
struct Shared {
    passes::GBuffer solid;
    std::vector<ShadowMaps> shadows;
    passes::GatherInputs gather;
    std::vector<passes::VplSource> sources;
    BouncedLights lit;
    Emitted emitted;
    passes::DepthSamples samples;  // where outlines are smoothed
};

// All light on a layer's surfaces, as on the solid ones in build_pipeline().
Light add_layer_light(FrameGraph& graph, const PipelineInputs& in, const Shared& shared,
                      const passes::GBuffer& gbuffer) {
    using namespace passes;
    Light out;
    for (size_t i = 0; in.plan.direct && i < in.lights.size(); ++i) {
        out.direct = add_light_of(graph, in, gbuffer, in.lights[i], shared.shadows[i], out.direct);
    }
    if (!shared.lit.sets.empty() || !shared.emitted.sets().empty()) {
        const FilteredLight light =
            add_bounced_light(graph, in, gbuffer, shared.sources, shared.lit, shared.emitted);
        out.bounced = light.bounced;
        out.lobes = light.lobes;
    }
    if (in.plan.indirect && !in.plan.vpls) {
        GatherInputs gather = shared.gather;
        gather.gbuffer = gbuffer;
        out.irradiance =
            in.plan.interpolate
                ? add_rsm_gather_interpolated(graph, in.context, gather, in.settings.lowres_step).irradiance
                : add_rsm_gather(graph, in.context, gather);
    }
    return out;
}

glm::vec2 offset_of(const PipelineInputs& in) {
    return in.one_of_many != nullptr ? in.one_of_many->offset : glm::vec2(0.0F);
}

// Blended surfaces over pictures of the solid ones: peeled off from the front, shaded one layer after the
// other as those are, laid over from the back. What a layer takes is not run where no surface is in it.
void add_blended(FrameGraph& graph, const PipelineInputs& in, const Shared& shared,
                 std::vector<TextureHandle>& pictures) {
    using namespace passes;
    std::vector<PeeledLayer> layers;
    for (int number = 1; number <= in.plan.blend_layers; ++number) {
        if (!layers.empty()) {
            graph.set_condition([any = layers.back().any] { return *any; });
        }
        layers.push_back(add_peeled_layer(graph, in.context, in.camera, shared.solid,
                                          layers.empty() ? TextureHandle{} : layers.back().gbuffer.depth,
                                          number));
    }
    graph.set_condition([any = layers.back().any] { return *any; });
    if (in.unpeeled_pixels != nullptr) {
        count_unpeeled(graph, in.context, in.camera, shared.solid, layers.back().gbuffer, in.unpeeled_pixels);
    }
    std::vector<DepthSamples> samples(layers.size());
    for (size_t i = 0; in.plan.antialias && i < layers.size(); ++i) {
        graph.set_condition([any = layers[i].any] { return *any; });
        samples[i] = add_peeled_samples(graph, in.context, in.camera, shared.samples,
                                        i == 0 ? TextureHandle{} : samples[i - 1].depth,
                                        fmt::format("layer {}", i + 1));
    }
    for (size_t i = layers.size(); i-- > 0;) {
        graph.set_condition([any = layers[i].any] { return *any; });
        const GBuffer& gbuffer = layers[i].gbuffer;
        CompositeInputs inputs = composite_inputs(in, gbuffer, add_layer_light(graph, in, shared, gbuffer));
        inputs.layer = true;
        TextureHandle layer = add_composite(graph, in.context, inputs, {});
        if (in.plan.antialias) {
            layer = add_antialias(graph, in.context, gbuffer, samples[i], layer, {}, offset_of(in),
                                  fmt::format("layer {}", i + 1));
        }
        for (TextureHandle& picture : pictures) {
            picture = add_over(graph, in.context, layer, picture, static_cast<int>(i) + 1);
        }
    }
    graph.set_condition(nullptr);
}

// A map that is drawn once for all pictures of a moment; kept: where it is, null: it is drawn for this one
// alone.
template <typename Add>
TextureHandle kept_map(FrameGraph& graph, const std::string& name, gl::Texture* kept, Add&& add) {
    if (kept != nullptr && *kept) {
        return graph.import_texture(name, *kept);
    }
    const TextureHandle made = add();
    if (kept != nullptr) {
        graph.keep(made, *kept);
    }
    return made;
}

// What bounding takes from that light; invalid where nothing is bounded: the near field gathers the first
// bounce's light near its sources from the reflective shadow maps.
TextureHandle add_removed(FrameGraph& graph, const PipelineInputs& in, const passes::GBuffer& gbuffer,
                          const BouncedLights& lit, const Emitted& emitted) {
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
    if (in.plan.emitters) {
        bounded.sets.push_back(emitted.emitters);
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
        // Those of the scene's lights, then of the world, then of emissive surfaces.
        const size_t of_lights = in.bounces.size();
        const size_t of_world = of_lights + in.world_bounces.size();
        const size_t first = i < of_lights ? 0 : i < of_world ? of_lights : of_world;
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

// Virtual point lights are drawn from the sources in the order of their names, so that they are the same
// whatever the order of the scene's nodes. firsts: indices of some sources, which go with them.
void sort_by_name(std::vector<passes::RsmSource>& sources, std::vector<size_t>& firsts) {
    std::vector<size_t> order(sources.size());
    std::iota(order.begin(), order.end(), size_t{0});
    std::stable_sort(order.begin(), order.end(),
                     [&](size_t a, size_t b) { return sources[a].light.name < sources[b].light.name; });
    std::vector<passes::RsmSource> sorted;
    std::vector<size_t> place(sources.size());
    for (const size_t i : order) {
        place[i] = sorted.size();
        sorted.push_back(sources[i]);
    }
    sources = std::move(sorted);
    for (size_t& first : firsts) {
        first = place[first];
    }
}

}  // namespace

void build_pipeline(FrameGraph& graph, const PipelineInputs& in) {
    using namespace passes;
    const PassContext& context = in.context;
    if (in.plan.motion) {
        add_motion(graph, context, in.camera, in.previous, in.target);
        return;
    }
    if (in.settings.show == Show::avg) {
        add_avg_view(graph, context, add_avg_grid(graph, context, in.avg.grid),
                     in.settings.avg_hits == AvgHits::voxels, in.target);
        return;
    }
    const GBuffer gbuffer = add_gbuffer(graph, context, in.camera, in.anything_seen);
    // Where bounced light is gathered.
    const GBuffer lit_surfaces = in.plan.hybrid ? add_simplified_gbuffer(graph, context, in.camera) : gbuffer;

    KeptMaps* const kept = in.one_of_many != nullptr ? in.one_of_many->kept : nullptr;
    if (kept != nullptr) {
        kept->hard.resize(in.lights.size());
        kept->rsms.resize(in.bounce_sources.size());
    }
    const auto keep = [kept](std::vector<gl::Texture> KeptMaps::*maps, size_t at) {
        return kept != nullptr ? &(kept->*maps)[at] : nullptr;
    };
    TextureHandle direct;
    std::vector<ShadowMaps> shadows(in.lights.size());
    GatherInputs gather{.gbuffer = gbuffer, .sources = {}, .full_sum = in.settings.rsm_full_sum};
    ScenePoints scene;
    if (in.plan.imperfect_shadows && in.points != nullptr) {
        scene = add_point_update(graph, context, *in.points);
    }
    std::vector<size_t> first_places;  // in gather.sources, of each light that bounces
    for (size_t i = 0; i < in.lights.size(); ++i) {
        const LightPass& light = in.lights[i];
        if (in.plan.direct) {
            if (!in.imperfect[i].empty()) {
                shadows[i].imperfect = add_imperfect_maps(graph, in, scene, i);
            }
            if (in.plan.shadows[i] && !in.plan.soft[i]) {
                shadows[i].hard = kept_map(graph, "shadow map: " + light.name, keep(&KeptMaps::hard, i),
                                           [&] { return add_shadow_map(graph, context, light); });
            }
            if (!light.soft.empty()) {
                shadows[i].soft = add_soft_maps(graph, context, light);
            }
            direct = add_light_of(graph, in, gbuffer, light, shadows[i], direct);
        }
        if (in.plan.indirect && !in.plan.takes_light[i] && !in.plan.traced) {
            first_places.push_back(gather.sources.size());
            for (size_t at = 0; at < in.bounce_sources.size(); ++at) {
                const BounceStart& place = in.bounce_sources[at];
                if (place.light == i) {
                    const TextureHandle rsm =
                        kept_map(graph, "rsm: " + place.pass.name, keep(&KeptMaps::rsms, at),
                                 [&] { return add_rsm(graph, context, place.pass); });
                    gather.sources.push_back({place.pass, rsm, place.gather_frame, place.pattern});
                }
            }
        }
    }

    sort_by_name(gather.sources, first_places);

    const auto shown = static_cast<size_t>(in.settings.shown_light);
    if (shows_rsm(in.settings.show) && shown < first_places.size()) {
        add_rsm_layer_view(graph, context, gather.sources[first_places[shown]], layer_of(in.settings.show),
                           in.target);
        return;
    }

    TextureHandle irradiance;
    FilteredLight bounced;
    BouncedLights lit;
    if (!in.plan.imperfect_shadows && in.points != nullptr) {
        scene = add_point_update(graph, context, *in.points);
    }
    Emitted emitted;
    std::vector<VplSource> sources;
    if (in.plan.world_occluded) {
        emitted.world = add_world(graph, in, lit_surfaces, scene);
    }
    if (in.plan.emitters) {
        emitted.emitters = add_emitters(graph, in, scene);
    }
    const bool lights_bounce = in.plan.vpls || in.plan.world_bounces > 0 || in.plan.emitter_bounces > 0;
    if (lights_bounce) {
        for (const RsmSource& source : gather.sources) {
            sources.push_back({source.light, source.rsm});
        }
        lit = add_bounces(graph, in, lit_surfaces, sources, scene, emitted);
        if (in.settings.show == Show::importance && shown < first_places.size()) {
            add_importance_view(graph, context, sources, first_places[shown], lit.importance, in.target);
            return;
        }
        if (add_map_layer(graph, in, gbuffer, lit)) {
            return;
        }
        if (!shows_vpl_maps(in.settings.show)) {  // without a map to show there is nothing to be seen
            bounced = add_bounced_light(graph, in, lit_surfaces, sources, lit, emitted);
            bounced.bounced = add_reuse(graph, in, lit_surfaces, bounced, in.settings.interleave);
        }
        if (in.settings.show == Show::removed || in.removed != nullptr) {
            const TextureHandle removed = add_removed(graph, in, lit_surfaces, lit, emitted);
            if (in.removed != nullptr && bounced.bounced.valid()) {
                add_removed_light(graph, context, lit_surfaces, bounced.bounced, removed, in.removed);
            }
            const int interleave = lit.sets.front().interleave;
            if (in.settings.show == Show::removed) {
                bounced.bounced = removed.valid() && interleave > 1
                                      ? add_bounced_blur(graph, context, lit_surfaces, removed, interleave,
                                                         in.plan.narrow_lobes)
                                      : removed;
                bounced.sharp_bounced = {};
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

    if (!lights_bounce && (in.plan.world_occluded || in.plan.emitters)) {
        bounced = add_bounced_light(graph, in, gbuffer, {}, lit, emitted);
    }
    DepthSamples samples;
    const auto shade = [&](TextureHandle irradiance_of_bounces, TextureHandle lobes, TextureHandle target) {
        TextureHandle reflected;
        if (in.plan.hybrid && irradiance_of_bounces.valid()) {
            reflected = add_reflected(graph, context, lit_surfaces, irradiance_of_bounces);
            irradiance_of_bounces = {};
        }
        const TextureHandle shaded = add_composite(
            graph, context,
            composite_inputs(in, gbuffer, {direct, irradiance, irradiance_of_bounces, lobes, reflected}),
            in.plan.antialias ? TextureHandle{} : target);
        if (!in.plan.antialias) {
            return shaded;
        }
        if (!samples.depth.valid()) {
            samples = add_depth_samples(graph, context, in.camera);
        }
        return add_antialias(graph, context, gbuffer, samples, shaded, target, offset_of(in));
    };
    std::vector<TextureHandle> pictures = {shade(bounced.bounced, bounced.lobes, in.target)};
    if (in.one_of_many != nullptr && bounced.sharp_bounced.valid()) {
        pictures.push_back(shade(bounced.sharp_bounced, bounced.sharp_lobes, {}));
    }
    if (in.plan.blend_layers > 0) {
        add_blended(graph, in, {gbuffer, shadows, gather, sources, lit, emitted, samples}, pictures);
    }
    const TextureHandle picture = pictures.front();
    if (in.one_of_many != nullptr) {
        add_accumulate(graph, context, picture, pictures.back(), *in.one_of_many->means);
    }
    if (in.settings.show == Show::vpls && !lit.sets.empty()) {
        add_all_dots(graph, in, gbuffer, lit, picture);
    }
    // Importance by the view is none where nothing is seen of a light, which is not to say that there is
    // none.
    if (in.reflected_flux != nullptr && lit.importance.row_count > 0 &&
        in.settings.vpl_importance == Importance::flux) {
        read_reflected_flux(graph, lit.importance, in.reflected_flux);
    }
}

}  // namespace bounce
