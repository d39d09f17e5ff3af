// SPDX-License-Identifier: Apache-2.0
//
// The world's virtual point lights at infinity from the cells of the sphere that passes/vpl_choose.comp chose. Where their
// maps stand and what these show is there already (renderer/world_lights.h), and stays; so do the lights that stand for the
// image's suns, the last one of each subset.
#include "lib/halton.glsl"
#include "lib/sphere.glsl"
#include "lib/vpl.glsl"

layout(local_size_x = GROUP_1D) in;
layout(location = 0) uniform ivec3 counts;  // lights, lights a subset, chosen ones a subset
layout(location = 1) uniform uint seed;     // 0: the middles of cells
layout(std430, binding = SSBO_VPL_CHOICES) readonly buffer ChoiceBlock { uvec4 choices[]; };
layout(std430, binding = SSBO_VPLS_OUT) writeonly buffer VplOutBlock { GpuVpl drawn[]; };

void main() {
    int index = int(gl_GlobalInvocationID.x);
    if (index >= counts.x) {
        return;
    }
    GpuVpl vpl = vpls[index];
    int in_subset = index % counts.y;
    if (in_subset >= counts.z) {
        drawn[index] = vpl;
        return;
    }
    uvec4 choice = choices[index / counts.y * counts.z + in_subset];
    ivec2 texel = ivec2(int(choice.y) % source_size(), int(choice.y) / source_size());
    vec4 cell = sphere_cell(texel) * uintBitsToFloat(choice.z);
    vec2 inside = seed == 0u ? vec2(0.5) : seeded_turn(seed, 0x3000u + uint(index));
    vec3 way = sphere_way(texel, inside);
    vec3 s;
    vec3 t;
    orthonormal_basis(way, s, t);
    // Turned, so that the texels of different maps do not line up.
    float turn = 2.0 * PI * seeded_turn(seed, 0x4000u + uint(index)).x;
    vpl.normal.xyz = way;
    vpl.incident.xyz = way;
    vpl.tangent.xyz = cos(turn) * s + sin(turn) * t;
    vpl.bitangent.xyz = cross(way, vpl.tangent.xyz);
    vpl.intensity = vec4(cell.rgb, 0.0);
    vpl.position.w = cell.w;
    vpl.incident.w = sphere_luminance(cell.rgb) * sphere.light.y;
    drawn[index] = vpl;
}
