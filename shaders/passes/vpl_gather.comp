// SPDX-License-Identifier: Apache-2.0
//
// Light from the virtual point lights, interleaved (Segovia et al. 2006, "Non-interleaved Deferred Shading of
// Interleaved Sample Patterns"): of n x n neighbouring pixels each gathers from another n x n-th of the lights. A
// dispatch shades pixels that share a subset, n apart, by a chunk of that subset, so that all threads read the
// same lights and the same small maps.
//
// The lights are copied to shared memory and used outside any branch: there constant indices are scalar loads on
// every driver (llvmpipe fetches uniforms and storage lane by lane).
#define READ_GBUFFER
#include "lib/gbuffer.glsl"
#include "lib/ism_lookup.glsl"
#include "lib/vpl_shading.glsl"

layout(local_size_x = GROUP_2D, local_size_y = GROUP_2D) in;
layout(location = 0) uniform ivec2 job;  // subset, the chunk's first light
layout(location = 1) uniform ivec2 first_pixel;  // of a block, whose subset is the first
layout(binding = IMG_OUT, rgba32ui) uniform uimage2D bounced_image;
#ifdef NEAR_FIELD
layout(binding = IMG_OUT1, r16f) uniform image2D reach_image;  // near radius of lights that are near
#endif
#ifdef ENVIRONMENT
// Of lights of the world's image: what the receiver's lobe gathers of them, seen and in all (packed as bounced light's
// irradiance). The reflection itself is looked up in the image (lib/environment_glossy.glsl).
layout(binding = IMG_LOBES, rgba32ui) uniform uimage2D lobes_image;
vec2 lobes = vec2(0.0);
#endif
shared GpuVpl chunk[CHUNK];

#ifdef DISTANT
// A piece of the sky, whose light travels along the normal; position.w: its solid angle.
void add(GpuVpl vpl, Surface s, Receiver r, float map_size, inout BouncedLight sum, inout float reach) {
    vec3 w = vpl.normal.xyz;
    float geometry = max(-dot(s.normal, w), 0.0);
#ifdef VISIBILITY
    float visibility = distant_visibility(vpl, s.position, map_size);
#else
    const float visibility = 1.0;
#endif
#ifdef ENVIRONMENT
    add_vpl(vpl, r, w, 1.0, geometry, geometry * visibility, WIDENING * vpl.position.w, sum);
    float lobe = widened_lobe(-dot(r.view, w), geometry + r.n_dot_v, r.smith_view, smith_term(geometry, r.alpha2), r.alpha2,
                              WIDENING * vpl.position.w);
    lobe *= geometry * vpl.incident.w;
    lobes += vec2(lobe * visibility, lobe);
#else
    add_vpl(vpl, r, w, 1.0, geometry, geometry * visibility, WIDENING * vpl.position.w, sum);
#endif
}
#else
void add(GpuVpl vpl, Surface s, Receiver r, float map_size, inout BouncedLight sum, inout float reach) {
    vec3 d = s.position - vpl.position.xyz;
    float squared = max(dot(d, d), 1e-30);
    float inverse = inversesqrt(squared);
    vec3 w = d * inverse;
    float cos_out = dot(vpl.normal.xyz, w);
    float cos_in = -dot(s.normal, w);
    float facing = max(cos_out, 0.0) * max(cos_in, 0.0);
#ifdef NEAR_FIELD
    float share = near_share(squared, vpl.tangent.w);
    // Coplanar up to rounding counts as unlit.
    reach = max(reach, share * facing > 1e-6 ? inversesqrt(vpl.tangent.w) : 0.0);
    float geometry = facing * inverse * inverse * (1.0 - share);
#else
    // The light stands for a piece of surface, not a point: at a distance small against it 1/d^2 overshoots. A
    // disk of the piece's area A, seen along its axis, gives exactly 1/(d^2 + A/pi); seen from the side the mean
    // of the kernel over it does not differ that way (passes/rsm_gather.comp), so the bound fades with cos^2.
    float geometry = facing / (squared + cos_out * cos_out * vpl.position.w / PI);
#ifdef REMOVED
    geometry = facing * inverse * inverse - geometry;
#endif
#endif
#ifdef VISIBILITY
    geometry *= vpl_visibility(vpl, w, squared * inverse, cos_out, cos_in, map_size);
#endif
    float widening = WIDENING * vpl.position.w * inverse * inverse;
    add_vpl(vpl, r, w, max(cos_out, 0.0), max(cos_in, 0.0), geometry, widening, sum);
}
#endif

void main() {
    if (gl_LocalInvocationIndex < uint(CHUNK)) {
        chunk[gl_LocalInvocationIndex] = vpls[job.y + int(gl_LocalInvocationIndex)];
    }
    barrier();
    int n = ism.gather.x;
    ivec2 pixel = ivec2(gl_GlobalInvocationID.xy) * n + (ivec2(job.x % n, job.x / n) + first_pixel) % n;
    Surface s;
    float depth = read_surface_unbranched(min(pixel, frame.size.xy - 1), s);
    Receiver r = make_receiver(s, direction_to_viewer(s.position));
    BouncedLight sum;
    sum.irradiance = vec3(0.0);
    sum.glossy = vec3(0.0);
    float reach = 0.0;
    float size = float(ism.atlas.x);
    // Written out, so that every index is a constant.
#define VPL(i) if (i < CHUNK) add(chunk[min(i, CHUNK - 1)], s, r, size, sum, reach);
    VPL(0) VPL(1) VPL(2) VPL(3) VPL(4) VPL(5) VPL(6) VPL(7)
    VPL(8) VPL(9) VPL(10) VPL(11) VPL(12) VPL(13) VPL(14) VPL(15)
    if (any(greaterThanEqual(pixel, frame.size.xy))) {
        return;
    }
    float scale = depth > 0.0 ? float(n * n) * frame.composite.w : 0.0;
    sum.irradiance *= scale;
    sum.glossy *= scale;
    reach = depth > 0.0 ? reach : 0.0;
#ifdef NEXT_CHUNK
    BouncedLight before = unpack_bounced(imageLoad(bounced_image, pixel));
    sum.irradiance += before.irradiance;
    sum.glossy += before.glossy;
#ifdef NEAR_FIELD
    reach = max(reach, imageLoad(reach_image, pixel).r);
#endif
#endif
    imageStore(bounced_image, pixel, pack_bounced(sum, depth));
#ifdef ENVIRONMENT
    BouncedLight gathered;
    gathered.irradiance = vec3(lobes * (depth > 0.0 ? float(n * n) : 0.0), 0.0);
    gathered.glossy = vec3(0.0);
#ifdef NEXT_LOBES
    gathered.irradiance += unpack_bounced(imageLoad(lobes_image, pixel)).irradiance;
#endif
    imageStore(lobes_image, pixel, pack_bounced(gathered, depth));
#endif
#ifdef NEAR_FIELD
    imageStore(reach_image, pixel, vec4(reach));
#endif
}
