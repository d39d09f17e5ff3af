// SPDX-License-Identifier: Apache-2.0
//
// A light's map as a picture: its faces side by side, in the middle of it.
#ifndef LIB_MAP_LAYERS
#define LIB_MAP_LAYERS

#include "lib/frame.glsl"
#include "lib/light.glsl"

// Which layer a pixel shows, and where there, -1 to 1. False where it shows none.
bool find_map_layer(ivec2 pixel, out vec2 st, out int layer) {
#if MAP_KIND == MAP_CUBE
    const ivec2 faces = ivec2(3, 2);
#else
    const ivec2 faces = ivec2(1, 1);
#endif
    float side = min(float(frame.size.x) / float(faces.x), float(frame.size.y) / float(faces.y));
    vec2 origin = 0.5 * (vec2(frame.size.xy) - side * vec2(faces));
    vec2 at = (vec2(pixel) + 0.5 - origin) / side;
    ivec2 cell = clamp(ivec2(floor(at)), ivec2(0), faces - 1);
    st = (at - vec2(cell)) * 2.0 - 1.0;
    layer = cell.x + cell.y * faces.x;
    return all(greaterThanEqual(at, vec2(0.0))) && all(lessThan(at, vec2(faces)));
}

#endif
