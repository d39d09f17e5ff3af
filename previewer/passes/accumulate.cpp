// SPDX-License-Identifier: Apache-2.0
#include "passes/accumulate.h"

namespace bounce::passes {

void add_accumulate(FrameGraph& graph, const PassContext& context, TextureHandle smooth, TextureHandle sharp,
                    PictureMeans& means) {
    const gl::TextureDesc desc{.format = GL_RGBA32F, .width = context.width, .height = context.height};
    if (means.count == 0 || means.smooth.desc() != desc) {
        means.smooth = gl::Texture("mean of smooth pictures", desc);
        means.sharp = gl::Texture("mean of sharp pictures", desc);
        means.count = 0;
    }
    const int number = ++means.count;
    const TextureHandle smooth_mean = graph.import_texture("mean of smooth pictures", means.smooth);
    const TextureHandle sharp_mean = graph.import_texture("mean of sharp pictures", means.sharp);
    graph.add_pass("accumulate", [&](PassBuilder& builder) {
        builder.read(smooth);
        if (sharp.version != smooth.version) builder.read(sharp);
        const TextureHandle smooth_out = builder.write(smooth_mean);
        const TextureHandle sharp_out = builder.write(sharp_mean);
        return [context, smooth, sharp, smooth_out, sharp_out, number](const PassResources& resources) {
            context.programs.compute("passes/accumulate.comp").use();
            resources.texture(smooth).bind(TEX_DIRECT);
            resources.texture(sharp).bind(TEX_INDIRECT);
            resources.texture(smooth_out).bind_image(IMG_OUT, GL_READ_WRITE);
            resources.texture(sharp_out).bind_image(IMG_OUT1, GL_READ_WRITE);
            glUniform1i(0, number);
            dispatch_2d(context.width, context.height);
            finish_writes();
        };
    });
}

void resolve_means(gl::ProgramCache& programs, const PictureMeans& means, const gl::Texture& target) {
    programs.compute("passes/resolve_means.comp").use();
    means.smooth.bind(TEX_DIRECT);
    means.sharp.bind(TEX_INDIRECT);
    target.bind_image(IMG_OUT, GL_WRITE_ONLY);
    glUniform1i(0, means.count);
    dispatch_2d(target.desc().width, target.desc().height);
    finish_writes();
}

}  // namespace bounce::passes
