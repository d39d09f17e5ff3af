// SPDX-License-Identifier: Apache-2.0
#include "passes/antialias.h"

#include "passes/pixel_filter.h"

namespace bounce::passes {
namespace {

constexpr int k_samples = AA_SAMPLES;

// The samples' places within a pixel, from its middle.
std::array<glm::vec2, k_samples> sample_places(const PassResources& resources, const DepthSamples& samples) {
    resources.framebuffer({}, {&resources.texture(samples.depth)}).bind();
    std::array<glm::vec2, k_samples> places{};
    for (GLuint i = 0; i < places.size(); ++i) {
        glGetMultisamplefv(GL_SAMPLE_POSITION, i, &places[i].x);
        places[i] -= 0.5F;
    }
    return places;
}

// Weights of the samples of 3 x 3 pixels, row by row; they add up to 1.
std::array<float, 9 * k_samples> filter_weights(const std::array<glm::vec2, k_samples>& places,
                                                const glm::vec2& offset) {
    std::array<float, 9 * k_samples> weights{};
    double sum = 0.0;
    for (size_t i = 0; i < weights.size(); ++i) {
        const auto pixel = static_cast<int>(i) / k_samples;
        const glm::vec2 at = places[i % k_samples] + offset + glm::vec2(pixel % 3 - 1, pixel / 3 - 1);
        const double weight =
            pixel_filter(static_cast<double>(at.x)) * pixel_filter(static_cast<double>(at.y));
        weights[i] = static_cast<float>(weight);
        sum += weight;
    }
    for (float& weight : weights) {
        weight = static_cast<float>(static_cast<double>(weight) / sum);
    }
    return weights;
}

gl::TextureDesc sample_desc(const PassContext& context) {
    return {.format = GL_DEPTH_COMPONENT32F,
            .width = context.width,
            .height = context.height,
            .samples = k_samples};
}

std::string named(const char* pass, const std::string& layer) {
    return layer.empty() ? pass : std::string(pass) + ", " + layer;
}

}  // namespace

DepthSamples add_depth_samples(FrameGraph& graph, const PassContext& context, const View& camera) {
    DepthSamples out;
    graph.add_pass("depth samples", [&](PassBuilder& builder) {
        out.depth = builder.create_texture("depth samples", sample_desc(context));
        builder.decided_by(drawn_content(context, &camera, DrawKind::seen_depth));
        return [context, camera, out](const PassResources& resources) {
            const gl::Framebuffer& target = resources.framebuffer({}, {&resources.texture(out.depth)});
            target.bind();
            const float far_depth = 0.0F;
            glClearNamedFramebufferfv(target.id(), GL_DEPTH, 0, &far_depth);
            draw_scene(context, camera, DrawKind::seen_depth, "passes/shadow_map.frag", {});
        };
    });
    return out;
}

DepthSamples add_peeled_samples(FrameGraph& graph, const PassContext& context, const View& camera,
                                const DepthSamples& solid, TextureHandle before, const std::string& layer) {
    DepthSamples out;
    graph.add_pass(named("depth samples", layer), [&](PassBuilder& builder) {
        builder.read(solid.depth);
        const bool first = !before.valid();
        TextureHandle behind = before;
        if (first) {
            behind = builder.create_texture("nothing peeled", sample_desc(context));
        } else {
            builder.read(behind);
        }
        out.depth = builder.create_texture("depth samples", sample_desc(context));
        return [context, camera, solid, behind, first, out](const PassResources& resources) {
            const float far_depth = 0.0F;
            const float near_depth = 1.0F;
            if (first) {
                glClearNamedFramebufferfv(resources.framebuffer({}, {&resources.texture(behind)}).id(),
                                          GL_DEPTH, 0, &near_depth);
            }
            const gl::Framebuffer& target = resources.framebuffer({}, {&resources.texture(out.depth)});
            target.bind();
            glClearNamedFramebufferfv(target.id(), GL_DEPTH, 0, &far_depth);
            resources.texture(solid.depth).bind(TEX_DEPTH);
            resources.texture(behind).bind(TEX_PEELED_DEPTH);
            draw_scene(context, camera, DrawKind::peeled_depth, "passes/shadow_map.frag",
                       {{"PEEL_SAMPLES", "1"}});
        };
    });
    return out;
}

TextureHandle add_antialias(FrameGraph& graph, const PassContext& context, const GBuffer& gbuffer,
                            const DepthSamples& samples, TextureHandle picture, TextureHandle target,
                            const glm::vec2& offset, const std::string& layer) {
    TextureHandle sources;
    graph.add_pass(named("sample sources", layer), [&](PassBuilder& builder) {
        read_gbuffer(builder, gbuffer);
        builder.read(gbuffer.geometric_normal);
        builder.read(samples.depth);
        sources = builder.create_texture(
            "sample sources", {.format = GL_R16UI, .width = context.width, .height = context.height});
        builder.decided_by(ContentHash().add(camera_content(context)).add_text(layer).key());
        return [context, gbuffer, samples, sources](const PassResources& resources) {
            context.programs.compute("passes/sample_sources.comp").use();
            context.uniforms.bind(UBO_FRAME, context.frame);
            bind_gbuffer(resources, gbuffer);
            resources.texture(gbuffer.geometric_normal).bind(TEX_GEOMETRIC_NORMAL);
            resources.texture(samples.depth).bind(TEX_DEPTH_SAMPLES);
            resources.texture(sources).bind_image(IMG_OUT, GL_WRITE_ONLY);
            const std::array<glm::vec2, k_samples> places = sample_places(resources, samples);
            glUniform2fv(0, k_samples, &places.front().x);
            dispatch_2d(context.width, context.height);
            finish_writes();
        };
    });
    TextureHandle out;
    graph.add_pass(named("antialias", layer), [&](PassBuilder& builder) {
        builder.read(picture);
        builder.read(sources);
        builder.read(samples.depth);
        out = target.valid()
                  ? builder.write(target)
                  : builder.create_texture(
                        "smoothed", {.format = GL_RGBA32F, .width = context.width, .height = context.height});
        gl::Defines defines;
        if (!layer.empty()) defines["LAYER"] = "1";
        return [context, picture, samples, sources, out, offset, defines](const PassResources& resources) {
            context.programs.compute("passes/antialias.comp", defines).use();
            context.uniforms.bind(UBO_FRAME, context.frame);
            resources.texture(picture).bind_image(IMG_IN, GL_READ_ONLY);
            resources.texture(sources).bind_image(IMG_SOURCES, GL_READ_ONLY);
            const std::array<float, 9 * k_samples> weights =
                filter_weights(sample_places(resources, samples), offset);
            glUniform1fv(0, static_cast<GLsizei>(weights.size()), weights.data());
            resources.texture(out).bind_image(IMG_OUT, GL_WRITE_ONLY);
            dispatch_2d(context.width, context.height);
            finish_writes();
        };
    });
    return out;
}

}  // namespace bounce::passes
