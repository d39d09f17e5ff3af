// SPDX-License-Identifier: Apache-2.0
#include "evaluate/scratch_folder.h"

#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <system_error>

#include <fmt/format.h>

#include "core/error.h"

namespace bounce {

ScratchFolder::ScratchFolder() {
    std::error_code code;
    std::string name = (std::filesystem::temp_directory_path(code) / "bounce-XXXXXX").string();
    if (code || mkdtemp(name.data()) == nullptr) {
        throw output_error(
            fmt::format("cannot make a folder for temporary files: {}; set TMPDIR to one that can "
                        "be written",
                        code ? code.message() : std::strerror(errno)));
    }
    path_ = name;
}

ScratchFolder::~ScratchFolder() {
    std::error_code ignored;  // what stays behind lies in the system's folder for such files
    std::filesystem::remove_all(path_, ignored);
}

}  // namespace bounce
