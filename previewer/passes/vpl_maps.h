// SPDX-License-Identifier: Apache-2.0
//
// How virtual point lights are chosen, and how maps of theirs are drawn from triangles.
#pragma once

namespace bounce::passes {

enum class VplSampling {
    inverse_transform,  // one for each cell of equal flux
    uniform,            // texels at the points of the Halton sequence (Lv et al. 2009)
    // Single texels of all lights' maps, chosen by their importance (passes/vpl_choice.h; Barak et al. 2013):
    uniform3,              // by the Halton sequence over lights, rows and columns
    inverse2,              // by inverse transform of two numbers
    inverse3,              // and of three
    metropolis,            // by chains of Independent Metropolis-Hastings
    metropolis_single,     // weighed by their first proposal
    metropolis_unreduced,  // with their start-up bias
    resampled,             // by chains that resample: without bias
    avg,                   // where rays from the lights meet the grid (Bashford-Rogers et al. 2012)
};

// Samplings whose lights are single texels, chosen among all maps by their importance. The others have a way
// of their own in passes/vpl_draw.comp, or trace rays.
[[nodiscard]] inline bool is_chosen(VplSampling sampling) {
    return sampling != VplSampling::inverse_transform && sampling != VplSampling::uniform &&
           sampling != VplSampling::avg;
}

// Of these the ones that run chains of proposals.
[[nodiscard]] inline bool is_chain(VplSampling sampling) {
    return is_chosen(sampling) && sampling != VplSampling::uniform3 && sampling != VplSampling::inverse2 &&
           sampling != VplSampling::inverse3;
}

// What a texel of a light's map counts for where lights are drawn by importance.
enum class Importance {
    flux,  // what it reflects
    view,  // what the picture shows of that, unhidden
};

// How the lights that stand for the world are chosen.
enum class WorldSampling {
    parts,  // one for each part of its image, or evenly where it has none
    drawn,  // from cells of the sphere, as those of a first bounce are from texels (passes/sphere_vpls.h)
};

// What those of further bounces are drawn from.
enum class BounceSource {
    points,  // that the bounce before lights
    irsm,    // these points, splatted into imperfect reflective shadow maps (Ritschel et al. 2008)
    avg,     // where rays from the bounce before meet the grid (Bashford-Rogers et al. 2012)
};

// Where a ray through the approximate visibility grid ends.
enum class AvgHits {
    slabs,   // where it enters the slab that bounds a voxel's surface
    voxels,  // in the first voxel that holds a surface, some way into it, as in the 2012 paper
};

// How the rays of a bounce are shared out among the lights before.
enum class AvgPaths {
    roulette,  // by what each reflects, so that rays are worth the same
    fixed,     // evenly, each ray weighed by what its light reflects
};

enum class MapProjection {
    faces,       // through five faces of a cube, exact
    paraboloid,  // each vertex by the map's own projection, which bends edges (Brabec et al. 2002)
};

}  // namespace bounce::passes
