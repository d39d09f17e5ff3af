// SPDX-License-Identifier: Apache-2.0
//
// Surface area that each virtual point light of a further bounce stands for, from how densely they lie: the disk
// around a light that holds its NEIGHBOURS nearest ones that face alike, shared out among them. (The maps they were
// drawn from overlap, so a texel's own area says nothing about it.)
//
// TRACED: by rays, some of which met nothing and made lights that are none. No area below LEAST_AREA of a voxel's face: what
// is nearer to each other than that the grid does not tell apart.
#include "lib/math.glsl"
#include "lib/vpl.glsl"
#ifdef TRACED
#include "lib/avg.glsl"
const float LEAST_AREA = 1.0 / 16.0;
#endif

layout(local_size_x = GROUP_1D) in;
layout(location = 0) uniform int stride;  // every stride-th light is looked at
layout(location = 1) uniform float extent;  // as in passes/vpl_draw.comp

layout(std430, binding = SSBO_VPLS_OUT) buffer VplOutBlock { GpuVpl spaced[]; };

// Enough that the area scatters by half of itself only, few enough to stay on the light's own surface.
const int NEIGHBOURS = 4;

// Normals that differ by less than 60 degrees: a curved surface goes on, the other side of a wall does not.
const float ALIKE = 0.5;

void main() {
    int index = int(gl_GlobalInvocationID.x);
    if (index >= ism.atlas.z) {
        return;
    }
    vec3 position = spaced[index].position.xyz;
    vec3 normal = spaced[index].normal.xyz;
    float nearest[NEIGHBOURS];
    for (int k = 0; k < NEIGHBOURS; ++k) {
        nearest[k] = 1.0;  // squared; the scene's own diagonal
    }
    for (int i = index % stride; i < ism.atlas.z; i += stride) {
        vec3 d = spaced[i].position.xyz - position;
        bool alike = i != index && dot(spaced[i].normal.xyz, normal) > ALIKE;
#ifdef TRACED
        alike = alike && any(greaterThan(spaced[i].intensity.rgb + spaced[i].glossy.rgb + spaced[i].arriving.rgb, vec3(0.0)));
#endif
        float squared = alike ? dot(d, d) : 1.0;
        for (int k = 0; k < NEIGHBOURS; ++k) {
            float less = min(nearest[k], squared);
            squared = max(nearest[k], squared);
            nearest[k] = less;
        }
    }
    // A surface with fewer lights than that is measured by the farthest it has; a light that is alone there stands for
    // an even part of the scene.
    float area = PI / float(ism.atlas.z);
    for (int k = 0; k < NEIGHBOURS; ++k) {
        area = nearest[k] < 1.0 ? PI * nearest[k] / float((k + 1) * stride) : area;
    }
#ifdef TRACED
    area = max(area, LEAST_AREA * avg.origin.w * avg.origin.w);
#endif
    spaced[index].position.w = area * extent;
}
