// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <string>

namespace bounce {

// A new empty folder for intermediate files in $TMPDIR or /tmp, removed with all in it at the end.
//
// A process that is killed cannot remove its own. So the folder is named bounce-PID-XXXXXX and locked (flock)
// for as long as it is in use: by the process that made it, or by one that this process has started, which
// inherits the lock. A folder of that name whose lock is free is nobody's, and
// remove_abandoned_scratch_folders() removes it. It gets the name only once it is locked, so there is no
// moment at which a folder in use looks abandoned.
class ScratchFolder {
  public:
    // Throws output_error where it cannot be made.
    ScratchFolder();
    ~ScratchFolder();
    ScratchFolder(const ScratchFolder&) = delete;
    ScratchFolder& operator=(const ScratchFolder&) = delete;
    ScratchFolder(ScratchFolder&&) = delete;
    ScratchFolder& operator=(ScratchFolder&&) = delete;

    [[nodiscard]] const std::filesystem::path& path() const { return path_; }
    [[nodiscard]] std::filesystem::path operator/(const std::string& name) const { return path_ / name; }

  private:
    std::filesystem::path path_;
    int lock_ = -1;  // the open folder
};

// Removes what killed processes of this user left in $TMPDIR or /tmp; returns how many folders. Those of
// other users, those in use and everything by another name stay. Does not throw: what cannot be removed stays
// as well.
size_t remove_abandoned_scratch_folders();

}  // namespace bounce
