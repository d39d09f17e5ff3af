// SPDX-License-Identifier: Apache-2.0
//
// What a receiver sees of a light with a size: imperfect shadow maps of places on it (Ritschel et al. 2008, 5.1), compared as
// those of virtual point lights are (lib/ism.glsl). A sun's places are directions, whose maps are orthographic (DISTANT).
// BOTH_SIDES: receivers lie all around the light, and each place has a second map, of the hemisphere behind it.
#ifndef LIB_IMPERFECT_SHADOW
#define LIB_IMPERFECT_SHADOW

#include "lib/ism.glsl"
#include "lib/light_place.glsl"

layout(binding = IMG_ISM, r32ui) readonly uniform uimage2D ism_image;

// A texel of a place's map, and where in it (from its middle, texels) something is seen; at: in texels.
uint map_texel(uint origin, vec2 at, float size, out vec2 from_center) {
    at = clamp(at, vec2(0.0), vec2(size - 0.01));
    ivec2 texel = ivec2(at);
    from_center = at - vec2(texel) - 0.5;
    return imageLoad(ism_image, texel + ivec2(origin & 0xffffu, origin >> 16)).r;
}

// Shares of the light: x what arrives, y what would without a shadow.
vec2 place_share(GpuVpl place, SoftReceiver r) {
    float size = float(ism.atlas.x);
    uint origin = floatBitsToUint(place.bitangent.w);
    vec2 from_center;
#ifdef DISTANT
    float weight = place_weight(r.normal, -place.normal.xyz, 1.0);
    vec3 p = vpl_from_render(place, r.position - place.position.xyz) / distant_reach(place);
    uint bits = map_texel(origin, (p.xy * 0.5 + 0.5) * size, size, from_center);
    bool lit = distant_lit(bits, p.z, from_center, size);
#else
    vec3 w = r.position - place.position.xyz;
    float squared = max(dot(w, w), 1e-30);
    float distance = sqrt(squared);
    w /= distance;
    float weight = place_weight(r.normal, -w, squared);
    vec3 p = vpl_from_render(place, w);
#ifdef BOTH_SIDES
    origin = p.z < 0.0 ? floatBitsToUint(place.incident.w) : origin;
    p.z = abs(p.z);
#endif
    vec3 window = map_window(place);
    vec2 st = (paraboloid_project(vec3(p.xy, max(p.z, 0.0)), 1.0) - window.xy) / window.z;
    uint bits = map_texel(origin, (st * 0.5 + 0.5) * size, size, from_center);
#ifdef SLOPE_BIAS
    // Splats of one depth, as in lib/ism_lookup.glsl.
    float cosine = abs(dot(r.plane, w));
    float slope = min(sqrt(max(1.0 - cosine * cosine, 0.0)) / max(cosine, 1e-4), 20.0);
    distance -= ism.splat.z + ism.splat.w * (distance * (1.0 + max(p.z, 0.0)) * window.z * 2.0 / size) * slope;
#endif
    bool lit = ism_lit(bits, distance, from_center);
#endif
    return weight * vec2(lit ? 1.0 : 0.0, 1.0);
}

#endif
