// SPDX-License-Identifier: Apache-2.0
//
// Cycles' pixel filter over four by four samples, half a pixel apart. Its Blackman-Harris of width 1.5 px is the window
// over three pixels (film.cpp there doubles the width it is given): samples a quarter, three quarters and five
// quarters of a pixel off weigh 0.396, 0.101 and 0.003; the last are left out.
#ifndef LIB_PIXEL_FILTER
#define LIB_PIXEL_FILTER

const float FILTER_NEAR = 0.3984;
const float FILTER_FAR = 0.1016;

#endif
