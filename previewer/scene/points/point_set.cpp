// SPDX-License-Identifier: Apache-2.0
#include "scene/points/point_set.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>

#include "scene/points/sobol.h"

namespace bounce::scene {
namespace {

// A triangle that would have at least this many points in a map is drawn as it is: from there on its exact
// outline costs less than its points.
constexpr double k_large_points = 6.0;

// The entry of a running sum that a value falls into, never one without a share.
size_t find(const std::vector<double>& cumulative, double value) {
    const auto last = std::lower_bound(cumulative.begin(), cumulative.end(), cumulative.back());
    return static_cast<size_t>(std::min(std::upper_bound(cumulative.begin(), cumulative.end(), value), last) -
                               cumulative.begin());
}

double before(const std::vector<double>& cumulative, size_t i) {
    return i == 0 ? 0.0 : cumulative[i - 1];
}

double triangle_area_m2(const SurfacePart& part, const AreaTable& table, size_t i) {
    const std::vector<double>& areas = table.cumulative;
    return (areas[i] - before(areas, i)) / areas.back() * part.area_m2;
}

struct PlacedTriangle {
    double area_m2;
    double rank;  // of its area, the same for triangles of one shape however their corners are rounded
    size_t part;
    size_t index;  // into the part's cover
};

// Triangles to draw as they are: those whose share of the points is at least k_large_points, where the points
// are spread over what is left.
std::vector<PlacedTriangle> find_large(const SurfaceParts& parts, const std::vector<bool>& use,
                                       size_t points_a_map) {
    double left = 0.0;
    for (size_t p = 0; p < parts.parts.size(); ++p) {
        left += use[p] ? parts.parts[p].area_m2 : 0.0;
    }
    // Without the largest ones less is left, and a share of it is smaller.
    std::vector<PlacedTriangle> candidates;
    const double all = left;
    const double least = left * k_large_points / static_cast<double>(points_a_map) / 16.0;
    for (size_t p = 0; p < parts.parts.size(); ++p) {
        const SurfacePart& part = parts.parts[p];
        for (size_t i = 0;
             use[p] && !part.cut_out && part.area_m2 >= least && i < part.cover->triangles.size(); ++i) {
            if (const double area = triangle_area_m2(part, *part.cover, i); area >= least) {
                candidates.push_back({area, std::floor(std::log2(area / all) * 4096.0 + 0.618), p, i});
            }
        }
    }
    std::sort(candidates.begin(), candidates.end(), [](const PlacedTriangle& a, const PlacedTriangle& b) {
        return a.rank != b.rank ? a.rank > b.rank : std::pair(a.part, a.index) < std::pair(b.part, b.index);
    });
    size_t count = 0;
    while (count < std::min(candidates.size(), k_most_large_triangles) &&
           candidates[count].area_m2 >= k_large_points * left / static_cast<double>(points_a_map)) {
        left -= candidates[count].area_m2;
        ++count;
    }
    candidates.resize(count);
    return candidates;
}

// A run of the curve through a triangle, of which points are drawn with one density.
struct CurvePiece {
    uint32_t triangle = 0;  // into the table
    double begin = 0.0;     // parts of the way along its curve
    double end = 1.0;
    double density = 1.0;  // over that of surfaces that are not thinned
};

// Parts as they are sampled: those in use, without their large triangles.
struct Sampled {
    const SurfacePart* part;
    const AreaTable* table;
    std::vector<uint32_t> triangles;  // into the table; empty: all of it
    std::vector<double> cumulative;   // parallel
    double area_m2;
    std::vector<CurvePiece> pieces;  // where it is thinned: parallel to `cumulative`, instead of triangles
    double weight_m2 = 0.0;          // its area times density
};

// What may hide something, by the parts' covers.
std::vector<Sampled> without(const SurfaceParts& parts, const std::vector<bool>& use,
                             const std::vector<PlacedTriangle>& large) {
    std::map<size_t, std::vector<bool>> dropped;
    for (const PlacedTriangle& triangle : large) {
        std::vector<bool>& drop = dropped[triangle.part];
        drop.resize(parts.parts[triangle.part].cover->triangles.size());
        drop[triangle.index] = true;
    }
    std::vector<Sampled> out;
    for (size_t p = 0; p < parts.parts.size(); ++p) {
        if (!use[p]) {
            continue;
        }
        const SurfacePart& part = parts.parts[p];
        Sampled sampled{&part, part.cover.get(), {}, {}, part.area_m2, {}, 0.0};
        if (const auto drop = dropped.find(p); drop != dropped.end()) {
            double sum = 0.0;
            for (size_t i = 0; i < drop->second.size(); ++i) {
                if (!drop->second[i]) {
                    sum += triangle_area_m2(part, *part.cover, i);
                    sampled.triangles.push_back(static_cast<uint32_t>(i));
                    sampled.cumulative.push_back(sum);
                }
            }
            sampled.area_m2 = sum;
        }
        sampled.weight_m2 = sampled.area_m2;
        if (sampled.area_m2 > 0.0) {
            out.push_back(std::move(sampled));
        }
    }
    return out;
}

std::vector<Sampled> all_of(const SurfaceParts& parts) {
    std::vector<Sampled> out;
    for (const SurfacePart& part : parts.parts) {
        out.push_back({&part, part.table.get(), {}, {}, part.area_m2, {}, part.area_m2});
    }
    return out;
}

// Barycentric weights of a triangle's second and third corner.
using Place = glm::dvec2;

// Halvings of a triangle along the curve: a large one is cut finer than the rows of a map's points.
constexpr int k_halvings = 16;

// A piece of a triangle that Sierpinski's curve runs through: where it enters, the corner beside it, where it
// leaves.
using CurveTriangle = std::array<Place, 3>;
constexpr CurveTriangle k_whole_triangle = {Place(0.0, 0.0), Place(1.0, 0.0), Place(0.0, 1.0)};

// The first or the second half of the way through a piece: the side between the ends is halved.
CurveTriangle half_of(const CurveTriangle& piece, bool second) {
    const auto& [enter, apex, leave] = piece;
    const Place middle = 0.5 * (enter + leave);
    return second ? CurveTriangle{apex, middle, leave} : CurveTriangle{enter, middle, apex};
}

// The piece of a triangle at a part t of the way along the curve. Pieces of equal length are of equal area.
CurveTriangle along_curve(double t) {
    CurveTriangle piece = k_whole_triangle;
    for (int i = 0; i < k_halvings; ++i) {
        t *= 2.0;
        piece = half_of(piece, t >= 1.0);
        t -= t >= 1.0 ? 1.0 : 0.0;
    }
    return piece;
}

// Cuts a triangle with these corners (world space) into pieces within which its distance from the ball does
// not change much, in the order of the curve.
void cut_for_thinning(const Thinning& thinning, const std::array<glm::dvec3, 3>& corners,
                      const CurveTriangle& piece, int halvings, CurvePiece run,
                      std::vector<CurvePiece>& out) {
    constexpr double k_finest =
        0.5;  // a piece's size over its distance from the ball's middle, or the ball's radius
    std::array<glm::dvec3, 3> at;
    for (size_t i = 0; i < 3; ++i) {
        at[i] = corners[0] + piece[i].x * (corners[1] - corners[0]) + piece[i].y * (corners[2] - corners[0]);
    }
    const double size =
        std::max({glm::distance(at[0], at[1]), glm::distance(at[1], at[2]), glm::distance(at[2], at[0])});
    const double distance = glm::distance((at[0] + at[1] + at[2]) / 3.0, thinning.center);
    if (halvings < k_halvings - 2 && size > k_finest * std::max(distance, thinning.radius)) {
        const double middle = 0.5 * (run.begin + run.end);
        CurvePiece first = run;
        CurvePiece second = run;
        first.end = second.begin = middle;
        cut_for_thinning(thinning, corners, half_of(piece, false), halvings + 1, first, out);
        cut_for_thinning(thinning, corners, half_of(piece, true), halvings + 1, second, out);
        return;
    }
    const double part = thinning.radius / std::max(distance, thinning.radius);
    run.density = part * part * part;
    out.push_back(run);
}

void thin(const SurfaceParts& parts, const Thinning& thinning, Sampled& sampled) {
    const uint32_t index = sampled.part->surface;
    const PointSurface& surface = parts.surfaces[index];
    if (!thinning.surfaces[index] || surface.deforms || !(thinning.radius > 0.0)) {
        return;
    }
    const Primitive& primitive = thinning.scene->meshes[static_cast<size_t>(surface.mesh)]
                                     .primitives[static_cast<size_t>(surface.primitive)];
    const glm::dmat4& m = thinning.world_from_model[index];
    double sum = 0.0;
    for (size_t t = 0; t < sampled.table->triangles.size(); ++t) {
        std::array<glm::dvec3, 3> corners;
        for (glm::length_t i = 0; i < 3; ++i) {
            const glm::vec3& position = primitive.positions[sampled.table->triangles[t][i]];
            corners[static_cast<size_t>(i)] = glm::dvec3(m * glm::dvec4(glm::dvec3(position), 1.0));
        }
        const size_t first = sampled.pieces.size();
        cut_for_thinning(thinning, corners, k_whole_triangle, 0, {static_cast<uint32_t>(t), 0.0, 1.0, 1.0},
                         sampled.pieces);
        const double area = triangle_area_m2(*sampled.part, *sampled.table, t);
        for (size_t i = first; i < sampled.pieces.size(); ++i) {
            const CurvePiece& piece = sampled.pieces[i];
            sum += area * (piece.end - piece.begin) * piece.density;
            sampled.cumulative.push_back(sum);
        }
    }
    sampled.weight_m2 = sum;
}

// block: runs of so many points are sorted along a curve over all surfaces, along which u.x is the way; 0
// leaves them in the sequence's order, and u.x picks the triangle alone.
std::vector<PointSample> sample_sequence(const std::vector<Sampled>& parts, size_t count, size_t block,
                                         uint32_t seed, double& area_m2, double& weight_m2) {
    std::vector<double> cumulative;
    double sum = 0.0;
    area_m2 = 0.0;
    for (const Sampled& part : parts) {
        area_m2 += part.area_m2;
        sum += part.weight_m2;
        cumulative.push_back(sum);
    }
    weight_m2 = sum;
    std::vector<PointSample> out;
    if (!(sum > 0.0)) {
        return out;
    }
    out.reserve(count);
    std::vector<glm::dvec3> points;
    points.reserve(count);
    for (size_t i = 0; i < count; ++i) {
        points.push_back(sobol_point(static_cast<uint32_t>(i), seed));
    }
    for (size_t first = 0; block > 0 && first < count; first += block) {
        std::sort(points.begin() + static_cast<std::ptrdiff_t>(first),
                  points.begin() + static_cast<std::ptrdiff_t>(std::min(first + block, count)),
                  [](const glm::dvec3& a, const glm::dvec3& b) { return a.x < b.x; });
    }
    for (const glm::dvec3& u : points) {
        const double place = u.x * sum;
        const size_t p = find(cumulative, place);
        const Sampled& sampled = parts[p];
        const AreaTable& table = *sampled.table;
        const std::vector<double>& areas = sampled.cumulative.empty() ? table.cumulative : sampled.cumulative;
        const double in_part = (place - before(cumulative, p)) / sampled.weight_m2 * areas.back();
        const size_t t = find(areas, in_part);
        CurvePiece piece;
        piece.triangle = static_cast<uint32_t>(t);
        if (!sampled.pieces.empty()) {
            piece = sampled.pieces[t];
        } else if (!sampled.triangles.empty()) {
            piece.triangle = sampled.triangles[t];
        }
        const size_t triangle = piece.triangle;
        // Uniform over a triangle: Osada et al. 2002, "Shape Distributions".
        const double root = std::sqrt(u.y);
        PointSample sample;
        sample.surface = sampled.part->surface;
        sample.triangle = table.triangles[triangle];
        Place at(root * (1.0 - u.z), root * u.z);
        if (block > 0) {
            const double begin = before(areas, t);
            const double in_piece = std::clamp((in_part - begin) / (areas[t] - begin), 0.0, 1.0);
            const auto [a, b, c] = along_curve(piece.begin + in_piece * (piece.end - piece.begin));
            at = a + (b - a) * at.x + (c - a) * at.y;
        }
        sample.second = static_cast<float>(at.x);
        sample.third = static_cast<float>(at.y);
        sample.share = static_cast<float>(sum / static_cast<double>(count) / piece.density /
                                          triangle_area_m2(*sampled.part, table, triangle));
        sample.flat = table.flat;
        out.push_back(sample);
    }
    return out;
}

}  // namespace

PointSet sample_points(const SurfaceParts& parts, const std::vector<bool>& on_hull, const PointCounts& counts,
                       const Thinning* thinning) {
    PointSet set;
    double weight_m2 = 0.0;
    std::vector<bool> hides(on_hull.size());
    for (size_t i = 0; i < on_hull.size(); ++i) {
        hides[i] = counts.hull_hides || !on_hull[i];
    }
    if (counts.occluders > 0) {
        const std::vector<PlacedTriangle> large = counts.large_triangles
                                                      ? find_large(parts, hides, counts.points_a_map)
                                                      : std::vector<PlacedTriangle>{};
        for (const PlacedTriangle& triangle : large) {
            const SurfacePart& part = parts.parts[triangle.part];
            set.large.push_back(
                {part.surface, part.cover->triangles[triangle.index], on_hull[triangle.part]});
        }
        std::stable_partition(set.large.begin(), set.large.end(),
                              [](const SurfaceTriangle& triangle) { return !triangle.on_hull; });
        set.occluders = sample_sequence(without(parts, hides, large), counts.occluders, 0, 1,
                                        set.occluder_area_m2, weight_m2);
    }
    if (counts.reflectors > 0) {
        std::vector<Sampled> sampled = all_of(parts);
        if (thinning != nullptr) {
            for (Sampled& part : sampled) {
                thin(parts, *thinning, part);
            }
        }
        set.reflectors = sample_sequence(sampled, counts.reflectors, counts.reflectors_a_map, 2,
                                         set.reflector_area_m2, weight_m2);
        set.dense_reflector_area_m2 = thinning != nullptr && weight_m2 < set.reflector_area_m2
                                          ? weight_m2 / static_cast<double>(counts.reflectors)
                                          : 0.0;
    }
    return set;
}

}  // namespace bounce::scene
