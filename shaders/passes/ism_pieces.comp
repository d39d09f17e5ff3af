// SPDX-License-Identifier: Apache-2.0
//
// Lists the further pieces of triangles that have more points than a patch gives, for an indirect draw. A thread a
// triangle of a batch, a row of groups a draw.
#define LOAD_PATCHES
#include "lib/patch.glsl"

layout(local_size_x = GROUP_1D) in;
layout(location = 2) uniform uvec4 batch;  // first index, base vertex, first draw, triangles
layout(location = 3) uniform uvec4 list;   // command, first piece, pieces at most, first triangle of this dispatch
layout(std430, binding = SSBO_PIECES_OUT) writeonly buffer PieceBlock { GpuPatchPiece pieces[]; };
layout(std430, binding = SSBO_PIECE_COMMANDS) buffer CommandBlock { GpuPieceCommand commands[]; };

void main() {
    uint number = list.w + gl_GlobalInvocationID.x;
    uint draw = batch.z + gl_GlobalInvocationID.y;
    if (number >= batch.w || is_dropped(draw, number)) {
        return;
    }
    PatchTriangle t = load_patch(batch.x, batch.y, draw, number);
    PatchPoints p = patch_points(t.draw_number, number, 0.5 * length(cross(t.ab, t.ac)) * spread.x, spread.y);
    uint further = p.count == 0u ? 0u : (p.count - 1u) / uint(PATCH_POINTS);
    if (further == 0u) {
        return;
    }
    uint first = atomicAdd(commands[list.x].draw.x, further);
    for (uint i = 0u; i < further && first + i < list.z; ++i) {
        pieces[list.y + first + i] = GpuPatchPiece(uvec4(t.vertices, draw), uvec4(number, i + 1u, 1u, 0u));
    }
}
