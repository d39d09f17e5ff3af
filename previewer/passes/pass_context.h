// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "frame_graph/frame_graph.h"
#include "gl/program.h"
#include "gpu/environment_maps.h"
#include "gpu/gpu_scene.h"
#include "gpu/lobe_table.h"
#include "gpu/uniform_arena.h"

namespace bounce::passes {

// One rasterised view of the scene.
struct View {
    gpu::UniformArena::Slot uniforms;  // ViewUniforms
    glm::mat4 clip_from_render{1.0F};  // as in these
    bool mirrored = false;             // the projection turns front faces into back faces
    bool begins_near = false;  // what lies before the near plane is not drawn; else it is, upon that plane
};

// The maps of a light with a size, one from each of some places on it; none where there are no chunks.
struct SoftMaps {
    struct Face {
        int layer = 0;
        View view;
    };
    int map_kind = 0;                             // MAP_*
    int size = 0;                                 // texels a side
    int layers = 0;                               // of all maps
    std::vector<Face> faces;                      // those that are drawn
    std::vector<gpu::UniformArena::Slot> chunks;  // ShadowViews
    bool blended_only = false;                    // the light has a hard shadow of all else
    int convolution_order = 0;                    // more: one map, whose surroundings are convolved
    [[nodiscard]] bool empty() const { return chunks.empty(); }
};

// One light of the frame, ready to draw.
struct LightPass {
    std::string name;
    int map_kind = 0;  // MAP_*
    int profile = 0;   // PROFILE_*
    gpu::UniformArena::Slot uniforms;
    std::vector<View> faces;  // one, or six for a cube
    int rsm_size = 0;
    int shadow_size = 0;
    bool casts_shadow = true;
    bool sized = false;                     // it has a radius, or a sun's angle
    bool glossy = true;                     // false: its reflection is drawn with the world's image
    const gpu::LobeTable* lobes = nullptr;  // where glossy lobes reflect it with its size
    SoftMaps soft;
    std::vector<glm::vec3>
        tints;  // of each place that throws its soft shadow, over the light's mean; empty: even
    // Light sent out, W (sun: through the scene's cross-section); decides its share of the samples.
    double flux_w = 0.0;
};

// The world's image, where it is drawn.
struct WorldImage {
    const gpu::EnvironmentMaps* maps = nullptr;
    gpu::UniformArena::Slot uniforms;  // WorldUniforms
};

// What every pass needs; valid for the frame.
struct PassContext {
    gl::ProgramCache& programs;
    const gpu::GpuScene& scene;
    const gpu::UniformArena& uniforms;
    gpu::UniformArena::Slot frame;  // FrameUniforms
    int width = 0;
    int height = 0;
    bool blends = false;  // blended surfaces have layers of their own; else they are cut out at one half
};

// MAP_KIND and PROFILE of a light, compiled in.
[[nodiscard]] gl::Defines light_defines(const LightPass& light);

// Draws the scene into the bound framebuffer, what the view may see of it. Programs are chosen by each
// batch's features; depth_only batches take their fragment shader only where an alpha test needs it.
enum class DrawKind {
    surface,
    surface_with_emission,
    seen_depth,
    // Of blended surfaces what lies behind a depth and before another (BLEND_PEEL).
    peeled_surface,
    peeled_surface_with_emission,
    peeled_depth,
    // As lights see it. Of blended surfaces a part of the texels, but where `depth` cuts them out at one half
    // and solid_depth leaves them out.
    light_surface,
    plane,
    depth,
    solid_depth,
    hashed_depth,
    blended_depth,  // nothing but these
};
void draw_scene(const PassContext& context, const View& view, DrawKind kind, const std::string& fragment,
                const gl::Defines& defines, gpu::Geometry geometry = gpu::Geometry::whole);
// All of the scene, with ViewUniforms that the caller has bound.
void draw_batches(const PassContext& context, bool mirrored, DrawKind kind, const std::string& fragment,
                  const gl::Defines& defines, gpu::Geometry geometry = gpu::Geometry::whole);

// What decides on what draw_scene() draws; view null: as draw_batches(). Materials where the kind looks at
// them.
[[nodiscard]] ContentKey drawn_content(const PassContext& context, const View* view, DrawKind kind,
                                       gpu::Geometry geometry = gpu::Geometry::whole);
// Of a uniform block.
[[nodiscard]] ContentKey content(const PassContext& context, gpu::UniformArena::Slot slot);
// Of what FrameUniforms say of the camera and the picture's size.
[[nodiscard]] ContentKey camera_content(const PassContext& context);
[[nodiscard]] ContentKey content(const gl::Defines& defines);

// Work groups that cover a picture, and the barrier after which everything written is seen.
void dispatch_2d(int width, int height);
// Of GROUP_1D threads each; shaders find their place by gl_WorkGroupID.y * MOST_GROUPS + gl_WorkGroupID.x, or
// by gl_GlobalInvocationID.x where there are at most MOST_GROUPS groups.
void dispatch_1d(int threads);
void finish_writes();

}  // namespace bounce::passes
