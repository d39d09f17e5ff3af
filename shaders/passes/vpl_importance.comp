// SPDX-License-Identifier: Apache-2.0
//
// The importance map: what each texel of a light's reflective shadow map (SPHERE: each cell of the world) counts for when virtual point lights are drawn. The
// flux it reflects; VIEW: what some pixels of the picture show of it, were nothing in between (Barak, Bittner and Havran
// 2013, "Temporally Coherent Adaptive Sampling for Imperfect Shadow Maps", equations 1 and 2).
//
// The floor keeps every texel that reflects anything: a light counts for no less than that part of what it would show on
// white across the whole scene (the unit of length). Without it a light that shows in none of the pixels looked at is never
// drawn, and the pixels between them lack it.
#ifdef SPHERE
#include "lib/sphere.glsl"
#else
#define READ_RSM
#include "lib/vpl_importance.glsl"
#endif
#ifdef VIEW
#include "lib/importance_pixels.glsl"
#include "lib/vpl_make.glsl"
#endif

layout(local_size_x = GROUP_1D) in;
layout(location = 0) uniform ivec3 source;  // first texel, texels, pixels looked at
layout(location = 1) uniform vec2 standing;  // texels that a light stands for, floor
layout(std430, binding = SSBO_IMPORTANCE) writeonly buffer ImportanceBlock { float importance[]; };

#if defined(VIEW) && defined(SPHERE)
float viewed(ivec2 texel, int layer) {
    vec4 cell = sphere_cell(texel);
    vec3 way = sphere_way(texel, vec2(0.5));
    GpuVpl vpl = dark_vpl();
    vpl.normal = vec4(way, 1.0);
    vpl.incident = vec4(way, 1.0);
    vpl.intensity = vec4(cell.rgb, 0.0);
    float sum = 0.0;
    for (int i = 0; i < source.z; ++i) {
        GpuImportancePixel at = importance_pixels[i];
        float cosine = max(-dot(at.normal.xyz, way), 0.0);
        // As passes/vpl_gather.comp has it.
        sum += shown_luminance(at, vpl, way, 1.0, cosine, cosine, WIDENING * cell.w * standing.x);
    }
    return sum + standing.y * texel_importance(texel, layer) / PI;
}
#elif defined(VIEW)
float viewed(ivec2 texel, int layer) {
    PixelLight p;
    if (!load_pixel_light(texel, layer, p)) {
        return 0.0;
    }
    float measure = texel_measure(texel, p);
    float area = surface_area(p, measure * standing.x) * light.cone.z;
    GpuVpl vpl = make_vpl(p, measure);
    float sum = 0.0;
    for (int i = 0; i < source.z; ++i) {
        GpuImportancePixel at = importance_pixels[i];
        vec3 d = at.position.xyz - p.position;
        float squared = max(dot(d, d), 1e-30);
        float inverse = inversesqrt(squared);
        vec3 w = d * inverse;
        float cos_out = dot(p.normal, w);
        float cos_in = -dot(at.normal.xyz, w);
        // As passes/vpl_gather.comp bounds it.
        float geometry = max(cos_out, 0.0) * max(cos_in, 0.0) / (squared + cos_out * cos_out * area / PI);
        sum += shown_luminance(at, vpl, w, max(cos_out, 0.0), max(cos_in, 0.0), geometry, WIDENING * area * inverse * inverse);
    }
    return sum + standing.y * texel_importance(texel, layer) / (PI * PI);
}
#endif

void main() {
    int at = (int(gl_WorkGroupID.y) * MOST_GROUPS + int(gl_WorkGroupID.x)) * GROUP_1D + int(gl_LocalInvocationID.x);
    if (at >= source.y) {
        return;
    }
    int size = source_size();
    int row = at / size;
    ivec2 texel = ivec2(at % size, row % source_rows());
    int layer = row / source_rows();
#ifdef VIEW
    importance[source.x + at] = viewed(texel, layer);
#else
    importance[source.x + at] = texel_importance(texel, layer);
#endif
}
