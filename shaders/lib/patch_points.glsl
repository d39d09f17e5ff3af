// SPDX-License-Identifier: Apache-2.0
//
// How many points a triangle has, which maps they are dealt to, and where on it they lie: numbers without buffers.
//
// A triangle has points in proportion to its area. Where that is no whole number it is rounded so that it is right in the
// mean. Both the rounding and the first map follow a lattice of an irrational step along the triangles, from a place of its
// own for each draw: those of neighbouring triangles differ as much as they can, and neither changes from frame to frame.
#ifndef LIB_PATCH_POINTS
#define LIB_PATCH_POINTS

// Jarzynski and Olano 2020, "Hash Functions for GPU Rendering": PCG.
uint patch_hash(uint x) {
    uint state = x * 747796405u + 2891336453u;
    uint word = ((state >> ((state >> 28u) + 4u)) ^ state) * 277803737u;
    return (word >> 22u) ^ word;
}

// A triangle's points, over all maps.
struct PatchPoints {
    uint count;
    uint first_map;
    uint seed;
};

// wanted: its part of the points of all maps, by its area. draw_number: GpuDraw::ids.z; number: of the triangle.
PatchPoints patch_points(uint draw_number, uint number, float wanted, float maps) {
    // Steps of the plastic number's lattice (Roberts 2018, "The Unreasonable Effectiveness of Quasirandom Sequences").
    uint own = patch_hash(draw_number);
    uint place = number * 0xC13FA9A9u + own;
    // A whole number below 2^32 with a float's digits however small it is.
    float rounding = float(place) / 4294967296.0;
    PatchPoints p;
    p.count = wanted > rounding ? uint(min(ceil(wanted - rounding), 4e9)) : 0u;
    // Of those that have a point by chance, as their part of the chance says; the others by the lattice's other way.
    float way = wanted < 1.0 ? rounding / max(wanted, 1e-30)
                             : float((number * 0x91E10DA5u + patch_hash(own)) >> 8u) / 16777216.0;
    p.first_map = uint(min(way * maps, maps - 1.0));
    p.seed = place ^ own * 0x9E3779B9u;
    return p;
}

// A square's points, evenly on a triangle: weights of its second and third corner (Heitz 2019, "A Low-Distortion Map
// Between Triangle and Square").
vec2 on_triangle(vec2 u) {
    return u.y > u.x ? vec2(0.5 * u.x, u.y - 0.5 * u.x) : vec2(u.x - 0.5 * u.y, 0.5 * u.y);
}

// Of the map's index-th point on the triangle: the plastic number's lattice (Roberts 2018), from another place for each
// map and triangle.
vec2 place_on_triangle(uint seed, uint map, uint index) {
    uint x = patch_hash(seed ^ map * 0x9E3779B9u);
    uint y = patch_hash(x);
    uvec2 place = uvec2(x, y) + index * uvec2(0xC13FA9A9u, 0x91E10DA5u);
    return on_triangle((vec2(place >> 8u) + 0.5) / 16777216.0);
}

#endif
