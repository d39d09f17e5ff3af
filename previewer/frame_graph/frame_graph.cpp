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
    graph_.declare(pass_, version);
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
    graph_.declare(pass_, version);
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

// A new version of what `version` stands for.
int FrameGraph::declare_write(int pass, int version) {
    const int resource = declare(pass, version);
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
    for (const int version : pass.writes) {
        const Resource& resource = resources_[at(resource_of_version_[at(version)])];
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
