// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <set>
#include <vector>

#include "core/content_key.h"
#include "frame_graph/transient_pool.h"

namespace bounce {

// What passes wrote in the frames before and may be read again, known by what it was made of. A frame may be
// drawn several times: each drawing finds the same, what the frame before left, until keep_frame().
class KeptContents {
  public:
    // Where off, nothing is kept, and what was is given back.
    void set_on(bool on, TransientPool& pool);
    [[nodiscard]] bool on() const { return on_; }

    // Before a drawing of a frame: what an earlier drawing of the same frame made goes back to the pool.
    void begin_drawing(TransientPool& pool);
    // What is not one of these, all that the drawing has, goes back to the pool.
    void drop_others(const std::set<ContentKey>& keys, TransientPool& pool);
    // Empty where there is none.
    [[nodiscard]] std::optional<gl::Texture> take_texture(const ContentKey& key);
    [[nodiscard]] std::optional<gl::Buffer> take_buffer(const ContentKey& key);
    // What was taken, when the drawing is done with it.
    void put_back(const ContentKey& key, gl::Texture texture);
    void put_back(const ContentKey& key, gl::Buffer buffer);
    // What the drawing made, for the frame after. Only where wants(key).
    void add(const ContentKey& key, gl::Texture texture);
    void add(const ContentKey& key, gl::Buffer buffer);
    // Whether the next frame may well need it: all of a first frame, and from then on what was in the frame
    // before, so that nothing is held for what changes in each.
    [[nodiscard]] bool wants(const ContentKey& key) const;
    [[nodiscard]] bool has_texture(const ContentKey& key) const;
    [[nodiscard]] bool has_buffer(const ContentKey& key) const;

    // The last drawing stands: the next frame finds what it made and what it used.
    void keep_frame(TransientPool& pool);
    // Gives all back.
    void clear(TransientPool& pool);
    [[nodiscard]] size_t bytes() const;

  private:
    template <typename T>
    struct Entry {
        ContentKey key;
        T content;
        bool used = false;  // by the last drawing
    };
    bool on_ = false;
    bool first_ = true;
    std::set<ContentKey> before_;  // that the frame before had, kept or not
    std::set<ContentKey> now_;
    std::vector<Entry<gl::Texture>> textures_, new_textures_;
    std::vector<Entry<gl::Buffer>> buffers_, new_buffers_;
};

}  // namespace bounce
