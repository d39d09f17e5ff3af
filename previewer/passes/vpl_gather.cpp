// SPDX-License-Identifier: Apache-2.0
#include "passes/vpl_gather.h"

#include <algorithm>

#include "passes/float_layouts.h"

namespace bounce::passes {
namespace {

TextureHandle create_bounced(PassBuilder& builder, const PassContext& context) {
    return builder.create_texture("bounced light",
                                  {.format = GL_RGBA32UI, .width = context.width, .height = context.height},
                                  k_bounced_floats);
}

gl::Defines gather_defines(const PassContext& context, const VplGatherInputs& inputs, const VplSet& set) {
    gl::Defines defines;
    if (set.atlas.valid()) defines["VISIBILITY"] = "1";
    if (inputs.slope_bias) defines["SLOPE_BIAS"] = "1";
    if (set.distant) defines["DISTANT"] = "1";
    if (inputs.near_field && &set == &inputs.sets.front()) defines["NEAR_FIELD"] = "1";
    if (inputs.glossy) defines[set.image ? "ENVIRONMENT" : "GLOSSY"] = "1";
    if (inputs.removed) defines["REMOVED"] = "1";
    if (context.scene.has_disney_diffuse()) defines["DISNEY"] = "1";
    return defines;
}

// Which pixel of a block gathers from the first subset: each in turn, as seeds follow one another, near ones
// far apart.
glm::ivec2 seeded_pixel(const VplSet& set) {
    const auto n = static_cast<uint32_t>(set.interleave);
    // An odd number, so that it visits every pixel of a block, whose side is a power of two.
    const uint32_t place = set.seed * (n * n * 5 / 8 | 1U) % (n * n);
    return {static_cast<int>(place % n), static_cast<int>(place / n)};
}

// One dispatch for each subset of the lights and each chunk of it; the very first overwrites.
void dispatch_chunks(const PassContext& context, const VplSet& set, gl::Defines defines, bool first_set) {
    const int n = set.interleave;
    const int block = GROUP_2D * n;
    for (int first = 0; first < set.subset; first += VPL_CHUNK) {
        defines["CHUNK"] = std::to_string(std::min(VPL_CHUNK, set.subset - first));
        if (!first_set || first > 0) defines["NEXT_CHUNK"] = "1";
        if (first > 0) defines["NEXT_LOBES"] = "1";
        context.programs.compute("passes/vpl_gather.comp", defines).use();
        const glm::ivec2 first_pixel = seeded_pixel(set);
        glUniform2i(1, first_pixel.x, first_pixel.y);
        for (int subset = 0; subset < n * n; ++subset) {
            glUniform2i(0, subset, subset * set.subset + first);
            glDispatchCompute(static_cast<GLuint>((context.width + block - 1) / block),
                              static_cast<GLuint>((context.height + block - 1) / block), 1);
        }
        finish_writes();
    }
}

}  // namespace

GatheredLight add_vpl_gather(FrameGraph& graph, const PassContext& context, const VplGatherInputs& inputs) {
    GatheredLight out;
    graph.add_pass(inputs.removed ? "vpl gather, removed" : "vpl gather", [&](PassBuilder& builder) {
        read_gbuffer(builder, inputs.gbuffer);
        for (const VplSet& set : inputs.sets) {
            builder.read(set.vpls);
            if (set.atlas.valid()) builder.read(set.atlas);
        }
        out.bounced = create_bounced(builder, context);
        const bool image =
            std::any_of(inputs.sets.begin(), inputs.sets.end(), [](const VplSet& s) { return s.image; });
        if (image && inputs.glossy) {
            out.lobes = create_bounced(builder, context);
        }
        if (inputs.near_field) {
            out.reach = builder.create_texture(
                "near reach", {.format = GL_R16F, .width = context.width, .height = context.height});
        }
        return [context, inputs, out](const PassResources& resources) {
            context.uniforms.bind(UBO_FRAME, context.frame);
            bind_gbuffer(resources, inputs.gbuffer);
            resources.texture(out.bounced).bind_image(IMG_OUT, GL_READ_WRITE);
            for (const VplSet& set : inputs.sets) {
                if (inputs.near_field && &set == &inputs.sets.front()) {
                    resources.texture(out.reach).bind_image(IMG_OUT1, GL_READ_WRITE);
                }
                if (set.image && out.lobes.valid()) {
                    resources.texture(out.lobes).bind_image(IMG_LOBES, GL_READ_WRITE);
                }
                context.uniforms.bind(UBO_ISM, set.uniforms);
                resources.buffer(set.vpls).bind_storage(SSBO_VPLS);
                if (set.atlas.valid()) resources.texture(set.atlas).bind_image(IMG_ISM, GL_READ_ONLY);
                dispatch_chunks(context, set, gather_defines(context, inputs, set),
                                &set == &inputs.sets.front());
            }
        };
    });
    return out;
}

TextureHandle add_bounced_blur(FrameGraph& graph, const PassContext& context, const GBuffer& gbuffer,
                               TextureHandle bounced, int interleave, bool tent) {
    for (const bool vertical : {false, true}) {
        graph.add_pass(vertical ? "blur, vertical" : "blur, horizontal", [&](PassBuilder& builder) {
            read_gbuffer(builder, gbuffer);
            builder.read(gbuffer.geometric_normal);
            const TextureHandle from = builder.read(bounced);
            const TextureHandle to = create_bounced(builder, context);
            bounced = to;
            return [context, gbuffer, interleave, from, to, vertical, tent](const PassResources& resources) {
                gl::Defines defines;
                if (vertical) defines["VERTICAL"] = "1";
                if (tent) defines["TENT"] = "1";
                context.programs.compute("passes/bounced_blur.comp", defines).use();
                context.uniforms.bind(UBO_FRAME, context.frame);
                bind_gbuffer(resources, gbuffer);
                resources.texture(gbuffer.geometric_normal).bind(TEX_GEOMETRIC_NORMAL);
                resources.texture(from).bind_image(IMG_IN, GL_READ_ONLY);
                resources.texture(to).bind_image(IMG_OUT, GL_WRITE_ONLY);
                glUniform1i(0, interleave);
                dispatch_2d(context.width, context.height);
                finish_writes();
            };
        });
    }
    return bounced;
}

}  // namespace bounce::passes
