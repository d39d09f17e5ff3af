// SPDX-License-Identifier: Apache-2.0
#include "viewer/screenshot.h"

#include <string>

#include <fmt/format.h>

#include "image/image_io.h"

namespace bounce::viewer {

std::filesystem::path save_screenshot(const std::filesystem::path& folder, const std::string& stem, int frame,
                                      const Image& image, const ViewTransform& view) {
    const std::string name = fmt::format("{}.{:04}", stem, frame);
    std::filesystem::path png = folder / (name + ".png");
    std::filesystem::path exr = folder / (name + ".exr");
    for (int copy = 2; std::filesystem::exists(png) || std::filesystem::exists(exr); ++copy) {
        png = folder / fmt::format("{}-{}.png", name, copy);
        exr = folder / fmt::format("{}-{}.exr", name, copy);
    }
    const ImageAttributes attributes = {
        {"Software", "bounce"}, {"bounce:scene", stem}, {"bounce:frame", std::to_string(frame)}};
    write_image(exr, image, attributes);
    write_image(png, to_display(image, view), attributes);
    return png;
}

}  // namespace bounce::viewer
