// SPDX-License-Identifier: Apache-2.0
#include <memory>
#include <string>

#include <fmt/format.h>

#include "cli/commands.h"
#include "cli/view_options.h"
#include "core/atomic_file.h"
#include "image/image_io.h"

namespace bounce::cli {
namespace {

struct Arguments {
    std::string image;
    std::string output;
    ViewOptions view;
};

ExitCode convert(const Arguments& arguments) {
    if (is_scene_linear(arguments.output)) {
        throw usage_error(fmt::format(
            "{} would be scene-linear, without a view transform; give a name that ends in .png or .jpg",
            arguments.output));
    }
    const ViewTransform view = arguments.view.checked_over({});
    require_writable(arguments.output);
    write_image(arguments.output, to_display(read_scene_linear(arguments.image), view),
                {{"Software", "bounce"}});
    return ExitCode::done;
}

}  // namespace

void add_convert(CLI::App& app, Run& run) {
    const auto arguments = std::make_shared<Arguments>();
    CLI::App* command = app.add_subcommand(
        "convert", "Show a scene-linear picture through a view transform, as 'render' does for a screen");
    command->add_option("image", arguments->image, "Picture: EXR, or PNG decoded from sRGB")->required();
    command->add_option("-o,--output", arguments->output, "Output file, such as .png")->required();
    arguments->view.add_to(*command);
    command->callback([arguments, &run] { run = [arguments] { return convert(*arguments); }; });
}

}  // namespace bounce::cli
