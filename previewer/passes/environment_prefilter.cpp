// SPDX-License-Identifier: Apache-2.0
#include "passes/environment_prefilter.h"

#include <algorithm>
#include <span>

#include "gl/buffer.h"
#include "passes/pass_context.h"

namespace bounce::passes {

void run_environment_prefilter(gl::ProgramCache& programs, const gpu::EnvironmentMaps& maps) {
    const gpu::WorldUniforms uniforms = maps.uniforms(glm::dmat3(1.0), 1.0);
    const gl::Buffer block =
        gl::Buffer::of("world image, prefilter", std::span<const gpu::WorldUniforms>(&uniforms, 1));
    programs.compute("passes/environment_prefilter.comp").use();
    block.bind_uniform(UBO_WORLD);
    maps.image.bind(TEX_ENVIRONMENT);
    const int levels = maps.glossy.desc().levels;
    for (int level = 0; level < levels; ++level) {
        const int width = std::max(maps.glossy.desc().width >> level, 1);
        const int height = std::max(maps.glossy.desc().height >> level, 1);
        const float first = static_cast<float>(ENVIRONMENT_FIRST_ROUGHNESS);
        const float roughness =
            first + (1.0F - first) * static_cast<float>(level) / static_cast<float>(levels - 1);
        glBindImageTexture(IMG_OUT, maps.glossy.id(), level, GL_FALSE, 0, GL_WRITE_ONLY, GL_RGBA32F);
        glUniform2i(0, width, height);
        glUniform1f(1, roughness * roughness);
        dispatch_2d(width, height);
    }
    glMemoryBarrier(GL_TEXTURE_FETCH_BARRIER_BIT);
}

}  // namespace bounce::passes
