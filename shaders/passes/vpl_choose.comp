// SPDX-License-Identifier: Apache-2.0
//
// Chooses the texels of all lights' maps that become virtual point lights, by the importance map, and how many texels each
// stands for: one over (lights * density). A thread a light. SAMPLER:
//   UNIFORM      the Halton sequence over lights, rows and columns (three numbers)
//   INVERSE2/3   inverse transform by the running sums: of all rows with the first number, or of lights with the first and of
//                the light's rows with the second; then within the row
//   METROPOLIS   Independent Metropolis-Hastings (Barak, Bittner and Havran 2013, "Temporally Coherent Adaptive Sampling for
//                Imperfect Shadow Maps", algorithm 1): a chain of `steps` uniform proposals, whose last state is the light,
//                weighed by the mean importance of the chain's own proposals over its own
//   SINGLE       the same, weighed by the importance of the first proposal (Veach and Guibas 1997)
//   UNREDUCED    the same, weighed by the mean over all texels: with start-up bias
//   RESAMPLED    a proposal is accepted with its part of the importance of all so far, so that the last state is any of them
//                in proportion to importance (Talbot, Cline and Egbert 2005, "Importance Resampling for Global Illumination");
//                with the weights of METROPOLIS there is no bias at any length
//
// Proposals of chain j are points j + lights * k of one sequence, so no two chains share any. Within the k-th block the points
// are dealt out anew: in base 2 the points j + 1024 k of one j agree in their first ten digits, and a chain that
// proposes these alone never leaves its light.
#include "lib/halton.glsl"
#include "shared/bindings.h"
#include "shared/types.h"

layout(local_size_x = GROUP_1D) in;
layout(location = 0) uniform ivec4 counts;  // lights, sources, rows of all sources, steps of a chain
layout(location = 1) uniform uint seed;     // 0: the sequence itself

layout(std430, binding = SSBO_VPL_SOURCES) readonly buffer SourceBlock { uvec4 sources[]; };  // first texel, texels, first row, rows
layout(std430, binding = SSBO_IMPORTANCE) readonly buffer ImportanceBlock { float importance[]; };
layout(std430, binding = SSBO_ROW_SUMS) readonly buffer RowBlock { float running_sums[]; };
layout(std430, binding = SSBO_TEXEL_SUMS) readonly buffer TexelBlock { float texel_sums[]; };
layout(std430, binding = SSBO_VPL_CHOICES) writeonly buffer ChoiceBlock { uvec4 choices[]; };

// The numbers of a point, below 1.
vec4 halton(uint index) {
    vec4 h = vec4(radical_inverse(2u, index), radical_inverse(3u, index), radical_inverse(5u, index), radical_inverse(7u, index));
    if (seed != 0u) {
        h = fract(h + vec4(seeded_turn(seed, 0x2000u), seeded_turn(seed, 0x2001u)));
    }
    return min(h, 1.0 - 1e-6);
}

// A texel: of which source, and its number there.
struct Choice {
    uint source;
    uint texel;
};

float importance_of(Choice c) {
    return importance[sources[c.source].x + c.texel];
}

// texels: what its light is worth. standing: what lies around it with no other light in it, by how densely the sampler puts
// them there; a function of the texel alone, so that a light's size does not change with the luck of its chain and the near
// field, which knows the texels only, agrees with it.
void store(Choice c, float texels, float standing) {
    choices[gl_GlobalInvocationID.x] = uvec4(c.source, c.texel, floatBitsToUint(texels), floatBitsToUint(standing));
}

#if SAMPLER == SAMPLER_INVERSE2 || SAMPLER == SAMPLER_INVERSE3
// The first row of `first` to `last` whose running sum exceeds the value.
uint find_row(uint first, uint last, float value) {
    while (first < last) {
        uint middle = (first + last) / 2u;
        if (running_sums[middle] > value) {
            last = middle;
        } else {
            first = middle + 1u;
        }
    }
    return first;
}

// The same within a row.
uint find_texel(uint first, uint size, float value) {
    uint low = 0u;
    uint high = size - 1u;
    while (low < high) {
        uint middle = (low + high) / 2u;
        if (texel_sums[first + middle] > value) {
            high = middle;
        } else {
            low = middle + 1u;
        }
    }
    return low;
}

float sum_before(uint row) {
    return row == 0u ? 0.0 : running_sums[row - 1u];
}

uint last_row(uint source) {
    return sources[source].z + sources[source].w - 1u;
}

// The first source whose rows' running sum exceeds the value.
uint find_source(float value) {
    uint low = 0u;
    uint high = uint(counts.y) - 1u;
    while (low < high) {
        uint middle = (low + high) / 2u;
        if (running_sums[last_row(middle)] > value) {
            high = middle;
        } else {
            low = middle + 1u;
        }
    }
    return low;
}

void main() {
    uint index = gl_GlobalInvocationID.x;
    if (index >= uint(counts.x)) {
        return;
    }
    float total = running_sums[counts.z - 1];
    if (!(total > 0.0)) {
        store(Choice(0u, 0u), 0.0, 0.0);
        return;
    }
    vec4 h = halton(index);
    Choice c;
    c.source = find_source(h.x * total);
    uvec4 source = sources[c.source];
    float low = sum_before(source.z);
    float high = running_sums[last_row(c.source)];
#if SAMPLER == SAMPLER_INVERSE3
    float in_source = mix(low, high, h.y);
    float in_row = h.z;
#else
    // What picked the source, stretched to it (Shirley and Wang 1991, "Direct Lighting Calculation by Monte Carlo Integration").
    float in_source = h.x * total;
    float in_row = h.y;
#endif
    uint row = find_row(source.z, last_row(c.source), in_source);
    uint size = source.y / source.w;
    uint first = source.x + (row - source.z) * size;
    c.texel = (row - source.z) * size + find_texel(first, size, in_row * texel_sums[first + size - 1u]);
    float f = importance_of(c);
    float texels = f > 0.0 ? total / (f * float(counts.x)) : 0.0;
    store(c, texels, texels);
}
#else
// Where the number i of 0 to n - 1 goes in a permutation of them, another one for each round; round 0 changes nothing.
uint permuted(uint i, uint n, uint round) {
    if (round == 0u || n < 3u) {
        return i;
    }
    uint bits = uint(findMSB(n - 1u)) + 1u;
    uint mask = (1u << bits) - 1u;
    uint fold = max(bits / 2u, 1u);
    uint key = hash(round);
    // Each step is one to one on so many bits; what leaves the range goes on until it is back (as in Kensler 2013,
    // "Correlated Multi-Jittered Sampling").
    do {
        i = ((i ^ key) * (hash(key) | 1u)) & mask;
        i ^= i >> fold;
        i = ((i ^ (key >> 16)) * (hash(key + 1u) | 1u)) & mask;
        i ^= i >> fold;
    } while (i >= n);
    return i;
}

// A proposal, and one over its density.
Choice propose(vec3 h, out float inverse_density) {
    Choice c;
    c.source = uint(h.x * float(counts.y));
    uvec4 source = sources[c.source];
    uint size = source.y / source.w;
    uint row = min(uint(h.y * float(source.w)), source.w - 1u);
    c.texel = row * size + min(uint(h.z * float(size)), size - 1u);
    inverse_density = float(counts.y) * float(source.y);
    return c;
}

void main() {
    uint index = gl_GlobalInvocationID.x;
    uint n = uint(counts.x);
    if (index >= n) {
        return;
    }
    float inverse_density;
    Choice c = propose(halton(index).xyz, inverse_density);
#if SAMPLER == SAMPLER_UNIFORM
    float texels = importance_of(c) > 0.0 ? inverse_density / float(n) : 0.0;
    store(c, texels, texels);
#else
    float f = importance_of(c) * inverse_density;
    float first = f;
    float sum = f;
    for (int k = 1; k < counts.w; ++k) {
        vec4 h = halton(permuted(index, n, uint(k)) + n * uint(k));
        float inverse_density_new;
        Choice proposed = propose(h.xyz, inverse_density_new);
        float f_new = importance_of(proposed) * inverse_density_new;
        sum += f_new;
#if SAMPLER == SAMPLER_RESAMPLED
        bool accepted = f_new > h.w * sum;
#else
        bool accepted = f_new > h.w * f;  // of two without importance the first stays
#endif
        c.source = accepted ? proposed.source : c.source;
        c.texel = accepted ? proposed.texel : c.texel;
        f = accepted ? f_new : f;
        inverse_density = accepted ? inverse_density_new : inverse_density;
    }
#if SAMPLER == SAMPLER_SINGLE
    float weight = first;
#elif SAMPLER == SAMPLER_UNREDUCED
    float weight = running_sums[counts.z - 1];
#else
    float weight = sum / float(counts.w);
#endif
    // What the light would be worth, were all proposals of its chain but the last state as important as texels are in the
    // mean: at one step uniform sampling, at many one over the density that is in proportion to importance.
    float expected = (f + float(counts.w - 1) * running_sums[counts.z - 1]) / float(counts.w);
    float texels = inverse_density / (max(f, 1e-30) * float(n));
    store(c, f > 0.0 ? weight * texels : 0.0, expected * texels);
#endif
}
#endif
