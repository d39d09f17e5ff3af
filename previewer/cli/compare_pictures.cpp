// SPDX-License-Identifier: Apache-2.0
#include "cli/compare_pictures.h"

#include "cli/frame_list.h"
#include "image/flip.h"
#include "image/heatmap.h"
#include "image/image_io.h"
#include "image/view_transform.h"

namespace bounce::cli {

void write_pictures(const ComparePictures& pictures, const Image& test, const Image& reference, int frame) {
    if (pictures.heatmap.empty() && pictures.difference.empty()) {
        return;
    }
    const Image test_display = to_display(test, {});
    const Image reference_display = to_display(reference, {});
    if (!pictures.heatmap.empty()) {
        write_image(frame_path(pictures.heatmap, frame),
                    magma(pictures.heatmap_of == "flip" ? flip_ldr(test_display, reference_display)
                                                        : relative_error(test, reference)));
    }
    if (!pictures.difference.empty()) {
        write_image(frame_path(pictures.difference, frame),
                    magnified_difference(test_display, reference_display));
    }
}

}  // namespace bounce::cli
