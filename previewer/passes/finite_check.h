// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "frame_graph/frame_graph.h"
#include "gl/buffer.h"
#include "gl/program.h"

namespace bounce::passes {

// Searches what passes write for NaN and infinities, on the GPU, pass by pass; what was found is read back
// once. Textures of whole numbers and buffers are searched where they say that they hold floats.
class FiniteCheck : public PassObserver {
  public:
    // width, height: of the picture, whose pixels are counted from its top left.
    FiniteCheck(gl::ProgramCache& programs, int width, int height);

    void wrote(const std::string& pass, const std::string& resource, const gl::Texture& texture,
               const PackedFloats& packed) override;
    void wrote(const std::string& pass, const std::string& resource, const gl::Buffer& buffer,
               const FloatWords& words) override;

    // What the first pass that left something not finite did, in words: pass, what it wrote, where first, how
    // many; empty where all is finite. Waits for the GPU.
    [[nodiscard]] std::string fault();

  private:
    struct Looked {
        std::string pass;
        std::string resource;
        // Of a texture's level; a buffer has no width.
        int width = 0;
        int height = 0;
        int level = 0;
        bool layered = false;
    };
    GLuint next_slot(Looked looked);
    void collect();
    [[nodiscard]] std::string place(const Looked& looked, uint32_t first) const;

    gl::ProgramCache& programs_;
    int width_;
    int height_;
    gl::Buffer found_;
    std::vector<Looked> looked_;  // by slot of found_
    std::string fault_;
};

}  // namespace bounce::passes
