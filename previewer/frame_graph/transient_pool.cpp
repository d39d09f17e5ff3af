// SPDX-License-Identifier: Apache-2.0
#include "frame_graph/transient_pool.h"

#include <algorithm>
#include <iterator>

namespace bounce {

gl::Texture TransientPool::acquire_texture(const std::string& name, const gl::TextureDesc& desc) {
    const auto found = std::find_if(textures_.begin(), textures_.end(),
                                    [&](const auto& idle) { return idle.resource.desc() == desc; });
    if (found == textures_.end()) {
        return {name, desc};
    }
    gl::Texture texture = std::move(found->resource);
    textures_.erase(found);
    return texture;
}

void TransientPool::hold_idle(bool hold) {
    if (!hold && hold_) {
        clear();
    }
    hold_ = hold;
}

void TransientPool::release(gl::Texture texture) {
    if (!hold_) {
        // Its name comes back as another texture's.
        const auto id = static_cast<int>(texture.id());
        std::erase_if(framebuffers_, [id](const auto& entry) {
            for (size_t i = 0; i < entry.first.size(); i += 2) {  // name and layer of each attachment
                if (entry.first[i] == id) return true;
            }
            return false;
        });
        return;
    }
    textures_.push_back({std::move(texture), frame_});
}

gl::Buffer TransientPool::acquire_buffer(const std::string& name, size_t bytes) {
    const auto found = std::find_if(buffers_.begin(), buffers_.end(),
                                    [&](const auto& idle) { return idle.resource.bytes() == bytes; });
    if (found == buffers_.end()) {
        return {name, bytes, GL_DYNAMIC_STORAGE_BIT};
    }
    gl::Buffer buffer = std::move(found->resource);
    buffers_.erase(found);
    return buffer;
}

void TransientPool::release(gl::Buffer buffer) {
    if (!hold_) {
        return;
    }
    buffers_.push_back({std::move(buffer), frame_});
}

const gl::Framebuffer& TransientPool::framebuffer(const std::string& name,
                                                  std::initializer_list<gl::Attachment> colors,
                                                  gl::Attachment depth) {
    std::vector<int> key;
    const auto add = [&](const gl::Attachment& attachment) {
        key.push_back(attachment.texture != nullptr ? static_cast<int>(attachment.texture->id()) : 0);
        key.push_back(attachment.layer);
    };
    std::for_each(colors.begin(), colors.end(), add);
    add(depth);
    auto found = framebuffers_.find(key);
    if (found == framebuffers_.end()) {
        found = framebuffers_.emplace(std::move(key), gl::Framebuffer(name, colors, depth)).first;
    }
    return found->second;
}

void TransientPool::end_frame() {
    // Long enough to carry a picture that alternates between two settings.
    constexpr int idle_frames = 4;
    ++frame_;
    const auto idle = [&](const auto& entry) { return frame_ - entry.since_frame > idle_frames; };
    std::erase_if(buffers_, idle);
    if (std::erase_if(textures_, idle) > 0) {
        // A new texture may get a dead one's name: framebuffers are known by those.
        framebuffers_.clear();
    }
}

size_t TransientPool::bytes() const {
    size_t sum = 0;
    for (const auto& idle : textures_) sum += idle.resource.bytes();
    for (const auto& idle : buffers_) sum += idle.resource.bytes();
    return sum;
}

void TransientPool::clear() {
    framebuffers_.clear();
    textures_.clear();
    buffers_.clear();
}

}  // namespace bounce
