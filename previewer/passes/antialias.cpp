// SPDX-License-Identifier: Apache-2.0
#include "passes/antialias.h"

#include <array>
#include <memory>

#include "passes/pixel_filter.h"

namespace bounce::passes {
namespace {

constexpr int k_samples = AA_SAMPLES;

// The samples' places within a pixel, from its middle; of the framebuffer that is bound.
std::array<glm::vec2, k_samples> sample_places() {
    std::array<glm::vec2, k_samples> places{};
    for (GLuint i = 0; i < places.size(); ++i) {
        glGetMultisamplefv(GL_SAMPLE_POSITION, i, &places[i].x);
        places[i] -= 0.5F;
    }
    return places;
}

// Weights of the samples of 3 x 3 pixels, row by row; they add up to 1.
std::array<float, 9 * k_samples> filter_weights(const std::array<glm::vec2, k_samples>& places) {
    std::array<float, 9 * k_samples> weights{};
    double sum = 0.0;
    for (size_t i = 0; i < weights.size(); ++i) {
        const auto pixel = static_cast<int>(i) / k_samples;
        const glm::vec2 at = places[i % k_samples] + glm::vec2(pixel % 3 - 1, pixel / 3 - 1);
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

TextureHandle add_depth_samples(FrameGraph& graph, const PassContext& context, const View& camera,
                                const std::shared_ptr<std::array<glm::vec2, k_samples>>& places) {
    TextureHandle samples;
    graph.add_pass("depth samples", [&](PassBuilder& builder) {
        samples = builder.create_texture("depth samples", {.format = GL_DEPTH_COMPONENT32F,
                                                           .width = context.width,
                                                           .height = context.height,
                                                           .samples = k_samples});
        return [context, camera, samples, places](const PassResources& resources) {
            const gl::Framebuffer& target = resources.framebuffer({}, {&resources.texture(samples)});
            target.bind();
            *places = sample_places();
            const float far_depth = 0.0F;
            glClearNamedFramebufferfv(target.id(), GL_DEPTH, 0, &far_depth);
            draw_scene(context, camera, DrawKind::seen_depth, "passes/shadow_map.frag", {});
        };
    });
    return samples;
}

}  // namespace

TextureHandle add_antialias(FrameGraph& graph, const PassContext& context, const GBuffer& gbuffer,
                            const View& camera, TextureHandle picture, TextureHandle target) {
    const auto places = std::make_shared<std::array<glm::vec2, k_samples>>();  // known when they are drawn
    const TextureHandle samples = add_depth_samples(graph, context, camera, places);
    TextureHandle sources;
    graph.add_pass("sample sources", [&](PassBuilder& builder) {
        read_gbuffer(builder, gbuffer);
        builder.read(gbuffer.geometric_normal);
        builder.read(samples);
        sources = builder.create_texture(
            "sample sources", {.format = GL_R16UI, .width = context.width, .height = context.height});
        return [context, gbuffer, samples, sources, places](const PassResources& resources) {
            context.programs.compute("passes/sample_sources.comp").use();
            context.uniforms.bind(UBO_FRAME, context.frame);
            bind_gbuffer(resources, gbuffer);
            resources.texture(gbuffer.geometric_normal).bind(TEX_GEOMETRIC_NORMAL);
            resources.texture(samples).bind(TEX_DEPTH_SAMPLES);
            resources.texture(sources).bind_image(IMG_OUT, GL_WRITE_ONLY);
            glUniform2fv(0, k_samples, &places->front().x);
            dispatch_2d(context.width, context.height);
            finish_writes();
        };
    });
    TextureHandle out;
    graph.add_pass("antialias", [&](PassBuilder& builder) {
        builder.read(picture);
        builder.read(sources);
        out = builder.write(target);
        return [context, picture, sources, out, places](const PassResources& resources) {
            context.programs.compute("passes/antialias.comp").use();
            context.uniforms.bind(UBO_FRAME, context.frame);
            resources.texture(picture).bind_image(IMG_IN, GL_READ_ONLY);
            resources.texture(sources).bind_image(IMG_SOURCES, GL_READ_ONLY);
            const std::array<float, 9 * k_samples> weights = filter_weights(*places);
            glUniform1fv(0, static_cast<GLsizei>(weights.size()), weights.data());
            resources.texture(out).bind_image(IMG_OUT, GL_WRITE_ONLY);
            dispatch_2d(context.width, context.height);
            finish_writes();
        };
    });
    return out;
}

}  // namespace bounce::passes
