// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <fstream>
#include <iterator>
#include <string>
#include <string_view>

#include <fmt/format.h>

#include "core/error.h"
#include "evaluate/embedded.h"
#include "evaluate/page.h"
#include "evaluate/report.h"
#include "evaluate/scratch_folder.h"
#include "image/flip.h"
#include "image/heatmap.h"
#include "image/image_io.h"
#include "image/view_transform.h"

namespace bounce {
namespace {

std::string base64(std::string_view bytes) {
    constexpr std::string_view digits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    std::string text;
    text.reserve((bytes.size() + 2) / 3 * 4);
    for (size_t i = 0; i < bytes.size(); i += 3) {
        uint32_t group = 0;
        for (size_t k = 0; k < 3; ++k) {
            group = group << 8U | (i + k < bytes.size() ? static_cast<unsigned char>(bytes[i + k]) : 0U);
        }
        const size_t used = std::min<size_t>(3, bytes.size() - i);
        for (size_t k = 0; k < 4; ++k) {
            text += k <= used ? digits[group >> (18 - 6 * k) & 63U] : '=';
        }
    }
    return text;
}

// The picture as a PNG inside a URI.
std::string data_uri(const Image& display, const ScratchFolder& scratch) {
    const auto path = scratch / "picture.png";
    write_image(path, display);
    std::ifstream in(path, std::ios::binary);
    const std::string bytes{std::istreambuf_iterator<char>(in), std::istreambuf_iterator<char>()};
    if (bytes.empty()) {
        throw output_error(fmt::format("cannot read back {}", path.string()));
    }
    return "data:image/png;base64," + base64(bytes);
}

// Null where there is none.
nlohmann::ordered_json final_uri(const Evaluation& evaluation, int frame, const ScratchFolder& scratch) {
    if (evaluation.final_render) {
        for (const Reference& reference : evaluation.final_render->references) {
            if (reference.frame == frame) {
                return data_uri(to_display(reference.image, evaluation.cycles.view), scratch);
            }
        }
    }
    return nullptr;
}

nlohmann::ordered_json pictures_json(const Evaluation& evaluation) {
    const ScratchFolder scratch;
    const auto shown = shown_points(evaluation);
    nlohmann::ordered_json frames = nlohmann::ordered_json::array();
    for (const Reference& reference : evaluation.references) {
        const Image reference_display = to_display(reference.image, evaluation.cycles.view);
        const Image reference_standard = to_display(reference.image, {});
        nlohmann::ordered_json previews = nlohmann::ordered_json::array();
        for (const auto& [curve, label] : shown) {
            for (const Picture& picture : evaluation.pictures) {
                if (picture.frame == reference.frame && picture.curve == curve && picture.label == label) {
                    const Image display = to_display(picture.image, evaluation.cycles.view);
                    previews.push_back(
                        {{"curve", curve},
                         {"label", label},
                         {"image", data_uri(display, scratch)},
                         {"difference", data_uri(magnified_difference(display, reference_display), scratch)},
                         // After the view transform of the figure, whatever the scene's own is.
                         {"flip", data_uri(magma(flip_ldr(to_display(picture.image, {}), reference_standard)),
                                           scratch)}});
                }
            }
        }
        frames.push_back({{"frame", reference.frame},
                          {"reference", data_uri(reference_display, scratch)},
                          {"final_render", final_uri(evaluation, reference.frame, scratch)},
                          {"previews", previews}});
    }
    return frames;
}

}  // namespace

std::string results_html(const Evaluation& evaluation) {
    std::string page(embedded::report_html());
    put_into_page(page, "/*STYLE*/", embedded::report_css());
    put_into_page(page, "/*CHART_NOTICE*/", embedded::chart_notice_txt());
    // The data last: its text could hold a marker.
    put_into_page(page, "/*CHART_JS*/", embedded::chart_js());
    put_into_page(page, "/*REPORT_JS*/", embedded::report_js());
    put_into_page(page, "/*REPORT_CHART_JS*/", embedded::report_chart_js());
    put_into_page(page, "/*REPORT_VIEWER_JS*/", embedded::report_viewer_js());
    put_into_page(page, "/*REPORT_FRAME_JS*/", embedded::report_frame_js());
    put_into_page(page, "/*REPORT_FRAMES_JS*/", embedded::report_frames_js());
    put_into_page(page, "/*REPORT_SEQUENCE_JS*/", embedded::report_sequence_js());
    put_into_page(page, "/*REPORT_BUDGETS_JS*/", embedded::report_budgets_js());
    put_into_page(page, "/*REPORT_FINAL_JS*/", embedded::report_final_js());
    put_into_page(page, "/*PICTURES*/", json_for_script(pictures_json(evaluation)));
    put_into_page(page, "/*RESULTS*/", json_for_script(results_json(evaluation)));
    return page;
}

}  // namespace bounce
