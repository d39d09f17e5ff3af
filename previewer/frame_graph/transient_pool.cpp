// SPDX-License-Identifier: Apache-2.0
#include "frame_graph/transient_pool.h"

#include <algorithm>
#include <iterator>

namespace bounce {

gl::Texture TransientPool::acquire_texture(const std::string& name, const gl::TextureDesc& desc) {
    const auto found = std::find_if(textures_.begin(), textures_.end(),
                                    [&](const gl::Texture& texture) { return texture.desc() == desc; });
    if (found == textures_.end()) {
        return {name, desc};
    }
    gl::Texture texture = std::move(*found);
    textures_.erase(found);
    return texture;
}

void TransientPool::release(gl::Texture texture) {
    textures_.push_back(std::move(texture));
}

gl::Buffer TransientPool::acquire_buffer(const std::string& name, size_t bytes) {
    const auto found = std::find_if(buffers_.begin(), buffers_.end(),
                                    [&](const gl::Buffer& buffer) { return buffer.bytes() == bytes; });
    if (found == buffers_.end()) {
        return {name, bytes, GL_DYNAMIC_STORAGE_BIT};
    }
    gl::Buffer buffer = std::move(*found);
    buffers_.erase(found);
    return buffer;
}

void TransientPool::release(gl::Buffer buffer) {
    buffers_.push_back(std::move(buffer));
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

void TransientPool::clear() {
    framebuffers_.clear();
    textures_.clear();
    buffers_.clear();
}

}  // namespace bounce
