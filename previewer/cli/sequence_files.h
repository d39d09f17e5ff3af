// SPDX-License-Identifier: Apache-2.0
//
// Which files a numbered sequence of images consists of.
#pragma once

#include <string>
#include <vector>

namespace bounce::cli {

// Frame numbers of the files that exist under the pattern, ascending; empty where there are none. The run
// of # must stand in the file's name, not in a folder's: throws usage_error.
[[nodiscard]] std::vector<int> existing_frames(const std::string& pattern);

// What compare takes: the frames asked for (--frames, empty: those that exist), which must all be there in
// test and reference (empty: none), ascending, at one distance, and two or more. Throws usage_error for a
// list that is none of that, input_error for files that are missing or where nothing is common.
[[nodiscard]] std::vector<int> frames_to_compare(const std::string& test, const std::string& reference,
                                                 const std::string& frames);

// Throws input_error, naming the first one, where a frame's file is missing.
void require_frames(const std::string& pattern, const std::vector<int>& frames);

}  // namespace bounce::cli
