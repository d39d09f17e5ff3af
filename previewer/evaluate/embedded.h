// SPDX-License-Identifier: Apache-2.0
//
// Files that the build puts into the program, so that it needs none beside it (embed.cmake).
#pragma once

#include <string_view>

namespace bounce::embedded {

[[nodiscard]] std::string_view blender_job_py();
[[nodiscard]] std::string_view cycles_render_py();
[[nodiscard]] std::string_view cycles_import_gltf_py();
[[nodiscard]] std::string_view eevee_render_py();
[[nodiscard]] std::string_view f3d_export_py();
[[nodiscard]] std::string_view report_html();
[[nodiscard]] std::string_view report_final_js();
[[nodiscard]] std::string_view report_js();
[[nodiscard]] std::string_view report_budgets_js();
[[nodiscard]] std::string_view report_chart_js();
[[nodiscard]] std::string_view report_frame_js();
[[nodiscard]] std::string_view report_frames_js();
[[nodiscard]] std::string_view report_sequence_js();
[[nodiscard]] std::string_view report_viewer_js();
[[nodiscard]] std::string_view report_css();
[[nodiscard]] std::string_view chart_notice_txt();
[[nodiscard]] std::string_view chart_js();  // Chart.js 3, minified

}  // namespace bounce::embedded
