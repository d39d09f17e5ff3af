// SPDX-License-Identifier: Apache-2.0
#include "renderer/light_history.h"

#include <algorithm>
#include <tuple>

#include "renderer/previous_frame.h"

namespace bounce {
namespace {

// Frames that a mean may be of: while nothing but the camera moves, and while something does, whose bounced
// light changes all around it. While nothing does each has other lights, so that the longer a mean is the
// less it flickers. At most 255, which are counted in bytes.
constexpr int k_most_frames = 64;
constexpr int k_most_frames_moving = 6;

size_t at(int index) {
    return static_cast<size_t>(index);
}

bool same_light(const scene::Light& a, const scene::Light& b) {
    const auto key = [](const scene::Light& l) {
        return std::tie(l.type, l.color, l.power_w, l.irradiance_w_m2, l.radius_m, l.angle_rad,
                        l.cone_angle_rad, l.blend, l.inner_cone_rad, l.profile, l.shape, l.size_x_m,
                        l.size_y_m, l.spread_rad, l.cast_shadow, l.pattern.width, l.pattern.height,
                        l.pattern.cells);
    };
    return key(a) == key(b);
}

bool same_material(const scene::Material& a, const scene::Material& b) {
    const auto key = [](const scene::Material& m) {
        return std::tie(m.base_color, m.metallic, m.roughness, m.specular, m.emission, m.emission_strength);
    };
    return key(a) == key(b);
}

bool emits(const scene::Scene& scene, const scene::Pose& pose, const scene::DrawInstance& draw) {
    const std::vector<scene::Primitive>& primitives = scene.meshes[at(draw.mesh)].primitives;
    return std::any_of(primitives.begin(), primitives.end(), [&](const scene::Primitive& p) {
        return p.material != scene::k_none &&
               pose.materials[at(p.material)].emission * pose.materials[at(p.material)].emission_strength !=
                   glm::vec3(0.0F);
    });
}

bool deforms(const scene::Scene& scene, const scene::DrawInstance& draw) {
    const std::vector<scene::Primitive>& primitives = scene.meshes[at(draw.mesh)].primitives;
    return std::any_of(primitives.begin(), primitives.end(), [&](const scene::Primitive& p) {
        return !p.targets.empty() || (draw.skin != scene::k_none && !p.joints.empty());
    });
}

bool same_draws(const std::vector<scene::DrawInstance>& a, const std::vector<scene::DrawInstance>& b) {
    return std::equal(a.begin(), a.end(), b.begin(), b.end(),
                      [](const scene::DrawInstance& x, const scene::DrawInstance& y) {
                          return x.node == y.node && x.mesh == y.mesh &&
                                 x.world_from_model == y.world_from_model;
                      });
}

// Whether what emits light moved.
bool emitters_moved(const scene::Scene& scene, const scene::Pose& before, const scene::Pose& now) {
    const auto emitting = [&](const scene::Pose& pose) {
        std::vector<scene::DrawInstance> out;
        std::copy_if(pose.draws.begin(), pose.draws.end(), std::back_inserter(out),
                     [&](const scene::DrawInstance& draw) { return emits(scene, pose, draw); });
        return out;
    };
    const std::vector<scene::DrawInstance> of_now = emitting(now);
    const bool change = std::any_of(of_now.begin(), of_now.end(),
                                    [&](const scene::DrawInstance& draw) { return deforms(scene, draw); });
    return change || !same_draws(emitting(before), of_now);
}

void require(gl::Texture& texture, const char* name, GLenum format, const Settings& settings) {
    const gl::TextureDesc desc{.format = format, .width = settings.width, .height = settings.height};
    if (!texture || texture.desc() != desc) {
        texture = gl::Texture(name, desc);
    }
}

}  // namespace

std::string light_changed(const scene::Scene& scene, const scene::Pose& before, const scene::Pose& now) {
    const bool lights =
        std::equal(before.light_instances.begin(), before.light_instances.end(), now.light_instances.begin(),
                   now.light_instances.end(), [&](const auto& a, const auto& b) {
                       return a.node == b.node && a.world_from_light == b.world_from_light &&
                              same_light(before.lights[at(a.light)], now.lights[at(b.light)]);
                   });
    if (!lights) {
        return "a light moved or changed";
    }
    if (before.world.color * before.world.strength != now.world.color * now.world.strength ||
        before.world.world_from_environment != now.world.world_from_environment) {
        return "the world's light changed";
    }
    if (!std::equal(before.materials.begin(), before.materials.end(), now.materials.begin(),
                    now.materials.end(), same_material)) {
        return "a material changed";
    }
    return emitters_moved(scene, before, now) ? "a surface that emits moved" : "";
}

std::string settings_changed(const Settings& before, const Settings& now) {
    if (before.width != now.width || before.height != now.height) {
        return "the picture's size changed";
    }
    // Not how many lights there are: more of them change no mean.
    const auto key = [](const Settings& s) {
        return std::tuple(s.technique, s.show, s.bounces, s.world_vpls > 0, s.world_sampling,
                          s.emitter_vpls > 0, s.emitter_panels, s.bounce_places, s.shading, s.visibility,
                          s.splat, s.bounce_source, s.vpl_sampling, s.vpl_importance, s.importance_pixels,
                          s.importance_floor, s.vpl_steps, s.avg_size, s.avg_hits, s.avg_paths,
                          s.map_projection, s.simplify.ratio, s.simplify.error, s.ism_points,
                          s.used_rsm_size(), s.ism_size, s.large_triangles, s.drop_hull, s.pull_push,
                          s.interleave, s.near_field, s.glossy_bounces, s.transparent_layers > 0);
    };
    return key(before) == key(now) ? "" : "the settings changed";
}

LightHistory::Continuation LightHistory::continuation(const gpu::GpuScene& scene, const scene::Pose& pose,
                                                      const Settings& settings) const {
    Continuation out;
    if (!before_) {
        out.reason = "there is no frame before it";
    } else if (out.reason = settings_changed(before_->settings, settings); out.reason.empty()) {
        out.reason = light_changed(scene.source(), before_->pose, pose);
    }
    if (out.reason.empty()) {
        out.moved = scene.deforms() || !same_draws(before_->pose.draws, pose.draws);
        out.number = before_->number + 1;
    }
    return out;
}

LightHistory::Frame LightHistory::begin(const gpu::GpuScene& scene, const scene::Pose& pose,
                                        const CameraMatrices& camera, const Settings& settings, float scale,
                                        const Continuation& continuation, gpu::UniformArena& uniforms) {
    Frame out;
    Textures& next = textures_[next_];
    require(next.bounced, "kept light", GL_RGBA32UI, settings);
    require(next.depth, "kept depth", GL_DEPTH_COMPONENT32F, settings);
    require(next.normal, "kept normals", GL_RG16, settings);
    require(next.frames, "kept frames", GL_R8UI, settings);
    out.next = next.kept();
    if (continuation.reason.empty()) {
        passes::LightBefore& light = out.before.emplace();
        light.kept = textures_[1 - next_].kept();
        light.camera = uniforms.add(motion_uniforms(before_->camera, settings, scene.space()));
        light.scale = scale / before_->scale;
        light.most_frames = continuation.moved ? k_most_frames_moving : k_most_frames;
        if (continuation.moved) {
            if (!has_positions_) {  // nothing deforms: they are what they were
                previous_pose_.keep_positions(scene.vertices());
                has_positions_ = true;
            }
            previous_pose_.match_draws(scene, pose, before_->pose);
            light.moved = &previous_pose_;
        }
    }
    drawn_ = Moment{pose, camera, settings, scale, continuation.number};
    return out;
}

void LightHistory::keep(const gpu::GpuScene& scene) {
    if (!drawn_) {
        return;
    }
    before_ = std::move(drawn_);
    drawn_.reset();
    next_ = 1 - next_;
    if (scene.deforms()) {
        previous_pose_.keep_positions(scene.vertices());
        has_positions_ = true;
    }
}

}  // namespace bounce
