// SPDX-License-Identifier: Apache-2.0
#include "image/view_transform.h"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <limits>
#include <memory>
#include <mutex>
#include <tuple>
#include <utility>

#include <OpenColorIO/OpenColorIO.h>

#include "core/log.h"
#include "image/color_config.h"
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

void warn_once(const std::string& why, const ViewTransform& view) {
    static std::atomic<bool> warned{false};
    if (!warned.exchange(true)) {
        log::warning("view transform {} (look {}, display {}) is shown as Standard: {}", view.view_transform,
                     view.look, view.display_device, why);
    }
}

using Key = std::tuple<std::string, std::string, std::string, std::string, float, float>;

// The processor of the last view asked for: an animation asks for the same one every frame, and reading
// the configuration's tables takes longer than a small picture. Null where there is none.
ocio::ConstCPUProcessorRcPtr processor_for(const ViewTransform& view) {
    static std::mutex mutex;
    static Key cached_key;
    static ocio::ConstCPUProcessorRcPtr cached;

    const auto config_path = find_color_config();
    if (!config_path) {
        warn_once("no OpenColorIO configuration of Blender was found (set OCIO or BLENDER)", view);
        return {};
    }
    const std::scoped_lock lock(mutex);
    Key key{config_path->string(), view.display_device, view.view_transform, view.look,
            view.exposure,         view.gamma};
    if (cached && key == cached_key) {
        return cached;
    }
    try {
        cached = make_processor(ocio::Config::CreateFromFile(config_path->string().c_str()), view);
        cached_key = std::move(key);
        return cached;
    } catch (const ocio::Exception& exception) {
        warn_once(exception.what(), view);
        return {};
    }
}

}  // namespace

bool is_plain_standard(const ViewTransform& view) {
    return view.view_transform == "Standard" && view.display_device == "sRGB" && without_look(view);
}

Image to_display(const Image& scene_linear, const ViewTransform& view) {
    Image display;
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
