// SPDX-License-Identifier: Apache-2.0
#include "renderer/frame_plan.h"

#include <algorithm>

#include <fmt/format.h>

namespace bounce {
namespace {

size_t at(int index) {
    return static_cast<size_t>(index);
}

bool is_dark(const glm::vec3& color) {
    return !(std::max({color.r, color.g, color.b}) > 0.0F);
}

// Radiant power or irradiance is nothing.
bool sends_light(const scene::Light& light) {
    const float strength = light.type == scene::LightType::sun ? light.irradiance_w_m2 : light.power_w;
    return strength > 0.0F && !is_dark(light.color);
}

bool deforms(const scene::Scene& scene, const scene::DrawInstance& draw) {
    const scene::Mesh& mesh = scene.meshes[at(draw.mesh)];
    return std::any_of(
        mesh.primitives.begin(), mesh.primitives.end(), [&](const scene::Primitive& primitive) {
            return !primitive.targets.empty() || (draw.skin != scene::k_none && !primitive.joints.empty());
        });
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

void plan_lights(const scene::Pose& pose, const Settings& settings, FramePlan& plan) {
    for (size_t i = 0; i < pose.light_instances.size(); ++i) {
        const scene::Light& light = pose.lights[at(pose.light_instances[i].light)];
        if (!sends_light(light)) {
            plan.left_out.push_back({"light: " + light.name, "it sends no light in this frame"});
            continue;
        }
        plan.lights.push_back(static_cast<int>(i));
        plan.shadows.push_back(light.cast_shadow && plan.direct);
        if (plan.direct && !light.cast_shadow) {
            plan.left_out.push_back({"shadow map: " + light.name, "the light casts no shadow"});
        }
        const bool soft = light.radius_m > 0.0F || light.angle_rad > 0.0F;
        if (light.type == scene::LightType::area) {
            plan.approximations.push_back(
                fmt::format("area light {}: its shadow and bounce are taken from its centre", light.name));
        } else if (soft && plan.shadows.back()) {
            plan.approximations.push_back(
                fmt::format("light {}: drawn with a hard shadow in spite of its size", light.name));
        }
    }
    if (settings.technique != Technique::direct && plan.lights.empty()) {
        plan.left_out.push_back({"rsm", "no light sends light"});
    }
}

void plan_materials(const scene::Scene& scene, const scene::Pose& pose, FramePlan& plan) {
    bool blend = false;
    bool emitters = false;
    bool reflects = false;
    for_each_material(scene, pose, [&](const scene::Material& material) {
        const bool shines = !material.unlit && !is_dark(material.emission * material.emission_strength);
        emitters |= shines;
        plan.emission |= shines || material.unlit;  // an unlit surface shows its colour as if it emitted it
        blend |= material.alpha_mode == scene::AlphaMode::blend;
        // Where a texture says what is metal, the factor 1 is only glTF's default.
        const float metallic = material.metallic_roughness_texture.present() ? 0.0F : material.metallic;
        reflects |= !is_dark(glm::vec3(material.base_color) * (1.0F - metallic)) && !material.unlit;
    });
    // A primitive without a material is white metal in glTF: no diffuse bounce either.
    if (plan.indirect && !reflects) {
        plan.indirect = false;
        plan.left_out.push_back({"rsm", "no surface reflects diffusely"});
    }
    if (blend) {
        plan.approximations.emplace_back("blended transparency is drawn as a cut-out at one half");
    }
    if (emitters) {
        plan.approximations.emplace_back("emissive surfaces are seen but light nothing");
    }
    if (!plan.emission) {
        plan.left_out.push_back({"emission", "no visible surface emits"});
    }
}

}  // namespace

FramePlan plan_frame(const scene::Scene& scene, const scene::Pose& pose, const Settings& settings) {
    FramePlan plan;
    plan.direct = settings.show == Show::shaded || settings.show == Show::direct;
    plan.indirect = settings.technique != Technique::direct && settings.show != Show::direct;
    if (settings.technique == Technique::direct) {
        plan.left_out.push_back({"rsm", "direct light only was asked for"});
    }
    plan.deform = std::any_of(pose.draws.begin(), pose.draws.end(),
                              [&](const scene::DrawInstance& draw) { return deforms(scene, draw); });
    if (!plan.deform) {
        plan.left_out.push_back({"deform", "no visible mesh is skinned or morphs"});
    }
    plan_lights(pose, settings, plan);
    plan.indirect = plan.indirect && !plan.lights.empty();
    plan.direct = plan.direct && !plan.lights.empty();
    plan_materials(scene, pose, plan);
    plan.vpls = plan.indirect && settings.technique == Technique::ism;
    plan.near_field = plan.vpls && settings.near_field;
    plan.glossy = plan.vpls && settings.glossy_bounces;
    plan.occluded = plan.vpls && settings.visibility != Visibility::none;
    plan.bounces = plan.vpls ? settings.bounces : 0;
    plan.interpolate = plan.indirect && !plan.vpls && settings.interpolate && settings.lowres_step > 1 &&
                       !settings.rsm_full_sum;
    if (plan.indirect && !plan.vpls && !plan.interpolate) {
        plan.left_out.push_back({"rsm interpolate", "every pixel is evaluated in full, as asked for"});
    }
    plan.antialias = settings.antialias && !pose.draws.empty();
    if (!plan.antialias) {
        plan.left_out.push_back(
            {"antialias", settings.antialias ? "nothing is drawn" : "pictures without it were asked for"});
    }
    plan.world_light = !is_dark(pose.world.color * pose.world.strength) && settings.show == Show::shaded;
    if (plan.world_light) {
        plan.approximations.emplace_back("the world's light is not occluded");
    } else if (settings.show == Show::shaded) {
        plan.left_out.push_back({"world light", "the world is black"});
    }
    return plan;
}

}  // namespace bounce
