// SPDX-License-Identifier: Apache-2.0
#include "passes/ism.h"

#include <algorithm>
#include <stdexcept>

#include "passes/ism_tessellation.h"

namespace bounce::passes {
namespace {

// The largest map that a group holds in 32 KiB of shared memory, with the pyramid of pull-push.
constexpr int k_largest_shared_map = 64;
// Overlap of pull-push tiles: more than the reach of three levels and their interpolation.
constexpr int k_border = 16;
// ISM_EMPTY, and that of distant lights.
constexpr GLuint k_empty = 0x7bff0000U;
constexpr GLuint k_empty_distant = 0xffff0000U;

bool fits_shared(const VplSet& set) {
    return set.map_size <= k_largest_shared_map;
}

gl::TextureDesc atlas_desc(const VplSet& set, GLenum format) {
    return {.format = format, .width = set.columns * set.map_size, .height = set.rows * set.map_size};
}

void bind_set(const PassContext& context, const PassResources& resources, const VplSet& set) {
    context.uniforms.bind(UBO_ISM, set.uniforms);
    resources.buffer(set.vpls).bind_storage(SSBO_VPLS);
}

gl::Defines pull_push_defines(const PullPushSettings& settings) {
    gl::Defines defines{{"LEVELS", std::to_string(settings.mode == PullPush::off ? 0 : settings.levels)}};
    if (settings.mode == PullPush::paper) defines["PAPER"] = "1";
    return defines;
}

ContentKey content(const PullPushSettings& settings) {
    return ContentHash()
        .add(settings.mode)
        .add(settings.levels)
        .add(settings.pull_threshold)
        .add(settings.push_threshold)
        .key();
}

void clear_atlas(const gl::Texture& atlas, const VplSet& set) {
    const GLuint& empty = set.distant ? k_empty_distant : k_empty;
    glClearTexImage(atlas.id(), 0, GL_RED_INTEGER, GL_UNSIGNED_INT, &empty);
}

void dispatch_splats(const VplSet& set) {
    const auto parts =
        fits_shared(set) ? 1U : static_cast<GLuint>((set.points_a_map + GROUP_SPLAT - 1) / GROUP_SPLAT);
    glDispatchCompute(static_cast<GLuint>(set.maps), parts, 1);
    finish_writes();
}

static_assert(scene::k_most_large_triangles == MOST_TRIANGLES);

TextureHandle add_triangles(FrameGraph& graph, const PassContext& context, const IsmInputs& inputs,
                            const VplSet& set) {
    TextureHandle out;
    graph.add_pass("ism triangles", [&](PassBuilder& builder) {
        builder.read(inputs.scene.triangles);
        builder.read(set.vpls);
        out = builder.create_texture("ism atlas", atlas_desc(set, GL_R32UI));
        builder.decided_by(ContentHash().add(content(context, set)).add(inputs.large_triangles).key());
        return [context, inputs, set, out](const PassResources& resources) {
            bind_set(context, resources, set);
            resources.buffer(inputs.scene.triangles).bind_storage(SSBO_TRIANGLES);
            resources.texture(out).bind_image(IMG_OUT, GL_WRITE_ONLY);
            const auto tiles = static_cast<GLuint>(set.map_size / GROUP_MAP_TILE);
            gl::Defines defines{{"TRIANGLE_COUNT", std::to_string(inputs.large_triangles)}};
            defines.merge(map_defines(set));
            context.programs.compute("passes/ism_triangles.comp", defines).use();
            glDispatchCompute(tiles, tiles, static_cast<GLuint>(set.maps));
            finish_writes();
        };
    });
    return out;
}

// Bare places inside surfaces closed, in maps that do not fit into shared memory.
TextureHandle add_close(FrameGraph& graph, const PassContext& context, const VplSet& set,
                        TextureHandle atlas) {
    TextureHandle out;
    graph.add_pass("ism close", [&](PassBuilder& builder) {
        builder.read(atlas);
        out = builder.create_texture("ism atlas", atlas_desc(set, GL_R32UI));
        builder.decided_by(content(context, set));
        return [context, set, atlas, out](const PassResources& resources) {
            gl::Defines defines{{"MAP_SIZE", std::to_string(set.map_size)}};
            defines.merge(map_defines(set));
            context.programs.compute("passes/ism_close.comp", defines).use();
            context.uniforms.bind(UBO_ISM, set.uniforms);
            resources.texture(atlas).bind_image(IMG_IN, GL_READ_ONLY);
            resources.texture(out).bind_image(IMG_OUT, GL_WRITE_ONLY);
            const auto groups = static_cast<GLuint>(set.map_size / GROUP_2D);
            glDispatchCompute(groups, groups, static_cast<GLuint>(set.maps));
            finish_writes();
        };
    });
    return out;
}

// over: an atlas with triangles, or invalid.
TextureHandle add_disks(FrameGraph& graph, const PassContext& context, const IsmInputs& inputs,
                        const VplSet& set, TextureHandle over) {
    TextureHandle out;
    graph.add_pass("ism disks", [&](PassBuilder& builder) {
        builder.read(inputs.scene.points);
        builder.read(set.vpls);
        out = over.valid() ? builder.write(over)
                           : builder.create_texture("ism atlas", atlas_desc(set, GL_R32UI));
        const bool has_triangles = over.valid();
        builder.decided_by(
            ContentHash().add(content(context, set)).add(inputs.close).add(has_triangles).key());
        return [context, inputs, set, out, has_triangles](const PassResources& resources) {
            gl::Defines defines{{"MAP_SIZE", std::to_string(set.map_size)}};
            if (fits_shared(set)) defines["SHARED"] = "1";
            defines.merge(map_defines(set));
            if (inputs.close) defines["CLOSE"] = "1";
            if (has_triangles) defines["OVER_TRIANGLES"] = "1";
            if (!fits_shared(set) && !has_triangles) clear_atlas(resources.texture(out), set);
            context.programs.compute("passes/ism_disks.comp", defines).use();
            bind_set(context, resources, set);
            resources.buffer(inputs.scene.points).bind_storage(SSBO_POINTS);
            resources.texture(out).bind_image(IMG_OUT, GL_READ_WRITE);
            dispatch_splats(set);
        };
    });
    return fits_shared(set) || !inputs.close ? out : add_close(graph, context, set, out);
}

TextureHandle add_pull_push(FrameGraph& graph, const PassContext& context, const PullPushSettings& settings,
                            const VplSet& set, TextureHandle splats, bool from_depth) {
    TextureHandle out;
    graph.add_pass("ism pull-push", [&](PassBuilder& builder) {
        builder.read(splats);
        out = builder.create_texture("ism atlas", atlas_desc(set, GL_R32UI));
        builder.decided_by(
            ContentHash().add(content(context, set)).add(content(settings)).add(from_depth).key());
        return [context, settings, set, splats, from_depth, out](const PassResources& resources) {
            const int side = std::min(set.map_size, k_largest_shared_map);
            const int border = side < set.map_size ? k_border : 0;
            gl::Defines defines = pull_push_defines(settings);
            defines["SIDE"] = std::to_string(side);
            defines["BORDER"] = std::to_string(border);
            if (from_depth) defines["FROM_DEPTH"] = "1";
            context.programs.compute("passes/ism_pull_push.comp", defines).use();
            context.uniforms.bind(UBO_ISM, set.uniforms);
            glUniform2f(0, settings.pull_threshold, settings.push_threshold);
            if (from_depth) {
                resources.texture(splats).bind(TEX_DEPTH);
            } else {
                resources.texture(splats).bind_image(IMG_IN, GL_READ_ONLY);
            }
            resources.texture(out).bind_image(IMG_OUT, GL_WRITE_ONLY);
            const int core = side - 2 * border;
            const auto tiles = static_cast<GLuint>((set.map_size + core - 1) / core);
            glDispatchCompute(tiles, tiles, static_cast<GLuint>(set.maps));
            finish_writes();
        };
    });
    return out;
}

// Squares in compute; where a map fits into shared memory its holes are filled in the same pass.
IsmAtlas add_squares(FrameGraph& graph, const PassContext& context, const IsmInputs& inputs,
                     const VplSet& set) {
    IsmAtlas out;
    const bool fused = fits_shared(set) && inputs.pull_push.mode != PullPush::off;
    graph.add_pass("ism squares", [&](PassBuilder& builder) {
        builder.read(inputs.scene.points);
        builder.read(set.vpls);
        out.splats = builder.create_texture("ism splats", atlas_desc(set, GL_R32UI));
        out.atlas = fused ? builder.create_texture("ism atlas", atlas_desc(set, GL_R32UI)) : out.splats;
        builder.decided_by(
            ContentHash().add(content(context, set)).add(content(inputs.pull_push)).add(fused).key());
        return [context, inputs, set, fused, out](const PassResources& resources) {
            gl::Defines defines{{"MAP_SIZE", std::to_string(set.map_size)}};
            if (fits_shared(set)) {
                defines["SHARED"] = "1";
            } else {
                clear_atlas(resources.texture(out.splats), set);
            }
            if (fused) defines.merge(pull_push_defines(inputs.pull_push));
            defines.merge(map_defines(set));
            context.programs.compute("passes/ism_squares.comp", defines).use();
            bind_set(context, resources, set);
            resources.buffer(inputs.scene.points).bind_storage(SSBO_POINTS);
            resources.texture(out.splats).bind_image(IMG_OUT, GL_READ_WRITE);
            if (fused) {
                resources.texture(out.atlas).bind_image(IMG_OUT1, GL_WRITE_ONLY);
                glUniform2f(0, inputs.pull_push.pull_threshold, inputs.pull_push.push_threshold);
            }
            dispatch_splats(set);
        };
    });
    if (!fused && inputs.pull_push.mode != PullPush::off) {
        out.atlas = add_pull_push(graph, context, inputs.pull_push, set, out.splats, false);
    }
    return out;
}

TextureHandle add_gl_points(FrameGraph& graph, const PassContext& context, const IsmInputs& inputs,
                            const VplSet& set) {
    TextureHandle out;
    graph.add_pass("ism points", [&](PassBuilder& builder) {
        builder.read(inputs.scene.points);
        builder.read(set.vpls);
        out = builder.create_texture("ism depth", atlas_desc(set, GL_DEPTH_COMPONENT32F));
        builder.decided_by(content(context, set));
        return [context, inputs, set, out](const PassResources& resources) {
            const gl::Framebuffer& target = resources.framebuffer({}, {&resources.texture(out)});
            target.bind();
            const float far_depth = 0.0F;
            glClearNamedFramebufferfv(target.id(), GL_DEPTH, 0, &far_depth);
            context.programs.raster("passes/ism_points.vert", "passes/ism_points.frag", map_defines(set))
                .use();
            bind_set(context, resources, set);
            resources.buffer(inputs.scene.points).bind_storage(SSBO_POINTS);
            context.scene.bind_vertex_array();  // nothing is read from it, but a core profile wants one
            glUniform2f(0, static_cast<float>(set.columns * set.map_size),
                        static_cast<float>(set.rows * set.map_size));
            glEnable(GL_DEPTH_TEST);
            glEnable(GL_PROGRAM_POINT_SIZE);
            glDrawArrays(GL_POINTS, 0, set.maps * set.points_a_map);
            glDisable(GL_PROGRAM_POINT_SIZE);
            glDisable(GL_DEPTH_TEST);
            finish_writes();
        };
    });
    return out;
}

}  // namespace

ContentKey content(const PassContext& context, const VplSet& set) {
    return ContentHash()
        .add(content(context, set.uniforms))
        .add(content(map_defines(set)))
        .add(glm::ivec4(set.maps, set.map_size, set.columns, set.rows))
        .add(glm::ivec4(set.points_a_map, set.interleave, set.subset, set.cell_columns))
        .add(set.seed)
        .add(set.middle)
        .add(set.extent)
        .add(set.image)
        .key();
}

gl::Defines map_defines(const VplSet& set) {
    gl::Defines defines;
    if (set.distant) defines["DISTANT"] = "1";
    if (set.window) defines["WINDOW"] = "1";
    if (set.both_sides) defines["BOTH_SIDES"] = "1";
    return defines;
}

IsmAtlas add_ism(FrameGraph& graph, const PassContext& context, const IsmInputs& inputs, const VplSet& set) {
    switch (inputs.splat) {
        case Splat::compute:
            return add_squares(graph, context, inputs, set);
        case Splat::tessellation:
        case Splat::points: {
            const TextureHandle depth = inputs.splat == Splat::points
                                            ? add_gl_points(graph, context, inputs, set)
                                            : add_tessellation(graph, context, inputs.tessellated, set);
            // The same pass turns depths into what the gather reads, also where no hole is to be filled.
            PullPushSettings unfilled = inputs.pull_push;
            unfilled.mode = PullPush::off;
            return {add_pull_push(graph, context, unfilled, set, depth, true),
                    add_pull_push(graph, context, inputs.pull_push, set, depth, true)};
        }
        case Splat::automatic:
            throw std::logic_error("how points are splatted was not chosen");
        case Splat::disks:
            break;
    }
    const TextureHandle triangles =
        inputs.large_triangles > 0 ? add_triangles(graph, context, inputs, set) : TextureHandle{};
    return {{}, add_disks(graph, context, inputs, set, triangles)};
}

}  // namespace bounce::passes
