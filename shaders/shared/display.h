// SPDX-License-Identifier: Apache-2.0
//
// What the display program binds; it runs after a frame's passes, so the numbers are its own.
#ifndef BOUNCE_SHARED_DISPLAY_H
#define BOUNCE_SHARED_DISPLAY_H

#define TEX_DISPLAY_COLOR 0
#define TEX_DISPLAY_LATTICE 1

#define LOC_DISPLAY_SCALE 0
#define LOC_DISPLAY_EXPONENT 1
#define LOC_DISPLAY_SIZE 2
#define LOC_DISPLAY_LATTICE_RANGE 3

#endif
