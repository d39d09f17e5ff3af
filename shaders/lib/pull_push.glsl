// SPDX-License-Identifier: Apache-2.0
//
// Fills the holes of a depth map in shared memory (Grossman and Dally 1998; Marroquim, Kraus and Cavalcanti 2007,
// "Efficient Point-Based Rendering Using Image Reconstruction"; thresholds as in Ritschel et al. 2008, 3.2): on the
// way up a coarser texel is made of those of its four that lie within the pull threshold of the nearest; on the way
// down a hole takes what the coarser level has there. Thresholds double with each level.
//
// PAPER: it is their mean, and interpolated on the way down; and a texel that lies farther behind than the push
// threshold is replaced as well. Otherwise it is the farthest of them: what fills a hole is the surface around it, and
// the mean over a surface that recedes lies before half of it and would hide it.
//
// The including shader defines SIDE (a power of two), LEVELS (0 to 3), GROUP_SIZE, and fills level 0, fine[].
// FINE_BITS: a shared array of uint that it has already, of SIDE x SIDE, which then holds level 0 as float bits.
#ifndef LIB_PULL_PUSH
#define LIB_PULL_PUSH

const float HOLE = -1.0;

#ifdef FINE_BITS
#define LOAD_FINE(i) uintBitsToFloat(FINE_BITS[i])
#define STORE_FINE(i, depth) FINE_BITS[i] = floatBitsToUint(depth)
#else
shared float fine[SIDE * SIDE];
#define LOAD_FINE(i) fine[i]
#define STORE_FINE(i, depth) fine[i] = depth
#endif
// Levels 1, 2, ... one after the other.
shared float coarse[SIDE * SIDE / 3 + 1];

int level_begin(int level) {
    // Sum of (SIDE / 2^k)^2 for k = 1 .. level - 1.
    return level <= 1 ? 0 : (SIDE * SIDE - (SIDE >> (level - 1)) * (SIDE >> (level - 1))) / 3;
}

float level_load(int level, ivec2 texel) {
    int side = SIDE >> level;
    texel = clamp(texel, ivec2(0), ivec2(side - 1));
    int place = texel.y * side + texel.x;
    return level == 0 ? LOAD_FINE(place) : coarse[level_begin(level) + place];
}

void level_store(int level, ivec2 texel, float depth) {
    int place = texel.y * (SIDE >> level) + texel.x;
    if (level == 0) {
        STORE_FINE(place, depth);
    } else {
        coarse[level_begin(level) + place] = depth;
    }
}

float pulled(int level, ivec2 texel, float threshold) {
    float depths[4];
    float nearest = 1e30;
    for (int i = 0; i < 4; ++i) {
        depths[i] = level_load(level - 1, 2 * texel + ivec2(i & 1, i >> 1));
        nearest = min(nearest, depths[i] >= 0.0 ? depths[i] : 1e30);
    }
    float sum = 0.0;
    float count = 0.0;
    float farthest = HOLE;
    for (int i = 0; i < 4; ++i) {
        if (depths[i] >= 0.0 && depths[i] - nearest <= threshold) {
            sum += depths[i];
            count += 1.0;
            farthest = max(farthest, depths[i]);
        }
    }
#ifdef PAPER
    return count > 0.0 ? sum / count : HOLE;
#else
    return farthest;
#endif
}

// The coarser level at a finer texel, from the four around it that are there.
float interpolated(int level, ivec2 texel) {
    ivec2 near = texel / 2;
    ivec2 step = 2 * (texel & 1) - 1;
    float sum = 0.0;
    float weights = 0.0;
    float farthest = HOLE;
    for (int i = 0; i < 4; ++i) {
        ivec2 off = ivec2(i & 1, i >> 1);
        float w = (off.x == 0 ? 0.75 : 0.25) * (off.y == 0 ? 0.75 : 0.25);
        float depth = level_load(level, near + off * step);
        if (depth >= 0.0) {
            sum += w * depth;
            weights += w;
            farthest = max(farthest, depth);
        }
    }
#ifdef PAPER
    return weights > 0.0 ? sum / weights : HOLE;
#else
    return farthest;
#endif
}

void pull_push(int me, float pull_threshold, float push_threshold) {
    for (int level = 1; level <= LEVELS; ++level) {
        barrier();
        int side = SIDE >> level;
        for (int i = me; i < side * side; i += GROUP_SIZE) {
            ivec2 texel = ivec2(i % side, i / side);
            level_store(level, texel, pulled(level, texel, pull_threshold * float(1 << (level - 1))));
        }
    }
    for (int level = LEVELS - 1; level >= 0; --level) {
        barrier();
        int side = SIDE >> level;
        for (int i = me; i < side * side; i += GROUP_SIZE) {
            ivec2 texel = ivec2(i % side, i / side);
            float depth = level_load(level, texel);
            float pushed = interpolated(level + 1, texel);
            bool replace = depth < 0.0;
#ifdef PAPER
            replace = replace || (pushed >= 0.0 && depth - pushed > push_threshold * float(1 << level));
#endif
            if (replace) {
                level_store(level, texel, pushed);
            }
        }
    }
    barrier();
}

#endif
