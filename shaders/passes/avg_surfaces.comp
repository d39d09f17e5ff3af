// SPDX-License-Identifier: Apache-2.0
//
// Surfaces of the approximate visibility grid from their sums: mean material and main normal. CLEAR: makes the sums zero.
#include "lib/avg.glsl"

layout(local_size_x = GROUP_1D) in;
layout(location = 0) uniform int rows;
layout(std430, binding = SSBO_ROW_SUMS) readonly buffer RowBlock { float running_sums[]; };
#ifdef CLEAR
layout(std430, binding = SSBO_AVG_SUMS) writeonly buffer SumBlock { uint sums[]; };
#else
layout(std430, binding = SSBO_AVG_SUMS) readonly buffer SumBlock { uint sums[]; };
layout(std430, binding = SSBO_AVG_VOXELS) writeonly buffer VoxelBlock { GpuAvgVoxel surfaces[]; };

// Faces of a voxel.
float read_sum(uint word) {
    uint low = sums[word];
    uint high = sums[word + 1u];
    bool negative = (high >> 31) == 1u;
    if (negative) {
        high = ~high + (low == 0u ? 1u : 0u);
        low = ~low + 1u;
    }
    float value = (float(high) * 4294967296.0 + float(low)) * (1.0 / AVG_SUM_STEPS);
    return negative ? -value : value;
}

// The main direction of a symmetric, positive matrix of trace 1: its 64th power, by squaring, is nearly that direction times
// itself. Where two are as strong, one between them.
vec3 main_direction(mat3 m) {
    for (int i = 0; i < 6; ++i) {
        m = m * m;
        m /= max(m[0][0] + m[1][1] + m[2][2], 1e-30);
    }
    vec3 d = vec3(m[0][0], m[1][1], m[2][2]);
    vec3 column = d.x >= d.y && d.x >= d.z ? m[0] : d.y >= d.z ? m[1] : m[2];
    return safe_normalize(column, vec3(0.0, 0.0, 1.0));
}
#endif

void main() {
    uint index = gl_GlobalInvocationID.x;
    if (index >= min(uint(running_sums[rows - 1]), uint(avg.size.w))) {
        return;
    }
    uint first = index * uint(AVG_SUM_WORDS);
#ifdef CLEAR
    for (uint word = 0u; word < uint(AVG_SUM_WORDS); ++word) {
        sums[first + word] = 0u;
    }
#else
    vec3 diagonal = vec3(read_sum(first), read_sum(first + 2u), read_sum(first + 4u));
    vec3 rest = vec3(read_sum(first + 6u), read_sum(first + 8u), read_sum(first + 10u));
    float area = diagonal.x + diagonal.y + diagonal.z;
    float inverse = area > 0.0 ? 1.0 / area : 0.0;
    vec3 d = diagonal * inverse;
    vec3 r = rest * inverse;
    float holes = read_sum(first + 26u);
    GpuAvgVoxel surface;
    surface.tensor_diagonal = vec4(diagonal, area);
    surface.tensor_rest = vec4(rest, holes > 0.0 ? area / (area + holes) : 1.0);
    surface.normal = vec4(main_direction(mat3(d.x, r.x, r.y, r.x, d.y, r.z, r.y, r.z, d.z)), 0.0);
    surface.color = vec4(vec3(read_sum(first + 12u), read_sum(first + 14u), read_sum(first + 16u)) * inverse, 0.0);
    surface.surface =
        vec4(read_sum(first + 18u), read_sum(first + 20u), read_sum(first + 22u), read_sum(first + 24u)) * inverse;
    // Nothing yet; of what shares the last place, anywhere in its voxels.
    bool shared_ = index == uint(avg.size.w) - 1u;
    surface.slab = shared_ ? ivec2(-0x200000, 0x200000).xyxy : ivec2(0x7fffffff, -0x7fffffff).xyxy;
    surfaces[index] = surface;
#endif
}
