// SPDX-License-Identifier: Apache-2.0
//
// The page of `bounce bench`, which the build puts into the program (evaluate/embed.cmake).
#pragma once

#include <string_view>

namespace bounce::embedded {

[[nodiscard]] std::string_view bench_html();
[[nodiscard]] std::string_view bench_js();

}  // namespace bounce::embedded
