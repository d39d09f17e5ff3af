// SPDX-License-Identifier: Apache-2.0
#include "core/atomic_file.h"

#include <atomic>
#include <fstream>
#include <system_error>

#include <fmt/format.h>
#include <unistd.h>

#include "core/error.h"

namespace bounce {
namespace fs = std::filesystem;
namespace {

fs::path temporary_name(const fs::path& target) {
    static std::atomic<unsigned> counter{0};
    const std::string stem = fmt::format(".{}.{}-{}.part", target.stem().string(), getpid(), counter++);
    return target.parent_path() / (stem + target.extension().string());
}

}  // namespace

AtomicFile::AtomicFile(fs::path target) : target_(std::move(target)), temporary_(temporary_name(target_)) {
    if (target_.has_parent_path()) {
        create_folder(target_.parent_path());
    }
    std::error_code code;
    if (fs::is_directory(target_, code)) {
        throw output_error(
            fmt::format("cannot write {}: it is a folder; give a file name", target_.string()));
    }
    std::ofstream probe(temporary_, std::ios::binary);
    if (!probe) {
        const std::string folder = target_.has_parent_path() ? target_.parent_path().string() : ".";
        throw output_error(fmt::format("cannot write to the folder {} (for {}); check its permissions",
                                       folder, target_.filename().string()));
    }
}

AtomicFile::~AtomicFile() {
    if (!committed_) {
        std::error_code ignored;  // nothing better can be done while unwinding
        fs::remove(temporary_, ignored);
    }
}

void AtomicFile::commit() {
    std::error_code code;
    fs::rename(temporary_, target_, code);
    if (code) {
        throw output_error(fmt::format("cannot write {}: {}", target_.string(), code.message()));
    }
    committed_ = true;
}

void write_file(const fs::path& path, std::string_view bytes) {
    AtomicFile file(path);
    {
        std::ofstream out(file.temporary_path(), std::ios::binary);
        out.write(bytes.data(), static_cast<std::streamsize>(bytes.size()));
        out.close();
        if (!out) {
            throw output_error(fmt::format("cannot write {}: the disk may be full", path.string()));
        }
    }
    file.commit();
}

void create_folder(const fs::path& folder) {
    std::error_code code;
    fs::create_directories(folder, code);
    if (code) {
        throw output_error(
            fmt::format("cannot create the output folder {}: {}", folder.string(), code.message()));
    }
}

void require_writable(const fs::path& path) {
    const AtomicFile probe(path);
}

}  // namespace bounce
