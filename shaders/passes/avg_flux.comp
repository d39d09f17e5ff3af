// SPDX-License-Identifier: Apache-2.0
//
// What each virtual point light is worth as a start of rays: the luminance of the flux that it sends out.
#include "lib/vpl.glsl"

layout(local_size_x = GROUP_1D) in;

layout(std430, binding = SSBO_ROW_SUMS) writeonly buffer RowBlock { float worth[]; };

void main() {
    int index = int(gl_GlobalInvocationID.x);
    if (index >= ism.atlas.z) {
        return;
    }
    GpuVpl vpl = vpls[index];
#ifdef DISTANT
    vec3 flux = vpl.intensity.rgb;
#else
    // Of the glossy lobe about what it sends at normal incidence.
    vec3 flux = vpl.intensity.rgb * 3.14159265 + vpl.glossy.rgb;
#endif
    worth[index] = max(dot(flux, vec3(0.2126, 0.7152, 0.0722)), 0.0);
}
