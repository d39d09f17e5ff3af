// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "passes/pass_context.h"

namespace bounce::passes {

// Layout in shaders/lib/gbuffer.glsl. emission is valid only where the scene has any.
struct GBuffer {
    TextureHandle depth;
    TextureHandle base_color_roughness;
    TextureHandle normal_metallic_specular;
    TextureHandle geometric_normal;
    TextureHandle emission;
};

[[nodiscard]] GBuffer add_gbuffer(FrameGraph& graph, const PassContext& context, const View& camera,
                                  bool* anything_seen = nullptr);
// The same of the simplified meshes, without emission.
[[nodiscard]] GBuffer add_simplified_gbuffer(FrameGraph& graph, const PassContext& context,
                                             const View& camera);

// For passes that read it: declares, then binds.
void read_gbuffer(PassBuilder& builder, const GBuffer& gbuffer);
void bind_gbuffer(const PassResources& resources, const GBuffer& gbuffer);

}  // namespace bounce::passes
