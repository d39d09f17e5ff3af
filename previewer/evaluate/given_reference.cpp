// SPDX-License-Identifier: Apache-2.0
#include "evaluate/given_reference.h"

#include <algorithm>
#include <cctype>
#include <charconv>
#include <cmath>
#include <limits>
#include <optional>
#include <type_traits>

#include <fmt/format.h>

#include "core/error.h"
#include "core/log.h"
#include "evaluate/cycles_runner.h"

namespace bounce {
namespace fs = std::filesystem;
namespace {

constexpr const char* k_scene = "bounce:scene";
constexpr const char* k_scene_hash = "bounce:scene_hash";
constexpr const char* k_frame = "bounce:frame";
constexpr const char* k_bounces = "bounce:bounces";
constexpr const char* k_light_paths = "bounce:light_paths";
constexpr const char* k_noise_floor = "bounce:noise_floor_relmse";
constexpr const char* k_seconds = "bounce:seconds";
constexpr const char* k_spp = "bounce:spp";

fs::path path_of(const std::string& name, int frame) {
    constexpr std::string_view field = "####";
    const size_t at = name.find(field);
    return at == std::string::npos ? name
                                   : std::string(name).replace(at, field.size(), fmt::format("{:04}", frame));
}

// What a header says, to stand in one line of a sentence.
std::string printable(std::string text) {
    std::replace_if(
        text.begin(), text.end(), [](unsigned char c) { return std::iscntrl(c) != 0; }, ' ');
    return text.substr(0, 200);
}

// A number of the header; nothing where it is not there. Throws input_error where it is no number, or one
// that a time or an error cannot be.
template <typename T>
std::optional<T> number(const ImageAttributes& attributes, const char* name, const fs::path& path) {
    const auto found = attributes.find(name);
    if (found == attributes.end()) {
        return std::nullopt;
    }
    const std::string& text = found->second;
    T value{};
    const auto [end, code] = std::from_chars(text.data(), text.data() + text.size(), value);
    bool usable = code == std::errc{} && end == text.data() + text.size();
    if constexpr (std::is_floating_point_v<T>) {
        usable = usable && std::isfinite(value) && value >= 0.0;  // times and errors
    }
    if (!usable) {
        throw input_error(fmt::format("the reference {} says {} = '{}', which cannot be", path.string(), name,
                                      printable(text)));
    }
    return value;
}

}  // namespace

ImageAttributes reference_attributes(const Reference& reference, const std::string& scene,
                                     const std::string& scene_hash, int bounces) {
    ImageAttributes attributes{{k_scene, scene},
                               {k_scene_hash, scene_hash},
                               {k_frame, std::to_string(reference.frame)},
                               {k_bounces, std::to_string(bounces)},
                               {k_seconds, fmt::format("{}", reference.seconds)}};
    if (std::isfinite(reference.noise_floor)) {
        attributes[k_noise_floor] = fmt::format("{}", reference.noise_floor);
    }
    if (reference.spp > 0) {
        attributes[k_spp] = std::to_string(reference.spp);
    }
    return attributes;
}

ImageAttributes final_attributes(const Reference& reference, const std::string& scene,
                                 const std::string& scene_hash) {
    ImageAttributes attributes = reference_attributes(reference, scene, scene_hash, k_own_light_paths);
    attributes.erase(k_bounces);
    attributes[k_light_paths] = "the scene's own";
    return attributes;
}

Reference load_given_reference(const std::string& name, int frame, int width, int height, int bounces,
                               const std::string& scene_hash) {
    const fs::path path = path_of(name, frame);
    Reference reference;
    reference.frame = frame;
    reference.cached = true;
    reference.image = read_scene_linear(path);
    if (reference.image.width != width || reference.image.height != height) {
        throw input_error(fmt::format("the reference {} is {}x{}, the frames are {}x{}; give --size {}x{}",
                                      path.string(), reference.image.width, reference.image.height, width,
                                      height, reference.image.width, reference.image.height));
    }
    const ImageAttributes header = read_attributes(path);
    if (const auto of = header.find(k_scene_hash); of != header.end() && of->second != scene_hash) {
        const auto scene = header.find(k_scene);
        throw input_error(fmt::format("the reference {} is of another scene or of another state of it: {}",
                                      path.string(),
                                      scene == header.end() ? "unnamed" : printable(scene->second)));
    }
    if (header.contains(k_light_paths)) {
        throw input_error(fmt::format(
            "{} is the final render, by the scene's own light paths, and no reference", path.string()));
    }
    if (const auto of = number<int>(header, k_frame, path); of && *of != frame) {
        throw input_error(
            fmt::format("the reference {} is of frame {}, not of frame {}", path.string(), *of, frame));
    }
    if (const auto of = number<int>(header, k_bounces, path); of && *of != bounces) {
        throw input_error(fmt::format("the reference {} has {} bounces of light; give --bounces {}",
                                      path.string(), *of, *of));
    }
    if (!std::all_of(reference.image.rgb.begin(), reference.image.rgb.end(),
                     [](float value) { return std::isfinite(value); })) {
        throw input_error(fmt::format("the reference {} has values that are not numbers", path.string()));
    }
    if (!header.contains(k_scene_hash) && !header.contains(k_bounces)) {
        log::warning(
            "the reference {} does not say of which scene, frame and bounces it is; it is taken for the "
            "right one",
            path.string());
    }
    reference.noise_floor =
        number<double>(header, k_noise_floor, path).value_or(std::numeric_limits<double>::quiet_NaN());
    reference.seconds = number<double>(header, k_seconds, path).value_or(0.0);
    reference.spp = std::max(number<int>(header, k_spp, path).value_or(0), 0);
    return reference;
}

}  // namespace bounce
