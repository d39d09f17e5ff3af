// SPDX-License-Identifier: Apache-2.0
//
// Places on surfaces that emit, spread in proportion to what they send: light sources that stand for the
// whole surface.
#pragma once

#include <array>
#include <span>
#include <vector>

#include <glm/glm.hpp>

#include "scene/emission.h"
#include "scene/emissive_panels.h"
#include "scene/points/point_set.h"
#include "scene/points/texture_reader.h"

namespace bounce::scene {

// A place on an emissive surface and the part of it that it stands for.
struct EmitterSample {
    PointSample point;        // its share is that of its triangle's area, and may exceed 1
    double area_m2 = 0.0;     // of that part
    bool back = false;        // sends to where the triangle turns clockwise
    glm::vec3 texture{1.0F};  // what the emission texture says around there, linear; 1 without one
};

// The emissive triangles of a scene with what their textures say; radiances, which may be animated, come
// later.
class Emitters {
  public:
    // scene and parts must outlive it. parts: of the scene, whose areas count. Surfaces whose material never
    // emits are left out: its factor is 0 and no animation moves it, or its texture is black.
    Emitters(const Scene& scene, const SurfaceParts& parts);

    [[nodiscard]] bool empty() const { return pieces_.empty(); }

    // `count` samples in proportion to emitted power (luminance of the radiance times area), stratified over
    // all surfaces; none where nothing emits. Sides send as EmittingSidesFinder says. radiance: what
    // decides the shares, one a material, without its texture, W/(m^2 sr); shown: for each of the parts'
    // surfaces. A radiance times a factor for all materials gives the same samples.
    // panels: left out, as something else draws their light. seed: other samples for each.
    [[nodiscard]] std::vector<EmitterSample> sample(std::span<const glm::vec3> radiance,
                                                    const std::vector<bool>& shown, size_t count,
                                                    std::span<const EmissivePanel> panels = {},
                                                    uint32_t seed = 0) const;

  private:
    // A triangle, or one of the equal parts that a textured one is cut into.
    struct Piece {
        size_t part;
        uint32_t index;                    // into the part's table
        std::array<glm::vec2, 3> corners;  // barycentric weights of the triangle's second and third corner
        float share;                       // of the triangle's area
        glm::vec3 texture;                 // mean over the piece
        EmittingSides sides;
    };
    void add_pieces(size_t part, uint32_t index, const EmittingSides& sides);
    [[nodiscard]] double area_m2(const Piece& piece) const;
    [[nodiscard]] std::vector<bool> taken_by(std::span<const EmissivePanel> panels) const;

    const Scene& scene_;
    const SurfaceParts& parts_;
    TextureReader textures_;
    std::vector<Piece> pieces_;
};

}  // namespace bounce::scene
