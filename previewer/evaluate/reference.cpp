// SPDX-License-Identifier: Apache-2.0
#include "evaluate/reference.h"

#include <fstream>
#include <system_error>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "core/atomic_file.h"
#include "core/error.h"
#include "core/log.h"
#include "evaluate/cache.h"
#include "evaluate/sha256.h"
#include "image/image_io.h"
#include "image/metrics.h"

namespace bounce {
namespace fs = std::filesystem;

namespace {

std::string text_of(const ReferenceKey& key) {
    return fmt::format("{}\nframe {}\n{}x{}\n{} spp\n{} bounces\n{}\n{}\n", key.scene_hash, key.frame,
                       key.width, key.height, key.spp, key.bounces, key.blender, key.scripts_hash);
}

}  // namespace

std::string cache_name(const ReferenceKey& key) {
    return sha256_of_text(text_of(key)).substr(0, 32);
}

Reference make_reference(const Image& half1, const Image& half2) {
    Reference reference;
    reference.image = half1;
    for (size_t i = 0; i < half1.rgb.size(); ++i) {
        reference.image.rgb[i] = 0.5F * (half1.rgb[i] + half2.rgb[i]);
    }
    reference.noise_floor = relmse(half1, reference.image);
    return reference;
}

std::optional<Reference> load_reference(const fs::path& folder, const ReferenceKey& key) {
    const std::string name = cache_name(key);
    const fs::path image = folder / (name + ".exr");
    const fs::path record = folder / (name + ".json");
    const fs::path files = folder / (name + ".files.json");
    std::error_code ignored;
    if (!fs::is_regular_file(image, ignored) || !files_unchanged(files)) {
        return std::nullopt;
    }
    std::ifstream in(record);
    const auto json = nlohmann::json::parse(in, nullptr, false);
    if (!json.is_object() || !json.contains("noise_floor_relmse") || !json.contains("seconds")) {
        log::warning("a cached reference is rendered again: {} is damaged", record.string());
        return std::nullopt;
    }
    try {
        // A foreign picture or record under this name is no reference of ours.
        if (json.at("key") != text_of(key) || json.at("image_sha256") != sha256_of_file(image)) {
            log::warning("a cached reference is rendered again: {} is not what {} tells of", image.string(),
                         record.filename().string());
            return std::nullopt;
        }
        Reference reference;
        reference.frame = key.frame;
        reference.image = read_image(image);
        reference.noise_floor = json["noise_floor_relmse"];
        reference.seconds = json["seconds"];
        reference.cached = true;
        if (reference.image.width != key.width || reference.image.height != key.height) {
            log::warning("a cached reference is rendered again: {} is {} x {}, not {} x {}", image.string(),
                         reference.image.width, reference.image.height, key.width, key.height);
            return std::nullopt;
        }
        return reference;
    } catch (const Error& error) {
        log::warning("a cached reference is rendered again: {}", error.what());
    } catch (const nlohmann::json::exception& error) {
        log::warning("a cached reference is rendered again: {} is damaged ({})", record.string(),
                     error.what());
    }
    return std::nullopt;
}

void store_reference(const fs::path& folder, const ReferenceKey& key, const Reference& reference,
                     const std::vector<fs::path>& scene_files) {
    const std::string name = cache_name(key);
    // Full floats: an evaluation that finds the reference gives the figures of the one that rendered it.
    write_image(folder / (name + ".exr"), reference.image, {}, ExrValues::full);
    write_text_file(folder / (name + ".json"),
                    nlohmann::json{{"noise_floor_relmse", reference.noise_floor},
                                   {"seconds", reference.seconds},
                                   {"key", text_of(key)},
                                   {"image_sha256", sha256_of_file(folder / (name + ".exr"))},
                                   {"frame", key.frame},
                                   {"spp", key.spp},
                                   {"blender", key.blender}}
                            .dump(2) +
                        "\n");
    // Last: a reference counts as present once its list of files is.
    write_file_hashes(folder / (name + ".files.json"), hash_files(scene_files));
}

}  // namespace bounce
