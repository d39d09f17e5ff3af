// SPDX-License-Identifier: Apache-2.0
#include "scene/gltf/environment_image.h"

#include <algorithm>
#include <cmath>
#include <string_view>

#include <OpenImageIO/filesystem.h>
#include <OpenImageIO/imageio.h>

#include "scene/gltf/images.h"
#include "scene/gltf/uri.h"

namespace bounce::scene::gltf {
namespace {

using nlohmann::json;

// A radiance beyond this times a texel's solid angle and a few thousand texels still fits in a float; the
// brightest sun in an image is 1e9 of the sky.
constexpr float k_most_radiance = 1e12F;

// The name under which OpenImageIO picks its reader.
const char* reader_name(std::span<const uint8_t> bytes) {
    const std::string_view start(reinterpret_cast<const char*>(bytes.data()),
                                 std::min<size_t>(bytes.size(), 16));
    if (start.starts_with("\x76\x2f\x31\x01")) {
        return "image.exr";
    }
    if (start.starts_with("#?")) {
        return "image.hdr";
    }
    return nullptr;
}

Environment decode(Source& source, std::span<const uint8_t> bytes, const std::string& whose) {
    const char* name = reader_name(bytes);
    if (name == nullptr) {
        throw refusal("{} is neither OpenEXR nor Radiance HDR", whose);
    }
    OIIO::Filesystem::IOMemReader memory(const_cast<uint8_t*>(bytes.data()), bytes.size());
    OIIO::ImageSpec hints;
    OIIO::Filesystem::IOProxy* proxy = &memory;
    hints.attribute("oiio:ioproxy", OIIO::TypeDesc::PTR, &proxy);
    const auto input = OIIO::ImageInput::open(name, &hints, &memory);
    if (!input) {
        throw refusal("{} cannot be decoded: {}", whose, OIIO::geterror());
    }
    const OIIO::ImageSpec& spec = input->spec();
    const uint64_t pixels = spend_pixels(source, spec.width, spec.height, spec.nchannels, whose);
    Environment out;
    out.width = spec.width;
    out.height = spec.height;
    const auto channels = static_cast<size_t>(std::min(spec.nchannels, 3));
    std::vector<float> values(pixels * channels);
    if (!input->read_image(0, 0, 0, static_cast<int>(channels), OIIO::TypeDesc::FLOAT, values.data())) {
        throw refusal("{} cannot be decoded: {}", whose, input->geterror());
    }
    if (channels == 3) {
        out.rgb = std::move(values);
        return out;
    }
    out.rgb.resize(pixels * 3);  // of one or two channels the first is grey
    for (size_t i = 0; i < pixels; ++i) {
        std::fill_n(&out.rgb[3 * i], 3, values[channels * i]);
    }
    return out;
}

void make_sound(Source& source, Environment& environment, const std::string& whose) {
    size_t not_finite = 0;
    size_t negative = 0;
    for (float& value : environment.rgb) {
        if (!std::isfinite(value)) {
            ++not_finite;
            value = 0.0F;
        } else if (value < 0.0F) {
            ++negative;
            value = 0.0F;
        }
        value = std::min(value, k_most_radiance);
    }
    if (not_finite > 0) {
        source.warn(fmt::format("{} has {} values that are not finite; they count as 0", whose, not_finite));
    }
    if (negative > 0) {
        source.warn(fmt::format("{} has {} negative values; they count as 0", whose, negative));
    }
}

}  // namespace

std::optional<Environment> read_environment(Source& source, Buffers& buffers, const json& description) {
    const std::string name = string_or(description, "name", "");
    const std::string whose = name.empty() ? "the world's image" : fmt::format("the world's image {}", name);
    try {
        Environment environment;
        if (const json* view = member(description, "bufferView")) {
            environment = decode(source, buffers.view(view->get<int>()), whose);
        } else if (const json* uri = member(description, "uri")) {
            const std::vector<uint8_t> bytes =
                read_uri(uri->get_ref<const std::string&>(), source.document.folder, whose);
            environment = decode(source, bytes, whose);
        } else {
            throw refusal("{} has neither a URI nor a buffer view", whose);
        }
        environment.name = name;
        make_sound(source, environment, whose);
        return environment;
    } catch (const Refusal& cause) {
        source.warn(fmt::format("{}; the world's colour is used instead", cause.what()));
        return std::nullopt;
    }
}

}  // namespace bounce::scene::gltf
