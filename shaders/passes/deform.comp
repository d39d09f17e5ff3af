// SPDX-License-Identifier: Apache-2.0
// Morph targets, then skinning, of one job's vertices into the deformed region of the vertex streams.
#include "shared/bindings.h"
#include "shared/types.h"

layout(local_size_x = GROUP_1D) in;
layout(location = 0) uniform uint job_index;

struct Influence {
    uvec4 joints;
    vec4 weights;
};
layout(std430, binding = SSBO_DEFORM_JOBS) readonly buffer JobBlock { DeformJob jobs[]; };
layout(std430, binding = SSBO_POSITIONS) buffer PositionBlock { float positions[]; };
layout(std430, binding = SSBO_NORMALS) buffer NormalBlock { float normals[]; };
#ifdef TANGENTS
layout(std430, binding = SSBO_TANGENTS) buffer TangentBlock { vec4 tangents[]; };
#endif
layout(std430, binding = SSBO_SKIN_INFLUENCES) readonly buffer InfluenceBlock { Influence influences[]; };
layout(std430, binding = SSBO_SKIN_MATRICES) readonly buffer MatrixBlock { vec4 matrix_rows[]; };
layout(std430, binding = SSBO_MORPH_DELTAS) readonly buffer DeltaBlock { vec4 deltas[]; };
layout(std430, binding = SSBO_MORPH_WEIGHTS) readonly buffer WeightBlock { float morph_weights[]; };

void main() {
    DeformJob job = jobs[job_index];
    int i = int(gl_GlobalInvocationID.x);
    if (i >= job.vertices.z) {
        return;
    }
    int from = 3 * (job.vertices.x + i);
    vec3 position = vec3(positions[from], positions[from + 1], positions[from + 2]);
    vec3 normal = vec3(normals[from], normals[from + 1], normals[from + 2]);
#ifdef TANGENTS
    vec4 tangent = tangents[job.vertices.x + i];
#endif
    for (int target = 0; target < job.morph.y; ++target) {
        float weight = morph_weights[job.morph.z + target];
        if (weight != 0.0) {
            int delta = job.morph.x + (target * job.vertices.z + i) * job.morph.w;
            position += weight * deltas[delta].xyz;
            if (job.morph.w == 2) {
                normal += weight * deltas[delta + 1].xyz;
            }
        }
    }
    if (job.skin.x >= 0) {
        Influence influence = influences[job.skin.x + i];
        vec4 rows[3] = vec4[3](vec4(0.0), vec4(0.0), vec4(0.0));
        for (int k = 0; k < 4; ++k) {
            int first = 3 * (job.skin.y + int(influence.joints[k]));
            for (int row = 0; row < 3; ++row) {
                rows[row] += influence.weights[k] * matrix_rows[first + row];
            }
        }
        vec4 p = vec4(position, 1.0);
        position = vec3(dot(rows[0], p), dot(rows[1], p), dot(rows[2], p));
        // The cofactor matrix turns normals right under any blend of joints.
        vec3 c0 = cross(rows[1].xyz, rows[2].xyz);
        vec3 c1 = cross(rows[2].xyz, rows[0].xyz);
        vec3 c2 = cross(rows[0].xyz, rows[1].xyz);
        normal = vec3(dot(c0, normal), dot(c1, normal), dot(c2, normal));
#ifdef TANGENTS
        tangent.xyz = vec3(dot(rows[0].xyz, tangent.xyz), dot(rows[1].xyz, tangent.xyz), dot(rows[2].xyz, tangent.xyz));
#endif
    }
    // Unit length here: interpolation across a triangle must not weigh corners by a joint's scale.
    float squared = dot(normal, normal);
    normal = squared > 0.0 ? normal * inversesqrt(squared) : vec3(0.0, 0.0, 1.0);
    int to = 3 * (job.vertices.y + i);
    positions[to] = position.x;
    positions[to + 1] = position.y;
    positions[to + 2] = position.z;
    normals[to] = normal.x;
    normals[to + 1] = normal.y;
    normals[to + 2] = normal.z;
#ifdef TANGENTS
    tangents[job.vertices.y + i] = tangent;
#endif
}
