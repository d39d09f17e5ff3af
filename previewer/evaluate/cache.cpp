// SPDX-License-Identifier: Apache-2.0
#include "evaluate/cache.h"

#include <algorithm>
#include <cstdlib>
#include <system_error>

#include <nlohmann/json.hpp>

#include "core/atomic_file.h"
#include "core/error.h"
#include "evaluate/record_file.h"
#include "evaluate/sha256.h"

namespace bounce {
namespace fs = std::filesystem;

fs::path cache_folder() {
    const char* cache = std::getenv("XDG_CACHE_HOME");
    if (cache != nullptr && *cache != '\0') {
        return fs::path(cache) / "bounce";
    }
    const char* home = std::getenv("HOME");
    if (home != nullptr && *home != '\0') {
        return fs::path(home) / ".cache" / "bounce";
    }
    throw output_error("there is no folder for cached files: set XDG_CACHE_HOME or HOME");
}

std::vector<FileHash> hash_files(const std::vector<fs::path>& files) {
    std::vector<FileHash> hashes;
    hashes.reserve(files.size());
    for (const fs::path& file : files) {
        std::error_code ignored;
        hashes.emplace_back(file, fs::is_regular_file(file, ignored) ? sha256_of_file(file) : "missing");
    }
    return hashes;
}

void write_file_hashes(const fs::path& record, const std::vector<FileHash>& hashes, double seconds) {
    nlohmann::json files = nlohmann::json::object();
    for (const auto& [path, hash] : hashes) {
        files[path.string()] = hash;
    }
    write_text_file(record, nlohmann::json{{"files", files}, {"seconds", seconds}}.dump(2) + "\n");
}

double recorded_seconds(const fs::path& record) {
    const auto json = read_record(record);
    const bool told = json.is_object() && json.contains("seconds") && json["seconds"].is_number();
    return told ? json["seconds"].get<double>() : 0.0;
}

std::vector<fs::path> recorded_files(const fs::path& record) {
    const auto json = read_record(record);
    std::vector<fs::path> files;
    if (json.is_object() && json.contains("files") && json["files"].is_object()) {
        for (const auto& [path, hash] : json["files"].items()) {
            files.emplace_back(path);
        }
    }
    return files;
}

bool files_unchanged(const fs::path& record) {
    const auto json = read_record(record);
    if (!json.is_object() || !json.contains("files") || !json["files"].is_object()) {
        return false;
    }
    std::vector<fs::path> paths;
    for (const auto& [path, hash] : json["files"].items()) {
        paths.emplace_back(path);
    }
    const std::vector<FileHash> now = hash_files(paths);
    return std::all_of(now.begin(), now.end(), [&](const FileHash& file) {
        return json["files"][file.first.string()] == file.second;
    });
}

std::string hash_folder(const fs::path& folder) {
    std::vector<fs::path> files;
    for (const auto& entry : fs::recursive_directory_iterator(folder)) {
        if (entry.is_regular_file() && entry.path().extension() != ".pyc") {
            files.push_back(entry.path());
        }
    }
    std::sort(files.begin(), files.end());
    Sha256 hash;
    for (const fs::path& file : files) {
        hash.add(fs::relative(file, folder).string());
        hash.add(sha256_of_file(file));
    }
    return hash.hex_digest();
}

}  // namespace bounce
