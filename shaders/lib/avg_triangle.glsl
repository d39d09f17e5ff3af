// SPDX-License-Identifier: Apache-2.0
//
// Takes triangles through the voxels they meet, by the test of separating axes, which is exact for triangles of any size
// and shape, so that none is lost. Included by passes/avg_triangles.comp and passes/avg_tiles.comp, which differ in how
// many threads a triangle has. STAGE:
//   AVG_MARK   marks which voxels have a surface of which axis
//   AVG_SUM    sums up normals and materials, by area
//   AVG_BOUND  bounds where the surfaces are along their main normal
//
// Sums are 64-bit integers in steps of 2^-40 of a voxel's face, so that they do not depend on the order of additions, a
// million specks in a voxel still count, and eight million whole faces do not overflow them.
#ifndef LIB_AVG_TRIANGLE
#define LIB_AVG_TRIANGLE

#include "lib/avg.glsl"

#define AVG_MARK 0
#define AVG_SUM 1
#define AVG_BOUND 2

layout(location = 0) uniform uvec4 batch;  // first index, triangles, base vertex, first draw
layout(location = 1) uniform uint draws_in_batch;

layout(std430, binding = SSBO_DRAWS) readonly buffer DrawBlock { GpuDraw draws[]; };
layout(std430, binding = SSBO_MATERIALS) readonly buffer MaterialBlock { GpuMaterial materials[]; };
layout(std430, binding = SSBO_AVG_POSITIONS) readonly buffer PositionBlock { float positions[]; };
layout(std430, binding = SSBO_AVG_INDICES) readonly buffer IndexBlock { uint indices[]; };
#if defined(BASE_COLOR_TEXTURE) || defined(METALLIC_ROUGHNESS_TEXTURE)
#define ANY_TEXTURE
layout(std430, binding = SSBO_AVG_UV0) readonly buffer Uv0Block { vec2 uv0[]; };
layout(std430, binding = SSBO_AVG_UV1) readonly buffer Uv1Block { vec2 uv1[]; };
#endif
#ifdef BASE_COLOR_TEXTURE
layout(binding = TEX_BASE_COLOR) uniform sampler2D base_color_texture;
#endif
#ifdef METALLIC_ROUGHNESS_TEXTURE
layout(binding = TEX_METALLIC_ROUGHNESS) uniform sampler2D metallic_roughness_texture;
#endif
#ifdef VERTEX_COLOR
layout(std430, binding = SSBO_AVG_COLORS) readonly buffer ColorBlock { vec4 colors[]; };
#endif
// What is cut out of a surface, by a cutoff or a part at a time, decides which voxels it is in.
#if STAGE == AVG_SUM || (STAGE == AVG_MARK && defined(ALPHA_TEST))
#define READ_MATERIAL
#endif
#if STAGE == AVG_MARK
layout(binding = IMG_AVG_CELLS, r32ui) uniform uimage2DArray cells;
#else
layout(binding = IMG_AVG_CELLS, r32ui) readonly uniform uimage2DArray cells;
#endif
#if STAGE == AVG_SUM
// AVG_SUM_WORDS words a surface (passes/avg_surfaces.comp reads them): low and high half of each sum.
layout(std430, binding = SSBO_AVG_SUMS) buffer SumBlock { uint sums[]; };
#elif STAGE == AVG_BOUND
layout(std430, binding = SSBO_AVG_SUMS) buffer VoxelBlock { GpuAvgVoxel surfaces[]; };
#endif

// By so much of a voxel voxels reach into each other, so that rounding opens no gap between them.
const float AVG_REACH = 1.0 / 4096.0;

// A triangle cut by six planes has nine corners at most.
const int AVG_CORNERS = 9;

struct AvgTriangle {
    vec3 corner[3];   // in voxels, turned so that z is the axis that the normal points along most
    vec3 across;      // the same turned, cross product of two sides
    float slack;      // of the plane's place times the length of `across`: what rounding may have done to it
    vec3 normal;      // unit, not turned
    float area;       // faces of a voxel
    uint axis;
    uint material;
    uvec3 vertices;
};

// Turns voxels' x, y, z to a triangle's, and back.
vec3 turned(vec3 v, uint axis) {
    return axis == 0u ? v.yzx : axis == 1u ? v.zxy : v;
}

ivec3 turned_back(ivec3 v, uint axis) {
    return axis == 0u ? v.zxy : axis == 1u ? v.yzx : v;
}

vec3 avg_corner(GpuDraw draw, uint vertex) {
    vec4 p = vec4(positions[3u * vertex], positions[3u * vertex + 1u], positions[3u * vertex + 2u], 1.0);
    return voxels_from_render(vec3(dot(draw.render_from_model[0], p), dot(draw.render_from_model[1], p),
                                   dot(draw.render_from_model[2], p)));
}

// False where the triangle has no area, and so no side that light could meet.
bool load_triangle(uint number, out AvgTriangle t) {
    uint first = batch.x + 3u * (number % batch.y);
    GpuDraw draw = draws[batch.w + number / batch.y];
    t.vertices = uvec3(indices[first], indices[first + 1u], indices[first + 2u]) + batch.z;
    vec3 a = avg_corner(draw, t.vertices.x);
    vec3 b = avg_corner(draw, t.vertices.y);
    vec3 c = avg_corner(draw, t.vertices.z);
    // By its largest side, so that the square of a sliver's area does not vanish.
    vec3 across = cross(b - a, c - a);
    float largest = max(max(abs(across.x), abs(across.y)), abs(across.z));
    t.normal = across / max(largest, 1e-37);
    float len = length(t.normal);
    t.area = 0.5 * len * largest;
    t.normal /= max(len, 1e-30);
    vec3 n = abs(t.normal);
    t.axis = n.x >= n.y && n.x >= n.z ? 0u : n.y >= n.z ? 1u : 2u;
    t.corner[0] = turned(a, t.axis);
    t.corner[1] = turned(b, t.axis);
    t.corner[2] = turned(c, t.axis);
    t.across = turned(across, t.axis);
    // A side's rounding is some 2^-22 of it at most, the cross product's that of a side squared; far from the corner that
    // it is measured from, a side's length away, the plane is off by as much again. Slivers have no plane to speak of.
    vec3 sides = max(max(abs(b - a), abs(c - a)), abs(c - b));
    float side = sides.x + sides.y + sides.z;
    t.slack = 1e-6 * side * side * side;
    t.material = uint(draw.ids.x);
    return largest > 1e-37;
}

// Columns of voxels along z that the triangle may meet: first and last.
void triangle_columns(AvgTriangle t, out ivec2 first, out ivec2 last) {
    vec2 low = min(min(t.corner[0].xy, t.corner[1].xy), t.corner[2].xy) - AVG_REACH;
    vec2 high = max(max(t.corner[0].xy, t.corner[1].xy), t.corner[2].xy) + AVG_REACH;
    ivec2 size = ivec2(turned(vec3(avg.size.xyz), t.axis).xy);
    first = clamp(ivec2(floor(low)), ivec2(0), size - 1);
    last = clamp(ivec2(floor(high)), ivec2(0), size - 1);
}

// First and last voxel of a column that the triangle may meet: within its own reach, and where its plane passes.
ivec2 triangle_depths(AvgTriangle t, ivec2 column) {
    float least = min(min(t.corner[0].z, t.corner[1].z), t.corner[2].z);
    float most = max(max(t.corner[0].z, t.corner[1].z), t.corner[2].z);
    vec2 offset = vec2(column) + 0.5 - t.corner[0].xy;
    float steep = max(abs(t.across.z), 1e-30);
    float middle = t.corner[0].z - dot(t.across.xy, offset) / (t.across.z < 0.0 ? -steep : steep);
    float reach = ((0.5 + AVG_REACH) * (abs(t.across.x) + abs(t.across.y)) + t.slack) / steep;
    least = max(least, middle - reach) - AVG_REACH;
    most = min(most, middle + reach) + AVG_REACH;
    float depth = turned(vec3(avg.size.xyz), t.axis).z;
    return ivec2(floor(clamp(vec2(least, most), 0.0, depth - 0.5)));
}

// Whether a triangle meets the voxel around a place, widened by AVG_REACH: no axis separates them (Akenine-Moller 2001,
// "Fast 3D Triangle-Box Overlap Testing").
bool separates(vec3 side, vec3 on_side, vec3 opposite, float half_) {
    // Of the cross products of a side with x, y and z.
    vec3 p = cross(side, on_side);
    vec3 q = cross(side, opposite);
    vec3 r = half_ * (abs(side).yxx + abs(side).zzy);
    return any(greaterThan(min(p, q), r)) || any(lessThan(max(p, q), -r));
}

bool meets(AvgTriangle t, vec3 center) {
    const float half_ = 0.5 + AVG_REACH;
    vec3 a = t.corner[0] - center;
    vec3 b = t.corner[1] - center;
    vec3 c = t.corner[2] - center;
    bool apart = any(greaterThan(min(min(a, b), c), vec3(half_))) || any(lessThan(max(max(a, b), c), vec3(-half_)));
    vec3 n = abs(t.across);
    apart = apart || abs(dot(t.across, a)) > half_ * (n.x + n.y + n.z) + t.slack;
    return !(apart || separates(b - a, a, c, half_) || separates(c - b, b, a, half_) || separates(a - c, c, b, half_));
}

#ifdef READ_MATERIAL
// The part of the triangle that is looked at, as a polygon.
vec3 corners[AVG_CORNERS];
int count = 0;

// Cuts the polygon's part beyond a plane across an axis off, where side is 1 what lies above it, where -1 what lies below
// (Sutherland and Hodgman 1974, "Reentrant Polygon Clipping").
void clip(vec3 axis, float plane, float side) {
    vec3 kept[AVG_CORNERS];
    int n = 0;
    vec3 before = corners[max(count - 1, 0)];
    float height_before = (plane - dot(axis, before)) * side;
    for (int i = 0; i < count; ++i) {
        vec3 now = corners[i];
        float height = (plane - dot(axis, now)) * side;
        if ((height >= 0.0) != (height_before >= 0.0) && n < AVG_CORNERS) {
            kept[n] = mix(before, now, height_before / (height_before - height));
            ++n;
        }
        if (height >= 0.0 && n < AVG_CORNERS) {
            kept[n] = now;
            ++n;
        }
        before = now;
        height_before = height;
    }
    for (int i = 0; i < n; ++i) {
        corners[i] = kept[i];
    }
    count = n;
}

#endif

#ifdef READ_MATERIAL
#if defined(BASE_COLOR_ENCODED) || defined(METALLIC_ROUGHNESS_ENCODED)
// IEC 61966-2-1.
vec3 linear_from_srgb(vec3 c) {
    return mix(pow((c + 0.055) / 1.055, vec3(2.4)), c / 12.92, lessThanEqual(c, vec3(0.04045)));
}
#endif

// Barycentrics of a point of the triangle's plane, in the map along its normal's axis; of a sliver, somewhere on it.
vec3 barycentrics(AvgTriangle t, vec2 p) {
    vec2 a = t.corner[1].xy - t.corner[0].xy;
    vec2 b = t.corner[2].xy - t.corner[0].xy;
    vec2 d = p - t.corner[0].xy;
    float all = a.x * b.y - a.y * b.x;
    float inverse = all != 0.0 ? 1.0 / all : 0.0;
    vec2 w = clamp(vec2(d.x * b.y - d.y * b.x, a.x * d.y - a.y * d.x) * inverse, 0.0, 1.0);
    w /= max(w.x + w.y, 1.0);
    return vec3(1.0 - w.x - w.y, w);
}

#ifdef ANY_TEXTURE
vec2 vertex_uv(GpuMaterial m, int slot, uint vertex) {
    vec4 row = m.uv[2 * slot];
    vec3 uv = vec3(row.w > 0.5 ? uv1[vertex] : uv0[vertex], 1.0);
    return vec2(dot(row.xyz, uv), dot(m.uv[2 * slot + 1].xyz, uv));
}

// A texture's mean around a point of the triangle, over `area` of it (faces of a voxel): the level whose texel has that
// area.
vec4 triangle_texel(sampler2D image, AvgTriangle t, GpuMaterial m, int slot, vec3 at, float area) {
    vec2 a = vertex_uv(m, slot, t.vertices.x);
    vec2 b = vertex_uv(m, slot, t.vertices.y);
    vec2 c = vertex_uv(m, slot, t.vertices.z);
    vec2 size = vec2(textureSize(image, 0));
    vec2 ab = (b - a) * size;
    vec2 ac = (c - a) * size;
    float texels = 0.5 * abs(ab.x * ac.y - ab.y * ac.x) * area / max(t.area, 1e-30);
    return textureLod(image, a * at.x + b * at.y + c * at.z, 0.5 * log2(max(texels, 1.0)));
}
#endif

// Base colour and alpha around a place on the triangle, over some area of it.
vec4 triangle_color(AvgTriangle t, GpuMaterial m, vec2 place, float area) {
    vec4 color = m.base_color;
#if defined(BASE_COLOR_TEXTURE) || defined(VERTEX_COLOR)
    vec3 at = barycentrics(t, place);
#endif
#ifdef BASE_COLOR_TEXTURE
    vec4 texel = triangle_texel(base_color_texture, t, m, TEX_BASE_COLOR, at, area);
#ifdef BASE_COLOR_ENCODED
    texel.rgb = linear_from_srgb(texel.rgb);
#endif
    color *= texel;
#endif
#ifdef VERTEX_COLOR
    color *= colors[t.vertices.x] * at.x + colors[t.vertices.y] * at.y + colors[t.vertices.z] * at.z;
#endif
    return color;
}

// How much of a surface is there, by its alpha.
float opaque_part(GpuMaterial m, float alpha) {
#if !defined(ALPHA_TEST)
    return 1.0;
#elif defined(BLEND)
    // Lights see a part of the texels (lib/alpha_cut.glsl).
    return alpha < ALPHA_NOTHING ? 0.0 : alpha >= ALPHA_SOLID ? 1.0 : alpha;
#else
    return alpha < m.emission.a ? 0.0 : 1.0;
#endif
}

// A polygon's mean base colour, and the part of it that is opaque.
vec4 polygon_color(AvgTriangle t, GpuMaterial m, vec3 middle, float area) {
#if defined(ALPHA_TEST) && (defined(BASE_COLOR_TEXTURE) || defined(VERTEX_COLOR))
    // At four places of each triangle between its middle and an edge, a quarter of it each.
    vec3 color = vec3(0.0);
    float opaque = 0.0;
    float all = 0.0;
    for (int i = 0; i < count; ++i) {
        vec3 a = corners[i];
        vec3 b = corners[i + 1 < count ? i + 1 : 0];
        float quarter = 0.125 * length(cross(a - middle, b - middle)) + 1e-30;
        vec3 center = (a + b + middle) / 3.0;
        for (int j = 0; j < avg.sides.y; ++j) {  // four
            vec3 place = j == 0 ? center : mix(center, j == 1 ? a : j == 2 ? b : middle, 0.5);
            vec4 sampled = triangle_color(t, m, place.xy, quarter);
            float part = opaque_part(m, sampled.a) * quarter;
            color += sampled.rgb * part;
            opaque += part;
            all += quarter;
        }
    }
    return vec4(color / max(opaque, 1e-30), opaque / max(all, 1e-30));
#else
    vec4 color = triangle_color(t, m, middle.xy, area);
    return vec4(color.rgb, opaque_part(m, color.a));
#endif
}
#endif

#if STAGE == AVG_SUM
void add(uint word, float value) {
    if (value == 0.0) {
        return;
    }
    float size = abs(value) * AVG_SUM_STEPS;
    uint high = uint(size * (1.0 / 4294967296.0));
    uint low = uint(size - float(high) * 4294967296.0);
    if (value < 0.0) {
        high = ~high + (low == 0u ? 1u : 0u);
        low = ~low + 1u;
    }
    uint before = atomicAdd(sums[word], low);
    high += before + low < before ? 1u : 0u;
    if (high != 0u) {
        atomicAdd(sums[word + 1u], high);
    }
}
#endif

// The part of a triangle that lies in a voxel.
void meet(AvgTriangle t, ivec3 turned_cell) {
    ivec3 cell = turned_back(turned_cell, t.axis);
    vec3 center = vec3(turned_cell) + 0.5;
#if STAGE != AVG_MARK
    uint word = imageLoad(cells, cell).r;
    if ((word >> t.axis & 1u) == 0u) {
        return;  // cut out
    }
    uint index = avg_surface_index(word, t.axis);
#endif
#ifdef READ_MATERIAL
    corners[0] = t.corner[0];
    corners[1] = t.corner[1];
    corners[2] = t.corner[2];
    count = 3;
    // Where the whole triangle is in the voxel, there is nothing to cut. Loops, and not a row of calls: compilers take long
    // over many copies of the clipping.
    vec3 low = min(min(t.corner[0], t.corner[1]), t.corner[2]) - center;
    vec3 high = max(max(t.corner[0], t.corner[1]), t.corner[2]) - center;
    bool inside = all(greaterThanEqual(low, vec3(-0.5))) && all(lessThanEqual(high, vec3(0.5)));
    for (int i = inside ? avg.sides.x : 0; i < avg.sides.x; ++i) {
        vec3 axis = i < 2 ? vec3(1.0, 0.0, 0.0) : i < 4 ? vec3(0.0, 1.0, 0.0) : vec3(0.0, 0.0, 1.0);
        float side = (i & 1) == 0 ? -1.0 : 1.0;
        clip(axis, dot(axis, center) + 0.5 * side, side);
    }
    vec3 middle = vec3(0.0);
    vec3 across = vec3(0.0);
    for (int i = 0; i < count; ++i) {
        middle += corners[i];
        across += cross(corners[i] - corners[0], corners[i + 1 < count ? i + 1 : 0] - corners[0]);
    }
    // A triangle that touches the voxel at most counts for the least.
    middle = count > 0 ? middle / float(count) : (t.corner[0] + t.corner[1] + t.corner[2]) / 3.0;
    float area = 0.5 * length(across);
    GpuMaterial m = materials[t.material];
    vec4 color = polygon_color(t, m, middle, area);
    if (color.a <= 0.0) {
        return;
    }
#endif
#if STAGE == AVG_MARK
    imageAtomicOr(cells, cell, 1u << t.axis);
#elif STAGE == AVG_SUM
    // The least speck counts for something.
    area = max(area, 1.0 / 268435456.0);
    float opaque = area * color.a;
    vec3 n = t.normal;
    vec2 roughness_metallic = m.surface.yx;
#ifdef METALLIC_ROUGHNESS_TEXTURE
    vec3 mr = triangle_texel(metallic_roughness_texture, t, m, TEX_METALLIC_ROUGHNESS, barycentrics(t, middle.xy), area).rgb;
#ifdef METALLIC_ROUGHNESS_ENCODED
    mr = linear_from_srgb(mr);
#endif
    roughness_metallic *= mr.gb;
#endif
    bool unlit = m.flags.y == 1;  // reflects nothing
    vec3 base = unlit ? vec3(0.0) : color.rgb;
    uint first = index * uint(AVG_SUM_WORDS);
    add(first, opaque * n.x * n.x);
    add(first + 2u, opaque * n.y * n.y);
    add(first + 4u, opaque * n.z * n.z);
    add(first + 6u, opaque * n.x * n.y);
    add(first + 8u, opaque * n.x * n.z);
    add(first + 10u, opaque * n.y * n.z);
    add(first + 12u, opaque * base.r);
    add(first + 14u, opaque * base.g);
    add(first + 16u, opaque * base.b);
    add(first + 18u, opaque * roughness_metallic.x);
    add(first + 20u, opaque * roughness_metallic.y);
    add(first + 22u, opaque * (unlit ? 0.0 : m.surface.z));
    add(first + 24u, opaque * (m.flags.x == DIFFUSE_DISNEY ? 1.0 : 0.0));
    add(first + 26u, area - opaque);
#else
    // Along the surfaces' main normal n the part lies within the triangle, within the voxel, and, where x is in the
    // triangle's plane m.x = m.a and n = (n.m) m + q, within n.x = (n.m)(m.a) + q.x.
    vec3 n = turned(surfaces[index].normal.xyz, t.axis);
    vec3 a = t.corner[0] - center;
    vec3 along = vec3(dot(n, a), dot(n, t.corner[1] - center), dot(n, t.corner[2] - center));
    float of_voxel = (0.5 + AVG_REACH) * (abs(n.x) + abs(n.y) + abs(n.z));
    vec3 m = turned(t.normal, t.axis);
    float n_dot_m = dot(n, m);
    vec3 q = abs(n - n_dot_m * m);
    float of_plane = (0.5 + AVG_REACH) * (q.x + q.y + q.z) + t.slack / max(length(t.across), 1e-30);
    float middle = n_dot_m * dot(m, a);
    float low = max(max(min(min(along.x, along.y), along.z), -of_voxel), middle - of_plane);
    float high = min(min(max(max(along.x, along.y), along.z), of_voxel), middle + of_plane);
    int least = int(floor((low - AVG_REACH) * AVG_SLAB_STEPS));
    int most = int(ceil((high + AVG_REACH) * AVG_SLAB_STEPS));
    // Two sides of a wall, or two walls that face each other, are a slab each, with nothing between them.
    if (m.z > 0.0) {
        atomicMin(surfaces[index].slab.x, least);
        atomicMax(surfaces[index].slab.y, most);
    } else {
        atomicMin(surfaces[index].slab.z, least);
        atomicMax(surfaces[index].slab.w, most);
    }
#endif
}

// The parts of a triangle that lie in a box of voxels, first to last. Looks for the next one that it meets in a loop of its
// own: threads of a wave wait for each other's parts, not for each other's voxels.
void meet_box(AvgTriangle t, ivec3 first, ivec3 last) {
    ivec3 size = last - first + 1;
    int voxels = size.x * size.y * size.z;
    int next = 0;
    while (next < voxels) {
        ivec3 cell = first;
        bool met = false;
        while (!met && next < voxels) {
            cell = first + ivec3(next % size.x, next / size.x % size.y, next / (size.x * size.y));
            met = meets(t, vec3(cell) + 0.5);
            ++next;
        }
        if (met) {
            meet(t, cell);
        }
    }
}

// The same in a column of voxels.
void meet_column(AvgTriangle t, ivec2 column) {
    ivec2 depths = triangle_depths(t, column);
    meet_box(t, ivec3(column, depths.x), ivec3(column, depths.y));
}

#endif
