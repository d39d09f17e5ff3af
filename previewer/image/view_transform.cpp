// SPDX-License-Identifier: Apache-2.0
#include "image/view_transform.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <limits>
#include <memory>
#include <mutex>
#include <set>
#include <string_view>
#include <system_error>
#include <tuple>
#include <utility>
#include <vector>

#include <OpenColorIO/OpenColorIO.h>
#include <fmt/format.h>
#include <fmt/ranges.h>

#include "core/log.h"
#include "image/display_config.h"
#include "image/srgb.h"

namespace bounce {
namespace {

namespace ocio = OCIO_NAMESPACE;

bool without_look(const ViewTransform& view) {
    return view.look.empty() || view.look == "None";
}

// As Blender guards it: a gamma of 0 would divide by zero.
float gamma_exponent(const ViewTransform& view) {
    return 1.0F / std::max(view.gamma, std::numeric_limits<float>::epsilon());
}

Image standard(const Image& scene_linear, const ViewTransform& view) {
    Image display = scene_linear;
    const float scale = std::exp2(view.exposure);
    const float exponent = gamma_exponent(view);
    for (float& value : display.rgb) {
        value = srgb_from_linear(std::max(value * scale, 0.0F));
        if (exponent != 1.0F) {
            value = std::pow(value, exponent);
        }
    }
    return display;
}

// The order of Blender's own display processor: exposure, look, view and display, gamma.
ocio::ConstCPUProcessorRcPtr make_processor(const ocio::ConstConfigRcPtr& config, const ViewTransform& view) {
    auto group = ocio::GroupTransform::Create();
    std::string input = ocio::ROLE_SCENE_LINEAR;

    auto exposure = ocio::MatrixTransform::Create();
    const double scale = std::exp2(static_cast<double>(view.exposure));
    const double diagonal[16] = {scale, 0, 0, 0, 0, scale, 0, 0, 0, 0, scale, 0, 0, 0, 0, 1};
    exposure->setMatrix(diagonal);
    group->appendTransform(exposure);

    if (!without_look(view)) {
        const char* after = ocio::LookTransform::GetLooksResultColorSpace(config, config->getCurrentContext(),
                                                                          view.look.c_str());
        auto look = ocio::LookTransform::Create();
        look->setSrc(input.c_str());
        look->setDst(after);
        look->setLooks(view.look.c_str());
        group->appendTransform(look);
        input = after;
    }

    auto to_screen = ocio::DisplayViewTransform::Create();
    to_screen->setSrc(input.c_str());
    to_screen->setLooksBypass(true);
    to_screen->setView(view.view_transform.c_str());
    to_screen->setDisplay(view.display_device.c_str());
    group->appendTransform(to_screen);

    if (const double exponent = gamma_exponent(view); exponent != 1.0) {
        auto gamma = ocio::ExponentTransform::Create();
        const double exponents[4] = {exponent, exponent, exponent, 1.0};
        gamma->setValue(exponents);
        group->appendTransform(gamma);
    }
    return config->getProcessor(group)->getDefaultCPUProcessor();
}

void warn_once(const std::string& sentence) {
    static std::mutex mutex;
    static std::set<std::string> told;
    const std::scoped_lock lock(mutex);
    if (told.insert(sentence).second) {
        log::warning("{}", sentence);
    }
}

bool has(const std::vector<std::string>& names, const std::string& name) {
    return std::find(names.begin(), names.end(), name) != names.end();
}

// A name of a view that the configuration does not have.
struct Unknown {
    const char* what = nullptr;  // null where all is there
    std::string ViewTransform::*name = nullptr;
    std::vector<std::string> known;
};

Unknown first_unknown(const DisplayConfig& config, const ViewTransform& view) {
    if (auto names = displays_of(config); !has(names, view.display_device)) {
        return {"display", &ViewTransform::display_device, std::move(names)};
    }
    if (auto names = views_of(config, view.display_device); !has(names, view.view_transform)) {
        return {"view transform", &ViewTransform::view_transform, std::move(names)};
    }
    if (auto names = looks_of(config); !without_look(view) && !has(names, view.look)) {
        return {"look", &ViewTransform::look, std::move(names)};
    }
    return {};
}

std::string sentence(const DisplayConfig& config, const Unknown& unknown, const ViewTransform& view) {
    const std::string names = fmt::format("{}", fmt::join(unknown.known, ", "));
    if (config.ocio) {
        return fmt::format("{} '{}' is not in {}, which has {}", unknown.what, view.*unknown.name,
                           config.path, names);
    }
    return fmt::format(
        "{} '{}' needs a colour configuration of Blender, and {} (set OCIO or BLENDER); without one there is "
        "{}",
        unknown.what, view.*unknown.name,
        config.faults.empty() ? "none was found" : "the one named cannot be read", names);
}

// The view with what the configuration has in the place of what it has not, each told.
ViewTransform known_view(const DisplayConfig& config, const ViewTransform& asked) {
    ViewTransform view = asked;
    for (Unknown unknown = first_unknown(config, view); unknown.what != nullptr;
         unknown = first_unknown(config, view)) {
        const ViewTransform plain{.exposure = asked.exposure, .gamma = asked.gamma};
        if (unknown.known.empty()) {  // a configuration without any display
            warn_once(
                fmt::format("{}nothing; Standard for sRGB is used instead", sentence(config, unknown, view)));
            return plain;
        }
        const std::string used =
            has(unknown.known, plain.*unknown.name) ? plain.*unknown.name : unknown.known.front();
        warn_once(fmt::format("{}; {} is used instead", sentence(config, unknown, view), used));
        view.*unknown.name = used;
    }
    return view;
}

using Key = std::tuple<std::string, std::string, std::string, std::string, float, float>;

// The processor of the last view asked for: an animation asks for the same one every frame, and reading
// the configuration's tables takes longer than a small picture. Null where Standard for sRGB is what there
// is.
ocio::ConstCPUProcessorRcPtr processor_for(const ViewTransform& asked) {
    static std::mutex mutex;
    static Key cached_key;
    static ocio::ConstCPUProcessorRcPtr cached;

    const DisplayConfig config = display_config();
    for (const std::string& fault : config.faults) {
        warn_once(fault);
    }
    const ViewTransform view = known_view(config, asked);
    if (!config.ocio || is_plain_standard(view)) {
        return {};
    }
    const std::scoped_lock lock(mutex);
    Key key{config.path, view.display_device, view.view_transform, view.look, view.exposure, view.gamma};
    if (cached && key == cached_key) {
        return cached;
    }
    try {
        cached = make_processor(config.ocio, view);
        cached_key = std::move(key);
        return cached;
    } catch (const ocio::Exception& exception) {
        // Names are known by now, so it is a table that is missing or broken.
        warn_once(fmt::format("{}: view transform '{}' cannot be made: {}; Standard for sRGB is used instead",
                              config.path, view.view_transform, one_line(exception.what())));
        return {};
    }
}

// Standard needs no configuration, but who names one wants to know that it is not there. OpenColorIO's own
// are no files.
void warn_of_missing_configuration() {
    const char* named = std::getenv("OCIO");
    if (named == nullptr || *named == '\0' || std::string_view(named).find("://") != std::string_view::npos) {
        return;
    }
    std::error_code error;
    if (!std::filesystem::exists(named, error)) {
        warn_once(fmt::format(
            "the colour configuration {} of $OCIO does not exist; Standard for sRGB needs none", named));
    }
}

}  // namespace

bool is_plain_standard(const ViewTransform& view) {
    return view.view_transform == "Standard" && view.display_device == "sRGB" && without_look(view);
}

std::string unknown_name(const ViewTransform& view) {
    if (is_plain_standard(view)) {
        return {};
    }
    const DisplayConfig config = display_config();
    const Unknown unknown = first_unknown(config, view);
    return unknown.what == nullptr ? std::string() : sentence(config, unknown, view);
}

Image to_display(const Image& scene_linear, const ViewTransform& view) {
    Image display;
    if (is_plain_standard(view)) {
        warn_of_missing_configuration();
    }
    const auto processor = is_plain_standard(view) ? nullptr : processor_for(view);
    if (processor) {
        display = scene_linear;
        ocio::PackedImageDesc description(display.rgb.data(), display.width, display.height, 3);
        processor->apply(description);
    } else {
        display = standard(scene_linear, view);
    }
    for (float& value : display.rgb) {
        value = std::clamp(value, 0.0F, 1.0F);
    }
    return display;
}

}  // namespace bounce
