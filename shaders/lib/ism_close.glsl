// SPDX-License-Identifier: Apache-2.0
//
// Closes what disks leave bare inside a surface. Points spread over a surface leave a part of it uncovered however many
// there are, and a finely cut wall would let that part of the light through. A texel with near surfaces to all four
// sides, along s and along t, whose planes agree on where they pass through the texel, shows that surface too. A texel
// beyond an outline lacks one of the four, one between things at different depths their agreement, so nothing grows.
//
// The including shader defines LOAD_CLOSE(texel) and MAP_SIZE.
#ifndef LIB_ISM_CLOSE
#define LIB_ISM_CLOSE

#include "lib/ism.glsl"

// Bare places are at most about as wide as a point's disk, two or three texels where the number of points is chosen by
// the size of the map.
const int CLOSE_REACH = 3;

// Planes of one surface, curved within a few texels, differ by less than this part of their distance; what is hidden
// behind them lies farther off by more.
const float CLOSE_TOLERANCE = 0.05;

// Distance of a texel's plane `from` texels beside its centre; infinite where it has none, or one so steep that it says
// nothing so far off.
float plane_beside(uint bits, float from, bool along_s) {
    float nearest = unpackHalf2x16(bits).y;
    float slope = float(along_s ? int(bits << 24) >> 24 : int(bits << 16) >> 24) / 64.0;
    float rise = 1.0 + slope * from;
    return bits == ISM_EMPTY || abs(slope * from) > 0.5 ? 1e30 : nearest / rise;
}

// The nearest plane within reach on one side, at the texel itself. side: -1 or 1.
float plane_on_side(ivec2 texel, ivec2 axis, int side, out uint bits) {
    float least = 1e30;
    bits = ISM_EMPTY;
    for (int k = 1; k <= CLOSE_REACH; ++k) {
        ivec2 other = clamp(texel + side * k * axis, ivec2(0), ivec2(MAP_SIZE - 1));
        uint candidate = LOAD_CLOSE(other);
        float distance = plane_beside(candidate, -float(side * k), axis.x != 0);
        bits = distance < least ? candidate : bits;
        least = min(least, distance);
    }
    return least;
}

uint closed_texel(ivec2 texel) {
    uint own = LOAD_CLOSE(texel);
    // Most texels have nothing nearer beside them and are done. A loop, because there are drivers that walk through
    // branches whether they are taken or not (llvmpipe), but none that walk through loops.
    float beside = 65504.0;
    for (int i = 0; i < 4; ++i) {
        ivec2 axis = i < 2 ? ivec2(1, 0) : ivec2(0, 1);
        uint bits = LOAD_CLOSE(clamp(texel + ((i & 1) * 2 - 1) * axis, ivec2(0), ivec2(MAP_SIZE - 1)));
        beside = min(beside, unpackHalf2x16(bits).y);
    }
    bool bare = beside * (1.0 + CLOSE_TOLERANCE) < unpackHalf2x16(own).y;
    float farthest = 0.0;
    float nearest = 1e30;
    uint plane_bits = ISM_EMPTY;
    for (int i = bare ? 0 : 4; i < 4; ++i) {
        uint bits;
        float distance = plane_on_side(texel, i < 2 ? ivec2(1, 0) : ivec2(0, 1), (i & 1) * 2 - 1, bits);
        plane_bits = distance > farthest ? bits : plane_bits;
        farthest = max(farthest, distance);
        nearest = min(nearest, distance);
    }
    bool agree = bare && farthest - nearest < CLOSE_TOLERANCE * farthest && farthest < 60000.0;
    // Set back by as much as the planes may differ: where the surface bulges it lies behind all of them, and must not be
    // hidden from the light by what closes it. The slope is the farthest one's: planes that agree have about the same.
    uint plane = packHalf2x16(vec2(0.0, farthest * (1.0 + CLOSE_TOLERANCE))) | (plane_bits & 0xffffu);
    return agree ? min(own, plane) : own;
}

#endif
