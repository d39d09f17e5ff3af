// SPDX-License-Identifier: Apache-2.0
//
// One frame as a graph of passes. Setup declares what a pass reads and writes; execute draws. Passes that
// nothing reads are dropped; textures and buffers that the graph creates exist from their first to their
// last use and come from a pool.
#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "core/content_key.h"
#include "frame_graph/dependency_graph.h"
#include "frame_graph/kept_contents.h"
#include "frame_graph/transient_pool.h"
#include "gl/pass_timer.h"

namespace bounce {

// One version of a resource. Writing gives a new handle; the old one stays readable only by passes that
// were added before.
template <typename T>
struct Handle {
    int version = -1;
    [[nodiscard]] bool valid() const { return version >= 0; }
};
using TextureHandle = Handle<gl::Texture>;
using BufferHandle = Handle<gl::Buffer>;

class FrameGraph;

// Which 32-bit words of a buffer's elements are floats: word i of an element of `stride` words where bit i is
// set. Without a stride nothing is known of the buffer.
struct FloatWords {
    int stride = 0;
    uint64_t floats = 0;
};
inline constexpr FloatWords k_all_floats{1, 1};

// Which parts of a texel of whole numbers hold floats: channel i where bit i of `floats` is set, and of its
// two 16-bit halves the lower where bit 2 i of `halves` is, the upper where the next is.
struct PackedFloats {
    uint32_t floats = 0;
    uint32_t halves = 0;
    [[nodiscard]] bool any() const { return floats != 0 || halves != 0; }
};

// Looks at what passes leave behind, between them. Textures and buffers of the graph hold zeros before their
// first pass where an observer is there: what no pass has written is then no fault of any.
class PassObserver {
  public:
    virtual ~PassObserver() = default;
    virtual void wrote(const std::string& pass, const std::string& resource, const gl::Texture& texture,
                       const PackedFloats& packed) = 0;
    virtual void wrote(const std::string& pass, const std::string& resource, const gl::Buffer& buffer,
                       const FloatWords& words) = 0;
};

// What an executing pass may touch: exactly what its setup declared.
class PassResources {
  public:
    // Both throw std::logic_error, naming pass and resource, for an undeclared access.
    [[nodiscard]] const gl::Texture& texture(TextureHandle handle) const;
    [[nodiscard]] gl::Buffer& buffer(BufferHandle handle) const;
    const gl::Framebuffer& framebuffer(std::initializer_list<gl::Attachment> colors,
                                       gl::Attachment depth = {}) const;

  private:
    friend class FrameGraph;
    PassResources(FrameGraph& graph, int pass) : graph_(graph), pass_(pass) {}
    FrameGraph& graph_;
    int pass_;
};

using Execute = std::function<void(const PassResources&)>;

// Given to a pass's setup.
class PassBuilder {
  public:
    [[nodiscard]] TextureHandle create_texture(const std::string& name, const gl::TextureDesc& desc,
                                               const PackedFloats& packed = {});
    [[nodiscard]] BufferHandle create_buffer(const std::string& name, size_t bytes,
                                             const FloatWords& words = {});
    TextureHandle read(TextureHandle handle);
    BufferHandle read(BufferHandle handle);
    // Changes what is there (reads and writes); returns the new version.
    [[nodiscard]] TextureHandle write(TextureHandle handle);
    [[nodiscard]] BufferHandle write(BufferHandle handle);
    // The same for a pass whose result is known by this key whatever was there before.
    [[nodiscard]] BufferHandle write(BufferHandle handle, const ContentKey& becomes);
    // The pass runs even where nothing reads its results.
    void side_effect();
    // All that decides on what the pass writes, but what it reads in the graph: where this and that are as in
    // the frame before, what it wrote then serves again (FrameGraph::execute). Without it the pass runs in
    // each frame that needs it.
    void decided_by(const ContentKey& key);

  private:
    friend class FrameGraph;
    PassBuilder(FrameGraph& graph, int pass) : graph_(graph), pass_(pass) {}
    FrameGraph& graph_;
    int pass_;
};

class FrameGraph {
  public:
    explicit FrameGraph(TransientPool& pool) : pool_(pool) {}

    // A texture that outlives the frame. Writing it is a side effect.
    TextureHandle import_texture(const std::string& name, const gl::Texture& texture);
    // A buffer that outlives the frame as a cache: unlike a texture's, writing it keeps no pass alive.
    // words: which of its words are floats. content: what is in it; unknown: passes that read it run in each
    // frame.
    BufferHandle import_buffer(const std::string& name, gl::Buffer& buffer, const FloatWords& words = {},
                               const ContentKey& content = {});

    // setup(PassBuilder&) declares and returns the function that draws.
    template <typename Setup>
    void add_pass(const std::string& name, Setup&& setup) {
        const int pass = dependencies_.add_pass(name);
        Pass& added = passes_.emplace_back();
        added.name = name;
        added.condition = condition_;
        PassBuilder builder(*this, pass);
        passes_.back().execute = setup(builder);
    }

    // The graph's own texture, as its last pass leaves it, goes to `into` instead of back to the pool; stays
    // empty where no pass that runs uses it. `into` must outlive execute().
    void keep(TextureHandle handle, gl::Texture& into);

    // Passes that are added until the next call run only where the condition holds when their turn comes;
    // null: they always run. What a pass that does not run would have written is undefined.
    void set_condition(std::function<bool()> condition) { condition_ = std::move(condition); }

    // Runs the live passes in the order they were added; GL errors are thrown with the pass's name. kept:
    // what earlier frames made, and where this one's goes; null: every live pass runs.
    // observer: told of each texture and buffer that a pass has written, right after it; null: none.
    void execute(gl::PassTimer& timer, KeptContents* kept = nullptr, PassObserver* observer = nullptr);
    // What execute() would do where every condition held, without doing it: the names of the passes that
    // would run, and how much is allocated at once, bytes, in an empty pool. keeps: all that is worth keeping
    // is kept. holds: TransientPool::hold_idle().
    struct Forecast {
        std::vector<std::string> passes, culled;
        size_t peak_bytes = 0;
    };
    [[nodiscard]] Forecast forecast(bool keeps, bool holds);
    // Conditions of passes count as held: everything that may run does.
    void ignore_conditions() { ignore_conditions_ = true; }

    // After execute(): names in order of execution, and of those culled.
    [[nodiscard]] const std::vector<std::string>& executed() const { return executed_; }
    [[nodiscard]] const std::vector<std::string>& culled() const { return culled_; }
    // Live ones whose condition did not hold.
    [[nodiscard]] const std::vector<std::string>& skipped() const { return skipped_; }
    // Those that did not run since all that they would have made is as in the frame before.
    [[nodiscard]] const std::vector<std::string>& unchanged() const { return unchanged_; }
    [[nodiscard]] std::string to_dot() const { return dependencies_.to_dot(); }

  private:
    friend class PassBuilder;
    friend class PassResources;
    class ReleaseAtEnd;

    struct Resource {
        std::string name;
        bool is_texture = true;
        gl::TextureDesc desc;
        size_t bytes = 0;
        FloatWords words;
        PackedFloats packed;
        const gl::Texture* imported = nullptr;
        gl::Buffer* imported_buffer = nullptr;
        gl::Texture texture;
        gl::Texture* kept = nullptr;  // where the texture goes in the end
        gl::Buffer buffer;
        ContentKey key;            // of its last version, with what it is; unknown where it cannot be kept
        bool kept_before = false;  // it is of an earlier frame, and no pass writes it
        bool complete = false;     // all that use it have run
        int latest_version = -1;
        int first_use = -1;
        int last_use = -1;
    };
    struct Pass {
        std::string name;
        Execute execute;
        std::vector<int> resources;  // declared, by resource (not version)
        std::function<bool()> condition;
        std::vector<int> reads, writes;  // versions
        ContentKey decided_by;
    };

    int add_version(int resource);
    int declare(int pass, int version);
    int declare_write(int pass, int version);
    void find_lifetimes(const std::vector<bool>& live);
    void find_contents(const std::vector<bool>& live);
    [[nodiscard]] std::vector<bool> live_without_kept(const std::vector<bool>& live, KeptContents& kept);
    void acquire(Resource& resource, bool zeroed);
    void show(const Pass& pass, PassObserver& observer) const;
    void release(Resource& resource);

    TransientPool& pool_;
    DependencyGraph dependencies_;
    std::vector<Pass> passes_;
    std::vector<Resource> resources_;
    std::vector<int> resource_of_version_;
    std::vector<ContentKey> content_of_version_;
    KeptContents* kept_ = nullptr;  // while it executes
    bool ignore_conditions_ = false;
    std::vector<std::string> unchanged_;
    std::vector<std::string> executed_;
    std::vector<std::string> culled_;
    std::vector<std::string> skipped_;
    std::function<bool()> condition_;
};

}  // namespace bounce
