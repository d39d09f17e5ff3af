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

#ifdef DISTANT
// Depths from the front of the map, in units of its reach; what holds for a part of a distance above holds for a part of
// the reach here.
const float CLOSE_FARTHEST = 2.0;

float own_distance(uint bits) {
    return bits == ISM_EMPTY ? 1e30 : float(bits >> 16) / 65535.0 * 2.0;
}

float tolerance_at(float distance) {
    return CLOSE_TOLERANCE;
}

float plane_beside(uint bits, float from, bool along_s) {
    float slope = float(along_s ? int(bits << 24) >> 24 : int(bits << 16) >> 24) / 16.0;
    float rise = slope * from * 2.0 / float(MAP_SIZE);
    return bits == ISM_EMPTY || abs(rise) > 0.5 ? 1e30 : own_distance(bits) + rise;
}

uint pack_closed(float distance, uint plane_bits) {
    return uint(clamp(ceil(0.5 * distance * 65535.0), 0.0, 65534.0)) << 16 | (plane_bits & 0xffffu);
}
#else
const float CLOSE_FARTHEST = 60000.0;

float own_distance(uint bits) {
    return unpackHalf2x16(bits).y;
}

float tolerance_at(float distance) {
    return CLOSE_TOLERANCE * distance;
}

// Distance of a texel's plane `from` texels beside its centre; infinite where it has none, or one so steep that it says
// nothing so far off.
float plane_beside(uint bits, float from, bool along_s) {
    float nearest = unpackHalf2x16(bits).y;
    float slope = float(along_s ? int(bits << 24) >> 24 : int(bits << 16) >> 24) / 64.0;
    float rise = 1.0 + slope * from;
    return bits == ISM_EMPTY || abs(slope * from) > 0.5 ? 1e30 : nearest / rise;
}

// The slope is that of the texel that shows the plane.
uint pack_closed(float distance, uint plane_bits) {
    return packHalf2x16(vec2(0.0, distance)) | (plane_bits & 0xffffu);
}
#endif

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
    float beside = 1e30;
    for (int i = 0; i < 4; ++i) {
        ivec2 axis = i < 2 ? ivec2(1, 0) : ivec2(0, 1);
        uint bits = LOAD_CLOSE(clamp(texel + ((i & 1) * 2 - 1) * axis, ivec2(0), ivec2(MAP_SIZE - 1)));
        beside = min(beside, own_distance(bits));
    }
    bool bare = beside + tolerance_at(beside) < own_distance(own);
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
    bool agree = bare && farthest - nearest < tolerance_at(farthest) && farthest < CLOSE_FARTHEST;
    // Set back by as much as the planes may differ: where the surface bulges it lies behind all of them, and must not be
    // hidden from the light by what closes it. The slope is the farthest one's: planes that agree have about the same.
    uint plane = pack_closed(farthest + tolerance_at(farthest), plane_bits);
    return agree ? min(own, plane) : own;
}

#endif
