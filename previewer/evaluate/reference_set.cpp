// SPDX-License-Identifier: Apache-2.0
#include "evaluate/reference_set.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <system_error>

#include <fmt/format.h>

#include "core/error.h"
#include "core/log.h"
#include "core/progress.h"
#include "evaluate/cycles_cache.h"
#include "evaluate/given_reference.h"
#include "image/image_io.h"

namespace bounce {
namespace fs = std::filesystem;

ReferenceSet::ReferenceSet(Source source, fs::path folder, const RenderCache& renders, CyclesKey key)
    : source_(std::move(source)), folder_(std::move(folder)), renders_(renders), key_(std::move(key)) {
    for (const int frame : source_.frames) {
        references_[frame] = source_.given.empty()
                                 ? load_reference(folder_, key_of(frame))
                                 : load_given_reference(source_.given, frame, source_.width, source_.height,
                                                        source_.bounces, source_.scene_hash);
    }
}

ReferenceKey ReferenceSet::key_of(int frame) const {
    return {
        source_.render_hash, frame,           source_.width,           source_.height,
        source_.goal.spp,    source_.bounces, source_.blender_version, cycles_scripts_hash(source_.scene)};
}

bool ReferenceSet::lacks_any() const {
    return std::any_of(references_.begin(), references_.end(), [](const auto& item) { return !item.second; });
}

std::vector<Reference> ReferenceSet::all() const {
    std::vector<Reference> result;
    for (const int frame : source_.frames) {
        result.push_back(at(frame));
    }
    return result;
}

std::vector<ReferenceSet::Batch> ReferenceSet::missing_batches(const SmallestError& smallest_error) const {
    std::vector<Batch> batches;
    for (const int frame : source_.frames) {
        const std::optional<Reference>& found = references_.at(frame);
        const Reference reference = found.value_or(Reference{});
        const int wanted =
            wanted_spp(source_.goal, reference,
                       found ? smallest_error(frame, found->image) : std::numeric_limits<double>::infinity());
        int have = reference.spp;
        int count = reference.batches;
        while (const int spp = next_batch_spp(have, wanted)) {
            batches.push_back({frame, spp, batch_seeds(count)});
            have += spp;
            ++count;
        }
        if (have > reference.spp && reference.spp > 0) {
            log::info("frame {}: the reference's noise floor is {:.2g} at {} samples; {} more follow, {}",
                      frame, reference.noise_floor, reference.spp, have - reference.spp,
                      rough_time(reference.seconds / reference.spp * (have - reference.spp)));
        }
    }
    return batches;
}

std::optional<CyclesReport> ReferenceSet::render(const SmallestError& smallest_error) {
    std::optional<CyclesReport> report;
    if (source_.given.empty()) {
        for (;;) {
            const std::vector<Batch> batches = missing_batches(smallest_error);
            if (batches.empty()) {
                break;
            }
            report = render(batches);
        }
    }
    warn_of_high_floors(smallest_error);
    return report;
}

CyclesReport ReferenceSet::render(const std::vector<Batch>& batches) {
    CyclesJob job;
    job.scene = source_.scene;
    job.width = source_.width;
    job.height = source_.height;
    job.bounces = source_.bounces;
    for (const Batch& batch : batches) {
        for (const int seed : batch.seeds) {
            CyclesRender half;
            half.frame = batch.frame;
            half.spp = batch.spp / 2;
            half.seed = seed;
            half.output = scratch_ / fmt::format("{}_{}.exr", batch.frame, seed);
            job.renders.push_back(half);
        }
    }
    Progress progress("reference", static_cast<int>(job.renders.size()));
    std::vector<CyclesRender> done;
    const auto on_render = [&](const CyclesRender& render, const CyclesReport& so_far) {
        tell_cycles(progress, render, fmt::format(", seed {}", render.seed));
        done.push_back(render);
        for (const Batch& batch : batches) {
            const auto half_of = [&](int seed) {
                return std::find_if(done.begin(), done.end(), [&](const CyclesRender& item) {
                    return item.frame == batch.frame && item.seed == seed;
                });
            };
            const auto half1 = half_of(batch.seeds[0]);
            const auto half2 = half_of(batch.seeds[1]);
            const bool is_last = render.frame == batch.frame &&
                                 (render.seed == batch.seeds[0] || render.seed == batch.seeds[1]);
            if (is_last && half1 != done.end() && half2 != done.end()) {
                add(batch, *half1, *half2, so_far.files);
            }
        }
    };
    // References are never measured anew: their time is told, not compared.
    return run_cycles_cached(job, source_.blender, renders_, key_, false, on_render);
}

void ReferenceSet::add(const Batch& batch, const CyclesRender& half1, const CyclesRender& half2,
                       const std::vector<fs::path>& scene_files) {
    Reference reference = make_reference(read_image(half1.output), read_image(half2.output), batch.spp);
    if (!std::isfinite(reference.noise_floor)) {
        throw input_error(fmt::format("Cycles' reference of frame {} of {} has values that are not numbers",
                                      batch.frame, source_.scene.string()));
    }
    reference.frame = batch.frame;
    reference.seconds = half1.seconds + half2.seconds;
    std::optional<Reference>& known = references_.at(batch.frame);
    known = known ? merge(*known, reference) : std::move(reference);
    known->cached = false;
    try {
        store_reference(folder_, key_of(batch.frame), *known, scene_files);
        // The reference holds them now.
        renders_.remove(key_(half1));
        renders_.remove(key_(half2));
    } catch (const Error& error) {
        if (error.code() != ExitCode::failed) {
            throw;
        }
        log::warning("the reference of frame {} is not kept for later runs: {}", batch.frame, error.what());
    }
    for (const fs::path& half : {half1.output, half2.output}) {
        std::error_code ignored;
        fs::remove(half, ignored);  // a reference of many batches would fill the folder for temporary files
    }
}

void ReferenceSet::warn_of_high_floors(const SmallestError& smallest_error) const {
    for (const int frame : source_.frames) {
        const Reference& reference = at(frame);
        const double smallest = smallest_error(frame, reference.image);
        if (std::isfinite(smallest) && std::isfinite(reference.noise_floor) &&
            !floor_is_low(source_.goal, reference, smallest)) {
            log::warning(
                "frame {}: the reference's noise floor, {:.2g}, is only {:.1f} times below the smallest "
                "relMSE "
                "measured against it, {:.2g}{}",
                frame, reference.noise_floor, smallest / reference.noise_floor, smallest,
                source_.given.empty() ? "; more samples lower it (--reference-spp, --reference-limit)" : "");
        }
    }
}

}  // namespace bounce
