// SPDX-License-Identifier: Apache-2.0
//
// Traces rays through the approximate visibility grid (Bashford-Rogers et al. 2012, III.B) and puts a virtual point light
// where each meets a surface. FROM_LIGHTS: the rays are those of the scene's lights (renderer/avg_rays.h). Otherwise they
// start at the virtual point lights of the bounce before.
//
// ROULETTE: by what each of these sends, at even steps of its running sum, so that a light has as many as its part of the
// flux, to one, and all rays are worth the same. Otherwise one after the other has a ray, and each ray what its light
// sends: a path of the paper, that goes on for as many bounces as there are.
#include "lib/avg_trace.glsl"
#include "lib/vpl.glsl"
#include "lib/vpl_make.glsl"

layout(local_size_x = GROUP_1D) in;
layout(location = 0) uniform ivec3 maps;   // rays, size of their lights' maps, maps a row of the atlas
layout(location = 1) uniform ivec3 before;  // lights of the bounce before; n and lights a subset of these rays' lights
layout(location = 2) uniform vec4 turn;    // of the sequence, for this bounce
layout(location = 3) uniform int first_number;

layout(std430, binding = SSBO_VPLS_OUT) writeonly buffer VplOutBlock { GpuVpl drawn[]; };
// Low-discrepancy numbers in [0, 1)^4 (renderer/avg_rays.h).
layout(std430, binding = SSBO_AVG_NUMBERS) readonly buffer NumberBlock { vec4 numbers[]; };
#ifdef FROM_LIGHTS
layout(std430, binding = SSBO_AVG_RAYS) readonly buffer RayBlock { GpuAvgRay rays[]; };
#else
layout(std430, binding = SSBO_ROW_SUMS) readonly buffer RowBlock { float running_sums[]; };

// The first light whose running sum exceeds the value.
int find_light(float value) {
    int low = 0;
    int high = before.x - 1;
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

// A ray of the bounce before; its flux, W, render-space units. False where it has none.
bool next_ray(int index, vec4 u, out vec3 origin, out vec3 direction, out vec3 leaving, out vec3 flux) {
    // Subsets of the interleaved gather take turns, so that each has rays from all lights.
    int step_ = index % before.z * before.y * before.y + index / before.z;
    float at = (float(step_) + 0.5) / float(maps.x);
    float total = running_sums[before.x - 1];
    origin = leaving = flux = vec3(0.0);
    direction = vec3(0.0, 0.0, 1.0);
    if (!(total > 0.0)) {
        return false;
    }
#ifdef ROULETTE
    int light = find_light(min(at, 1.0 - 1e-6) * total);
    float worth = running_sums[light] - (light == 0 ? 0.0 : running_sums[light - 1]);
    float rays_over_lights = total / (float(maps.x) * max(worth, 1e-30));
#else
    int light = min(int(at * float(before.x)), before.x - 1);
    float rays_over_lights = float(before.x) / float(maps.x);
#endif
    GpuVpl vpl = vpls[light];
    vec3 n = vpl.normal.xyz;
    vec3 t;
    vec3 b;
    orthonormal_basis(n, t, b);
    float angle = 2.0 * PI * u.y;
    vec2 disk = sqrt(u.x) * vec2(cos(angle), sin(angle));
#ifdef DISTANT
    // Across the grid, from a disk that is as wide as the grid's diagonal.
    vec3 size = vec3(avg.size.xyz) * avg.origin.w;
    float radius = 0.5 * length(size);
    direction = n;
    origin = avg.origin.xyz + 0.5 * size + radius * (t * disk.x + b * disk.y - n);
    flux = vpl.intensity.rgb * (PI * radius * radius * rays_over_lights);
#else
    // By the cosine: what Lambert's law sends along a ray is then the same for all.
    float cos_out = sqrt(max(1.0 - u.x, 0.0));
    direction = normalize(t * disk.x + b * disk.y + n * cos_out);
    origin = vpl.position.xyz;
    leaving = n;
    flux = vpl_intensity(vpl, direction, cos_out, 0.0) * (PI * rays_over_lights);
#endif
    return true;
}
#endif

void main() {
    int index = int(gl_GlobalInvocationID.x);
    if (index >= maps.x) {
        return;
    }
    vec4 u = fract(numbers[first_number + index] + turn);
    vec3 origin;
    vec3 direction;
    vec3 leaving;
    vec3 flux;
#ifdef FROM_LIGHTS
    GpuAvgRay ray = rays[index];
    origin = ray.origin.xyz;
    direction = ray.direction.xyz;
    leaving = ray.leaving.xyz * ray.origin.w;
    flux = ray.flux.rgb;
    bool sent = any(greaterThan(flux, vec3(0.0)));
#else
    bool sent = next_ray(index, u, origin, direction, leaving, flux);
#endif
    AvgHit hit;
    if (!sent || !trace_avg(origin, direction, leaving, u.zw, hit)) {
        drawn[index] = dark_vpl();
        return;
    }
#ifdef FROM_LIGHTS
    vec3 way = hit.position - origin;
    flux *= dot(way, way) / max(dot(way, way) + ray.direction.w, 1e-30);
#endif
    PixelLight p;
    p.position = hit.position;
    p.normal = hit.normal;
    p.color = hit.color;
    p.roughness = hit.surface.x;
    p.metallic = hit.surface.y;
    p.specular = hit.surface.z;
    p.disney = hit.surface.w > 0.5;
    p.from_light = direction;
    p.squared_distance = 1.0;
    p.arriving = flux;
    p.profile = 1.0;
    p.area = 0.0;
    GpuVpl vpl = make_vpl(p, 1.0);
    ivec2 origin_of_map = ivec2(index % maps.z, index / maps.z) * maps.y;
    vpl.position.w = 0.0;  // passes/vpl_spacing.comp fills it in
    vpl.bitangent.w = uintBitsToFloat(uint(origin_of_map.x) | uint(origin_of_map.y) << 16);
    drawn[index] = vpl;
}
