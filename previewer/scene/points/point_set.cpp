// SPDX-License-Identifier: Apache-2.0
#include "scene/points/point_set.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <tuple>

#include "scene/points/morton.h"
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
    const double least = left * k_large_points / static_cast<double>(points_a_map) / 16.0;
    for (size_t p = 0; p < parts.parts.size(); ++p) {
        const SurfacePart& part = parts.parts[p];
        for (size_t i = 0;
             use[p] && !part.cut_out && part.area_m2 >= least && i < part.cover->triangles.size(); ++i) {
            if (const double area = triangle_area_m2(part, *part.cover, i); area >= least) {
                candidates.push_back({area, p, i});
            }
        }
    }
    std::sort(candidates.begin(), candidates.end(), [](const PlacedTriangle& a, const PlacedTriangle& b) {
        return a.area_m2 != b.area_m2 ? a.area_m2 > b.area_m2
                                      : std::pair(a.part, a.index) < std::pair(b.part, b.index);
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

// Parts as they are sampled: those in use, without their large triangles.
struct Sampled {
    const SurfacePart* part;
    const AreaTable* table;
    std::vector<uint32_t> triangles;  // into the table; empty: all of it
    std::vector<double> cumulative;   // parallel
    double area_m2;
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
        Sampled sampled{&part, part.cover.get(), {}, {}, part.area_m2};
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
        if (sampled.area_m2 > 0.0) {
            out.push_back(std::move(sampled));
        }
    }
    return out;
}

// All parts, along a curve through their centres, whatever the order of the scene's nodes.
std::vector<Sampled> all_of(const SurfaceParts& parts) {
    glm::dvec3 low(1e300);
    glm::dvec3 high(-1e300);
    for (const SurfacePart& part : parts.parts) {
        low = glm::min(low, part.center_world);
        high = glm::max(high, part.center_world);
    }
    const glm::dvec3 cells = 1023.0 / glm::max(high - low, glm::dvec3(1e-300));
    std::vector<Sampled> out;
    for (const SurfacePart& part : parts.parts) {
        out.push_back({&part, part.table.get(), {}, {}, part.area_m2});
    }
    const auto key = [&](const Sampled& s) {
        const glm::dvec3& c = s.part->center_world;
        return std::tuple(morton(glm::uvec3((c - low) * cells)), c.x, c.y, c.z, s.area_m2);
    };
    std::stable_sort(out.begin(), out.end(),
                     [&](const Sampled& a, const Sampled& b) { return key(a) < key(b); });
    return out;
}

// Barycentric weights of a triangle's second and third corner.
using Place = glm::dvec2;

// Halvings of a triangle along the curve: a large one is cut finer than the rows of a map's points.
constexpr int k_halvings = 16;

// The piece of a triangle, as its corners, at a part t of the way along Sierpinski's curve: the side between
// the ends is halved, and one half after the other followed. Pieces of equal length are of equal area.
std::array<Place, 3> along_curve(double t) {
    std::array<Place, 3> piece = {Place(0.0, 0.0), Place(1.0, 0.0), Place(0.0, 1.0)};
    auto& [enter, apex, leave] = piece;
    for (int i = 0; i < k_halvings; ++i) {
        const Place middle = 0.5 * (enter + leave);
        t *= 2.0;
        if (t < 1.0) {
            leave = apex;
        } else {
            enter = apex;
            t -= 1.0;
        }
        apex = middle;
    }
    return piece;
}

// block: runs of so many points are sorted along a curve over all surfaces, along which u.x is the way; 0
// leaves them in the sequence's order, and u.x picks the triangle alone.
std::vector<PointSample> sample_sequence(const std::vector<Sampled>& parts, size_t count, size_t block,
                                         uint32_t seed, double& area_m2) {
    std::vector<double> cumulative;
    double sum = 0.0;
    for (const Sampled& part : parts) {
        sum += part.area_m2;
        cumulative.push_back(sum);
    }
    area_m2 = sum;
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
        const double in_part = (place - before(cumulative, p)) / sampled.area_m2 * areas.back();
        const size_t t = find(areas, in_part);
        const size_t triangle = sampled.triangles.empty() ? t : sampled.triangles[t];
        // Uniform over a triangle: Osada et al. 2002, "Shape Distributions".
        const double root = std::sqrt(u.y);
        PointSample sample;
        sample.surface = sampled.part->surface;
        sample.triangle = table.triangles[triangle];
        Place at(root * (1.0 - u.z), root * u.z);
        if (block > 0) {
            const double begin = before(areas, t);
            const auto [a, b, c] = along_curve(std::clamp((in_part - begin) / (areas[t] - begin), 0.0, 1.0));
            at = a + (b - a) * at.x + (c - a) * at.y;
        }
        sample.second = static_cast<float>(at.x);
        sample.third = static_cast<float>(at.y);
        sample.share = static_cast<float>(sum / static_cast<double>(count) /
                                          triangle_area_m2(*sampled.part, table, triangle));
        sample.flat = table.flat;
        out.push_back(sample);
    }
    return out;
}

}  // namespace

PointSet sample_points(const SurfaceParts& parts, const std::vector<bool>& on_hull,
                       const PointCounts& counts) {
    PointSet set;
    std::vector<bool> hides = on_hull;
    hides.flip();
    if (counts.occluders > 0) {
        const std::vector<PlacedTriangle> large = counts.large_triangles
                                                      ? find_large(parts, hides, counts.points_a_map)
                                                      : std::vector<PlacedTriangle>{};
        for (const PlacedTriangle& triangle : large) {
            const SurfacePart& part = parts.parts[triangle.part];
            set.large.push_back({part.surface, part.cover->triangles[triangle.index]});
        }
        set.occluders =
            sample_sequence(without(parts, hides, large), counts.occluders, 0, 1, set.occluder_area_m2);
    }
    if (counts.reflectors > 0) {
        set.reflectors = sample_sequence(all_of(parts), counts.reflectors, counts.reflectors_a_map, 2,
                                         set.reflector_area_m2);
    }
    return set;
}

}  // namespace bounce::scene
