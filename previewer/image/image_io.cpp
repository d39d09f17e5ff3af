// SPDX-License-Identifier: Apache-2.0
#include "image/image_io.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <cctype>
#include <cmath>
#include <cstdint>
#include <limits>
#include <optional>
#include <string_view>
#include <system_error>

#include <OpenImageIO/filesystem.h>
#include <OpenImageIO/imageio.h>
#include <fmt/format.h>

#include "core/atomic_file.h"
#include "core/error.h"
#include "core/log.h"
#include "image/srgb.h"

namespace bounce {
namespace fs = std::filesystem;
namespace {

// Past this a header is damaged or hostile rather than a picture: 16384 squared, the largest texture.
constexpr int64_t k_max_pixels = int64_t{16384} * 16384;
constexpr float k_largest_half = 65504.0F;

std::string extension_of(const fs::path& path) {
    std::string extension = path.extension().string();
    std::transform(extension.begin(), extension.end(), extension.begin(),
                   [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
    return extension;
}

std::vector<uint8_t> to_bytes(const Image& image) {
    std::vector<uint8_t> bytes(image.rgb.size());
    std::transform(image.rgb.begin(), image.rgb.end(), bytes.begin(), [](float value) {
        // NaN compares false both ways and becomes black: 8 bits have no way to say it.
        const float clamped = value > 0.0F ? std::min(value, 1.0F) : 0.0F;
        return static_cast<uint8_t>(std::lround(clamped * 255.0F));
    });
    return bytes;
}

// Finite values that half cannot hold become the largest half, not infinity; NaN and infinity stay.
std::vector<float> within_half(const Image& image, const fs::path& path) {
    std::vector<float> values = image.rgb;
    size_t clipped = 0;
    for (float& value : values) {
        if (std::isfinite(value) && std::abs(value) > k_largest_half) {
            value = std::copysign(k_largest_half, value);
            ++clipped;
        }
    }
    if (clipped > 0) {
        log::warning("{}: {} values above 65504, the largest half float, were clipped", path.string(),
                     clipped);
    }
    return values;
}

Error cannot_read(const fs::path& path, std::string_view why) {
    return input_error(fmt::format("cannot read the image {}: {}", path.string(), why));
}

// OpenImageIO's messages may hold several lines and end in one.
std::string one_line(std::string text) {
    std::replace(text.begin(), text.end(), '\n', ' ');
    while (!text.empty() && (std::isspace(static_cast<unsigned char>(text.back())) != 0)) {
        text.pop_back();
    }
    return text;
}

struct ChannelLayout {
    std::array<int, 3> rgb{};
    std::optional<int> alpha;
};

// Channels by name, because EXR stores them in alphabetical order and may hold others beside them.
ChannelLayout find_channels(const OIIO::ImageSpec& spec, const fs::path& path) {
    ChannelLayout layout;
    if (spec.alpha_channel >= 0) {
        layout.alpha = spec.alpha_channel;
    }
    const std::array<int, 3> named{spec.channelindex("R"), spec.channelindex("G"), spec.channelindex("B")};
    if (std::all_of(named.begin(), named.end(), [](int index) { return index >= 0; })) {
        layout.rgb = named;
    } else if (spec.nchannels == 1 || (spec.nchannels == 2 && layout.alpha == 1)) {
        layout.rgb = {0, 0, 0};
    } else {
        throw cannot_read(path, fmt::format("it has no channels named R, G and B (its first of {} is {})",
                                            spec.nchannels, spec.channel_name(0)));
    }
    return layout;
}

void check_spec(const OIIO::ImageSpec& spec, const fs::path& path) {
    if (spec.width <= 0 || spec.height <= 0 || spec.nchannels <= 0) {
        throw cannot_read(path, "it has no pixels");
    }
    if (spec.depth > 1 || spec.deep) {
        throw cannot_read(path, "it is a volume or a deep image; save it as a flat RGB image");
    }
    if (int64_t{spec.width} * spec.height > k_max_pixels) {
        throw cannot_read(path,
                          fmt::format("{}x{} pixels are more than 16384x16384", spec.width, spec.height));
    }
    if (spec.width != spec.full_width || spec.height != spec.full_height || spec.x != spec.full_x ||
        spec.y != spec.full_y) {
        throw cannot_read(path, "it covers only a part of its frame; render it without a border");
    }
}

}  // namespace

bool is_scene_linear(const fs::path& path) {
    const std::string extension = extension_of(path);
    constexpr std::array<std::string_view, 5> linear{".exr", ".hdr", ".pfm", ".tif", ".tiff"};
    return std::find(linear.begin(), linear.end(), extension) != linear.end();
}

void write_image(const fs::path& path, const Image& image, const ImageAttributes& attributes,
                 ExrValues values) {
    assert(image.width > 0 && image.height > 0);
    assert(image.rgb.size() == static_cast<size_t>(image.width) * static_cast<size_t>(image.height) * 3U);
    const bool linear = is_scene_linear(path);
    const bool exr = extension_of(path) == ".exr";
    const bool half = exr && values == ExrValues::half;
    const auto stored =
        linear ? (half ? OIIO::TypeDesc::HALF : OIIO::TypeDesc::FLOAT) : OIIO::TypeDesc::UINT8;
    OIIO::ImageSpec spec(image.width, image.height, 3, stored);
    // The curve is in the values already; without this a writer may guess another and record a gamma.
    spec.attribute("oiio:ColorSpace", linear ? "Linear" : "sRGB");
    if (exr) {
        spec.attribute("compression", "zip");
        // Without one OpenImageIO writes the time of day, and the same pixels would make another file.
        spec.attribute("DateTime", "1970:01:01 00:00:00");
    } else if (extension_of(path) == ".jpg" || extension_of(path) == ".jpeg") {
        spec.attribute("Compression", "jpeg:95");
    }
    for (const auto& [key, value] : attributes) {
        spec.attribute(key, value);
    }

    const auto output = OIIO::ImageOutput::create(path.string());
    if (!output) {
        (void)OIIO::geterror();  // else OpenImageIO prints it when the program ends
        throw output_error(
            fmt::format("cannot write {}: \"{}\" is no image format known here; use .exr or .png",
                        path.string(), path.extension().string()));
    }
    const auto encode = [&](const fs::path& name) {
        const bool written =
            output->open(name.string(), spec) &&
            (linear ? output->write_image(OIIO::TypeDesc::FLOAT,
                                          half ? within_half(image, path).data() : image.rgb.data())
                    : output->write_image(OIIO::TypeDesc::UINT8, to_bytes(image).data()));
        if (!written || !output->close()) {
            throw output_error(
                fmt::format("cannot write the image {}: {}", path.string(), one_line(output->geterror())));
        }
    };
    if (output->supports("ioproxy")) {
        // In memory first: on a full disk OpenImageIO's writers leave a part of the file, or an empty one,
        // and say that all went well.
        OIIO::Filesystem::IOVecOutput memory;
        output->set_ioproxy(&memory);
        encode(path);
        const auto& bytes = memory.buffer();
        write_file(path, {reinterpret_cast<const char*>(bytes.data()), bytes.size()});
    } else {  // some rare formats
        AtomicFile file(path);
        encode(file.temporary_path());
        file.commit();
    }
}

Image read_image(const fs::path& path) {
    std::error_code code;
    if (!fs::exists(path, code)) {
        throw cannot_read(path, "there is no such file");
    }
    if (!fs::is_regular_file(path, code)) {
        throw cannot_read(path, "it is not a file");
    }
    OIIO::ImageSpec config;
    config.attribute("oiio:UnassociatedAlpha", 1);  // values as stored, not multiplied by alpha
    const auto input = OIIO::ImageInput::open(path.string(), &config);
    if (!input) {
        throw cannot_read(path, one_line(OIIO::geterror()));
    }
    const OIIO::ImageSpec spec = input->spec();
    check_spec(spec, path);
    const ChannelLayout layout = find_channels(spec, path);

    const auto channels = static_cast<size_t>(spec.nchannels);
    const size_t pixels = static_cast<size_t>(spec.width) * static_cast<size_t>(spec.height);
    std::vector<float> stored(pixels * channels);
    if (!input->read_image(0, 0, 0, spec.nchannels, OIIO::TypeDesc::FLOAT, stored.data())) {
        throw cannot_read(path, one_line(input->geterror()));
    }

    Image image(spec.width, spec.height);
    for (size_t pixel = 0; pixel < pixels; ++pixel) {
        const float* values = &stored[pixel * channels];
        if (layout.alpha && values[*layout.alpha] != 1.0F) {
            throw cannot_read(path,
                              fmt::format("its alpha is {} at pixel ({}, {}); flatten it over a background",
                                          values[*layout.alpha], pixel % static_cast<size_t>(spec.width),
                                          pixel / static_cast<size_t>(spec.width)));
        }
        for (size_t channel = 0; channel < 3; ++channel) {
            image.rgb[pixel * 3 + channel] = values[layout.rgb[channel]];
        }
    }
    return image;
}

ImageAttributes read_attributes(const fs::path& path) {
    const auto input = OIIO::ImageInput::open(path.string());
    if (!input) {
        throw cannot_read(path, one_line(OIIO::geterror()));
    }
    ImageAttributes attributes;
    for (const OIIO::ParamValue& value : input->spec().extra_attribs) {
        if (value.name().string().starts_with("bounce:") && value.type() == OIIO::TypeDesc::STRING) {
            attributes[value.name().string()] = value.get_string();
        }
    }
    return attributes;
}

Image read_scene_linear(const fs::path& path) {
    Image image = read_image(path);
    if (!is_scene_linear(path)) {
        std::transform(image.rgb.begin(), image.rgb.end(), image.rgb.begin(), linear_from_srgb);
    }
    return image;
}

}  // namespace bounce
