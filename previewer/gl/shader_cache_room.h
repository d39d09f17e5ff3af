// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>

namespace bounce::gl {

// Mesa maps the index of its shader cache into memory, and a page of it that a full disk has no room for ends
// the process with SIGBUS. Where the cache's disk is full the driver is told to do without, by
// $MESA_SHADER_CACHE_DISABLE. To be called before the first use of EGL or GLFW, while there is one thread.
void leave_shader_cache_where_disk_is_full();

// Where Mesa keeps its shader cache, or the nearest folder above that is there. Empty where it has none.
[[nodiscard]] std::filesystem::path shader_cache_folder();

}  // namespace bounce::gl
