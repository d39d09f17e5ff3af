// SPDX-License-Identifier: Apache-2.0
#include "evaluate/scratch_folder.h"

#include <algorithm>
#include <cctype>
#include <cerrno>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <string_view>
#include <system_error>
#include <vector>

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include "core/error.h"
#include "core/log.h"

namespace bounce {
namespace fs = std::filesystem;
namespace {

constexpr std::string_view k_prefix = "bounce-";
constexpr std::string_view k_random = "XXXXXX";  // what mkdtemp() replaces

// bounce-PID-XXXXXX, as the constructor below makes them.
bool is_scratch_name(std::string_view name) {
    if (!name.starts_with(k_prefix)) {
        return false;
    }
    name.remove_prefix(k_prefix.size());
    const size_t dash = name.find('-');
    const auto all = [](std::string_view text, auto is) {
        return std::all_of(text.begin(), text.end(),
                           [&](char c) { return is(static_cast<unsigned char>(c)) != 0; });
    };
    return dash != std::string_view::npos && dash > 0 && name.size() == dash + 1 + k_random.size() &&
           all(name.substr(0, dash), [](int c) { return std::isdigit(c); }) &&
           all(name.substr(dash + 1), [](int c) { return std::isalnum(c); });
}

int open_folder(const fs::path& path) {
    return open(path.c_str(), O_RDONLY | O_DIRECTORY | O_NOFOLLOW | O_CLOEXEC);
}

bool lock_now(int folder) {
    return flock(folder, LOCK_EX | LOCK_NB) == 0;
}

// The path still leads to the open folder: nobody has removed it, and perhaps made another, before it was
// locked.
bool is_still(const fs::path& path, const struct stat& open) {
    struct stat named {};
    return lstat(path.c_str(), &named) == 0 && named.st_dev == open.st_dev && named.st_ino == open.st_ino;
}

bool remove_if_abandoned(const fs::path& path) {
    const int folder = open_folder(path);
    if (folder < 0) {
        return false;
    }
    struct stat status {};
    std::error_code code;
    const bool abandoned = fstat(folder, &status) == 0 && status.st_uid == geteuid() && lock_now(folder) &&
                           is_still(path, status);
    if (abandoned) {
        fs::remove_all(path, code);  // does not follow links
    }
    close(folder);
    return abandoned && !code;
}

}  // namespace

ScratchFolder::ScratchFolder() {
    std::error_code code;
    const fs::path parent = fs::temp_directory_path(code);
    std::string name = (parent / fmt::format("{}new-{}", k_prefix, k_random)).string();
    if (code || mkdtemp(name.data()) == nullptr) {
        throw output_error(
            fmt::format("cannot make a folder for temporary files: {}; set TMPDIR to one that can "
                        "be written",
                        code ? code.message() : std::strerror(errno)));
    }
    path_ = name;
    lock_ = open_folder(path_);
    if (lock_ < 0 || !lock_now(lock_)) {
        return;  // a file system without locks: the folder keeps the name that is never taken for abandoned
    }
    // Programs that we start keep the lock, should they outlive us.
    fcntl(lock_, F_SETFD, 0);
    const fs::path locked =
        parent / fmt::format("{}{}-{}", k_prefix, getpid(), name.substr(name.size() - k_random.size()));
    if (renameat2(AT_FDCWD, path_.c_str(), AT_FDCWD, locked.c_str(), RENAME_NOREPLACE) == 0) {
        path_ = locked;
    }
}

ScratchFolder::~ScratchFolder() {
    std::error_code ignored;  // what stays behind lies in the system's folder for such files
    fs::remove_all(path_, ignored);
    if (lock_ >= 0) {
        close(lock_);  // only now: else another process would remove it beside us
    }
}

size_t remove_abandoned_scratch_folders() {
    std::error_code code;
    std::vector<fs::path> candidates;
    fs::directory_iterator entry(fs::temp_directory_path(code), code);
    for (; !code && entry != fs::directory_iterator(); entry.increment(code)) {
        if (is_scratch_name(entry->path().filename().string())) {
            candidates.push_back(entry->path());
        }
    }
    const auto removed = std::count_if(candidates.begin(), candidates.end(), remove_if_abandoned);
    if (removed > 0) {
        log::debug("removed {} folders of temporary files that killed runs had left", removed);
    }
    return static_cast<size_t>(removed);
}

}  // namespace bounce
