// SPDX-License-Identifier: Apache-2.0
#include "passes/classic_maps.h"

#include <array>
#include <string>

namespace bounce::passes {
namespace {

// A uniform block may begin at multiples of 256 bytes on every driver.
constexpr int k_view_stride = 256;

// ISM_EMPTY of shaders/lib/ism.glsl.
constexpr GLuint k_nothing_hit = 0x7bff0000U;

void make_views(const PassContext& context, const PassResources& resources, const VplSet& set, int faces,
                const gl::Buffer& views) {
    gl::Defines defines;
    if (faces == 1) defines["PARABOLOID"] = "1";
    context.programs.compute("passes/classic_views.comp", defines).use();
    context.uniforms.bind(UBO_ISM, set.uniforms);
    resources.buffer(set.vpls).bind_storage(SSBO_VPLS);
    views.bind_storage(SSBO_VIEWS_OUT);
    const auto count = static_cast<GLuint>(set.maps * faces);
    glDispatchCompute((count + GROUP_1D - 1) / GROUP_1D, 1, 1);
    finish_writes();
    glMemoryBarrier(GL_UNIFORM_BARRIER_BIT);
}

void draw_view(const PassContext& context, const gl::Framebuffer& target, const gl::Buffer& views, int view,
               const std::string& fragment, gl::Defines defines, gpu::Geometry geometry) {
    const float far_depth = 0.0F;
    glClearNamedFramebufferfv(target.id(), GL_DEPTH, 0, &far_depth);
    glBindBufferRange(GL_UNIFORM_BUFFER, UBO_VIEW, views.id(), static_cast<GLintptr>(view) * k_view_stride,
                      sizeof(gpu::ViewUniforms));
    if (geometry == gpu::Geometry::simplified) defines["SET_BACK"] = "1";
    draw_batches(context, false, DrawKind::plane, fragment, defines, geometry);
}

gl::TextureDesc atlas_desc(const VplSet& set) {
    return {.format = GL_R32UI, .width = set.columns * set.map_size, .height = set.rows * set.map_size};
}

TextureHandle add_faces(FrameGraph& graph, const PassContext& context, const VplSet& set,
                        gpu::Geometry geometry) {
    TextureHandle atlas;
    graph.add_pass("classic maps", [&](PassBuilder& builder) {
        builder.read(set.vpls);
        atlas = builder.create_texture("ism atlas", atlas_desc(set));
        const BufferHandle views = builder.create_buffer(
            "classic views", static_cast<size_t>(set.maps) * k_classic_faces * k_view_stride);
        const TextureHandle planes = builder.create_texture(
            "classic planes",
            {.format = GL_RGBA32F, .width = set.map_size, .height = set.map_size, .layers = k_classic_faces});
        const TextureHandle depth = builder.create_texture(
            "classic depth",
            {.format = GL_DEPTH_COMPONENT32F, .width = set.map_size, .height = set.map_size});
        builder.decided_by(ContentHash()
                               .add(content(context, set))
                               .add(drawn_content(context, nullptr, DrawKind::plane, geometry))
                               .key());
        return [context, set, geometry, atlas, views, planes, depth](const PassResources& resources) {
            constexpr std::array<float, 4> nothing{};
            make_views(context, resources, set, k_classic_faces, resources.buffer(views));
            for (int map = 0; map < set.maps; ++map) {
                for (int face = 0; face < k_classic_faces; ++face) {
                    const gl::Framebuffer& target = resources.framebuffer(
                        {{&resources.texture(planes), face}}, {&resources.texture(depth)});
                    target.bind();
                    glClearNamedFramebufferfv(target.id(), GL_COLOR, 0, nothing.data());
                    draw_view(context, target, resources.buffer(views), map * k_classic_faces + face,
                              "passes/classic_map.frag", {}, geometry);
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

// One map is drawn after the other and copied into the atlas, so that the depths are those of one map.
TextureHandle add_paraboloids(FrameGraph& graph, const PassContext& context, const VplSet& set,
                              gpu::Geometry geometry) {
    TextureHandle atlas;
    graph.add_pass("paraboloid maps", [&](PassBuilder& builder) {
        builder.read(set.vpls);
        atlas = builder.create_texture("ism atlas", atlas_desc(set));
        const BufferHandle views =
            builder.create_buffer("paraboloid views", static_cast<size_t>(set.maps) * k_view_stride);
        const TextureHandle drawn = builder.create_texture(
            "paraboloid map", {.format = GL_R32UI, .width = set.map_size, .height = set.map_size});
        const TextureHandle depth = builder.create_texture(
            "paraboloid depth",
            {.format = GL_DEPTH_COMPONENT32F, .width = set.map_size, .height = set.map_size});
        builder.decided_by(ContentHash()
                               .add(content(context, set))
                               .add(drawn_content(context, nullptr, DrawKind::plane, geometry))
                               .key());
        return [context, set, geometry, atlas, views, drawn, depth](const PassResources& resources) {
            constexpr std::array<GLuint, 4> nothing{k_nothing_hit, 0, 0, 0};
            make_views(context, resources, set, 1, resources.buffer(views));
            glEnable(GL_CLIP_DISTANCE0);
            for (int map = 0; map < set.maps; ++map) {
                const gl::Framebuffer& target =
                    resources.framebuffer({{&resources.texture(drawn)}}, {&resources.texture(depth)});
                target.bind();
                glClearNamedFramebufferuiv(target.id(), GL_COLOR, 0, nothing.data());
                draw_view(context, target, resources.buffer(views), map, "passes/paraboloid_map.frag",
                          {{"PARABOLOID", "1"}}, geometry);
                glCopyImageSubData(resources.texture(drawn).id(), GL_TEXTURE_2D, 0, 0, 0, 0,
                                   resources.texture(atlas).id(), GL_TEXTURE_2D, 0,
                                   map % set.columns * set.map_size, map / set.columns * set.map_size, 0,
                                   set.map_size, set.map_size, 1);
            }
            glDisable(GL_CLIP_DISTANCE0);
            finish_writes();
        };
    });
    return atlas;
}

}  // namespace

TextureHandle add_classic_maps(FrameGraph& graph, const PassContext& context, const VplSet& set,
                               gpu::Geometry geometry, MapProjection projection) {
    return projection == MapProjection::faces ? add_faces(graph, context, set, geometry)
                                              : add_paraboloids(graph, context, set, geometry);
}

}  // namespace bounce::passes
