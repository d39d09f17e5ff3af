// SPDX-License-Identifier: Apache-2.0
#include "image/display_config.h"

#include <filesystem>
#include <mutex>

#include <fmt/format.h>

#include "image/color_config.h"

namespace bounce {
namespace {

namespace ocio = OCIO_NAMESPACE;

DisplayConfig read_first(const std::vector<std::filesystem::path>& candidates) {
    DisplayConfig config;
    for (const std::filesystem::path& path : candidates) {
        try {
            config.ocio = ocio::Config::CreateFromFile(path.string().c_str());
            config.path = path.string();
            break;
        } catch (const ocio::Exception& exception) {
            config.faults.push_back(fmt::format("the colour configuration {} cannot be read: {}",
                                                path.string(), one_line(exception.what())));
        }
    }
    for (std::string& fault : config.faults) {
        fault += config.ocio ? "; " + config.path + " is used instead"
                             : std::string("; without one there is Standard for sRGB alone");
    }
    return config;
}

}  // namespace

std::string one_line(std::string text) {
    for (char& c : text) {
        c = c == '\n' || c == '\r' ? ' ' : c;
    }
    return text;
}

DisplayConfig display_config() {
    static std::mutex mutex;
    static std::vector<std::filesystem::path> read_from;
    static DisplayConfig cached;
    const std::vector<std::filesystem::path> candidates = color_config_candidates();
    const std::scoped_lock lock(mutex);
    if (candidates != read_from) {
        cached = read_first(candidates);
        read_from = candidates;
    }
    return cached;
}

std::vector<std::string> displays_of(const DisplayConfig& config) {
    if (!config.ocio) {
        return {ViewTransform{}.display_device};
    }
    std::vector<std::string> names;
    for (int i = 0; i < config.ocio->getNumDisplays(); ++i) {
        names.emplace_back(config.ocio->getDisplay(i));
    }
    return names;
}

std::vector<std::string> views_of(const DisplayConfig& config, const std::string& display) {
    if (!config.ocio) {
        return {ViewTransform{}.view_transform};
    }
    std::vector<std::string> names;
    for (int i = 0; i < config.ocio->getNumViews(display.c_str()); ++i) {
        names.emplace_back(config.ocio->getView(display.c_str(), i));
    }
    return names;
}

std::vector<std::string> looks_of(const DisplayConfig& config) {
    std::vector<std::string> names{ViewTransform{}.look};
    for (int i = 0; config.ocio && i < config.ocio->getNumLooks(); ++i) {
        names.emplace_back(config.ocio->getLookNameByIndex(i));
    }
    return names;
}

}  // namespace bounce
