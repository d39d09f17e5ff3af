// SPDX-License-Identifier: Apache-2.0
#include "passes/temporal_reuse.h"

#include <algorithm>

#include "passes/motion.h"

namespace bounce::passes {
namespace {

// Side of the blocks whose spread is measured: of the interleaved pixels, and enough for a variance.
int spread_block(int interleave) {
    return std::max(interleave, 4);
}

TextureHandle add_spread(FrameGraph& graph, const PassContext& context, const TemporalReuseInputs& inputs) {
    const int block = spread_block(inputs.interleave);
    const int width = (context.width + block - 1) / block;
    const int height = (context.height + block - 1) / block;
    TextureHandle out;
    graph.add_pass("light spread", [&](PassBuilder& builder) {
        builder.read(inputs.unblurred);
        builder.read(inputs.bounced);
        out =
            builder.create_texture("light spread", {.format = GL_RGBA16F, .width = width, .height = height});
        return [context, inputs, block, width, height, out](const PassResources& resources) {
            context.programs.compute("passes/light_spread.comp", {{"BLOCK", std::to_string(block)}}).use();
            context.uniforms.bind(UBO_FRAME, context.frame);
            resources.texture(inputs.unblurred).bind_image(IMG_IN, GL_READ_ONLY);
            resources.texture(inputs.bounced).bind_image(IMG_HISTORY, GL_READ_ONLY);
            resources.texture(out).bind_image(IMG_OUT, GL_WRITE_ONLY);
            dispatch_2d(width, height);
            finish_writes();
        };
    });
    return out;
}

void copy(const gl::Texture& from, const gl::Texture& to) {
    glCopyImageSubData(from.id(), GL_TEXTURE_2D, 0, 0, 0, 0, to.id(), GL_TEXTURE_2D, 0, 0, 0, 0,
                       from.desc().width, from.desc().height, 1);
}

}  // namespace

TextureHandle add_temporal_reuse(FrameGraph& graph, const PassContext& context,
                                 const TemporalReuseInputs& inputs, ReusedPixels* counted) {
    TextureHandle spread;
    TextureHandle motion;
    const bool moved = inputs.before && inputs.before->moved != nullptr;
    if (inputs.before) {
        spread = add_spread(graph, context, inputs);
        if (moved) {
            motion =
                add_motion_vectors(graph, context, inputs.camera,
                                   {inputs.before->camera, inputs.before->moved, inputs.before->kept.depth});
        }
    }
    TextureHandle bounced = graph.import_texture("kept light", *inputs.next.bounced);
    TextureHandle frames = graph.import_texture("kept frames", *inputs.next.frames);
    TextureHandle depth = graph.import_texture("kept depth", *inputs.next.depth);
    TextureHandle normal = graph.import_texture("kept normals", *inputs.next.normal);
    graph.add_pass("temporal reuse", [&](PassBuilder& builder) {
        read_gbuffer(builder, inputs.gbuffer);
        builder.read(inputs.gbuffer.geometric_normal);
        builder.read(inputs.bounced);
        if (spread.valid()) builder.read(spread);
        if (motion.valid()) builder.read(motion);
        bounced = builder.write(bounced);
        frames = builder.write(frames);
        depth = builder.write(depth);
        normal = builder.write(normal);
        const BufferHandle counts = builder.create_buffer("reused pixels", 2 * sizeof(GLuint));
        return [=](const PassResources& resources) {
            gl::Defines defines;
            if (inputs.before) {
                defines["BEFORE"] = "1";
                defines["BLOCK"] = std::to_string(spread_block(inputs.interleave));
            }
            if (motion.valid()) defines["MOVED"] = "1";
            if (counted != nullptr) defines["COUNT"] = "1";
            context.programs.compute("passes/temporal_reuse.comp", defines).use();
            context.uniforms.bind(UBO_FRAME, context.frame);
            bind_gbuffer(resources, inputs.gbuffer);
            const gl::Texture& geometric_normal = resources.texture(inputs.gbuffer.geometric_normal);
            geometric_normal.bind(TEX_GEOMETRIC_NORMAL);
            resources.texture(inputs.bounced).bind_image(IMG_IN, GL_READ_ONLY);
            resources.texture(bounced).bind_image(IMG_OUT, GL_WRITE_ONLY);
            resources.texture(frames).bind_image(IMG_OUT1, GL_WRITE_ONLY);
            if (inputs.before) {
                context.uniforms.bind(UBO_MOTION, inputs.before->camera);
                inputs.before->kept.bounced->bind_image(IMG_HISTORY, GL_READ_ONLY);
                inputs.before->kept.frames->bind_image(IMG_HISTORY_LENGTH, GL_READ_ONLY);
                inputs.before->kept.normal->bind(TEX_HISTORY_NORMAL);
                resources.texture(spread).bind(TEX_LOWRES);
                glUniform4f(0, static_cast<float>(inputs.before->most_frames), inputs.before->scale,
                            1.0F / static_cast<float>(inputs.interleave), 0.0F);
            }
            if (motion.valid()) resources.texture(motion).bind(TEX_MOTION);
            gl::Buffer& counter = resources.buffer(counts);
            if (counted != nullptr) {
                counter.clear_to_zero();
                counter.bind_storage(SSBO_REUSE_COUNT);
            }
            dispatch_2d(context.width, context.height);
            finish_writes();
            copy(resources.texture(inputs.gbuffer.depth), resources.texture(depth));
            copy(geometric_normal, resources.texture(normal));
            if (counted != nullptr) {
                const std::vector<GLuint> read = counter.read<GLuint>(2);
                *counted = {static_cast<int>(read[0]), static_cast<int>(read[1])};
            }
        };
    });
    return bounced;
}

}  // namespace bounce::passes
