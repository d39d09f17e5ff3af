// SPDX-License-Identifier: Apache-2.0
#include "evaluate/render_cache.h"

#include <ctime>
#include <system_error>

#include <fmt/chrono.h>
#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "core/atomic_file.h"
#include "core/error.h"
#include "core/json_fault.h"
#include "core/log.h"
#include "evaluate/cache.h"
#include "evaluate/record_file.h"
#include "evaluate/sha256.h"
#include "image/image_io.h"

namespace bounce {
namespace fs = std::filesystem;

namespace {

// Why the entry cannot be used, or nothing.
std::string fault_of(const nlohmann::json& record, const std::string& key, const fs::path& image) {
    if (!record.is_object() || !record.contains("key") || !record.contains("image_sha256")) {
        return "its record is damaged";
    }
    if (record["key"] != key) {
        return "it was made from something else";
    }
    std::error_code ignored;
    if (!fs::is_regular_file(image, ignored) || record["image_sha256"] != sha256_of_file(image)) {
        return "its picture is missing or damaged";
    }
    return {};
}

}  // namespace

fs::path RenderCache::file(const std::string& key, const char* extension) const {
    return folder_ / (sha256_of_text(key).substr(0, 32) + extension);
}

std::optional<CachedRender> RenderCache::load(const std::string& key) const {
    const fs::path record_file = file(key, ".json");
    const fs::path image = file(key, ".exr");
    std::error_code ignored;
    if (!fs::is_regular_file(record_file, ignored)) {
        return std::nullopt;
    }
    const auto record = read_record(record_file);
    try {
        if (const std::string fault = fault_of(record, key, image); !fault.empty()) {
            log::warning("{} is made again: {}", image.string(), fault);
            return std::nullopt;
        }
        if (!files_unchanged(file(key, ".files.json"))) {
            return std::nullopt;  // as after every edit of a texture: nothing to warn of
        }
        CachedRender render;
        render.image = read_image(image);
        if (render.image.width != width_ || render.image.height != height_) {
            log::warning("{} is made again: it is {} x {}, not {} x {}", image.string(), render.image.width,
                         render.image.height, width_, height_);
            return std::nullopt;
        }
        render.seconds = finite_number(record, "seconds");
        render.all_seconds = record.at("all_seconds").get<std::vector<double>>();
        render.setup_seconds = finite_number(record, "setup_seconds");
        render.startup_seconds = finite_number(record, "startup_seconds");
        render.first_render_seconds = finite_number(record, "first_render_seconds");
        render.export_seconds = finite_number(record, "export_seconds");
        render.rss_peak_bytes = static_cast<size_t>(finite_number(record, "rss_peak_bytes"));
        render.date = record.at("date");
        render.notes = record.at("notes").get<std::vector<std::string>>();
        render.engine = record.at("engine");
        render.files = recorded_files(file(key, ".files.json"));
        return render;
    } catch (const Error& error) {
        log::warning("{} is made again: {}", image.string(), error.what());
    } catch (const nlohmann::json::exception& error) {
        log::warning("{} is made again: its record is damaged: {}", image.string(), json_fault(error));
    }
    return std::nullopt;
}

void RenderCache::store(const std::string& key, const CachedRender& render,
                        const std::vector<fs::path>& scene_files) const {
    const fs::path image = file(key, ".exr");
    remove(key);  // no record stands beside another picture
    write_image(image, render.image, {}, ExrValues::full);
    write_file_hashes(file(key, ".files.json"), hash_files(scene_files));
    // Last: an entry counts once its record is there.
    write_text_file(file(key, ".json"), nlohmann::json{{"key", key},
                                                       {"image_sha256", sha256_of_file(image)},
                                                       {"seconds", render.seconds},
                                                       {"all_seconds", render.all_seconds},
                                                       {"setup_seconds", render.setup_seconds},
                                                       {"startup_seconds", render.startup_seconds},
                                                       {"first_render_seconds", render.first_render_seconds},
                                                       {"export_seconds", render.export_seconds},
                                                       {"rss_peak_bytes", render.rss_peak_bytes},
                                                       {"date", render.date},
                                                       {"notes", render.notes},
                                                       {"engine", render.engine}}
                                                .dump(2) +
                                            "\n");
}

void RenderCache::store_or_warn(const std::string& key, const CachedRender& render,
                                const std::vector<fs::path>& scene_files) const {
    try {
        store(key, render, scene_files);
    } catch (const Error& error) {
        remove(key);  // a picture without its record only takes room
        log::warning("a picture is not kept for later runs: {}", error.what());
    }
}

void RenderCache::remove(const std::string& key) const {
    for (const char* extension : {".json", ".files.json", ".exr"}) {
        std::error_code ignored;  // what stays is recognised by its record
        fs::remove(file(key, extension), ignored);
    }
}

std::string utc_now() {
    return fmt::format("{:%Y-%m-%dT%H:%M:%SZ}", fmt::gmtime(std::time(nullptr)));
}

}  // namespace bounce
