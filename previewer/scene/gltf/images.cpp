// SPDX-License-Identifier: Apache-2.0
#include "scene/gltf/images.h"

#include <algorithm>
#include <string_view>

#include <OpenImageIO/filesystem.h>
#include <OpenImageIO/imageio.h>

#include "scene/gltf/png_check.h"
#include "scene/gltf/uri.h"

namespace bounce::scene::gltf {
namespace {

constexpr const char* k_png = "image.png";

// The name under which OpenImageIO picks its reader, by the file's first bytes: the extension and the
// MIME type are often wrong. Only the formats that glTF allows: the fewer decoders a file can reach, the
// better.
const char* reader_name(std::span<const uint8_t> bytes) {
    const std::string_view start(reinterpret_cast<const char*>(bytes.data()),
                                 std::min<size_t>(bytes.size(), 16));
    if (start.starts_with("\x89PNG\r\n\x1a\n")) {
        return k_png;
    }
    if (start.starts_with("\xff\xd8\xff")) {
        return "image.jpg";
    }
    if (start.size() >= 12 && start.starts_with("RIFF") && start.substr(8, 4) == "WEBP") {
        return "image.webp";
    }
    return nullptr;
}

// Grey, grey with alpha and RGB become RGBA.
template <typename T>
std::vector<T> expanded(const std::vector<T>& pixels, size_t count, size_t channels) {
    if (channels == 4) {
        return pixels;
    }
    std::vector<T> rgba(count * 4);
    const bool grey = channels < 3;
    for (size_t i = 0; i < count; ++i) {
        const T* in = &pixels[i * channels];
        T* out = &rgba[i * 4];
        out[0] = in[0];
        out[1] = grey ? in[0] : in[1];
        out[2] = grey ? in[0] : in[2];
        out[3] = channels == 2 ? in[1] : std::numeric_limits<T>::max();
    }
    return rgba;
}

template <typename T>
std::vector<T> read_pixels(OIIO::ImageInput& input, OIIO::TypeDesc type, const std::string& whose) {
    const OIIO::ImageSpec& spec = input.spec();
    const size_t count = static_cast<size_t>(spec.width) * static_cast<size_t>(spec.height);
    const int channels = std::min(spec.nchannels, 4);
    std::vector<T> pixels(count * static_cast<size_t>(channels));
    if (!input.read_image(0, 0, 0, channels, type, pixels.data())) {
        throw refusal("{} cannot be decoded: {}", whose, input.geterror());
    }
    return expanded(pixels, count, static_cast<size_t>(channels));
}

Image decode(Source& source, std::span<const uint8_t> bytes, const std::string& whose) {
    const char* name = reader_name(bytes);
    if (name == nullptr) {
        throw refusal("{} is not a PNG, JPEG or WebP image", whose);
    }
    if (name == k_png && !is_whole_png(bytes)) {
        throw refusal("{} cannot be decoded: the PNG data is damaged or cut short", whose);
    }
    OIIO::Filesystem::IOMemReader memory(const_cast<uint8_t*>(bytes.data()), bytes.size());
    OIIO::ImageSpec hints;
    // glTF's alpha is not multiplied into the colour.
    hints.attribute("oiio:UnassociatedAlpha", 1);
    // Some of its readers take the memory from the hints alone, some from the argument.
    OIIO::Filesystem::IOProxy* proxy = &memory;
    hints.attribute("oiio:ioproxy", OIIO::TypeDesc::PTR, &proxy);
    const auto input = OIIO::ImageInput::open(name, &hints, &memory);
    if (!input) {
        throw refusal("{} cannot be decoded: {}", whose, OIIO::geterror());
    }
    const OIIO::ImageSpec& spec = input->spec();
    (void)spend_pixels(source, spec.width, spec.height, spec.nchannels, whose);
    Image image;
    image.width = spec.width;
    image.height = spec.height;
    if (spec.format.basesize() > 1) {
        image.rgba16 = read_pixels<uint16_t>(*input, OIIO::TypeDesc::UINT16, whose);
    } else {
        image.rgba8 = read_pixels<uint8_t>(*input, OIIO::TypeDesc::UINT8, whose);
    }
    return image;
}

bool is_opaque(const Image& image) {
    const auto full = [](const auto& channels, auto one) {
        for (size_t i = 3; i < channels.size(); i += 4) {
            if (channels[i] != one) {
                return false;
            }
        }
        return true;
    };
    return full(image.rgba8, uint8_t{255}) && full(image.rgba16, uint16_t{65535});
}

}  // namespace

uint64_t spend_pixels(Source& source, int width, int height, int channels, const std::string& whose) {
    if (width <= 0 || height <= 0 || channels <= 0 || width > k_max_image_side || height > k_max_image_side) {
        throw refusal("{} is {} by {} pixels; at most {} a side are allowed", whose, width, height,
                      k_max_image_side);
    }
    const uint64_t pixels = static_cast<uint64_t>(width) * static_cast<uint64_t>(height);
    if (pixels > k_max_image_pixels) {
        throw refusal("{} has {} pixels, more than the {} allowed", whose, pixels, k_max_image_pixels);
    }
    Source::spend(source.spent.image_pixels, pixels, k_max_total_image_pixels, "pixels in all its images");
    return pixels;
}

Image read_image(Source& source, Buffers& buffers, int index) {
    const nlohmann::json& description = source.json()["images"][static_cast<size_t>(index)];
    const std::string name = string_or(description, "name", "");
    const std::string whose =
        name.empty() ? fmt::format("image {}", index) : fmt::format("image {} ({})", index, name);
    Image image;
    if (const nlohmann::json* view = member(description, "bufferView")) {
        image = decode(source, buffers.view(view->get<int>()), whose);
    } else if (const nlohmann::json* uri = member(description, "uri")) {
        const std::vector<uint8_t> bytes =
            read_uri(uri->get_ref<const std::string&>(), source.document.folder, whose);
        image = decode(source, bytes, whose);
    } else {
        throw refusal("{} has neither a URI nor a buffer view", whose);
    }
    image.name = name;
    image.opaque = is_opaque(image);
    return image;
}

}  // namespace bounce::scene::gltf
