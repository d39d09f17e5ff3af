// SPDX-License-Identifier: Apache-2.0
//
// A triangle as a patch of one vertex: its corners as they are now. PIECES: one of a list of further pieces of triangles
// that have more points than a patch gives (passes/ism_pieces.comp).
#define LOAD_PATCHES
#include "lib/patch.glsl"

#ifdef PIECES
layout(location = 2) uniform uvec4 batch;  // first piece of the list, pieces that it holds at most, -, -
layout(std430, binding = SSBO_PATCH_PIECES) readonly buffer PieceBlock { GpuPatchPiece pieces[]; };
#else
layout(location = 2) uniform uvec4 batch;  // first index, base vertex, first draw, -
#endif

layout(location = 0) out vec3 out_a;
layout(location = 1) out vec3 out_ab;
layout(location = 2) out vec3 out_ac;
layout(location = 3) flat out uvec4 out_number;  // GpuDraw::ids.z, triangle, piece, 1 where it is drawn

#ifdef ALPHA_TEST
layout(std430, binding = SSBO_MATERIALS) readonly buffer MaterialBlock { GpuMaterial materials[]; };
layout(location = 4) out vec3 out_alpha;   // of the corners, without the texture
layout(location = 5) flat out float out_cutoff;
#ifdef BASE_COLOR_TEXTURE
layout(std430, binding = SSBO_PATCH_UVS) readonly buffer UvBlock { vec2 uvs[]; };
layout(location = 6) out vec4 out_uv_ab;
layout(location = 7) out vec2 out_uv_c;
vec2 base_uv(int material, uint vertex) {
    vec3 uv = vec3(uvs[vertex], 1.0);
    return vec2(dot(materials[material].uv[2 * TEX_BASE_COLOR].xyz, uv), dot(materials[material].uv[2 * TEX_BASE_COLOR + 1].xyz, uv));
}
#endif
#ifdef VERTEX_COLOR
layout(std430, binding = SSBO_PATCH_COLORS) readonly buffer ColorBlock { vec4 colors[]; };
#endif
#endif

void main() {
#ifdef PIECES
    uint index = uint(gl_VertexID);
    GpuPatchPiece piece = pieces[min(index, batch.x + batch.y - 1u)];
    bool drawn = index < batch.x + batch.y && piece.number.z == 1u;
    PatchTriangle t = make_patch(piece.place.xyz, piece.place.w, piece.number.x);
    out_number = uvec4(t.draw_number, t.number, piece.number.y, drawn ? 1u : 0u);
#else
    uint draw = batch.z + uint(gl_InstanceID);
    PatchTriangle t = load_patch(batch.x, batch.y, draw, uint(gl_VertexID));
    out_number = uvec4(t.draw_number, t.number, 0u, is_dropped(draw, t.number) ? 0u : 1u);
#endif
    out_a = t.a;
    out_ab = t.ab;
    out_ac = t.ac;
    gl_Position = vec4(0.0);
#ifdef ALPHA_TEST
    int material = draws[t.draw].ids.x;
    out_alpha = vec3(materials[material].base_color.a);
    out_cutoff = materials[material].emission.a;
#ifdef VERTEX_COLOR
    out_alpha *= vec3(colors[t.vertices.x].a, colors[t.vertices.y].a, colors[t.vertices.z].a);
#endif
#ifdef BASE_COLOR_TEXTURE
    out_uv_ab = vec4(base_uv(material, t.vertices.x), base_uv(material, t.vertices.y));
    out_uv_c = base_uv(material, t.vertices.z);
#endif
#endif
}
