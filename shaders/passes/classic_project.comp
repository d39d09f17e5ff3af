// SPDX-License-Identifier: Apache-2.0
// A light's parabolic map from the five faces of its hemisphere: each texel's ray meets the plane that the face shows
// there.
#include "lib/classic.glsl"
#include "lib/ism.glsl"

layout(local_size_x = GROUP_2D, local_size_y = GROUP_2D) in;
layout(location = 0) uniform int map;
layout(binding = TEX_RSM) uniform sampler2DArray planes;
layout(binding = IMG_OUT, r32ui) writeonly uniform uimage2D atlas_image;

vec3 ray_of(GpuVpl vpl, vec3 local) {
    return vpl.tangent.xyz * local.x + vpl.bitangent.xyz * local.y + vpl.normal.xyz * local.z;
}

void main() {
    ivec2 texel = ivec2(gl_GlobalInvocationID.xy);
    int size = ism.atlas.x;
    if (any(greaterThanEqual(texel, ivec2(size)))) {
        return;
    }
    GpuVpl vpl = vpls[map];
    float texel_size = 2.0 / float(size);
    vec2 at = (vec2(texel) + 0.5) * texel_size - 1.0;
    vec3 local = paraboloid_direction(at);
    uint bits = ISM_EMPTY;
    // The map's corners lie below the horizon, where nothing is looked up.
    if (local.z >= 0.0) {
        int face = classic_face_of(local);
        vec3 right;
        vec3 up;
        vec3 forward;
        classic_face(face, right, up, forward);
        vec2 st = vec2(dot(local, right), dot(local, up)) / dot(local, forward);
        ivec2 place = clamp(ivec2((st * 0.5 + 0.5) * float(size)), ivec2(0), ivec2(size - 1));
        vec4 plane = texelFetch(planes, ivec3(place, face), 0);
        float along = dot(plane.xyz, ray_of(vpl, local));
        float distance = plane.w / along;
        if (plane.w != 0.0 && distance > 0.0) {
            bits = pack_ism(distance, plane_slope(vpl_from_render(vpl, plane.xyz), along, at, texel_size));
        }
    }
    imageStore(atlas_image, ism_origin(map) + texel, uvec4(bits));
}
