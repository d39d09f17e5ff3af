// SPDX-License-Identifier: Apache-2.0
#include "renderer/previous_frame.h"

#include "gl/debug_output.h"
#include "passes/deform.h"

namespace bounce {

gpu::MotionUniforms motion_uniforms(const CameraMatrices& camera, const Settings& settings,
                                    const gpu::RenderSpace& space) {
    gpu::MotionUniforms out{};
    out.clip_from_render = glm::mat4(camera.clip_from_render);
    out.render_from_clip = glm::mat4(camera.render_from_clip);
    out.eye = glm::vec4(glm::vec3(camera.position), static_cast<float>(1.0 / space.scale));
    out.forward = glm::vec4(glm::vec3(camera.forward), static_cast<float>(2.0 * camera.pixel_radius));
    out.picture = {settings.width, settings.height, camera.perspective ? 1.0F : 0.0F, 0.0F};
    return out;
}

void PreviousFrameSource::draw(gpu::GpuScene& scene, gl::ProgramCache& programs, TransientPool& pool,
                               gpu::UniformArena& uniforms, const Moment& before, const Settings& settings,
                               gl::PassTimer& timer, std::vector<std::string>& executed) {
    scene.set_pose(before.pose);
    if (scene.deforms()) {
        timer.begin("previous deform");
        passes::run_deform(programs, scene);
        timer.end();
        gl::throw_on_debug_error("previous deform");
        executed.emplace_back("previous deform");
    }
    pose_.keep_positions(scene.vertices());

    const gl::TextureDesc desc{
        .format = GL_DEPTH_COMPONENT32F, .width = settings.width, .height = settings.height};
    if (depth_.desc() != desc || !depth_) {
        depth_ = gl::Texture("previous depth", desc);
    }
    const CameraMatrices camera = camera_matrices(tighten_orthographic_depth(before.camera, scene.bounds()),
                                                  settings.width, settings.height, scene.space());
    motion_ = motion_uniforms(camera, settings, scene.space());

    uniforms.clear();
    const gpu::UniformArena::Slot view =
        uniforms.add(gpu::ViewUniforms{motion_.clip_from_render, glm::vec4(0.0F)});
    uniforms.upload();
    FrameGraph graph(pool);
    passes::add_previous_depth(graph,
                               {.programs = programs,
                                .scene = scene,
                                .uniforms = uniforms,
                                .frame = {},
                                .width = settings.width,
                                .height = settings.height},
                               {view, motion_.clip_from_render, false},
                               graph.import_texture("previous depth", depth_));
    graph.execute(timer);
    executed.insert(executed.end(), graph.executed().begin(), graph.executed().end());
}

passes::PreviousFrame PreviousFrameSource::match(const gpu::GpuScene& scene, const scene::Pose& now,
                                                 const scene::Pose& before, gpu::UniformArena& uniforms) {
    pose_.match_draws(scene, now, before);
    return {uniforms.add(motion_), &pose_, &depth_};
}

}  // namespace bounce
