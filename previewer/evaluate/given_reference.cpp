// SPDX-License-Identifier: Apache-2.0
#include "evaluate/given_reference.h"

#include <charconv>
#include <string>

#include <fmt/format.h>

#include "core/error.h"

namespace bounce {
namespace fs = std::filesystem;
namespace {

// The header of a reference; what is missing or no number is refused.
class Header {
  public:
    explicit Header(const fs::path& path) : path_(path), attributes_(read_attributes(path)) {}

    [[nodiscard]] Error refused(const std::string& why) const {
        return input_error(fmt::format("the reference {} cannot be used: {}", path_.string(), why));
    }

    [[nodiscard]] std::string text(const std::string& name) const {
        const auto found = attributes_.find("bounce:" + name);
        if (found == attributes_.end()) {
            throw refused(
                fmt::format("it does not say its {}; give one that bounce evaluate wrote, "
                            "frames/reference.####.exr of a report",
                            name));
        }
        return found->second;
    }

    template <typename Number>
    [[nodiscard]] Number number(const std::string& name) const {
        const std::string value = text(name);
        Number result{};
        const auto [end, code] = std::from_chars(value.data(), value.data() + value.size(), result);
        if (code != std::errc() || end != value.data() + value.size()) {
            throw refused(fmt::format("its {} is \"{}\"", name, value));
        }
        return result;
    }

  private:
    const fs::path& path_;
    ImageAttributes attributes_;
};

}  // namespace

ImageAttributes reference_attributes(const Evaluation& evaluation, const Reference& reference) {
    return {{"bounce:scene", evaluation.scene},
            {"bounce:scene_sha256", evaluation.scene_hash},
            {"bounce:frame", std::to_string(reference.frame)},
            {"bounce:bounces", std::to_string(evaluation.bounces)},
            {"bounce:spp", std::to_string(evaluation.reference_spp)},
            {"bounce:seconds", fmt::format("{}", reference.seconds)},
            {"bounce:noise_floor_relmse", fmt::format("{}", reference.noise_floor)}};
}

GivenReference read_given_reference(const fs::path& path, const ReferenceKey& key) {
    GivenReference given;
    given.reference.image = read_image(path);
    const Header header(path);
    if (header.text("scene_sha256") != key.scene_hash) {
        throw header.refused(
            fmt::format("it is of another scene, {}, or of another state of this one", header.text("scene")));
    }
    given.reference.frame = header.number<int>("frame");
    if (given.reference.frame != key.frame) {
        throw header.refused(fmt::format("it is of frame {}, not {}", given.reference.frame, key.frame));
    }
    const Image& image = given.reference.image;
    if (image.width != key.width || image.height != key.height) {
        throw header.refused(fmt::format("it is {} x {}, not {} x {}; give --size {}x{}", image.width,
                                         image.height, key.width, key.height, image.width, image.height));
    }
    if (const int bounces = header.number<int>("bounces"); bounces != key.bounces) {
        throw header.refused(
            fmt::format("its bounces are {}, not {}; give --bounces {}", bounces, key.bounces, bounces));
    }
    given.spp = header.number<int>("spp");
    given.reference.seconds = header.number<double>("seconds");
    given.reference.noise_floor = header.number<double>("noise_floor_relmse");
    given.reference.cached = true;
    return given;
}

}  // namespace bounce
