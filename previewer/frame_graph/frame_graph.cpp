// SPDX-License-Identifier: Apache-2.0
#include "frame_graph/frame_graph.h"

#include <algorithm>
#include <stdexcept>

#include <fmt/format.h>

#include "gl/debug_output.h"

namespace bounce {
namespace {

size_t at(int index) {
    return static_cast<size_t>(index);
}

}  // namespace

// ---- building ----

int FrameGraph::add_version(int resource) {
    const int version = dependencies_.add_resource(resources_[at(resource)].name);
    resource_of_version_.push_back(resource);
    content_of_version_.emplace_back();
    resources_[at(resource)].latest_version = version;
    return version;
}

int FrameGraph::declare(int pass, int version) {
    if (version < 0) {
        throw std::logic_error(
            fmt::format("pass {} declares a resource that was never made", passes_[at(pass)].name));
    }
    const int resource = resource_of_version_[at(version)];
    // Passes run in the order they were added, so what an older handle stands for is gone by now.
    if (version != resources_[at(resource)].latest_version) {
        throw std::logic_error(fmt::format("pass {} declares {} as it was before another pass changed it",
                                           passes_[at(pass)].name, resources_[at(resource)].name));
    }
    passes_[at(pass)].resources.push_back(resource);
    return resource;
}

TextureHandle FrameGraph::import_texture(const std::string& name, const gl::Texture& texture) {
    Resource resource;
    resource.name = name;
    resource.desc = texture.desc();
    resource.imported = &texture;
    resources_.push_back(std::move(resource));
    return {add_version(static_cast<int>(resources_.size()) - 1)};
}

BufferHandle FrameGraph::import_buffer(const std::string& name, gl::Buffer& buffer, const FloatWords& words,
                                       const ContentKey& content) {
    Resource resource;
    resource.name = name;
    resource.is_texture = false;
    resource.bytes = buffer.bytes();
    resource.words = words;
    resource.imported_buffer = &buffer;
    resources_.push_back(std::move(resource));
    const int version = add_version(static_cast<int>(resources_.size()) - 1);
    content_of_version_[at(version)] = content;
    return {version};
}

void FrameGraph::keep(TextureHandle handle, gl::Texture& into) {
    resources_[at(resource_of_version_[at(handle.version)])].kept = &into;
}

TextureHandle PassBuilder::create_texture(const std::string& name, const gl::TextureDesc& desc,
                                          const PackedFloats& packed) {
    FrameGraph::Resource resource;
    resource.name = name;
    resource.desc = desc;
    resource.packed = packed;
    graph_.resources_.push_back(std::move(resource));
    const int version = graph_.add_version(static_cast<int>(graph_.resources_.size()) - 1);
    graph_.declare_created(pass_, version);
    graph_.dependencies_.write(pass_, version);
    graph_.passes_[at(pass_)].writes.push_back(version);
    return {version};
}

BufferHandle PassBuilder::create_buffer(const std::string& name, size_t bytes, const FloatWords& words) {
    FrameGraph::Resource resource;
    resource.name = name;
    resource.is_texture = false;
    resource.bytes = bytes;
    resource.words = words;
    graph_.resources_.push_back(std::move(resource));
    const int version = graph_.add_version(static_cast<int>(graph_.resources_.size()) - 1);
    graph_.declare_created(pass_, version);
    graph_.dependencies_.write(pass_, version);
    graph_.passes_[at(pass_)].writes.push_back(version);
    return {version};
}

TextureHandle PassBuilder::read(TextureHandle handle) {
    graph_.declare(pass_, handle.version);
    graph_.dependencies_.read(pass_, handle.version);
    graph_.passes_[at(pass_)].reads.push_back(handle.version);
    return handle;
}

BufferHandle PassBuilder::read(BufferHandle handle) {
    graph_.declare(pass_, handle.version);
    graph_.dependencies_.read(pass_, handle.version);
    graph_.passes_[at(pass_)].reads.push_back(handle.version);
    return handle;
}

void FrameGraph::declare_created(int pass, int version) {
    const int resource = declare(pass, version);
    passes_[at(pass)].written.push_back(resource);
}

// A new version of what `version` stands for.
int FrameGraph::declare_write(int pass, int version) {
    const int resource = declare(pass, version);
    passes_[at(pass)].written.push_back(resource);
    dependencies_.read(pass, version);
    const int next = add_version(resource);
    dependencies_.write(pass, next);
    passes_[at(pass)].reads.push_back(version);
    passes_[at(pass)].writes.push_back(next);
    return next;
}

TextureHandle PassBuilder::write(TextureHandle handle) {
    const int version = graph_.declare_write(pass_, handle.version);
    if (graph_.resources_[at(graph_.resource_of_version_[at(version)])].imported != nullptr) {
        side_effect();
    }
    return {version};
}

BufferHandle PassBuilder::write(BufferHandle handle) {
    return {graph_.declare_write(pass_, handle.version)};
}

BufferHandle PassBuilder::write(BufferHandle handle, const ContentKey& becomes) {
    const BufferHandle out = write(handle);
    graph_.content_of_version_[at(out.version)] = becomes;
    return out;
}

void PassBuilder::decided_by(const ContentKey& key) {
    graph_.passes_[at(pass_)].decided_by = key;
}

void PassBuilder::side_effect() {
    graph_.dependencies_.keep(pass_);
}

// ---- running ----

void FrameGraph::find_lifetimes(const std::vector<bool>& live) {
    for (size_t pass = 0; pass < passes_.size(); ++pass) {
        if (!live[pass]) {
            continue;
        }
        for (const int index : passes_[pass].resources) {
            Resource& resource = resources_[at(index)];
            if (resource.first_use < 0) {
                resource.first_use = static_cast<int>(pass);
            }
            resource.last_use = static_cast<int>(pass);
        }
    }
}

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

void FrameGraph::acquire(Resource& resource, bool zeroed) {
    if (resource.kept_before && resource.is_texture) {
        resource.texture = std::move(kept_->take_texture(resource.key).value());
        return;
    }
    if (resource.kept_before) {
        resource.buffer = std::move(kept_->take_buffer(resource.key).value());
        return;
    }
    if (!resource.is_texture && resource.imported_buffer == nullptr) {
        resource.buffer = pool_.acquire_buffer(resource.name, resource.bytes);
        if (zeroed) {
            resource.buffer.clear_to_zero();
        }
    } else if (resource.is_texture && resource.imported == nullptr) {
        resource.texture = pool_.acquire_texture(resource.name, resource.desc);
        if (zeroed) {
            resource.texture.clear_to_zero();
        }
    }
}

void FrameGraph::show(const Pass& pass, PassObserver& observer) const {
    for (const int index : pass.written) {
        const Resource& resource = resources_[at(index)];
        if (resource.is_texture) {
            observer.wrote(pass.name, resource.name,
                           resource.imported != nullptr ? *resource.imported : resource.texture,
                           resource.packed);
        } else {
            observer.wrote(pass.name, resource.name,
                           resource.imported_buffer != nullptr ? *resource.imported_buffer : resource.buffer,
                           resource.words);
        }
    }
}

void FrameGraph::release(Resource& resource) {
    if (kept_ != nullptr && resource.key.known() && (resource.texture || resource.buffer)) {
        if (resource.kept_before) {
            resource.is_texture ? kept_->put_back(resource.key, std::move(resource.texture))
                                : kept_->put_back(resource.key, std::move(resource.buffer));
            return;
        }
        // What a failed frame left may be half done.
        if (resource.complete && kept_->wants(resource.key)) {
            resource.is_texture ? kept_->add(resource.key, std::move(resource.texture))
                                : kept_->add(resource.key, std::move(resource.buffer));
            return;
        }
    }
    if (resource.texture && resource.kept != nullptr) {
        *resource.kept = std::move(resource.texture);
    } else if (resource.texture) {
        pool_.release(std::move(resource.texture));
    }
    if (resource.buffer) {
        pool_.release(std::move(resource.buffer));
    }
}

namespace {

// Ends a pass's time, and the driver's query, also where the pass throws.
class TimedPass {
  public:
    TimedPass(gl::PassTimer& timer, const std::string& name) : timer_(timer) { timer_.begin(name); }
    ~TimedPass() { timer_.end(); }
    TimedPass(const TimedPass&) = delete;
    TimedPass& operator=(const TimedPass&) = delete;
    TimedPass(TimedPass&&) = delete;
    TimedPass& operator=(TimedPass&&) = delete;

  private:
    gl::PassTimer& timer_;
};

}  // namespace

// Gives everything back to the pool, also where a pass throws: the pool keeps framebuffers over these
// textures, and the names of deleted ones would come back as other textures.
class FrameGraph::ReleaseAtEnd {
  public:
    explicit ReleaseAtEnd(FrameGraph& graph) : graph_(graph) {}
    ~ReleaseAtEnd() {
        for (Resource& resource : graph_.resources_) {
            graph_.release(resource);
        }
    }
    ReleaseAtEnd(const ReleaseAtEnd&) = delete;
    ReleaseAtEnd& operator=(const ReleaseAtEnd&) = delete;
    ReleaseAtEnd(ReleaseAtEnd&&) = delete;
    ReleaseAtEnd& operator=(ReleaseAtEnd&&) = delete;

  private:
    FrameGraph& graph_;
};

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

void FrameGraph::execute(gl::PassTimer& timer, KeptContents* kept, PassObserver* observer) {
    kept_ = kept != nullptr && kept->on() ? kept : nullptr;
    const ReleaseAtEnd release_at_end(*this);
    const std::vector<bool> needed = dependencies_.live_passes();
    std::vector<bool> live = needed;
    if (kept_ != nullptr) {
        kept_->begin_drawing(pool_);
        find_contents(needed);
        live = live_without_kept(needed, *kept_);
    }
    find_lifetimes(live);
    for (size_t pass = 0; pass < passes_.size(); ++pass) {
        const std::string& name = passes_[pass].name;
        if (!live[pass]) {
            (needed[pass] ? unchanged_ : culled_).push_back(name);
            continue;
        }
        for (Resource& resource : resources_) {
            if (resource.first_use == static_cast<int>(pass)) {
                acquire(resource, observer != nullptr);
            }
        }
        if (passes_[pass].condition && !ignore_conditions_ && !passes_[pass].condition()) {
            skipped_.push_back(name);
        } else {
            {
                const gl::DebugGroup group(name);
                const TimedPass timed(timer, name);
                passes_[pass].execute(PassResources(*this, static_cast<int>(pass)));
            }
            gl::throw_on_debug_error(name);
            executed_.push_back(name);
            if (observer != nullptr) {
                show(passes_[pass], *observer);
            }
        }
        for (Resource& resource : resources_) {
            if (resource.last_use == static_cast<int>(pass)) {
                resource.complete = true;
                release(resource);
            }
        }
    }
}

namespace {

[[noreturn]] void refuse_access(const std::string& pass, const std::string& resource) {
    throw std::logic_error(fmt::format("pass {} uses {} without declaring it", pass, resource));
}

bool contains(const std::vector<int>& list, int value) {
    return std::find(list.begin(), list.end(), value) != list.end();
}

}  // namespace

const gl::Texture& PassResources::texture(TextureHandle handle) const {
    const FrameGraph::Pass& pass = graph_.passes_[at(pass_)];
    if (!handle.valid()) {
        refuse_access(pass.name, "an invalid handle");
    }
    const int index = graph_.resource_of_version_[at(handle.version)];
    const FrameGraph::Resource& resource = graph_.resources_[at(index)];
    if (!contains(pass.resources, index)) {
        refuse_access(pass.name, resource.name);
    }
    return resource.imported != nullptr ? *resource.imported : resource.texture;
}

gl::Buffer& PassResources::buffer(BufferHandle handle) const {
    const FrameGraph::Pass& pass = graph_.passes_[at(pass_)];
    if (!handle.valid()) {
        refuse_access(pass.name, "an invalid handle");
    }
    const int index = graph_.resource_of_version_[at(handle.version)];
    if (!contains(pass.resources, index)) {
        refuse_access(pass.name, graph_.resources_[at(index)].name);
    }
    FrameGraph::Resource& resource = graph_.resources_[at(index)];
    return resource.imported_buffer != nullptr ? *resource.imported_buffer : resource.buffer;
}

const gl::Framebuffer& PassResources::framebuffer(std::initializer_list<gl::Attachment> colors,
                                                  gl::Attachment depth) const {
    return graph_.pool_.framebuffer(graph_.passes_[at(pass_)].name, colors, depth);
}

}  // namespace bounce
