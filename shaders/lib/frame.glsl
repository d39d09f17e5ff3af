// SPDX-License-Identifier: Apache-2.0
#ifndef LIB_FRAME
#define LIB_FRAME

#include "shared/bindings.h"
#include "shared/types.h"

layout(std140, binding = UBO_FRAME) uniform FrameBlock {
    FrameUniforms frame;
};

// Unit vector from a surface point towards the viewer.
vec3 direction_to_viewer(vec3 position) {
    return frame.camera_position.w > 0.5 ? normalize(frame.camera_position.xyz - position)
                                         : -frame.camera_forward.xyz;
}

// Radius of a pixel's footprint at a point, facing the viewer, render-space units.
float pixel_footprint(vec3 position) {
    float distance = frame.camera_position.w > 0.5
                         ? dot(position - frame.camera_position.xyz, frame.camera_forward.xyz)
                         : 1.0;
    return frame.interpolation.z * distance;
}

#endif
