// SPDX-License-Identifier: Apache-2.0
//
// Where each of a pixel's four depth samples (AA_SAMPLES) takes its colour from: one of the 3 x 3 pixels around, row by row,
// 4 bits a sample.
#ifndef LIB_SAMPLE_SOURCES
#define LIB_SAMPLE_SOURCES

const uint SOURCE_SELF = 4u;
const uint ALL_SELF = 0x4444u;

uint source_of(uint sources, int s) {
    return sources >> (4 * s) & 15u;
}

ivec2 source_offset(uint source) {
    return ivec2(int(source) % 3 - 1, int(source) / 3 - 1);
}

#endif
