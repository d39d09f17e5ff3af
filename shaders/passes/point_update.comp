// SPDX-License-Identifier: Apache-2.0
// Moves points with their triangles: a run of points whose surfaces changed. TRIANGLES: moves large triangles.
#include "lib/points.glsl"
#include "shared/types.h"

layout(local_size_x = GROUP_1D) in;
layout(location = 0) uniform uvec2 run;  // first, count

layout(std430, binding = SSBO_POSITIONS) readonly buffer PositionBlock { float positions[]; };
#ifdef TRIANGLES
layout(std430, binding = SSBO_POINT_SOURCES) readonly buffer SourceBlock { uvec4 sources[]; };
layout(std430, binding = SSBO_TRIANGLES) writeonly buffer TriangleBlock { vec4 triangles[]; };
#else
layout(std430, binding = SSBO_POINT_SOURCES) readonly buffer SourceBlock { GpuPointSource sources[]; };
layout(std430, binding = SSBO_POINTS) writeonly buffer PointBlock { uvec4 points[]; };
#endif
layout(std430, binding = SSBO_POINT_SURFACES) readonly buffer SurfaceBlock { GpuPointSurface surfaces[]; };

vec3 corner(GpuPointSurface surface, uint vertex) {
    vec4 p = vec4(positions[3u * vertex], positions[3u * vertex + 1u], positions[3u * vertex + 2u], 1.0);
    return vec3(dot(surface.render_from_model[0], p), dot(surface.render_from_model[1], p),
                dot(surface.render_from_model[2], p));
}

void main() {
    if (gl_GlobalInvocationID.x >= run.y) {
        return;
    }
#ifdef TRIANGLES
    uint index = run.x + gl_GlobalInvocationID.x;
    uvec4 place = sources[index];
    GpuPointSurface surface = surfaces[place.w];
    // One that is not drawn has no area, and so covers nothing.
    vec3 a = corner(surface, place.x);
    bool drawn = surface.ids.y == 1;
    triangles[3u * index] = vec4(a, 0.0);
    triangles[3u * index + 1u] = vec4(drawn ? corner(surface, place.y) : a, 0.0);
    triangles[3u * index + 2u] = vec4(drawn ? corner(surface, place.z) : a, 0.0);
#else
    GpuPointSource source = sources[run.x + gl_GlobalInvocationID.x];
    GpuPointSurface surface = surfaces[source.place.w];
    vec3 a = corner(surface, source.place.x);
    vec3 ab = corner(surface, source.place.y) - a;
    vec3 ac = corner(surface, source.place.z) - a;
    vec3 across = cross(ab, ac);
    float double_area = length(across);
    SurfacePoint p;
    p.position = a + ab * source.weights.x + ac * source.weights.y;
    p.normal = double_area > 0.0 ? across / double_area : vec3(0.0, 0.0, 1.0);
    p.radius = surface.ids.y == 1 ? sqrt(0.5 * double_area * abs(source.weights.z) / PI) : 0.0;
    p.flat_surface = source.weights.z < 0.0;
    points[floatBitsToUint(source.weights.w)] = pack_point(p);
#endif
}
