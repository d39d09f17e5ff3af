// SPDX-License-Identifier: Apache-2.0
// The five views of each light's classic map (PARABOLOID: the one of its paraboloid), written where the draws of its faces bind them: the lights' places are
// known to the GPU alone.
#include "lib/classic.glsl"
#include "lib/vpl.glsl"

layout(local_size_x = GROUP_1D) in;

// One view in 256 bytes, what a uniform block may begin at.
struct PaddedView {
    ViewUniforms view;
    vec4 padding[11];
};
layout(std430, binding = SSBO_VIEWS_OUT) writeonly buffer ViewOutBlock { PaddedView views[]; };

// Nearer than this nothing is drawn, render units; what is farther away keeps its digits in reversed float depth.
const float NEAR_PLANE = 1e-4;

void main() {
    int index = int(gl_GlobalInvocationID.x);
#ifdef PARABOLOID
    if (index >= ism.atlas.z) {
        return;
    }
    GpuVpl vpl = vpls[index];
    vec3 eye = vpl.position.xyz;
    // Into the frame of the map; passes/geometry.vert projects.
    views[index].view.clip_from_render =
        transpose(mat4(vec4(vpl.tangent.xyz, -dot(vpl.tangent.xyz, eye)), vec4(vpl.bitangent.xyz, -dot(vpl.bitangent.xyz, eye)),
                       vec4(vpl.normal.xyz, -dot(vpl.normal.xyz, eye)), vec4(0.0, 0.0, 0.0, 1.0)));
    views[index].view.eye = vec4(eye, float(index & 4095));
#else
    if (index >= ism.atlas.z * CLASSIC_FACES) {
        return;
    }
    GpuVpl vpl = vpls[index / CLASSIC_FACES];
    mat3 render_from_map = mat3(vpl.tangent.xyz, vpl.bitangent.xyz, vpl.normal.xyz);
    vec3 right;
    vec3 up;
    vec3 forward;
    classic_face(index % CLASSIC_FACES, right, up, forward);
    right = render_from_map * right;
    up = render_from_map * up;
    forward = render_from_map * forward;
    vec3 eye = vpl.position.xyz;
    views[index].view.clip_from_render =
        transpose(mat4(vec4(right, -dot(right, eye)), vec4(up, -dot(up, eye)), vec4(0.0, 0.0, 0.0, NEAR_PLANE),
                       vec4(forward, -dot(forward, eye))));
    views[index].view.eye = vec4(eye, float(index & 4095));
#endif
}
