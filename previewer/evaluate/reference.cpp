// SPDX-License-Identifier: Apache-2.0
#include "evaluate/reference.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <system_error>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "core/atomic_file.h"
#include "core/error.h"
#include "core/json_fault.h"
#include "core/log.h"
#include "evaluate/cache.h"
#include "evaluate/cycles_runner.h"
#include "evaluate/record_file.h"
#include "evaluate/sha256.h"
#include "image/image_io.h"
#include "image/metrics.h"

namespace bounce {
namespace fs = std::filesystem;

namespace {

std::string text_of(const ReferenceKey& key) {
    return fmt::format("{}\nframe {}\n{}x{}\n{} spp\n{}\n{}\n{}\n", key.scene_hash, key.frame, key.width,
                       key.height, key.spp, bounces_text(key.bounces), key.blender, key.scripts_hash);
}

}  // namespace

std::string cache_name(const ReferenceKey& key) {
    return sha256_of_text(text_of(key)).substr(0, 32);
}

Reference make_reference(const Image& half1, const Image& half2, int spp) {
    Reference reference;
    reference.spp = spp;
    reference.batches = 1;
    reference.image = half1;
    for (size_t i = 0; i < half1.rgb.size(); ++i) {
        reference.image.rgb[i] = 0.5F * (half1.rgb[i] + half2.rgb[i]);
    }
    reference.noise_floor = relmse(half1, reference.image);
    return reference;
}

Reference merge(const Reference& a, const Reference& b) {
    const double all = a.spp + b.spp;
    const double part_a = a.spp / all;
    const double part_b = b.spp / all;
    Reference merged = a;
    for (size_t i = 0; i < merged.image.rgb.size(); ++i) {
        merged.image.rgb[i] = static_cast<float>(part_a * a.image.rgb[i] + part_b * b.image.rgb[i]);
    }
    merged.noise_floor = part_a * part_a * a.noise_floor + part_b * part_b * b.noise_floor;
    merged.seconds = a.seconds + b.seconds;
    merged.spp = a.spp + b.spp;
    merged.batches = a.batches + b.batches;
    return merged;
}

std::optional<Reference> load_reference(const fs::path& folder, const ReferenceKey& key) {
    const std::string name = cache_name(key);
    const fs::path record = folder / (name + ".json");
    const fs::path files = folder / (name + ".files.json");
    std::error_code ignored;
    if (!fs::exists(record, ignored)) {
        return std::nullopt;
    }
    if (!files_unchanged(files)) {
        log::warning(
            "a cached reference is rendered again: a file that the scene refers to has changed, or {} is "
            "damaged",
            files.string());
        return std::nullopt;
    }
    try {
        const auto json = read_record(record);
        const fs::path image = folder / json.at("image").get<fs::path>().filename();
        // A foreign picture or record under this name is no reference of ours.
        if (json.at("key") != text_of(key) || json.at("image_sha256") != sha256_of_file(image)) {
            log::warning("a cached reference is rendered again: {} is not what {} tells of", image.string(),
                         record.filename().string());
            return std::nullopt;
        }
        Reference reference;
        reference.frame = key.frame;
        reference.image = read_image(image);
        reference.noise_floor = finite_number(json, "noise_floor_relmse");
        reference.seconds = finite_number(json, "seconds");
        reference.spp = whole_number(json, "spp", 2, std::numeric_limits<int>::max());
        reference.batches = whole_number(json, "batches", 1, reference.spp / 2);
        reference.cached = true;
        if (reference.image.width != key.width || reference.image.height != key.height) {
            log::warning("a cached reference is rendered again: {} is {} x {}, not {} x {}", image.string(),
                         reference.image.width, reference.image.height, key.width, key.height);
            return std::nullopt;
        }
        if (!std::all_of(reference.image.rgb.begin(), reference.image.rgb.end(),
                         [](float value) { return std::isfinite(value); })) {
            log::warning("a cached reference is rendered again: {} has values that are not numbers",
                         image.string());
            return std::nullopt;
        }
        return reference;
    } catch (const Error& error) {
        log::warning("a cached reference is rendered again: {}", error.what());
    } catch (const nlohmann::json::exception& error) {
        log::warning("a cached reference is rendered again: {} is damaged: {}", record.string(),
                     json_fault(error));
    }
    return std::nullopt;
}

void store_reference(const fs::path& folder, const ReferenceKey& key, const Reference& reference,
                     const std::vector<fs::path>& scene_files) {
    const std::string name = cache_name(key);
    const fs::path image = folder / fmt::format("{}-{}.exr", name, reference.spp);
    // Before the record: a reference counts as present once both are there.
    write_file_hashes(folder / (name + ".files.json"), hash_files(scene_files));
    // Full floats: an evaluation that finds the reference gives the figures of the one that rendered it.
    write_image(image, reference.image, {}, ExrValues::full);
    write_text_file(folder / (name + ".json"), nlohmann::json{{"noise_floor_relmse", reference.noise_floor},
                                                              {"seconds", reference.seconds},
                                                              {"key", text_of(key)},
                                                              {"image", image.filename().string()},
                                                              {"image_sha256", sha256_of_file(image)},
                                                              {"frame", key.frame},
                                                              {"spp", reference.spp},
                                                              {"batches", reference.batches},
                                                              {"blender", key.blender}}
                                                       .dump(2) +
                                                   "\n");
    // The record has let go of the image with fewer samples only now: a run that is killed in between keeps
    // one of the two.
    std::error_code ignored;
    std::vector<fs::path> old;
    for (fs::directory_iterator entry(folder, ignored); !ignored && entry != fs::directory_iterator();
         entry.increment(ignored)) {
        const std::string file = entry->path().filename().string();
        if (file.starts_with(name + "-") && entry->path().extension() == ".exr" && entry->path() != image) {
            old.push_back(entry->path());
        }
    }
    for (const fs::path& file : old) {
        fs::remove(file, ignored);
    }
}

}  // namespace bounce
