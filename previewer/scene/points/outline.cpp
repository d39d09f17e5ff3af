// SPDX-License-Identifier: Apache-2.0
#include "scene/points/outline.h"

#include <algorithm>
#include <utility>

namespace bounce::scene {
namespace {

struct Edge {
    uint32_t from;
    uint32_t to;
};

// An edge as a number by which those of the same two vertices stand together, and whether it runs upwards.
std::pair<uint64_t, bool> sortable(uint32_t from, uint32_t to) {
    return {uint64_t{std::min(from, to)} << 32U | std::max(from, to), from < to};
}

// Edges that are left when each is paired off with one that runs the other way, by where they begin.
std::vector<Edge> pair_off(std::vector<std::pair<uint64_t, bool>> edges) {
    std::sort(edges.begin(), edges.end());
    std::vector<Edge> rim;
    for (size_t i = 0; i < edges.size();) {
        const uint64_t both = edges[i].first;
        int upwards = 0;
        for (; i < edges.size() && edges[i].first == both; ++i) {
            upwards += edges[i].second ? 1 : -1;
        }
        const Edge edge{static_cast<uint32_t>(both >> 32U), static_cast<uint32_t>(both)};
        rim.insert(rim.end(), static_cast<size_t>(std::max(upwards, 0)), edge);
        rim.insert(rim.end(), static_cast<size_t>(std::max(-upwards, 0)), {edge.to, edge.from});
    }
    std::sort(rim.begin(), rim.end(),
              [](const Edge& a, const Edge& b) { return std::pair(a.from, a.to) < std::pair(b.from, b.to); });
    return rim;
}

// Closed lines of edges, as many of which end at each vertex as begin there.
std::vector<Outline> chain(const std::vector<Edge>& rim) {
    std::vector<bool> used(rim.size(), false);
    std::vector<size_t> next_of(rim.size(), 0);  // at the first edge of a vertex: how many are used
    const auto first_from = [&](uint32_t vertex) {
        const auto found = std::lower_bound(rim.begin(), rim.end(), vertex,
                                            [](const Edge& e, uint32_t v) { return e.from < v; });
        return static_cast<size_t>(found - rim.begin());
    };
    std::vector<Outline> out;
    for (size_t start = 0; start < rim.size(); ++start) {
        if (used[start]) {
            continue;
        }
        Outline outline;
        for (size_t edge = start;;) {
            used[edge] = true;
            outline.push_back(rim[edge].from);
            if (rim[edge].to == rim[start].from) {
                break;
            }
            const size_t first = first_from(rim[edge].to);
            edge = first + next_of[first];
            while (used[edge]) {
                edge = first + ++next_of[first];
            }
        }
        out.push_back(std::move(outline));
    }
    return out;
}

double distance_to_segment(const glm::dvec2& p, const glm::dvec2& a, const glm::dvec2& b) {
    const glm::dvec2 ab = b - a;
    const double square = glm::dot(ab, ab);
    const double along = square > 0.0 ? std::clamp(glm::dot(p - a, ab) / square, 0.0, 1.0) : 0.0;
    return glm::distance(p, a + along * ab);
}

class Straightener {
  public:
    Straightener(const Outline& outline, std::span<const glm::dvec2> places, double tolerance)
        : outline_(outline), places_(places), tolerance_(tolerance) {}

    Outline straighten() {
        // What is farthest from any place is a corner, not a place on a straight edge.
        const size_t first = farthest_from(0);
        std::rotate(outline_.begin(), outline_.begin() + static_cast<std::ptrdiff_t>(first), outline_.end());
        split(farthest_from(0));
        drop_spare();
        Outline out;
        for (size_t i = 0; i + 1 < kept_.size(); ++i) {
            out.push_back(outline_[kept_[i]]);
        }
        return out.size() < 3 ? Outline{} : out;
    }

  private:
    [[nodiscard]] const glm::dvec2& place(size_t i) const { return places_[outline_[i % outline_.size()]]; }

    [[nodiscard]] size_t farthest_from(size_t from) const {
        size_t best = from;
        for (size_t i = 0; i < outline_.size(); ++i) {
            if (glm::distance(place(from), place(i)) > glm::distance(place(from), place(best))) {
                best = i;
            }
        }
        return best;
    }

    // The vertex between two that lies farthest from the edge between them, and how far.
    [[nodiscard]] std::pair<size_t, double> farthest_between(size_t from, size_t to) const {
        std::pair<size_t, double> best{from, -1.0};
        for (size_t i = from + 1; i < to; ++i) {
            const double distance = distance_to_segment(place(i), place(from), place(to));
            best = distance > best.second ? std::pair(i, distance) : best;
        }
        return best;
    }

    // Douglas and Peucker 1973, "Algorithms for the Reduction of the Number of Points Required to Represent a
    // Digitized Line or its Caricature". The last vertex is the first again.
    void split(size_t second) {
        kept_ = {0};
        std::vector<size_t> ends = {outline_.size(), second};
        while (!ends.empty()) {
            const auto [middle, distance] = farthest_between(kept_.back(), ends.back());
            if (distance > tolerance_) {
                ends.push_back(middle);
            } else {
                kept_.push_back(ends.back());
                ends.pop_back();
            }
        }
    }

    // Where an edge runs along a chord, the split falls on any of its vertices.
    void drop_spare() {
        for (size_t i = 1; i + 1 < kept_.size();) {
            if (farthest_between(kept_[i - 1], kept_[i + 1]).second <= tolerance_) {
                kept_.erase(kept_.begin() + static_cast<std::ptrdiff_t>(i));
                i = std::max<size_t>(i - 1, 1);
            } else {
                ++i;
            }
        }
    }

    Outline outline_;
    std::span<const glm::dvec2> places_;
    double tolerance_;
    std::vector<size_t> kept_;  // into outline_
};

}  // namespace

std::vector<Outline> find_outlines(std::span<const glm::uvec3> triangles) {
    std::vector<std::pair<uint64_t, bool>> edges;
    edges.reserve(3 * triangles.size());
    for (const glm::uvec3& t : triangles) {
        for (int k = 0; k < 3; ++k) {
            if (t[k] != t[(k + 1) % 3]) {
                edges.push_back(sortable(t[k], t[(k + 1) % 3]));
            }
        }
    }
    return chain(pair_off(std::move(edges)));
}

std::vector<Outline> join_outlines(std::span<const Outline> outlines) {
    std::vector<std::pair<uint64_t, bool>> edges;
    for (const Outline& outline : outlines) {
        for (size_t i = 0; i < outline.size(); ++i) {
            edges.push_back(sortable(outline[i], outline[(i + 1) % outline.size()]));
        }
    }
    return chain(pair_off(std::move(edges)));
}

Outline straighten(const Outline& outline, std::span<const glm::dvec2> places, double tolerance) {
    return outline.size() < 3 ? Outline{} : Straightener(outline, places, tolerance).straighten();
}

}  // namespace bounce::scene
