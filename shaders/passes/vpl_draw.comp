// SPDX-License-Identifier: Apache-2.0
//
// Draws virtual point lights from the reflective shadow maps of all lights (FROM_IRSM: from the imperfect ones of all
// lights of the bounce before), in proportion to the flux reflected.
//
// The unit square is cut into one cell for each light; points of it become texels by the running sums, first of
// rows, then within the row, so equal areas of the square are equal fluxes. A light stands for its cell: it has the
// mean colour of CHILDREN texels drawn there (the first points of the Halton sequence), and the place, normal and
// material of that one of them that lies nearest to their middle. The mean makes colours sum up to those of the
// maps; the middle is a midpoint rule, far more exact than a random place. Runs once for each light source; a cell
// belongs to one, and a source has as many as its part of the flux, to one cell.
//
// SEEDED: for pictures that are the mean of many. The children's places in the cell turn with the seed, and one of them,
// picked by flux, is the light, with the cell's flux: single pictures are noisier, but their mean has no midpoint rule in it.
// With MIDDLE the light stays the mean of its children, for frames that are shown one by one and have to be quiet.
// EXTENT is what is left then of the area that a light stands for, as the many together leave less to each.
//
// STRIPS: rows are patches of surface in the order of a curve, and a cell is a run of whole rows: what lies there has
// received its light from all lights of the bounce before.
//
// HALTON: instead, each light is the texel at a point of the two-dimensional Halton sequence over the map (Lv et al. 2009,
// "A Fast Method for Real-time Computation of Approximated Global Illumination", section III.B), and stands for an equal
// part of the map. A texel in which nothing was hit, or that the light does not reach, makes a dark one.
//
// CHOSEN: instead, the texels that passes/vpl_choose.comp chose.
#ifdef FROM_IRSM
#include "lib/irsm.glsl"
#ifndef SPLATTED
#define STRIPS
#endif
#else
#define READ_RSM
#include "lib/vpl_importance.glsl"
#endif
#include "lib/halton.glsl"
#include "lib/vpl_make.glsl"

layout(local_size_x = GROUP_1D) in;
layout(location = 0) uniform ivec4 rows;    // this source's first row, its number of rows, rows in all, first texel
layout(location = 1) uniform ivec3 layout_;  // n, lights a subset, columns of a subset's cells
layout(location = 2) uniform ivec3 maps;     // lights, size of their maps, maps a row of the atlas
layout(std430, binding = SSBO_VPLS_OUT) writeonly buffer VplOutBlock { GpuVpl drawn[]; };

#ifdef SEEDED
layout(location = 4) uniform uint seed;
layout(location = 5) uniform float extent;
#else
const float extent = 1.0;
#endif
#if defined(CHOSEN)
layout(location = 3) uniform uint number;  // this source's
layout(std430, binding = SSBO_VPL_CHOICES) readonly buffer ChoiceBlock { uvec4 choices[]; };
#elif defined(HALTON)
layout(location = 3) uniform vec2 share;  // the part of the sequence's first coordinate that is this source's
#else
layout(std430, binding = SSBO_ROW_SUMS) readonly buffer RowBlock { float running_sums[]; };
layout(std430, binding = SSBO_TEXEL_SUMS) readonly buffer TexelBlock { float texel_sums[]; };
#endif

const int CHILDREN = 16;

#ifdef SEEDED
vec2 seeded_shift(uint number) {
    return seeded_turn(seed, number);
}
#endif

#ifdef SEEDED
// Its map turned about its axis, so that texels lie elsewhere for every seed.
void turn_map(int index, inout GpuVpl vpl) {
    float angle = 2.0 * PI * seeded_shift(2u * uint(index) + 1u).y;
    vec3 t = vpl.tangent.xyz * cos(angle) + vpl.bitangent.xyz * sin(angle);
    vpl.bitangent.xyz = vpl.bitangent.xyz * cos(angle) - vpl.tangent.xyz * sin(angle);
    vpl.tangent.xyz = t;
}
#endif

// Puts the light into the list, with its map's place and the area and near field of what it stands for.
void store(int index, GpuVpl vpl, float area) {
#ifdef FROM_IRSM
    area *= extent;
    float near_radius = 0.0;  // the near field looks into reflective shadow maps, and there is none here
#else
    area *= light.cone.z * extent;  // lights of the other places stand on the same surface
    float near_radius = NEAR_RADIUS * sqrt(area);
#endif
#ifdef SEEDED
    turn_map(index, vpl);
#endif
    ivec2 origin = ivec2(index % maps.z, index / maps.z) * maps.y;
    vpl.position.w = area;
    vpl.tangent.w = 1.0 / max(near_radius * near_radius, 1e-30);
    vpl.bitangent.w = uintBitsToFloat(uint(origin.x) | uint(origin.y) << 16);
    drawn[index] = vpl;
}

#ifdef GLOSSY
// Its lobe is the mean over all the surface it stands for.
void widen(inout GpuVpl vpl, float spread) {
    float gain = widening_gain(spread);
    vpl.glossy = vec4(vpl.glossy.rgb * gain, min(vpl.glossy.w + spread, 1.0));
    vpl.arriving.rgb *= gain;
}
#endif

#if defined(CHOSEN) || defined(HALTON)
// The light that is a single texel and stands for so many.
// standing: how many lie around it without another light.
void store_texel(int index, ivec2 texel, int layer, float texels, float standing) {
    PixelLight p;
    if (!load_pixel_light(texel, layer, p) || !(texels > 0.0)) {
        drawn[index] = dark_vpl();
        return;
    }
    float measure = texel_measure(texel, p) * texels;
    GpuVpl vpl = make_vpl(p, measure);
#if defined(GLOSSY) && MAP_KIND != MAP_ORTHOGRAPHIC
    widen(vpl, WIDENING * texel_measure(texel, p) * standing * extent);
#endif
    store(index, vpl, surface_area(p, texel_measure(texel, p) * standing));
}
#endif

#if defined(CHOSEN)
void main() {
    int index = int(gl_GlobalInvocationID.x);
    if (index >= maps.x || choices[index].x != number) {
        return;
    }
    int size = source_size();
    int row = int(choices[index].y) / size;
    store_texel(index, ivec2(int(choices[index].y) % size, row % source_rows()), row / source_rows(),
                uintBitsToFloat(choices[index].z), uintBitsToFloat(choices[index].w));
}
#elif defined(HALTON)
void main() {
    int index = int(gl_GlobalInvocationID.x);
    if (index >= maps.x) {
        return;
    }
    vec2 h = vec2(radical_inverse(2u, uint(index)), radical_inverse(3u, uint(index)));
#ifdef SEEDED
    h = fract(h + seeded_shift(0u));
#endif
    if (h.x < share.x || h.x >= share.y) {
        return;  // of another source
    }
    int size = source_size();
    int faces = rows.y / source_rows();
    float across = (h.x - share.x) / (share.y - share.x) * float(faces);
    int layer = min(int(across), faces - 1);
    ivec2 texel = min(ivec2(vec2(across - float(layer), h.y) * float(size)), ivec2(size - 1));
    // Texels that one of the source's points stands for.
    float texels = float(size) * float(rows.y) / (float(maps.x) * (share.y - share.x));
    store_texel(index, texel, layer, texels, texels);
}
#else
// The first row whose running sum exceeds the value.
int find_row(float value) {
    int low = 0;
    int high = rows.z - 1;
    while (low < high) {
        int middle = (low + high) / 2;
        if (running_sums[middle] > value) {
            high = middle;
        } else {
            low = middle + 1;
        }
    }
    return low;
}

#ifdef STRIPS
// The same with the part of the row that lies before the value.
float row_at(float value) {
    int row = find_row(value);
    float before = row == 0 ? 0.0 : running_sums[row - 1];
    return float(row) + clamp((value - before) / max(running_sums[row] - before, 1e-30), 0.0, 1.0);
}

// A light bounded by the whole disk it stands for sends too little sideways; without the near field of a first bounce
// nothing puts that back. docs/papers/imperfect_shadow_maps.md has the measurement.
const float BOUNDED_SHARE = 0.4;
#endif

int find_texel(int first, int size, float value) {
    int low = 0;
    int high = size - 1;
    while (low < high) {
        int middle = (low + high) / 2;
        if (texel_sums[first + middle] > value) {
            high = middle;
        } else {
            low = middle + 1;
        }
    }
    return low;
}

// The texel at a part u of the row that a running sum falls into, as its column and its row of this source's.
// weight: of its row, over the importance of the row's texels.
ivec2 find(float u, float sum, out float weight) {
    int size = source_size();
    int row = clamp(find_row(sum), rows.x, rows.x + rows.y - 1);
    int first = rows.w + (row - rows.x) * size;
    float in_row = texel_sums[first + size - 1];
    weight = 1.0;
#ifdef FROM_IRSM
    weight = (running_sums[row] - (row == 0 ? 0.0 : running_sums[row - 1])) / max(in_row, 1e-30);
#endif
    return ivec2(find_texel(first, size, u * in_row), row - rows.x);
}

// Columns of a row of cells in an order that leaves no gaps: steps of about the golden section that visit each once.
int shuffled(int column, int columns) {
    int stride = max(int(0.618034 * float(columns) + 0.5), 1);
    for (bool coprime = false; !coprime; stride += coprime ? 0 : 1) {
        int a = columns;
        int b = stride;
        while (b > 0) {
            int rest = a % b;
            a = b;
            b = rest;
        }
        coprime = a == 1;
    }
    return column * stride % columns;
}

void main() {
    int index = int(gl_GlobalInvocationID.x);
    if (index >= maps.x) {
        return;
    }
    float total = running_sums[rows.z - 1];
    if (!(total > 0.0)) {
        drawn[index] = dark_vpl();
        return;
    }
    // Cells of one subset of the interleaved gather are n apart, so each subset covers the whole square.
    int n = layout_.x;
    int subset = index / layout_.y;
    int k = index % layout_.y;
#ifdef STRIPS
    ivec2 cell = ivec2(0, k * n * n + subset);
    vec2 cells = vec2(1.0, maps.x);
#else
    ivec2 cell = ivec2(k % layout_.z, k / layout_.z) * n + ivec2(subset % n, subset / n);
    vec2 cells = vec2(layout_.z * n, layout_.y / layout_.z * n);
#endif
    // Where sources meet within a row of cells each takes its part of the columns, and all of its cells' points lie in
    // its own map.
    float decider = (float(shuffled(cell.x, int(cells.x))) + 0.5) / cells.x;
    int row = find_row(min((float(cell.y) + decider) / cells.y, 1.0 - 1e-6) * total);
    if (row < rows.x || row >= rows.x + rows.y) {
        return;
    }
    float low = max(float(cell.y) / cells.y * total, rows.x == 0 ? 0.0 : running_sums[rows.x - 1]);
    float high = min((float(cell.y) + 1.0) / cells.y * total, running_sums[rows.x + rows.y - 1]);
    float texels = total / (float(maps.x) * float(CHILDREN));  // over importance: texels a child stands for
    PixelLight children[CHILDREN];
    float measures[CHILDREN];
    float fluxes[CHILDREN];
    float flux = 0.0;
    for (int i = 0; i < CHILDREN; ++i) {
        vec2 h = vec2(radical_inverse(2u, uint(i)), radical_inverse(3u, uint(i))) + 0.5 / float(CHILDREN);
#ifdef SEEDED
        h = fract(h + seeded_shift(2u * uint(index)));
#endif
        float weight;
        ivec2 found = find(min((float(cell.x) + h.x) / cells.x, 1.0 - 1e-6), mix(low, high, min(h.y, 1.0 - 1e-6)), weight);
        ivec2 texel = ivec2(found.x, found.y % source_rows());
        int layer = found.y / source_rows();
        load_pixel_light(texel, layer, children[i]);
        float importance = texel_importance(texel, layer) * weight;
        measures[i] = importance > 0.0 ? texel_measure(texel, children[i]) * texels / importance : 0.0;
        fluxes[i] = importance_density(children[i].color, children[i].metallic, children[i].arriving) * measures[i];
        flux += fluxes[i];
    }
    // A cell may lie across an edge. One child, picked by flux, picks the surface, so that in the mean every surface
    // has its due; the light then stands in the middle of those that lie on it.
    float wanted = (float(hash(uint(index)) % uint(CHILDREN)) + 0.5) / float(CHILDREN) * flux;
#ifdef STRIPS
    // Where strips one after the other lie across the same edge, they take turns; never where two children meet,
    // where rounding would decide.
    wanted = fract(radical_inverse(2u, uint(cell.y)) + 0.31 / float(CHILDREN)) * flux;
#endif
#ifdef SEEDED
    wanted = seeded_shift(2u * uint(index) + 1u).x * flux;
#endif
    int picked = 0;
    float sum = 0.0;
    for (int i = 0; i < CHILDREN; ++i) {
        picked = sum <= wanted && fluxes[i] > 0.0 ? i : picked;
        sum += fluxes[i];
    }
#ifdef IMPORTANCE_MAP
    // Children of other importance than their flux: those that count for little stand for much. Picked by flux these would
    // be the light nearly always, and what is seen of the cell a rare and bright one; so all are as likely.
    picked = clamp(int(wanted / max(flux, 1e-30) * float(CHILDREN)), 0, CHILDREN - 1);
#endif
    PixelLight chosen = children[picked];
#if defined(SEEDED) && !defined(MIDDLE)
    // Picked in proportion to flux, it stands for all of it.
#ifdef IMPORTANCE_MAP
    float standing = measures[picked] * float(CHILDREN);
#else
    float standing = fluxes[picked] > 0.0 ? measures[picked] * (flux / fluxes[picked]) : 0.0;
#endif
    if (!(standing > 0.0)) {
        drawn[index] = dark_vpl();
        return;
    }
    GpuVpl light_ = make_vpl(chosen, standing);
#if defined(GLOSSY) && !defined(FROM_IRSM) && MAP_KIND != MAP_ORTHOGRAPHIC
    widen(light_, WIDENING * standing * extent);
#endif
#if defined(STRIPS)
    float standing_area = BOUNDED_SHARE * (row_at(high) - row_at(low)) * chosen.area;
#elif defined(FROM_IRSM)
    float standing_area = 0.0;  // passes/vpl_spacing.comp fills it in
#else
    float standing_area = surface_area(chosen, standing);
#endif
    store(index, light_, standing_area);
#else
    // Sums over the members.
    vec3 center = vec3(0.0);
    vec3 normal = vec3(0.0);
    vec3 arriving = vec3(0.0);
    vec3 reflected = vec3(0.0);
    float metal = 0.0;  // metallic, weighed by what is reflected
    float area = 0.0;
    float measure = 0.0;
    float member_flux = 0.0;
    int members = 0;
    bool member[CHILDREN];
    for (int i = 0; i < CHILDREN; ++i) {
        vec3 d = children[i].position - chosen.position;
        member[i] = fluxes[i] > 0.0 && dot(children[i].normal, chosen.normal) > 0.9 &&
                    abs(dot(d, chosen.normal)) <= 0.2 * length(d) + 1e-5;
        if (member[i]) {
            vec3 part = children[i].color * children[i].arriving * measures[i];
            center += children[i].position * fluxes[i];
            normal += children[i].normal * fluxes[i];
            arriving += children[i].arriving * measures[i];
            reflected += part;
            metal += dot(part, vec3(1.0)) * children[i].metallic;
            area += surface_area(children[i], measures[i]);
            measure += measures[i];
            member_flux += fluxes[i];
            ++members;
        }
    }
    if (!(member_flux > 0.0)) {
        drawn[index] = dark_vpl();
        return;
    }
    center /= member_flux;
    PixelLight middle = chosen;
    float least = 1e30;
    for (int i = 0; i < CHILDREN; ++i) {
        vec3 d = children[i].position - center;
        // By more than rounding: of two that are as near, the first.
        if (member[i] && dot(d, d) < 0.999 * least) {
            least = dot(d, d);
            middle = children[i];
        }
    }
    // Members stand for the others as well.
#ifdef IMPORTANCE_MAP
    float all = float(CHILDREN) / float(max(members, 1));
#else
    float all = flux / member_flux;
#endif
    float sent = dot(reflected, vec3(1.0));
    middle.color = reflected / max(arriving, vec3(1e-30));
    middle.arriving = arriving / measure;
    // So that what is reflected diffusely sums up as well.
    middle.metallic = sent > 0.0 ? metal / sent : middle.metallic;
    GpuVpl vpl = make_vpl(middle, measure * all);
#ifdef GLOSSY
    // Its lobe is the mean over all the surface it stands for (Toksvig 2005, "Mipmapping Normal Maps"): normals that vary
    // by s^2 along each axis have a mean of length 1 - s^2 and add 2 s^2 to alpha^2.
    float spread = 2.0 * (1.0 - length(normal) / member_flux);
#if !defined(FROM_IRSM) && MAP_KIND != MAP_ORTHOGRAPHIC
    spread += WIDENING * measure * all;  // arriving directions: measure is a solid angle
#endif
    widen(vpl, spread);
#endif
#if defined(STRIPS)
    // A row is an equal part of the surfaces, and a cell so many rows.
    area = BOUNDED_SHARE * (row_at(high) - row_at(low)) * middle.area;
#elif defined(FROM_IRSM)
    area = 0.0;  // passes/vpl_spacing.comp fills it in
#else
    area *= all;
#endif
    store(index, vpl, area);
#endif
}
#endif
