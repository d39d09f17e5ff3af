// SPDX-License-Identifier: Apache-2.0
#include "passes/irsm.h"

namespace bounce::passes {

TextureHandle add_irsm(FrameGraph& graph, const PassContext& context, const ScenePoints& scene,
                       const VplSet& set) {
    TextureHandle out;
    graph.add_pass("irsm", [&](PassBuilder& builder) {
        builder.read(scene.points);
        builder.read(set.vpls);
        out = builder.create_texture(
            "irsm atlas",
            {.format = GL_R32UI, .width = set.columns * set.map_size, .height = set.rows * set.map_size});
        builder.decided_by(content(context, set));
        return [context, scene, set, out](const PassResources& resources) {
            context.programs.compute("passes/irsm_splat.comp", {{"MAP_SIZE", std::to_string(set.map_size)}})
                .use();
            context.uniforms.bind(UBO_ISM, set.uniforms);
            resources.buffer(scene.points).bind_storage(SSBO_POINTS);
            resources.buffer(set.vpls).bind_storage(SSBO_VPLS);
            resources.texture(out).bind_image(IMG_OUT, GL_WRITE_ONLY);
            glDispatchCompute(static_cast<GLuint>(set.maps), 1, 1);
            finish_writes();
        };
    });
    return out;
}

}  // namespace bounce::passes
