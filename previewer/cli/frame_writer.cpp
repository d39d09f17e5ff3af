// SPDX-License-Identifier: Apache-2.0
#include "cli/frame_writer.h"

#include <string>

#include "image/image_io.h"
#include "image/view_transform.h"

namespace bounce::cli {

void FrameWriter::write(const std::filesystem::path& path, const Image& image,
                        const scene::ViewSettings& view, int frame) const {
    const ImageAttributes attributes = {
        {"Software", "bounce"}, {"bounce:scene", scene_.name}, {"bounce:frame", std::to_string(frame)}};
    // Debug layers are data to look at, not light: they go out without the scene's look.
    if (is_scene_linear(path)) {
        write_image(path, image, attributes,
                    settings_.show == Show::motion ? ExrValues::full : ExrValues::half);
    } else if (shows_light(settings_.show)) {
        write_image(path,
                    to_display(image, view_.over({view.display_device, view.view_transform, view.look,
                                                  view.exposure, view.gamma})),
                    attributes);
    } else {
        write_image(path, to_display(image, {}), attributes);
    }
}

}  // namespace bounce::cli
