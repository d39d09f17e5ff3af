// SPDX-License-Identifier: Apache-2.0
#include "lib/ism.glsl"

layout(location = 0) flat in ivec2 in_origin;

void main() {
    // A square must not spill over into the neighbouring maps.
    ivec2 texel = ivec2(gl_FragCoord.xy) - in_origin;
    if (any(lessThan(texel, ivec2(0))) || any(greaterThanEqual(texel, ivec2(ism.atlas.x)))) {
        discard;
    }
}
