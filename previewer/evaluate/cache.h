// SPDX-License-Identifier: Apache-2.0
//
// Files that are slow to make and follow wholly from their inputs, kept between runs. A file's name is
// the hash of what it was made from, so a changed input never finds an old file.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace bounce {

// $XDG_CACHE_HOME/bounce, or ~/.cache/bounce. Throws output_error where neither variable is set.
[[nodiscard]] std::filesystem::path cache_folder();

// What a result depends on beyond the key it is stored under: files that the scene refers to, known
// only once it has been opened.
using FileHash = std::pair<std::filesystem::path, std::string>;

// Hashes of the files now; one that cannot be read has the hash "missing".
[[nodiscard]] std::vector<FileHash> hash_files(const std::vector<std::filesystem::path>& files);

// A record beside a cached file: {"files": {path: hash}, "seconds": what making it took}. Written atomically.
void write_file_hashes(const std::filesystem::path& record, const std::vector<FileHash>& hashes,
                       double seconds = 0.0);

// The seconds of a record, 0 where it does not tell.
[[nodiscard]] double recorded_seconds(const std::filesystem::path& record);

// True where the record can be read and every file in it still has its hash.
[[nodiscard]] bool files_unchanged(const std::filesystem::path& record);

// The files that the record names; none where it cannot be read.
[[nodiscard]] std::vector<std::filesystem::path> recorded_files(const std::filesystem::path& record);

// Hash of all regular files below a folder (paths and contents), compiled Python left out.
[[nodiscard]] std::string hash_folder(const std::filesystem::path& folder);

}  // namespace bounce
