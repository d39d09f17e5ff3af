// SPDX-License-Identifier: Apache-2.0
#include "renderer/frame_plan.h"

#include <algorithm>

#include <fmt/format.h>

#include "renderer/bounce_places.h"
#include "renderer/penumbra.h"
#include "renderer/plan_details.h"
#include "scene/transparency.h"

namespace bounce {
namespace {

// The picture's filter blurs a hard shadow's outline by more than this.
constexpr double k_least_penumbra_pixels = 0.5;

constexpr const char* k_no_light = "no light sends light";

size_t at(int index) {
    return static_cast<size_t>(index);
}

bool is_dark(const glm::vec3& color) {
    return !(std::max({color.r, color.g, color.b}) > 0.0F);
}

// Radiant power, W, or irradiance, W/m^2, times colour. Cycles takes light away where it is below 0.
glm::vec3 strength(const scene::Light& light) {
    return light.color * (light.type == scene::LightType::sun ? light.irradiance_w_m2 : light.power_w);
}

// Whether it has power, and a surface to send it from: to Cycles an area light without one is dark.
bool sends_light(const scene::LightInstance& instance, const scene::Light& light) {
    const bool flat = light.type == scene::LightType::area &&
                      !(static_cast<double>(light.size_x_m) * static_cast<double>(light.size_y_m) *
                            glm::length(glm::dvec3(instance.world_from_light[0])) *
                            glm::length(glm::dvec3(instance.world_from_light[1])) >
                        0.0);
    return strength(light) != glm::vec3(0.0F) && !flat;
}

bool deforms(const scene::Scene& scene, const scene::DrawInstance& draw) {
    const scene::Mesh& mesh = scene.meshes[at(draw.mesh)];
    return std::any_of(
        mesh.primitives.begin(), mesh.primitives.end(), [&](const scene::Primitive& primitive) {
            return !primitive.targets.empty() || (draw.skin != scene::k_none && !primitive.joints.empty());
        });
}

// Metals reflect by their lobe alone, and the lobe of a dielectric smoother than Blender's default (roughness
// 0.5) stands out from its diffuse reflection.
bool has_narrow_lobe(const scene::Material& material) {
    const bool textured = material.metallic_roughness_texture.present();
    return !material.unlit && (textured || material.metallic > 0.0F || material.roughness < 0.5F);
}

// Bounced light was asked for, but there is none in this frame.
void leave_out_bounces(FramePlan& plan, const std::string& reason) {
    if (!plan.indirect) {
        return;
    }
    plan.indirect = false;
    plan.left_out.push_back({"bounced light", reason});
    plan.notes.push_back("no bounced light: " + reason);
}

// Calls visit(material) for each material that a visible draw uses.
template <typename Visit>
void for_each_material(const scene::Scene& scene, const scene::Pose& pose, Visit&& visit) {
    for (const scene::DrawInstance& draw : pose.draws) {
        for (const scene::Primitive& primitive : scene.meshes[at(draw.mesh)].primitives) {
            if (primitive.material != scene::k_none) {
                visit(pose.materials[at(primitive.material)]);
            }
        }
    }
}

// Whether a light that casts shadows has a penumbra to be drawn.
bool throws_penumbra(const scene::LightInstance& instance, const scene::Light& light,
                     const Settings& settings, const Sight* sight, FramePlan& plan) {
    const auto leave_out = [&](const char* reason) {
        plan.left_out.push_back({"soft shadow: " + light.name, reason});
        return false;
    };
    if (!(light_extent(instance, light) > 0.0)) {
        return leave_out("the light has no size");
    }
    if (sight != nullptr && settings.forced != Forced::all &&
        widest_penumbra_m(instance, light, sight->bounds) < k_least_penumbra_pixels * sight->finest_pixel_m) {
        return leave_out("its penumbra is narrower than half a pixel everywhere");
    }
    if (settings.direct_shadows == DirectShadows::hard) {
        plan.approximations.push_back(
            fmt::format("light {}: drawn with a hard shadow in spite of its size, as asked for", light.name));
        return leave_out("hard shadows were asked for");
    }
    if (settings.direct_shadows == DirectShadows::convolution) {
        plan.approximations.push_back(
            fmt::format("light {}: its soft shadow is convolved from one map of its centre", light.name));
    }
    if (settings.direct_shadows == DirectShadows::ism) {
        plan.imperfect_shadows = true;
        plan.approximations.push_back(
            fmt::format("light {}: its soft shadow is of imperfect maps, drawn from points", light.name));
    }
    return true;
}

void plan_lights(const scene::Pose& pose, const Settings& settings, const Sight* sight, FramePlan& plan) {
    for (size_t i = 0; i < pose.light_instances.size(); ++i) {
        const scene::Light& light = pose.lights[at(pose.light_instances[i].light)];
        if (!sends_light(pose.light_instances[i], light)) {
            plan.left_out.push_back({"light: " + light.name, "it sends no light in this frame"});
            continue;
        }
        plan.lights.push_back(static_cast<int>(i));
        plan.takes_light.push_back(glm::any(glm::lessThan(strength(light), glm::vec3(0.0F))));
        if (plan.takes_light.back() && plan.indirect) {
            plan.approximations.push_back(
                fmt::format("light {}: takes light away, but not bounced light", light.name));
        }
        plan.shadows.push_back(light.cast_shadow && plan.direct);
        if (plan.direct && !light.cast_shadow) {
            plan.left_out.push_back({"shadow map: " + light.name, "the light casts no shadow"});
        }
        plan.soft.push_back(plan.shadows.back() &&
                            throws_penumbra(pose.light_instances[i], light, settings, sight, plan));
        if (light.pattern.width > 0 && plan.direct &&
            !(plan.soft.back() && settings.direct_shadows != DirectShadows::convolution)) {
            plan.approximations.push_back(
                fmt::format("light {}: shines with its image's mean colour, as it throws no soft shadow from "
                            "places on it",
                            light.name));
        }
        plan.veiled.push_back(plan.veils && plan.shadows.back() && !plan.soft.back() &&
                              settings.direct_shadows != DirectShadows::hard);
        const bool bounces = plan.indirect && !plan.takes_light.back();
        plan.places.push_back(bounces && sight != nullptr
                                  ? count_bounce_places(pose.light_instances[i], light,
                                                        sight->scene_diagonal_m, settings.bounce_places)
                                  : 1);
        if (light.type == scene::LightType::area && plan.indirect) {
            plan.approximations.push_back(fmt::format(
                "area light {}: its bounce is taken from {}", light.name,
                plan.places.back() == 1 ? "its centre" : fmt::format("{} places", plan.places.back())));
        }
    }
    if (std::find(plan.takes_light.begin(), plan.takes_light.end(), false) == plan.takes_light.end()) {
        leave_out_bounces(plan, k_no_light);
    }
}

bool draws_triangles(const scene::Scene& scene, const scene::Pose& pose) {
    return std::any_of(pose.draws.begin(), pose.draws.end(), [&](const scene::DrawInstance& draw) {
        const std::vector<scene::Primitive>& primitives = scene.meshes[at(draw.mesh)].primitives;
        return std::any_of(primitives.begin(), primitives.end(),
                           [](const scene::Primitive& primitive) { return !primitive.indices.empty(); });
    });
}

// A primitive without a material is white metal in glTF.
bool draws_default_material(const scene::Scene& scene, const scene::Pose& pose) {
    return std::any_of(pose.draws.begin(), pose.draws.end(), [&](const scene::DrawInstance& draw) {
        const std::vector<scene::Primitive>& primitives = scene.meshes[at(draw.mesh)].primitives;
        return std::any_of(primitives.begin(), primitives.end(), [](const scene::Primitive& primitive) {
            return primitive.material == scene::k_none && !primitive.indices.empty();
        });
    });
}

void plan_materials(const scene::Scene& scene, const scene::Pose& pose, const Settings& settings,
                    FramePlan& plan) {
    // Lights with glossy lobes carry what metals reflect, too.
    const bool glossy = settings.technique == Technique::ism && settings.glossy_bounces;
    bool emitters = false;
    bool reflects = false;
    bool receives = draws_default_material(scene, pose);
    bool holes = false;
    for_each_material(scene, pose, [&](const scene::Material& material) {
        const bool shines = !material.unlit && !is_dark(material.emission * material.emission_strength);
        emitters |= shines;
        plan.emission |= shines || material.unlit;  // an unlit surface shows its colour as if it emitted it
        plan.narrow_lobes |= glossy && has_narrow_lobe(material);
        holes |= material.alpha_mode != scene::AlphaMode::opaque;
        receives |= !material.unlit && (!is_dark(glm::vec3(material.base_color)) || material.specular > 0.0F);
        // Where a texture says what is metal, the factor 1 is only glTF's default.
        const float metallic =
            glossy || material.metallic_roughness_texture.present() ? 0.0F : material.metallic;
        reflects |= !is_dark(glm::vec3(material.base_color) * (1.0F - metallic)) && !material.unlit;
    });
    plan.narrow_lobes |= glossy && draws_default_material(scene, pose);
    if (!draws_triangles(scene, pose)) {
        leave_out_bounces(plan, "nothing that is drawn has a triangle");
    } else if (!reflects && !(glossy && draws_default_material(scene, pose))) {
        leave_out_bounces(plan, glossy ? "no surface reflects light" : "no surface reflects diffusely");
    }
    // A hole between the parts of a cut-out looks like a place that points left bare.
    const bool disks = settings.technique == Technique::ism && settings.visibility == Visibility::ism &&
                       settings.splat == Splat::disks;
    plan.close_maps = disks && !holes;
    plan.close_world = !holes;
    if (disks && holes) {
        plan.left_out.push_back({"ism close", "a material has holes, which closing would fill"});
    }
    plan.emitters = emitters;
    plan.receives = receives;
    plan.emission |= settings.forced != Forced::nothing;
    if (!plan.emission) {
        plan.left_out.push_back({"emission", "no visible surface emits"});
    }
}

// Whether what emits lights anything. plan.emitters: whether anything that is drawn emits. bounces: of its
// light.
void plan_emitters(const Settings& settings, bool whole, int bounces, FramePlan& plan) {
    const bool emits = plan.emitters;
    plan.emitters = emits && plan.receives && whole && settings.emitter_vpls > 0;
    if (!plan.emitters) {
        plan.left_out.push_back({"emitter lights", !emits   ? "no visible surface emits"
                                                   : !whole ? "the layer shows other light alone"
                                                   : !plan.receives
                                                       ? "no surface reflects light"
                                                       : "emissive surfaces were asked to light nothing"});
        if (emits && whole && settings.emitter_vpls == 0) {
            plan.approximations.emplace_back("emissive surfaces are seen but light nothing, as asked for");
        }
        return;
    }
    const bool ism = settings.technique == Technique::ism;
    plan.emitter_bounces = ism ? bounces : 0;
    plan.emitters_occluded = !ism || settings.visibility != Visibility::none;
}

void plan_transparency(const scene::Scene& scene, const scene::Pose& pose, const Settings& settings,
                       FramePlan& plan) {
    const bool any = scene::draws_blended(scene, pose);
    const bool forced = settings.forced != Forced::nothing;
    plan.blends = (any || forced) && settings.transparent_layers > 0;
    plan.veils = any && plan.blends;
    const bool shown =
        shows_light(settings.show) && settings.show != Show::unblurred && settings.show != Show::removed;
    plan.blend_layers =
        plan.blends && (shown || settings.show == Show::vpls) ? settings.transparent_layers : 0;
    if (plan.blend_layers == 0) {
        plan.left_out.push_back({"transparent layers", !any ? "no visible surface is blended"
                                                       : !plan.blends
                                                           ? "blended surfaces were asked for as cut-outs"
                                                           : "the layer shows solid surfaces alone"});
    }
    if (any && !plan.blends) {
        plan.approximations.emplace_back("blended transparency is drawn as a cut-out at one half");
    } else if (any && settings.direct_shadows == DirectShadows::hard) {
        plan.approximations.emplace_back(
            "blended surfaces throw the shadows of cut-outs at one half: hard shadows were asked for");
    }
}

// lit: whether any light bounces.
void plan_temporal_reuse(const Settings& settings, bool lit, FramePlan& plan) {
    const bool shown =
        settings.show == Show::shaded || settings.show == Show::indirect || settings.show == Show::vpls;
    const char* reason = !settings.temporal_reuse                ? "it was not asked for"
                         : settings.technique != Technique::ism  ? "technique ism alone keeps light"
                         : !lit                                  ? "there is no bounced light"
                         : !shown                                ? "the layer shows one frame's own data"
                         : settings.shading != Shading::deferred ? "light is gathered on simplified meshes"
                         : settings.interleave == 1
                             ? "without interleaved pixels nothing says how far lights may differ"
                             : nullptr;
    plan.temporal_reuse = reason == nullptr;
    if (reason != nullptr) {
        plan.left_out.push_back({"temporal reuse", reason});
    }
}

// Whether rays are traced through the approximate visibility grid.
void plan_grid(const Settings& settings, FramePlan& plan) {
    const bool further = plan.bounces > 1 || plan.world_bounces > 0 || plan.emitter_bounces > 0;
    plan.avg = plan.traced || (further && settings.bounce_source == BounceSource::avg);
    if (!plan.avg && settings.technique == Technique::ism) {
        plan.left_out.push_back(
            {"avg cells",
             settings.bounce_source == BounceSource::avg
                 ? "nothing is traced through it: there is no bounce after those of the reflective "
                   "shadow maps"
                 : "nothing is traced through it: bounces are not asked for by avg"});
    }
}

}  // namespace

FramePlan plan_frame(const scene::Scene& scene, const scene::Pose& pose, const Settings& settings,
                     const Sight* sight) {
    FramePlan plan;
    plan.direct =
        settings.show == Show::shaded || settings.show == Show::direct || settings.show == Show::vpls;
    plan.indirect = settings.technique != Technique::direct && settings.show != Show::direct;
    if (settings.technique == Technique::direct) {
        plan.left_out.push_back({"bounced light", "direct light only was asked for"});
    }
    plan.deform = std::any_of(pose.draws.begin(), pose.draws.end(),
                              [&](const scene::DrawInstance& draw) { return deforms(scene, draw); });
    if (!plan.deform) {
        plan.left_out.push_back({"deform", "no visible mesh is skinned or morphs"});
    }
    if (settings.show == Show::motion) {
        plan.motion = true;
        plan.direct = plan.indirect = false;
        plan.left_out.push_back({"light", "the layer shows motion alone"});
        return plan;
    }
    if (settings.show == Show::avg) {
        plan.avg = true;
        plan.direct = plan.indirect = false;
        plan.left_out.push_back({"light", "the layer shows the approximate visibility grid alone"});
        return plan;
    }
    plan_transparency(scene, pose, settings, plan);
    plan_lights(pose, settings, sight, plan);
    plan.direct = plan.direct && !plan.lights.empty();
    plan_materials(scene, pose, settings, plan);
    plan.vpls = plan.indirect && settings.technique == Technique::ism && !shows_rsm(settings.show);
    plan.traced = plan.vpls && settings.traces_first();
    plan.near_field = plan.vpls && settings.near_field && !plan.traced;
    const double albedo = albedo_bound(scene, pose, settings.glossy_bounces);
    const int counted =
        settings.forced == Forced::all ? settings.bounces : counted_bounces(settings.bounces, albedo);
    if (plan.vpls && counted < settings.bounces) {
        plan.left_out.push_back(
            {"further bounces",
             fmt::format(
                 "no surface reflects more than {:.2g} of the light, so less than {:g} of it is to come "
                 "after {}",
                 albedo, k_least_bounced_share,
                 counted == 0   ? "direct light"
                 : counted == 1 ? "the first bounce"
                                : fmt::format("{} bounces", counted))});
    }
    plan.bounces = plan.vpls ? counted : 0;
    if (plan.vpls && plan.bounces == 0) {
        plan.vpls = plan.near_field = plan.traced = plan.indirect = false;
    }
    plan.interpolate = plan.indirect && settings.technique == Technique::rsm && settings.interpolate &&
                       settings.lowres_step > 1 && !settings.rsm_full_sum;
    if (plan.indirect && settings.technique == Technique::rsm && !plan.interpolate) {
        plan.left_out.push_back({"rsm interpolate", "every pixel is evaluated in full, as asked for"});
    }
    plan.antialias = settings.antialias && !pose.draws.empty() &&
                     (shows_light(settings.show) || settings.show == Show::vpls) &&
                     settings.show != Show::unblurred;
    if (!plan.antialias) {
        plan.left_out.push_back({"antialias", !settings.antialias  ? "pictures without it were asked for"
                                              : pose.draws.empty() ? "nothing is drawn"
                                                                   : "the layer shows data as they are"});
    }
    const bool whole = settings.show == Show::shaded || settings.show == Show::vpls;
    plan.world_light = !is_dark(pose.world.color * pose.world.strength) && whole;
    plan.environment = plan.world_light && scene.environment.has_value();
    plan.world_occluded = (plan.world_light || (whole && settings.forced == Forced::all)) &&
                          settings.world_vpls > 0 && draws_triangles(scene, pose);
    if (!plan.world_occluded) {
        plan.left_out.push_back({"world lights", !plan.world_light && whole ? "the world is black"
                                                 : !plan.world_light ? "the layer shows other light alone"
                                                 : settings.world_vpls == 0
                                                     ? "the world's light was asked for without what hides it"
                                                     : "nothing that is drawn has a triangle"});
    }
    plan.world_bounces =
        plan.world_occluded && settings.technique == Technique::ism && !shows_rsm(settings.show) ? counted
                                                                                                 : 0;
    plan_emitters(settings, whole, counted, plan);
    plan_grid(settings, plan);
    if (plan.world_bounces + plan.emitter_bounces > 0) {
        std::erase(plan.notes, std::string("no bounced light: ") + k_no_light);
    }
    // The option is one of technique ism; what surfaces reflect of the world directly has both lobes
    // everywhere.
    plan.glossy = (plan.vpls || plan.world_occluded || plan.emitters) &&
                  (settings.glossy_bounces || settings.technique != Technique::ism);
    plan.occluded = (plan.vpls || plan.world_bounces > 0 || plan.emitter_bounces > 0) &&
                    settings.visibility != Visibility::none;
    const bool lit = plan.vpls || plan.world_bounces > 0 || plan.emitter_bounces > 0;
    plan.hybrid = lit && settings.shading == Shading::hybrid;
    plan_temporal_reuse(settings, lit, plan);
    plan.simplified = plan.hybrid || ((plan.occluded || plan.emitters_occluded) &&
                                      settings.visibility == Visibility::simplified);
    if (settings.simplifies() && !plan.simplified) {
        plan.left_out.push_back({"simplified meshes", "no bounced light is drawn by them"});
    }
    if (!plan.environment) {
        plan.left_out.push_back(
            {"world image", scene.environment ? "the world's light is not shown" : "the world has no image"});
    } else if (!plan.world_occluded) {
        plan.approximations.emplace_back("the world's image lights with its mean colour");
    }
    if (plan.world_light && !plan.world_occluded) {
        plan.approximations.emplace_back("the world's light is not occluded");
    } else if (!plan.world_light && whole) {
        plan.left_out.push_back({"world light", "the world is black"});
    }
    const std::vector<LeftOut> absent = absent_details(scene, pose, settings, plan);
    plan.left_out.insert(plan.left_out.end(), absent.begin(), absent.end());
    return plan;
}

}  // namespace bounce
