// SPDX-License-Identifier: Apache-2.0
//
// The running mean of many pictures of one moment, each with other lights, points and places of its pixels.
#pragma once

#include "passes/pass_context.h"

namespace bounce::passes {

// Means of the pictures so far, RGBA32F: red, green and blue, and the sum of the squared deviations of their
// luminance (Welford 1962, "Note on a Method for Calculating Corrected Sums of Squares and Products").
struct PictureMeans {
    gl::Texture smooth;  // of pictures whose bounced light was blurred
    gl::Texture sharp;   // of the same without the blur
    int count = 0;
};

// Takes one more picture in, `number` counted from 1; the first makes the textures, of the context's size.
// sharp: the same as smooth where nothing was blurred.
void add_accumulate(FrameGraph& graph, const PassContext& context, TextureHandle smooth, TextureHandle sharp,
                    PictureMeans& means);

// The best picture of the means, into `target` (RGBA32F): red, green and blue, and the estimated squared
// error of the mean over its channels, each over what is shown squared + 0.01, so that the mean over pixels
// estimates relMSE.
//
// The blurred mean is quiet but lacks what is finer than the blur; the sharp one is noisy and lacks nothing.
// What they differ by beyond what their noise explains, in the 3 x 3 pixels around, is what the blur took;
// the sharper a pixel must be and the quieter it has become, the more the sharp mean counts (after James and
// Stein 1961, "Estimation with Quadratic Loss"). So the result tends to the sharp mean.
void resolve_means(gl::ProgramCache& programs, const PictureMeans& means, const gl::Texture& target);

}  // namespace bounce::passes
