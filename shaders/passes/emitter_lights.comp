// SPDX-License-Identifier: Apache-2.0
// Virtual point lights on surfaces that emit, one from each sample (scene/points/emitters.h): what the surface sends from
// the part of it that the sample stands for.
#include "lib/math.glsl"
#include "shared/bindings.h"
#include "shared/types.h"

layout(local_size_x = GROUP_1D) in;
layout(location = 0) uniform ivec3 maps;  // lights, size of their maps, maps a row of the atlas

layout(std430, binding = SSBO_POSITIONS) readonly buffer PositionBlock { float positions[]; };
layout(std430, binding = SSBO_POINT_SOURCES) readonly buffer SourceBlock { GpuEmitterSource sources[]; };
layout(std430, binding = SSBO_POINT_SURFACES) readonly buffer SurfaceBlock { GpuPointSurface surfaces[]; };
layout(std430, binding = SSBO_VPLS_OUT) writeonly buffer VplOutBlock { GpuVpl lights[]; };

vec3 corner(GpuPointSurface surface, uint vertex) {
    vec4 p = vec4(positions[3u * vertex], positions[3u * vertex + 1u], positions[3u * vertex + 2u], 1.0);
    return vec3(dot(surface.render_from_model[0], p), dot(surface.render_from_model[1], p),
                dot(surface.render_from_model[2], p));
}

void main() {
    int index = int(gl_GlobalInvocationID.x);
    if (index >= maps.x) {
        return;
    }
    GpuEmitterSource source = sources[index];
    GpuPointSurface surface = surfaces[source.place.w];
    vec3 a = corner(surface, source.place.x);
    vec3 ab = corner(surface, source.place.y) - a;
    vec3 ac = corner(surface, source.place.z) - a;
    vec3 across = cross(ab, ac);
    float double_area = length(across);
    // A transform that mirrors turns the triangle's corners the other way round.
    float turn = dot(cross(surface.render_from_model[0].xyz, surface.render_from_model[1].xyz),
                     surface.render_from_model[2].xyz) < 0.0 ? -1.0 : 1.0;
    float side = source.weights.z < 0.0 ? -turn : turn;
    vec3 normal = double_area > 0.0 ? across * (side / double_area) : vec3(0.0, 0.0, 1.0);
    float area = surface.ids.y == 1 ? 0.5 * double_area * abs(source.weights.z) : 0.0;
    vec3 t;
    vec3 b;
    orthonormal_basis(normal, t, b);
    ivec2 origin = ivec2(index % maps.z, index / maps.z) * maps.y;
    GpuVpl light;
    light.position = vec4(a + ab * source.weights.x + ac * source.weights.y, area);
    light.normal = vec4(normal, 0.0);
    light.tangent = vec4(t, 1e30);  // no near field
    light.bitangent = vec4(b, uintBitsToFloat(uint(origin.x) | uint(origin.y) << 16));
    light.intensity = vec4(source.radiance.rgb * area, 0.0);
    // No lobe that light would have arrived at.
    light.incident = vec4(-normal, 1.0);
    light.glossy = vec4(0.0, 0.0, 0.0, 1.0);
    light.arriving = vec4(0.0, 0.0, 0.0, 1.0);
    lights[index] = light;
}
