// SPDX-License-Identifier: Apache-2.0
#include "frame_graph/kept_contents.h"

#include <algorithm>
#include <utility>

namespace bounce {
namespace {

template <typename Entries, typename Condition>
void release_if(Entries& entries, TransientPool& pool, const Condition& condition) {
    for (auto& entry : entries) {
        if (condition(entry)) {
            pool.release(std::move(entry.content));
        }
    }
    std::erase_if(entries, [](const auto& entry) { return !entry.content; });
}

template <typename Entries>
void release_all(Entries& entries, TransientPool& pool) {
    release_if(entries, pool, [](const auto&) { return true; });
}

template <typename Entries>
auto find(Entries& entries, const ContentKey& key) {
    return std::find_if(entries.begin(), entries.end(), [&](const auto& entry) { return entry.key == key; });
}

template <typename T, typename Entries>
std::optional<T> take(Entries& entries, const ContentKey& key) {
    const auto found = find(entries, key);
    if (found == entries.end()) {
        return std::nullopt;
    }
    std::optional<T> out(std::move(found->content));
    entries.erase(found);
    return out;
}

template <typename Entries>
void append(Entries& to, Entries& from) {
    std::move(from.begin(), from.end(), std::back_inserter(to));
    from.clear();
}

}  // namespace

void KeptContents::set_on(bool on, TransientPool& pool) {
    if (!on) {
        clear(pool);
    }
    on_ = on;
}

void KeptContents::begin_drawing(TransientPool& pool) {
    release_all(new_textures_, pool);
    release_all(new_buffers_, pool);
    for (auto& entry : textures_) entry.used = false;
    for (auto& entry : buffers_) entry.used = false;
}

void KeptContents::drop_others(const std::set<ContentKey>& keys, TransientPool& pool) {
    const auto other = [&](const auto& entry) { return !keys.contains(entry.key); };
    release_if(textures_, pool, other);
    release_if(buffers_, pool, other);
    now_ = keys;
}

std::optional<gl::Texture> KeptContents::take_texture(const ContentKey& key) {
    return take<gl::Texture>(textures_, key);
}

std::optional<gl::Buffer> KeptContents::take_buffer(const ContentKey& key) {
    return take<gl::Buffer>(buffers_, key);
}

void KeptContents::put_back(const ContentKey& key, gl::Texture texture) {
    textures_.push_back({key, std::move(texture), true});
}

void KeptContents::put_back(const ContentKey& key, gl::Buffer buffer) {
    buffers_.push_back({key, std::move(buffer), true});
}

void KeptContents::add(const ContentKey& key, gl::Texture texture) {
    new_textures_.push_back({key, std::move(texture), true});
}

void KeptContents::add(const ContentKey& key, gl::Buffer buffer) {
    new_buffers_.push_back({key, std::move(buffer), true});
}

bool KeptContents::wants(const ContentKey& key) const {
    return on_ && (first_ || before_.contains(key));
}

bool KeptContents::has_texture(const ContentKey& key) const {
    return find(textures_, key) != textures_.end();
}

bool KeptContents::has_buffer(const ContentKey& key) const {
    return find(buffers_, key) != buffers_.end();
}

void KeptContents::keep_frame(TransientPool& pool) {
    if (!on_) {
        return;
    }
    const auto unused = [](const auto& entry) { return !entry.used; };
    release_if(textures_, pool, unused);
    release_if(buffers_, pool, unused);
    append(textures_, new_textures_);
    append(buffers_, new_buffers_);
    before_ = std::exchange(now_, {});
    first_ = false;
}

void KeptContents::clear(TransientPool& pool) {
    for (auto* entries : {&textures_, &new_textures_}) release_all(*entries, pool);
    for (auto* entries : {&buffers_, &new_buffers_}) release_all(*entries, pool);
    before_.clear();
    now_.clear();
    first_ = true;
}

size_t KeptContents::bytes() const {
    size_t sum = 0;
    for (const auto* entries : {&textures_, &new_textures_}) {
        for (const auto& entry : *entries) sum += entry.content.bytes();
    }
    for (const auto* entries : {&buffers_, &new_buffers_}) {
        for (const auto& entry : *entries) sum += entry.content.bytes();
    }
    return sum;
}

}  // namespace bounce
