// SPDX-License-Identifier: Apache-2.0
#ifndef LIB_IMPORTANCE_PIXELS
#define LIB_IMPORTANCE_PIXELS

#include "lib/gbuffer.glsl"
#include "lib/vpl_shading.glsl"

layout(std430, binding = SSBO_IMPORTANCE_PIXELS) buffer ImportancePixelBlock {
    GpuImportancePixel importance_pixels[];
};

// weight: 0 where the pixel shows nothing.
GpuImportancePixel pack_importance_pixel(Surface s, vec3 view, float weight) {
    Receiver r = make_receiver(s, view);
    GpuImportancePixel p;
    p.position = vec4(s.position, weight);
    p.normal = vec4(s.normal, r.n_dot_v);
    p.view = vec4(r.view, r.view_fifth);
    p.albedo = vec4(diffuse_albedo(s) / PI, r.roughness);
    p.f0 = vec4(r.f0, r.f90);
    p.lobe = vec4(r.alpha2, r.smith_view, 0.0, 0.0);
    return p;
}

Receiver receiver_of(GpuImportancePixel p) {
    Receiver r;
    r.view = p.view.xyz;
    r.view_fifth = p.view.w;
    r.roughness = p.albedo.w;
    r.n_dot_v = p.normal.w;
    r.f0 = p.f0.rgb;
    r.f90 = p.f0.w;
    r.alpha2 = p.lobe.x;
    r.smith_view = p.lobe.y;
    return r;
}

// Luminance that the pixel shows of a light seen along the unit vector w, unhidden; arguments as add_vpl() has them.
float shown_luminance(GpuImportancePixel p, GpuVpl vpl, vec3 w, float cos_out, float cos_in, float geometry, float widening) {
    BouncedLight sum;
    sum.irradiance = vec3(0.0);
    sum.glossy = vec3(0.0);
    add_vpl(vpl, receiver_of(p), w, cos_out, cos_in, geometry, widening, sum);
    return dot(sum.irradiance * p.albedo.rgb + sum.glossy, vec3(0.2126, 0.7152, 0.0722)) * p.position.w;
}

#endif
