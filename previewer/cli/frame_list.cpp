// SPDX-License-Identifier: Apache-2.0
#include "cli/frame_list.h"

#include <algorithm>
#include <charconv>
#include <optional>
#include <string_view>

#include <fmt/format.h>

#include "core/error.h"

namespace bounce::cli {
namespace {

// A picture's longest side; OpenGL 4.5 promises 16,384.
constexpr int k_largest_size = 16384;
// More frames than this in one command is a typing error.
constexpr int k_most_frames = 1'000'000;

// Takes a number off the front of text, or nothing.
std::optional<int> take_number(std::string_view& text) {
    int value = 0;
    const auto [end, code] = std::from_chars(text.data(), text.data() + text.size(), value);
    if (code != std::errc()) {
        return std::nullopt;
    }
    text.remove_prefix(static_cast<size_t>(end - text.data()));
    return value;
}

bool take(std::string_view& text, char c) {
    if (!text.starts_with(c)) {
        return false;
    }
    text.remove_prefix(1);
    return true;
}

void add_range(std::string_view part, const std::string& text, std::vector<int>& frames) {
    const auto refuse = [&](const char* why) {
        return usage_error(
            fmt::format("cannot read the frames '{}': {}; write 1-48, 1,24 or 1-48x4", text, why));
    };
    const std::optional<int> first = take_number(part);
    if (!first) {
        throw refuse("a number is missing");
    }
    std::optional<int> last = first;
    std::optional<int> step = 1;
    if (take(part, '-')) {
        last = take_number(part);
        if (last && take(part, 'x')) {
            step = take_number(part);
        }
    }
    if (!last || !step || !part.empty()) {
        throw refuse("it is not a list of numbers and ranges");
    }
    if (*last < *first || *step < 1) {
        throw refuse("a range runs backwards");
    }
    if ((*last - *first) / *step >= k_most_frames) {
        throw refuse("that is more than a million frames");
    }
    for (int frame = *first; frame <= *last; frame += *step) {
        frames.push_back(frame);
    }
}

}  // namespace

std::vector<int> parse_frames(const std::string& text) {
    std::vector<int> frames;
    std::string_view rest = text;
    for (;;) {
        const size_t comma = std::min(rest.find(','), rest.size());
        add_range(rest.substr(0, comma), text, frames);
        if (comma == rest.size()) {
            return frames;
        }
        rest.remove_prefix(comma + 1);
    }
}

std::pair<int, int> parse_size(const std::string& text) {
    std::string_view rest = text;
    const std::optional<int> width = take_number(rest);
    const bool cross = take(rest, 'x');
    const std::optional<int> height = take_number(rest);
    if (!width || !cross || !height || !rest.empty() || *width < 1 || *height < 1) {
        throw usage_error(
            fmt::format("cannot read the size '{}'; write WIDTHxHEIGHT, such as 640x360", text));
    }
    if (std::max(*width, *height) > k_largest_size) {
        throw usage_error(
            fmt::format("the size {} is too large; {} pixels a side is the most", text, k_largest_size));
    }
    return {*width, *height};
}

bool has_frame_field(const std::string& pattern) {
    return pattern.find('#') != std::string::npos;
}

std::filesystem::path frame_path(const std::string& pattern, int frame) {
    const size_t first = pattern.find('#');
    if (first == std::string::npos) {
        return pattern;
    }
    const size_t end = std::min(pattern.find_first_not_of('#', first), pattern.size());
    return pattern.substr(0, first) + fmt::format("{:0{}}", frame, end - first) + pattern.substr(end);
}

}  // namespace bounce::cli
