// SPDX-License-Identifier: Apache-2.0
#include "passes/soft_shadow.h"

#include <array>
#include <bit>

namespace bounce::passes {

gl::Defines soft_defines(const LightPass& light) {
    gl::Defines defines = light_defines(light);
    defines["SOFT_KIND"] = std::to_string(light.soft.map_kind);
    return defines;
}

namespace {

int tiles_along(int pixels) {
    return (pixels + GROUP_2D - 1) / GROUP_2D;
}

// What a light's places see: maps of triangles, or imperfect ones.
struct Maps {
    TextureHandle triangles;
    ImperfectMaps imperfect;
    [[nodiscard]] int chunks(const LightPass& light) const {
        return imperfect.empty() ? static_cast<int>(light.soft.chunks.size())
                                 : imperfect.places / SHADOW_VIEW_CHUNK;
    }
};

gl::Defines maps_defines(const LightPass& light, const Maps& maps) {
    gl::Defines defines = maps.imperfect.empty() ? soft_defines(light) : light_defines(light);
    if (!light.tints.empty()) defines["TINTED"] = "1";
    if (maps.imperfect.empty()) {
        return defines;
    }
    defines["IMPERFECT"] = "1";
    if (maps.imperfect.slope_bias) defines["SLOPE_BIAS"] = "1";
    defines.merge(map_defines(maps.imperfect.set));
    return defines;
}

void declare_maps(PassBuilder& builder, const GBuffer& gbuffer, const Maps& maps) {
    read_gbuffer(builder, gbuffer);
    builder.read(gbuffer.geometric_normal);
    if (maps.imperfect.empty()) {
        builder.read(maps.triangles);
    } else {
        builder.read(maps.imperfect.set.atlas);
        builder.read(maps.imperfect.set.vpls);
    }
}

void bind_maps(const PassContext& context, const PassResources& resources, const GBuffer& gbuffer,
               const LightPass& light, const Maps& maps) {
    context.uniforms.bind(UBO_FRAME, context.frame);
    context.uniforms.bind(UBO_LIGHT, light.uniforms);
    bind_gbuffer(resources, gbuffer);
    resources.texture(gbuffer.geometric_normal).bind(TEX_GEOMETRIC_NORMAL);
    if (maps.imperfect.empty()) {
        resources.texture(maps.triangles).bind(TEX_SHADOW);
    } else {
        context.uniforms.bind(UBO_ISM, maps.imperfect.set.uniforms);
        resources.buffer(maps.imperfect.set.vpls).bind_storage(SSBO_VPLS);
        resources.texture(maps.imperfect.set.atlas).bind_image(IMG_ISM, GL_READ_ONLY);
    }
}

// The next eight places.
void bind_chunk(const PassContext& context, const LightPass& light, const Maps& maps, int chunk) {
    if (maps.imperfect.empty()) {
        context.uniforms.bind(UBO_SHADOW_VIEWS, light.soft.chunks[static_cast<size_t>(chunk)]);
    }
    glUniform1i(1, chunk * SHADOW_VIEW_CHUNK);
}

BufferHandle add_probe(FrameGraph& graph, const PassContext& context, const GBuffer& gbuffer,
                       const LightPass& light, const Maps& maps) {
    BufferHandle flags;
    graph.add_pass("soft shadow probe: " + light.name, [&](PassBuilder& builder) {
        declare_maps(builder, gbuffer, maps);
        const int tiles = tiles_along(context.width) * tiles_along(context.height);
        flags = builder.create_buffer("soft shadow flags", static_cast<size_t>(tiles) * sizeof(GLuint));
        return [context, gbuffer, light, maps, flags](const PassResources& resources) {
            constexpr GLuint none = 0;
            glClearNamedBufferData(resources.buffer(flags).id(), GL_R32UI, GL_RED_INTEGER, GL_UNSIGNED_INT,
                                   &none);
            context.programs.compute("passes/soft_probe.comp", maps_defines(light, maps)).use();
            bind_maps(context, resources, gbuffer, light, maps);
            resources.buffer(flags).bind_storage(SSBO_TILE_FLAGS);
            // A block of pixels has one for each chunk, and a tile has whole blocks.
            const int chunks = maps.chunks(light);
            const int bits = std::bit_width(static_cast<unsigned>(chunks)) - 1;
            const int width = 1 << ((bits + 1) / 2);
            const int height = chunks / width;
            for (int chunk = 0; chunk < chunks; ++chunk) {
                bind_chunk(context, light, maps, chunk);
                glUniform4i(0, width, height, chunk % width, chunk / width);
                dispatch_2d((context.width + width - 1) / width, (context.height + height - 1) / height);
            }
            finish_writes();
        };
    });
    return flags;
}

struct Tiles {
    BufferHandle list;
    BufferHandle counts;
};

Tiles add_tiles(FrameGraph& graph, const PassContext& context, const LightPass& light, BufferHandle flags) {
    Tiles out;
    graph.add_pass("soft shadow tiles: " + light.name, [&](PassBuilder& builder) {
        builder.read(flags);
        const int tiles = tiles_along(context.width) * tiles_along(context.height);
        out.list = builder.create_buffer("soft shadow tiles", static_cast<size_t>(tiles) * sizeof(GLuint));
        out.counts = builder.create_buffer("soft shadow dispatch", 4 * sizeof(GLuint));
        return [context, flags, tiles, out](const PassResources& resources) {
            constexpr std::array<GLuint, 4> none = {0, 0, 1, 0};
            resources.buffer(out.counts).update(std::span<const GLuint>(none));
            context.programs.compute("passes/soft_tiles.comp").use();
            context.uniforms.bind(UBO_FRAME, context.frame);
            resources.buffer(flags).bind_storage(SSBO_TILE_FLAGS);
            resources.buffer(out.list).bind_storage(SSBO_PIXEL_LIST);
            resources.buffer(out.counts).bind_storage(SSBO_DISPATCH);
            glDispatchCompute((static_cast<GLuint>(tiles) + GROUP_1D - 1) / GROUP_1D, 1, 1);
            finish_writes();
        };
    });
    return out;
}

TextureHandle add_penumbra(FrameGraph& graph, const PassContext& context, const GBuffer& gbuffer,
                           const LightPass& light, const Maps& maps, const Tiles& tiles) {
    TextureHandle shares;
    graph.add_pass("soft shadow: " + light.name, [&](PassBuilder& builder) {
        declare_maps(builder, gbuffer, maps);
        builder.read(tiles.list);
        builder.read(tiles.counts);
        const GLenum format = light.tints.empty() ? GL_RG32F : GL_RGBA32F;
        shares = builder.create_texture("soft shadow",
                                        {.format = format, .width = context.width, .height = context.height});
        return [context, gbuffer, light, maps, tiles, shares](const PassResources& resources) {
            bind_maps(context, resources, gbuffer, light, maps);
            resources.buffer(tiles.list).bind_storage(SSBO_PIXEL_LIST);
            resources.buffer(tiles.counts).bind_storage(SSBO_DISPATCH);
            resources.texture(shares).bind_image(IMG_OUT, GL_READ_WRITE);
            glBindBuffer(GL_DISPATCH_INDIRECT_BUFFER, resources.buffer(tiles.counts).id());
            for (int chunk = 0; chunk < maps.chunks(light); ++chunk) {
                gl::Defines defines = maps_defines(light, maps);
                if (chunk == 0) defines["FIRST_CHUNK"] = "1";
                context.programs.compute("passes/soft_penumbra.comp", defines).use();
                bind_chunk(context, light, maps, chunk);
                if (!light.tints.empty()) {
                    glUniform3fv(2, SHADOW_VIEW_CHUNK,
                                 &light.tints[static_cast<size_t>(chunk) * SHADOW_VIEW_CHUNK].x);
                }
                glDispatchComputeIndirect(0);
                finish_writes();
            }
        };
    });
    return shares;
}

SoftShadow add_shares(FrameGraph& graph, const PassContext& context, const GBuffer& gbuffer,
                      const LightPass& light, const Maps& maps) {
    SoftShadow out;
    out.flags = add_probe(graph, context, gbuffer, light, maps);
    const Tiles tiles = add_tiles(graph, context, light, out.flags);
    out.shares = add_penumbra(graph, context, gbuffer, light, maps, tiles);
    return out;
}

}  // namespace

TextureHandle add_soft_maps(FrameGraph& graph, const PassContext& context, const LightPass& light) {
    TextureHandle maps;
    graph.add_pass("soft shadow maps: " + light.name, [&](PassBuilder& builder) {
        const SoftMaps& soft = light.soft;
        maps = builder.create_texture("soft shadow maps", {.format = GL_DEPTH_COMPONENT32F,
                                                           .width = soft.size,
                                                           .height = soft.size,
                                                           .layers = soft.layers});
        const DrawKind kind = soft.blended_only ? DrawKind::blended_depth : DrawKind::hashed_depth;
        ContentHash hash;
        for (const SoftMaps::Face& face : soft.faces) {
            hash.add(face.layer).add(drawn_content(context, &face.view, kind));
        }
        builder.decided_by(hash.key());
        return [context, soft, maps, kind](const PassResources& resources) {
            const float far_depth = 0.0F;
            for (const SoftMaps::Face& face : soft.faces) {
                const gl::Framebuffer& target =
                    resources.framebuffer({}, {&resources.texture(maps), face.layer});
                target.bind();
                glClearNamedFramebufferfv(target.id(), GL_DEPTH, 0, &far_depth);
                draw_scene(context, face.view, kind, "passes/shadow_map.frag", {});
            }
        };
    });
    return maps;
}

SoftShadow add_soft_shadow(FrameGraph& graph, const PassContext& context, const GBuffer& gbuffer,
                           const LightPass& light, TextureHandle maps) {
    return add_shares(graph, context, gbuffer, light, {maps, {}});
}

SoftShadow add_imperfect_shadow(FrameGraph& graph, const PassContext& context, const GBuffer& gbuffer,
                                const LightPass& light, const ImperfectMaps& maps) {
    return add_shares(graph, context, gbuffer, light, {{}, maps});
}

}  // namespace bounce::passes
