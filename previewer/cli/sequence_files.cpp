// SPDX-License-Identifier: Apache-2.0
#include "cli/sequence_files.h"

#include <algorithm>
#include <charconv>
#include <filesystem>
#include <iterator>
#include <optional>
#include <string_view>
#include <system_error>

#include <fmt/format.h>

#include "cli/frame_list.h"
#include "core/error.h"
#include "image/sequence_metrics.h"

namespace bounce::cli {
namespace fs = std::filesystem;
namespace {

// The number in a file's name, where it is as long as the pattern pads it to.
std::optional<int> frame_of(const std::string& name, const std::string& pattern) {
    const size_t first = pattern.find('#');
    const size_t tail = pattern.size() - std::min(pattern.find_first_not_of('#', first), pattern.size());
    if (name.size() <= first + tail) {
        return std::nullopt;
    }
    const std::string_view digits = std::string_view(name).substr(first, name.size() - first - tail);
    int frame = 0;
    const auto [end, code] = std::from_chars(digits.data(), digits.data() + digits.size(), frame);
    if (code != std::errc() || end != digits.data() + digits.size() || frame_path(pattern, frame) != name) {
        return std::nullopt;
    }
    return frame;
}

// One distance between neighbours, ascending, at least two.
void require_even(const std::vector<int>& frames, const std::string& given) {
    if (frames.size() < 2) {
        throw usage_error(
            fmt::format("--frames {} is one frame; name its two files without # to compare them", given));
    }
    if (even_step(frames) == 0) {
        throw usage_error(
            fmt::format("--frames {}: a sequence runs forwards at one step, as 1-48 or 1-48x2 do", given));
    }
}

}  // namespace

std::vector<int> existing_frames(const std::string& pattern) {
    const fs::path path(pattern);
    if (has_frame_field(path.parent_path().string())) {
        throw usage_error(fmt::format(
            "{} has # in a folder's name, where frames cannot be looked for; give --frames", pattern));
    }
    const std::string name = path.filename().string();
    std::error_code code;
    std::vector<int> frames;
    const fs::path folder = path.has_parent_path() ? path.parent_path() : fs::path(".");
    for (auto entry = fs::directory_iterator(folder, code); !code && entry != fs::directory_iterator();
         entry.increment(code)) {
        if (const auto frame = frame_of(entry->path().filename().string(), name)) {
            frames.push_back(*frame);
        }
    }
    std::sort(frames.begin(), frames.end());
    return frames;
}

void require_frames(const std::string& pattern, const std::vector<int>& frames) {
    for (const int frame : frames) {
        const fs::path path = frame_path(pattern, frame);
        std::error_code code;
        if (!fs::exists(path, code)) {
            throw input_error(fmt::format("frame {} is missing: there is no file {}", frame, path.string()));
        }
    }
}

std::vector<int> frames_to_compare(const std::string& test, const std::string& reference,
                                   const std::string& frames) {
    if (!frames.empty()) {
        const std::vector<int> asked = parse_frames(frames);
        require_even(asked, frames);
        require_frames(test, asked);
        if (!reference.empty()) {
            require_frames(reference, asked);
        }
        return asked;
    }
    const std::vector<int> found = existing_frames(test);
    if (found.empty()) {
        throw input_error(fmt::format("no file matches {}", test));
    }
    if (!reference.empty()) {
        const std::vector<int> others = existing_frames(reference);
        std::vector<int> common;
        std::set_intersection(found.begin(), found.end(), others.begin(), others.end(),
                              std::back_inserter(common));
        if (others.empty()) {
            throw input_error(fmt::format("no file matches {}", reference));
        }
        if (common.empty()) {
            throw input_error(fmt::format("{} (frames {} to {}) and {} ({} to {}) have no frame in common",
                                          test, found.front(), found.back(), reference, others.front(),
                                          others.back()));
        }
        std::vector<int> single;
        std::set_symmetric_difference(found.begin(), found.end(), others.begin(), others.end(),
                                      std::back_inserter(single));
        if (!single.empty()) {
            const bool in_test = std::binary_search(found.begin(), found.end(), single.front());
            throw input_error(fmt::format("frame {} is missing in {}; --frames compares a part",
                                          single.front(), in_test ? reference : test));
        }
    }
    if (found.size() < 2) {
        throw input_error(
            fmt::format("{} has a single frame, {}; a sequence has two or more", test, found.front()));
    }
    for (size_t i = 1; i < found.size(); ++i) {
        const int expected = found[i - 1] + found[1] - found[0];
        if (found[i] != expected) {
            throw input_error(
                fmt::format("{} has frames {} and {} but not those between at the distance "
                            "of the first two; --frames compares a part",
                            test, found[i - 1], found[i]));
        }
    }
    return found;
}

}  // namespace bounce::cli
