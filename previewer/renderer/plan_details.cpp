// SPDX-License-Identifier: Apache-2.0
#include "renderer/plan_details.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

namespace bounce {
namespace {

size_t at(int index) {
    return static_cast<size_t>(index);
}

// A lobe of specular 0.5 (an index of refraction of 1.5) reflects 9 % of light from all directions together.
constexpr double k_lobe_albedo = 0.2;

double albedo_bound(const scene::Material& material, bool glossy) {
    if (material.unlit) {
        return 0.0;
    }
    const glm::vec3 base(material.base_color);
    const double lobe = glossy ? k_lobe_albedo * static_cast<double>(material.specular) : 0.0;
    return std::clamp(static_cast<double>(std::max({base.r, base.g, base.b})) + lobe, 0.0, 1.0);
}

// Calls visit(primitive, material) for each primitive that is drawn and has triangles.
template <typename Visit>
void for_each_drawn(const scene::Scene& scene, const scene::Pose& pose, const Visit& visit) {
    static const scene::Material default_material;
    for (const scene::DrawInstance& draw : pose.draws) {
        for (const scene::Primitive& primitive : scene.meshes[at(draw.mesh)].primitives) {
            if (!primitive.indices.empty()) {
                visit(primitive, primitive.material == scene::k_none
                                     ? default_material
                                     : pose.materials[at(primitive.material)]);
            }
        }
    }
}

struct Drawn {
    bool base_color_texture = false;
    bool metallic_roughness_texture = false;
    bool normal_map = false;
    bool emission_texture = false;
    bool vertex_colors = false;
    bool alpha = false;
    bool lobes = false;
};

Drawn find_drawn(const scene::Scene& scene, const scene::Pose& pose) {
    Drawn out;
    for_each_drawn(scene, pose, [&](const scene::Primitive& primitive, const scene::Material& material) {
        out.base_color_texture |= material.base_color_texture.present();
        out.metallic_roughness_texture |= material.metallic_roughness_texture.present();
        out.normal_map |= material.normal_texture.present() && !primitive.tangents.empty();
        out.emission_texture |= material.emission_texture.present();
        out.vertex_colors |= !primitive.colors.empty();
        out.alpha |= material.alpha_mode != scene::AlphaMode::opaque;
        out.lobes |= !material.unlit && (material.specular > 0.0F || material.metallic > 0.0F);
    });
    return out;
}

bool sends(const scene::Pose& pose, const FramePlan& plan, scene::LightType type) {
    return std::any_of(plan.lights.begin(), plan.lights.end(), [&](int light) {
        return pose.lights[at(pose.light_instances[at(light)].light)].type == type;
    });
}

}  // namespace

double albedo_bound(const scene::Scene& scene, const scene::Pose& pose, bool glossy) {
    double most = 0.0;
    for_each_drawn(scene, pose, [&](const scene::Primitive& primitive, const scene::Material& material) {
        // A file's vertex colours may be above 1: they count as whatever makes the surface white.
        const bool any = !primitive.colors.empty() && !material.unlit;
        most = std::max(most, any ? 1.0 : albedo_bound(material, glossy));
    });
    return most;
}

int counted_bounces(int asked, double albedo) {
    double to_come = 0.0;  // of all bounces after `count`
    int count = asked;
    while (count > 0 && to_come + std::pow(albedo, count) < k_least_bounced_share) {
        to_come += std::pow(albedo, count);
        --count;
    }
    return count;
}

std::vector<LeftOut> absent_details(const scene::Scene& scene, const scene::Pose& pose,
                                    const Settings& settings, const FramePlan& plan) {
    std::vector<LeftOut> out;
    const auto leave_out_if = [&](bool absent, const char* what, const char* reason) {
        if (absent) {
            out.push_back({what, reason});
        }
    };
    const Drawn drawn = find_drawn(scene, pose);
    leave_out_if(!drawn.base_color_texture, "base colour textures",
                 "no visible surface has one: compiled out");
    leave_out_if(!drawn.metallic_roughness_texture, "metallic-roughness textures",
                 "no visible surface has one: compiled out");
    leave_out_if(!drawn.normal_map, "normal maps", "no visible surface has one: compiled out");
    leave_out_if(!drawn.emission_texture, "emission textures", "no visible surface has one: compiled out");
    leave_out_if(!drawn.vertex_colors, "vertex colours", "no visible mesh has any: compiled out");
    leave_out_if(!drawn.alpha, "alpha test", "every visible surface is opaque: compiled out");
    leave_out_if(!drawn.lobes, "glossy lobes", "no visible surface is metallic or specular");
    leave_out_if(
        drawn.lobes && !plan.glossy && plan.indirect, "glossy lobes of bounced light",
        settings.glossy_bounces ? "no light bounces by them" : "diffuse bounces alone were asked for");
    leave_out_if(!sends(pose, plan, scene::LightType::point), "point lights",
                 "none sends light in this frame");
    leave_out_if(!sends(pose, plan, scene::LightType::spot), "spot lights", "none sends light in this frame");
    leave_out_if(!sends(pose, plan, scene::LightType::sun), "suns", "none sends light in this frame");
    leave_out_if(!sends(pose, plan, scene::LightType::area), "area lights", "none sends light in this frame");
    const bool lit = plan.vpls || plan.world_bounces > 0 || plan.emitter_bounces > 0;
    leave_out_if(plan.vpls && !plan.near_field, "near field",
                 plan.traced ? "lights that are traced have no reflective shadow maps to gather from"
                             : "it was asked to be left out");
    leave_out_if(lit && settings.bounces == 1, "further bounces", "one bounce was asked for");
    leave_out_if(lit && !plan.occluded, "visibility of bounced light", "it was asked to be left out");
    leave_out_if(lit && settings.interleave == 1, "blur",
                 "every pixel gathers from all lights, so there is nothing to blur over");
    leave_out_if(!lit && !plan.world_occluded && !plan.emitters, "gather and blur",
                 "no virtual point light shines");
    leave_out_if(shows_light(settings.show), "debug layers", "the picture itself is shown");
    return out;
}

bool splats_points(const FramePlan& plan, const Settings& settings) {
    const bool emitters = plan.emitters && plan.emitters_occluded;
    return plan.world_occluded || ((plan.occluded || emitters) && (settings.visibility == Visibility::ism ||
                                                                   settings.technique != Technique::ism));
}

bool draws_from_points(const FramePlan& plan, const Settings& settings) {
    return settings.bounce_source != BounceSource::avg &&
           (plan.bounces > 1 || plan.world_bounces > 0 || plan.emitter_bounces > 0);
}

bool points_needed(const FramePlan& plan, const Settings& settings) {
    return splats_points(plan, settings) || draws_from_points(plan, settings) || plan.emitters ||
           plan.imperfect_shadows;
}

}  // namespace bounce
