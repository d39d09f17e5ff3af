// SPDX-License-Identifier: Apache-2.0
#include "evaluate/cycles_cache.h"

#include <algorithm>
#include <string>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "core/error.h"
#include "core/json_fault.h"
#include "core/log.h"
#include "evaluate/picture_room.h"
#include "image/image_io.h"

namespace bounce {
namespace {

using nlohmann::json;

std::string engine_of(const CyclesReport& report) {
    return json{{"version", report.version},
                {"threads", report.threads},
                {"view",
                 {{"display_device", report.view.display_device},
                  {"view_transform", report.view.view_transform},
                  {"look", report.view.look},
                  {"exposure", report.view.exposure},
                  {"gamma", report.view.gamma}}}}
        .dump();
}

// What a report says of the engine, from one of its pictures. Throws json::exception.
void set_engine(CyclesReport& report, const CachedRender& found) {
    const json engine = json::parse(found.engine);
    report.version = engine.at("version");
    report.threads = engine.at("threads");
    const json& view = engine.at("view");
    report.view = {view.at("display_device"), view.at("view_transform"), view.at("look"), view.at("exposure"),
                   view.at("gamma")};
    report.notes = found.notes;
    report.files = found.files;
    report.startup_seconds = found.startup_seconds;
    report.first_render_seconds = found.first_render_seconds;
}

bool same(const CyclesRender& a, const CyclesRender& b) {
    return a.frame == b.frame && a.spp == b.spp && a.seed == b.seed;
}

}  // namespace

CyclesReport run_cycles_cached(
    const CyclesJob& job, const std::filesystem::path& blender, const RenderCache& cache,
    const CyclesKey& key, bool fresh,
    const std::function<void(const CyclesRender&, const CyclesReport&)>& on_render) {
    CyclesReport kept;
    std::vector<CyclesRender> done;
    CyclesJob missing = job;
    missing.renders.clear();
    for (CyclesRender render : job.renders) {
        const auto found = fresh ? std::nullopt : cache.load(key(render));
        if (found) {
            try {
                set_engine(kept, *found);
                render.seconds = found->seconds;
                render.all_seconds = found->all_seconds;
                render.setup_seconds = found->setup_seconds;
                render.rss_peak_bytes = found->rss_peak_bytes;
                render.measured = found->date;
                write_image(render.output, found->image, {}, ExrValues::full);
                done.push_back(render);
                if (on_render) {
                    on_render(render, kept);
                }
                continue;
            } catch (const json::exception& error) {
                log::warning("a kept picture of Cycles is rendered again: its record is damaged: {}",
                             json_fault(error));
            }
        }
        missing.renders.push_back(render);
    }
    CyclesReport report = kept;
    std::string unreadable;
    if (!missing.renders.empty()) {
        report = run_cycles(missing, blender, [&](const CyclesRender& render, const CyclesReport& so_far) {
            CachedRender item;
            try {
                item.image = read_image(render.output);
            } catch (const Error& error) {
                unreadable = error.what();
                return;
            }
            item.seconds = render.seconds;
            item.all_seconds = render.all_seconds;
            item.setup_seconds = render.setup_seconds;
            item.startup_seconds = so_far.startup_seconds;
            item.first_render_seconds = so_far.first_render_seconds;
            item.rss_peak_bytes = render.rss_peak_bytes;
            item.date = utc_now();
            item.notes = so_far.notes;
            item.engine = engine_of(so_far);
            cache.store_or_warn(key(render), item, so_far.files);
            if (on_render) {
                on_render(render, so_far);
            }
        });
        if (!unreadable.empty()) {
            const auto full =
                no_room_for_picture(job.renders.front().output.parent_path(), job.width, job.height);
            throw full
                ? *full
                : Error(ExitCode::failed, fmt::format("a picture of Cycles is damaged: {}", unreadable));
        }
        done.insert(done.end(), report.renders.begin(), report.renders.end());
    }
    report.renders.clear();
    for (const CyclesRender& wanted : job.renders) {
        report.renders.push_back(*std::find_if(done.begin(), done.end(),
                                               [&](const CyclesRender& item) { return same(item, wanted); }));
    }
    return report;
}

bool cycles_cache_lacks_any(const CyclesJob& job, const RenderCache& cache, const CyclesKey& key,
                            bool fresh) {
    return std::any_of(job.renders.begin(), job.renders.end(), [&](const CyclesRender& render) {
        return fresh || !cache.load(key(render)).has_value();
    });
}

void tell_cycles(Progress& progress, const CyclesRender& render, const std::string& more) {
    const std::string note =
        fmt::format("frame {}, {} spp{}: {:.2f} s", render.frame, render.spp, more, render.seconds);
    if (render.measured.empty()) {
        progress.step(note);
    } else {
        progress.found(note + " (from an earlier run)");
    }
}

}  // namespace bounce
