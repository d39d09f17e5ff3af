// SPDX-License-Identifier: Apache-2.0
//
// What the results of a graph's passes are made of: which of them earlier frames have left, and what memory they
// take.
#include <algorithm>
#include <set>

#include "frame_graph/frame_graph.h"

namespace bounce {
namespace {

size_t at(int index) {
    return static_cast<size_t>(index);
}

}  // namespace

// Of every version that live passes write what decides on it, as far as that is known.
void FrameGraph::find_contents(const std::vector<bool>& live) {
    std::vector<bool> read_between(resources_.size(), false);  // a version that another pass changes later
    for (size_t i = 0; i < passes_.size(); ++i) {
        const Pass& pass = passes_[i];
        if (!live[i]) {
            continue;
        }
        bool known = pass.decided_by.known() && !pass.condition;
        ContentHash hash;
        hash.add_text(pass.name).add(pass.decided_by);
        for (const int version : pass.reads) {
            known = known && content_of_version_[at(version)].known();
            hash.add(content_of_version_[at(version)]);
            const int resource = resource_of_version_[at(version)];
            const bool changes = std::any_of(pass.writes.begin(), pass.writes.end(), [&](int written) {
                return resource_of_version_[at(written)] == resource;
            });
            if (version != resources_[at(resource)].latest_version && !changes) {
                read_between[at(resource)] = true;
            }
        }
        for (size_t w = 0; w < pass.writes.size(); ++w) {
            ContentKey& content = content_of_version_[at(pass.writes[w])];
            if (known && !content.known()) {
                content = ContentHash(hash).add(w).key();
            }
        }
    }
    for (size_t i = 0; i < resources_.size(); ++i) {
        Resource& resource = resources_[i];
        const ContentKey& content = content_of_version_[at(resource.latest_version)];
        const bool own = resource.imported == nullptr && resource.imported_buffer == nullptr;
        if (own && resource.kept == nullptr && content.known() && !read_between[i]) {
            ContentHash hash;
            hash.add(content).add_text(resource.name).add(resource.is_texture).add(resource.bytes);
            hash.add(resource.desc);
            resource.key = hash.key();
        }
    }
}

// The passes that still run where what is kept need not be made again.
std::vector<bool> FrameGraph::live_without_kept(const std::vector<bool>& live, KeptContents& kept) {
    std::set<ContentKey> keys;
    for (Resource& resource : resources_) {
        if (resource.key.known()) {
            resource.kept_before =
                resource.is_texture ? kept.has_texture(resource.key) : kept.has_buffer(resource.key);
            // One is kept of each: of several that are alike the others are made.
            resource.kept_before = keys.insert(resource.key).second && resource.kept_before;
        }
    }
    kept.drop_others(keys, pool_);
    std::vector<bool> out = live;
    for (bool again = true; again;) {
        again = false;
        std::vector<bool> at_hand(resource_of_version_.size());
        for (size_t version = 0; version < at_hand.size(); ++version) {
            at_hand[version] = resources_[at(resource_of_version_[version])].kept_before;
        }
        out = dependencies_.live_passes(at_hand);
        // A pass that runs for another of its results writes this one as well: then it cannot be the old one.
        for (size_t i = 0; i < passes_.size(); ++i) {
            for (const int version : passes_[i].writes) {
                Resource& resource = resources_[at(resource_of_version_[at(version)])];
                again = again || (out[i] && resource.kept_before);
                resource.kept_before = resource.kept_before && !out[i];
            }
        }
    }
    return out;
}

FrameGraph::Forecast FrameGraph::forecast(bool keeps, bool holds) {
    const std::vector<bool> live = dependencies_.live_passes();
    find_contents(live);
    find_lifetimes(live);
    Forecast out;
    std::vector<gl::TextureDesc> idle_textures;
    std::vector<size_t> idle_buffers;
    size_t allocated = 0;
    // Of an equal one that is idle nothing is allocated.
    const auto acquire_from = [&](auto& idle, const auto& what, size_t bytes) {
        const auto found = std::find(idle.begin(), idle.end(), what);
        if (found == idle.end()) {
            allocated += bytes;
            out.peak_bytes = std::max(out.peak_bytes, allocated);
        } else {
            idle.erase(found);
        }
    };
    for (size_t pass = 0; pass < passes_.size(); ++pass) {
        (live[pass] ? out.passes : out.culled).push_back(passes_[pass].name);
        for (const Resource& resource : resources_) {
            if (resource.imported != nullptr || resource.imported_buffer != nullptr) {
                continue;
            }
            const bool first = resource.first_use == static_cast<int>(pass);
            if (first && resource.is_texture) {
                acquire_from(idle_textures, resource.desc, gl::storage_bytes(resource.desc));
            } else if (first) {
                acquire_from(idle_buffers, resource.bytes, resource.bytes);
            }
        }
        for (const Resource& resource : resources_) {
            const bool stays = resource.kept != nullptr || (keeps && resource.key.known());
            if (resource.last_use != static_cast<int>(pass) || stays || resource.imported != nullptr ||
                resource.imported_buffer != nullptr) {
                continue;
            }
            if (!holds) {
                allocated -= resource.is_texture ? gl::storage_bytes(resource.desc) : resource.bytes;
            } else {
                resource.is_texture ? idle_textures.push_back(resource.desc)
                                    : idle_buffers.push_back(resource.bytes);
            }
        }
    }
    return out;
}

}  // namespace bounce
