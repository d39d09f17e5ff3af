// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <string_view>

namespace bounce {

// A file that appears under its name only when it is whole: write to temporary_path(), then commit().
// Without commit() (an exception, an interrupt that unwinds) the temporary file is removed and what
// stood under the name before is untouched. The temporary keeps the extension, because image writers
// choose the format by it.
class AtomicFile {
  public:
    // Creates missing parent folders. Throws output_error where the folder cannot be made or written.
    explicit AtomicFile(std::filesystem::path target);
    ~AtomicFile();
    AtomicFile(const AtomicFile&) = delete;
    AtomicFile& operator=(const AtomicFile&) = delete;
    AtomicFile(AtomicFile&&) = delete;
    AtomicFile& operator=(AtomicFile&&) = delete;

    [[nodiscard]] const std::filesystem::path& temporary_path() const { return temporary_; }

    // Renames the temporary over the target. Throws output_error if that fails.
    void commit();

  private:
    std::filesystem::path target_;
    std::filesystem::path temporary_;
    bool committed_ = false;
};

// Writes all of the bytes to path, atomically; a disk that takes only a part of them is an error. Throws
// output_error.
void write_file(const std::filesystem::path& path, std::string_view bytes);
inline void write_text_file(const std::filesystem::path& path, std::string_view text) {
    write_file(path, text);
}

// Makes a folder and those above it that are missing. Throws output_error.
void create_folder(const std::filesystem::path& folder);

// Throws output_error unless a file can be created in path's folder; so that hours of rendering do
// not end at a folder that cannot be written.
void require_writable(const std::filesystem::path& path);

}  // namespace bounce
