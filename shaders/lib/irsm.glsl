// SPDX-License-Identifier: Apache-2.0
//
// Imperfect reflective shadow maps (Ritschel et al. 2008, 4.1): for each virtual point light the points that it lights.
// As a source of the next bounce's lights they have the functions of lib/vpl_importance.glsl; a layer is a map.
//
// SPLATTED, as in the paper: one small parabolic map for each light, in one atlas; what hides a point is another
// point's splat. A texel (IRSM_EMPTY where nothing was hit): distance, half, in the high 16 bits; the point's index in
// the map's block of the sequence in the low ones.
//
// Otherwise a map is the points of its block themselves, each with the solid angle of its area; what hides them is
// looked up in the light's imperfect shadow map, which knows surfaces far better than splats of a few points. Blocks
// are sorted along one curve over all surfaces, so that the j-th points of all maps lie near each other: they make a
// row, and a texel of it is a map.
#ifndef LIB_IRSM
#define LIB_IRSM

#include "lib/pixel_light.glsl"
#include "lib/splat.glsl"
#include "lib/vpl_shading.glsl"

#ifdef SPLATTED
const uint IRSM_EMPTY = 0xffffffffu;
layout(binding = IMG_IN, r32ui) readonly uniform uimage2D irsm_image;
#elif defined(VISIBILITY)
#include "lib/ism_lookup.glsl"
#endif
layout(std430, binding = SSBO_POINTS) readonly buffer PointBlock { uvec4 points[]; };
// In the order of the points: surface; base colour of its textures (square roots, 10 bits each); roughness and
// metallic of its textures (16 bits each).
layout(std430, binding = SSBO_POINT_MATERIALS) readonly buffer PointMaterialBlock { uvec4 point_materials[]; };
layout(std430, binding = SSBO_POINT_SURFACES) readonly buffer PointSurfaceBlock { GpuPointSurface surfaces[]; };
layout(std430, binding = SSBO_MATERIALS) readonly buffer MaterialBlock { GpuMaterial materials[]; };

#ifdef SPLATTED
int source_size() {
    return ism.atlas.x;
}

int source_rows() {
    return ism.atlas.x;
}

// Solid angle from the light; 0 outside the parabolic map's disk.
float texel_measure(ivec2 texel, PixelLight p) {
    float side = 2.0 / float(ism.atlas.x);
    vec2 st = (vec2(texel) + 0.5) * side - 1.0;
    return dot(st, st) < 1.0 ? paraboloid_solid_angle(st, side * side) : 0.0;
}
#else
int source_size() {
    return ism.atlas.z;
}

int source_rows() {
    return 1;
}

// Solid angle from the light (of one at infinity: the area across its rays) of the area that the point stands for.
// Points are samples of the surfaces' area, so that in the mean A cos / d^2 is right however near they are; only single
// ones are kept from outshining whole maps.
float texel_measure(ivec2 texel, PixelLight p) {
    return min(max(-dot(p.normal, p.from_light), 0.0) * p.area / p.squared_distance, 32.0 * PI);
}
#endif

int source_map(ivec2 texel, int layer) {
#ifdef SPLATTED
    return layer;
#else
    return texel.x;
#endif
}

bool load_pixel_light(ivec2 texel, int layer, out PixelLight p) {
    int map = source_map(texel, layer);
#ifdef SPLATTED
    uint bits = imageLoad(irsm_image, ism_origin(map) + texel).r;
    bool hit = bits != IRSM_EMPTY;
    int place = point_place(map, hit ? int(bits & 0xffffu) : 0);
#else
    int place = point_place(map, layer);
#endif
    SurfacePoint point = unpack_point(points[place]);
    uvec4 textures = point_materials[place];
    GpuMaterial m = materials[surfaces[textures.x].ids.x];
    GpuVpl vpl = vpls[map];
#ifdef DISTANT
    p.squared_distance = 1.0;
    p.from_light = vpl.normal.xyz;
#else
    vec3 d = point.position - vpl.position.xyz;
    p.squared_distance = max(dot(d, d), 1e-20);
    p.from_light = d * inversesqrt(p.squared_distance);
#endif
    p.position = point.position;
    p.normal = dot(point.normal, p.from_light) > 0.0 ? -point.normal : point.normal;
    vec3 root = vec3(textures.y & 1023u, textures.y >> 10 & 1023u, textures.y >> 20 & 1023u) / 1023.0;
    p.color = m.base_color.rgb * root * root;
    p.roughness = m.surface.y * float(textures.z & 0xffffu) / 65535.0;
    p.metallic = m.surface.x * float(textures.z >> 16) / 65535.0;
    p.specular = m.surface.z;
    if (m.flags.y == 1) {  // unlit: reflects nothing
        p.color = vec3(0.0);
        p.specular = 0.0;
    }
    p.disney = m.flags.x == DIFFUSE_DISNEY;
#ifdef DISTANT
    const float cos_out = 1.0;
    p.arriving = vpl.intensity.rgb;
#else
    float cos_out = max(dot(vpl.normal.xyz, p.from_light), 0.0);
    p.arriving = vpl_intensity(vpl, p.from_light, cos_out, 0.0) * cos_out;
#endif
    p.profile = 1.0;
    p.area = PI * point.radius * point.radius * ism.splat.x;
#ifndef SPLATTED
    float cos_in = -dot(p.normal, p.from_light);
    bool hit = cos_out > 0.0 && cos_in > 0.0 && p.area > 0.0;
#if defined(VISIBILITY) && defined(DISTANT)
    hit = hit && distant_visibility(vpl, p.position, float(ism.points.z)) > 0.0;
#elif defined(VISIBILITY)
    hit = hit && vpl_visibility(vpl, p.from_light, sqrt(p.squared_distance), cos_out, cos_in, float(ism.points.z)) > 0.0;
#endif
#endif
    return hit;
}

// The part of its light that may matter: points are thinned where little of what they send reaches anything
// (scene/points/point_set.h), and each then stands for so much more area.
float reaching_part(PixelLight p) {
#ifdef SPLATTED
    return 1.0;
#else
    return ism.splat.y > 0.0 ? min(ism.splat.y / max(p.area, 1e-30), 1.0) : 1.0;
#endif
}

// What a texel counts for: the flux it reflects, as far as that may matter.
float texel_importance(ivec2 texel, int layer) {
    PixelLight p;
    bool hit = load_pixel_light(texel, layer, p);
    return hit ? importance_density(p.color, p.metallic, p.arriving) * texel_measure(texel, p) * reaching_part(p) : 0.0;
}

#endif
