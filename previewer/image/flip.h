// SPDX-License-Identifier: Apache-2.0
//
// FLIP: the difference that a viewer notices who flips between two images. 0 is none, 1 the largest.
#pragma once

#include <vector>

#include <glm/vec3.hpp>

#include "image/convolution.h"
#include "image/image.h"

namespace bounce {

// Pixels per degree of visual angle: 0.7 m from a 0.7 m wide screen of 3840 pixels, the papers' default.
constexpr float k_flip_pixels_per_degree = 67.0206432F;

// LDR-FLIP of display-referred sRGB images (0..1), one value a pixel in 0..1.
// Andersson, Nilsson, Akenine-Moeller, Oskarsson, Astroem and Fairchild, 2020, "FLIP: A Difference
// Evaluator for Alternating Images". The images must have the same size.
[[nodiscard]] Plane flip_ldr(const Image& test_display, const Image& reference_display,
                             float pixels_per_degree = k_flip_pixels_per_degree);

// What FLIP sees of one picture, before it compares two: made once for a picture that is compared several
// times. 20 bytes a pixel.
struct PerceivedImage {
    int width = 0;
    int height = 0;
    std::vector<glm::vec3> colors;  // one a pixel, in the space in which differences are taken
    Plane edges, points;            // lengths of the responses
};
[[nodiscard]] PerceivedImage perceived(const Image& display,
                                       float pixels_per_degree = k_flip_pixels_per_degree);
// The same figures as from the pictures themselves.
[[nodiscard]] Plane flip_ldr(const PerceivedImage& test, const PerceivedImage& reference);

// Exposures, in stops, that HDR-FLIP looks at: from the one that brings the reference's brightest pixel
// to 0.85 on the screen to the one that does so for its median.
struct FlipExposures {
    float start = 0.0F;
    float stop = 0.0F;
    int count = 2;
};
[[nodiscard]] FlipExposures flip_exposures(const Image& reference_linear);

// HDR-FLIP of scene-linear images: in each pixel the largest LDR-FLIP over the exposures, tone-mapped by
// ACES. Andersson, Nilsson, Shirley and Akenine-Moeller, 2021, "Visualizing Errors in Rendered High
// Dynamic Range Images". The images must have the same size.
[[nodiscard]] Plane flip_hdr(const Image& test_linear, const Image& reference_linear,
                             float pixels_per_degree = k_flip_pixels_per_degree);

// A reference of HDR-FLIP for many pictures, which then take half the time: 20 bytes a pixel and exposure.
class HdrFlipReference {
  public:
    explicit HdrFlipReference(const Image& reference_linear,
                              float pixels_per_degree = k_flip_pixels_per_degree);
    // flip_hdr() of the picture, which must have the reference's size.
    [[nodiscard]] Plane error_of(const Image& test_linear) const;

  private:
    FlipExposures exposures_;
    float pixels_per_degree_;
    std::vector<PerceivedImage> perceived_;  // one an exposure
};

// Mean of the values; NaN for an empty plane.
[[nodiscard]] double mean(const Plane& plane);

}  // namespace bounce
