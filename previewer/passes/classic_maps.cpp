// SPDX-License-Identifier: Apache-2.0
#include "passes/classic_maps.h"

#include <array>

namespace bounce::passes {
namespace {

// A uniform block may begin at multiples of 256 bytes on every driver.
constexpr int k_view_stride = 256;

void make_views(const PassContext& context, const PassResources& resources, const VplSet& set,
                const gl::Buffer& views) {
    context.programs.compute("passes/classic_views.comp").use();
    context.uniforms.bind(UBO_ISM, set.uniforms);
    resources.buffer(set.vpls).bind_storage(SSBO_VPLS);
    views.bind_storage(SSBO_VIEWS_OUT);
    const auto count = static_cast<GLuint>(set.maps * k_classic_faces);
    glDispatchCompute((count + GROUP_1D - 1) / GROUP_1D, 1, 1);
    finish_writes();
    glMemoryBarrier(GL_UNIFORM_BARRIER_BIT);
}

void draw_face(const PassContext& context, const gl::Framebuffer& target, const gl::Buffer& views, int view) {
    constexpr std::array<float, 4> nothing{};
    const float far_depth = 0.0F;
    target.bind();
    glClearNamedFramebufferfv(target.id(), GL_COLOR, 0, nothing.data());
    glClearNamedFramebufferfv(target.id(), GL_DEPTH, 0, &far_depth);
    glBindBufferRange(GL_UNIFORM_BUFFER, UBO_VIEW, views.id(), static_cast<GLintptr>(view) * k_view_stride,
                      sizeof(gpu::ViewUniforms));
    draw_batches(context, false, DrawKind::plane, "passes/classic_map.frag", {});
}

}  // namespace

TextureHandle add_classic_maps(FrameGraph& graph, const PassContext& context, const VplSet& set) {
    TextureHandle atlas;
    graph.add_pass("classic maps", [&](PassBuilder& builder) {
        builder.read(set.vpls);
        atlas = builder.create_texture(
            "ism atlas",
            {.format = GL_R32UI, .width = set.columns * set.map_size, .height = set.rows * set.map_size});
        const BufferHandle views = builder.create_buffer(
            "classic views", static_cast<size_t>(set.maps) * k_classic_faces * k_view_stride);
        const TextureHandle planes = builder.create_texture(
            "classic planes",
            {.format = GL_RGBA32F, .width = set.map_size, .height = set.map_size, .layers = k_classic_faces});
        const TextureHandle depth = builder.create_texture(
            "classic depth",
            {.format = GL_DEPTH_COMPONENT32F, .width = set.map_size, .height = set.map_size});
        return [context, set, atlas, views, planes, depth](const PassResources& resources) {
            make_views(context, resources, set, resources.buffer(views));
            for (int map = 0; map < set.maps; ++map) {
                for (int face = 0; face < k_classic_faces; ++face) {
                    draw_face(context,
                              resources.framebuffer({{&resources.texture(planes), face}},
                                                    {&resources.texture(depth)}),
                              resources.buffer(views), map * k_classic_faces + face);
                }
                context.programs.compute("passes/classic_project.comp").use();
                context.uniforms.bind(UBO_ISM, set.uniforms);
                resources.buffer(set.vpls).bind_storage(SSBO_VPLS);
                resources.texture(planes).bind(TEX_RSM);
                resources.texture(atlas).bind_image(IMG_OUT, GL_WRITE_ONLY);
                glUniform1i(0, map);
                glMemoryBarrier(GL_FRAMEBUFFER_BARRIER_BIT | GL_TEXTURE_FETCH_BARRIER_BIT);
                dispatch_2d(set.map_size, set.map_size);
            }
            finish_writes();
        };
    });
    return atlas;
}

}  // namespace bounce::passes
