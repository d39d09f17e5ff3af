// SPDX-License-Identifier: Apache-2.0
#include "gpu/point_store.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstring>
#include <numeric>

#include "scene/points/point_materials.h"

namespace bounce::gpu {
namespace {

size_t at(int index) {
    return static_cast<size_t>(index);
}

bool same(const GpuPointSurface& a, const GpuPointSurface& b) {
    return std::memcmp(&a, &b, sizeof(a)) == 0;
}

bool same_draws(const std::vector<scene::DrawInstance>& a, const std::vector<scene::DrawInstance>& b) {
    return std::equal(a.begin(), a.end(), b.begin(), b.end(),
                      [](const scene::DrawInstance& x, const scene::DrawInstance& y) {
                          return x.node == y.node && x.world_from_model == y.world_from_model;
                      });
}

}  // namespace

PointStore::PointStore(const scene::Scene& scene, int animation)
    : scene_(scene),
      animation_(animation),
      parts_(scene::surface_parts(scene, animation)),
      hull_finder_(scene_, parts_) {}

std::vector<bool> PointStore::on_hull(const scene::Pose& pose, bool drop_hull) {
    if (!drop_hull) {
        return std::vector<bool>(parts_.parts.size(), false);
    }
    const bool deforms = std::any_of(parts_.surfaces.begin(), parts_.surfaces.end(),
                                     [](const scene::PointSurface& surface) { return surface.deforms; });
    if (on_hull_.empty() || deforms || !same_draws(hull_draws_, pose.draws)) {
        on_hull_ = hull_finder_.on_hull(pose);
        hull_draws_ = pose.draws;
    }
    return on_hull_;
}

double PointStore::occluding_area_m2(const scene::Pose& pose, bool drop_hull) {
    const std::vector<bool> hull = on_hull(pose, drop_hull);
    double area = 0.0;
    for (size_t i = 0; i < hull.size(); ++i) {
        area += hull[i] ? 0.0 : parts_.parts[i].area_m2;
    }
    return area;
}

scene::Ground PointStore::ground(const scene::Pose& pose) {
    return scene::find_ground(scene_, pose, parts_, on_hull(pose, true));
}

const scene::Ground& PointStore::first_ground() {
    if (!first_ground_) {
        const scene::Pose pose = scene::evaluate_pose(scene_, 0.0, animation_);
        first_ground_ = scene::find_ground(scene_, pose, parts_, hull_finder_.on_hull(pose));
    }
    return *first_ground_;
}

// A function of the scene alone, so that a frame's points do not depend on which frames were rendered before.
scene::Thinning PointStore::thinning() {
    const scene::Pose pose = scene::evaluate_pose(scene_, 0.0, animation_);
    const scene::Ground& ground = first_ground();
    scene::Thinning out{ground.surfaces, ground.rest.center(), 0.5 * ground.rest.diagonal(), {}, &scene_};
    for (const scene::PointSurface& surface : parts_.surfaces) {
        const scene::Node& node = scene_.nodes[at(surface.node)];
        const glm::dmat4& m = pose.world_from_node[at(surface.node)];
        out.world_from_model.push_back(node.instances.empty() ? m : m * node.instances[at(surface.instance)]);
    }
    return out;
}

size_t PointStore::large_triangles_inside() const {
    return static_cast<size_t>(
        std::count_if(set_.large.begin(), set_.large.end(),
                      [](const scene::SurfaceTriangle& triangle) { return !triangle.on_hull; }));
}

glm::uvec4 PointStore::place(uint32_t surface_index, const glm::uvec3& triangle,
                             const VertexStore& vertices) const {
    const scene::PointSurface& surface = parts_.surfaces[surface_index];
    const PrimitiveRange range = vertices.node_deforms(surface.node)
                                     ? vertices.deformed_range(surface.node, surface.primitive)
                                     : vertices.range(surface.mesh, surface.primitive);
    const auto base = static_cast<uint32_t>(range.base_vertex);
    return {base + triangle, surface_index};
}

void PointStore::upload(const VertexStore& vertices) {
    const size_t total = set_.occluders.size() + set_.reflectors.size();
    std::vector<uint32_t> order(total);
    std::iota(order.begin(), order.end(), 0U);
    const auto sample = [&](uint32_t i) -> const scene::PointSample& {
        return i < set_.occluders.size() ? set_.occluders[i] : set_.reflectors[i - set_.occluders.size()];
    };
    std::stable_sort(order.begin(), order.end(),
                     [&](uint32_t a, uint32_t b) { return sample(a).surface < sample(b).surface; });
    std::vector<GpuPointSource> sources;
    sources.reserve(total);
    surface_runs_.assign(parts_.surfaces.size(), {});
    for (const uint32_t i : order) {
        const scene::PointSample& point = sample(i);
        PointRun& run = surface_runs_[point.surface];
        run.first = run.count == 0 ? static_cast<uint32_t>(sources.size()) : run.first;
        ++run.count;
        // A flat point has its share negated.
        sources.push_back(
            {place(point.surface, point.triangle, vertices),
             {point.second, point.third, point.flat ? -point.share : point.share, std::bit_cast<float>(i)}});
    }
    sources_ = gl::Buffer::of("point sources", std::span<const GpuPointSource>(sources));
    points_ = gl::Buffer("points", total * sizeof(glm::uvec4), 0);
    std::vector<glm::uvec4> large;
    for (const scene::SurfaceTriangle& triangle : set_.large) {
        large.push_back(place(triangle.surface, triangle.triangle, vertices));
    }
    triangle_sources_ = gl::Buffer::of("large triangle sources", std::span<const glm::uvec4>(large));
    triangles_ = gl::Buffer("large triangles", large.size() * 3 * sizeof(glm::vec4), 0);
    upload_materials();
    updated_surfaces_.clear();
}

// Only of the reflectors: their places follow the occluders'.
void PointStore::upload_materials() {
    if (set_.reflectors.empty()) {
        point_materials_ = {};
        return;
    }
    std::vector<glm::uvec4> packed(set_.occluders.size(), glm::uvec4(0U));
    const std::vector<scene::PointMaterial> materials =
        scene::point_materials(scene_, parts_, set_.reflectors);
    const auto fraction = [](float value, float steps) {
        return static_cast<uint32_t>(std::lround(std::clamp(value, 0.0F, 1.0F) * steps));
    };
    for (size_t i = 0; i < materials.size(); ++i) {
        const scene::PointMaterial& material = materials[i];
        const glm::vec3 root = glm::sqrt(glm::clamp(material.base_color, 0.0F, 1.0F));
        packed.emplace_back(
            set_.reflectors[i].surface,
            fraction(root.r, 1023.0F) | fraction(root.g, 1023.0F) << 10U | fraction(root.b, 1023.0F) << 20U,
            fraction(material.roughness, 65535.0F) | fraction(material.metallic, 65535.0F) << 16U, 0U);
    }
    point_materials_ = gl::Buffer::of("point materials", std::span<const glm::uvec4>(packed));
}

void PointStore::bind_materials() const {
    point_materials_.bind_storage(SSBO_POINT_MATERIALS);
    surface_buffer_.bind_storage(SSBO_POINT_SURFACES);
    points_.bind_storage(SSBO_POINTS);
}

void PointStore::find_changes(const std::vector<GpuPointSurface>& now) {
    changed_.clear();
    const auto moved = [&](size_t i) {
        return updated_surfaces_.empty() || (parts_.surfaces[i].deforms && deformed_ != updated_deformed_) ||
               !same(now[i], updated_surfaces_[i]);
    };
    large_changed_ = std::any_of(set_.large.begin(), set_.large.end(),
                                 [&](const scene::SurfaceTriangle& t) { return moved(t.surface); });
    for (size_t i = 0; i < now.size(); ++i) {
        const PointRun& run = surface_runs_[i];
        if (run.count == 0 || !moved(i)) {
            continue;
        }
        if (!changed_.empty() && changed_.back().first + changed_.back().count == run.first) {
            changed_.back().count += run.count;
        } else {
            changed_.push_back(run);
        }
    }
}

void PointStore::set_pose(const scene::Pose& pose, const RenderSpace& space, const VertexStore& vertices,
                          const scene::PointCounts& wanted, bool drop_hull, bool thin_ground) {
    positions_ = &vertices.positions();
    const std::vector<bool> hull = on_hull(pose, drop_hull || wanted.hull_hides);
    if (wanted != wanted_ || hull != sampled_on_hull_ || thin_ground != thinned_) {
        scene::Thinning thinned;
        if (thin_ground) {
            thinned = thinning();
        }
        set_ = scene::sample_points(parts_, hull, wanted, thin_ground ? &thinned : nullptr);
        thinned_ = thin_ground;
        scene::drop_cut_out(scene_, parts_, set_.occluders);
        scene::drop_cut_out(scene_, parts_, set_.reflectors);
        wanted_ = wanted;
        sampled_on_hull_ = hull;
        upload_due_ = true;
        ++samplings_;
        const size_t total = set_.occluders.size() + set_.reflectors.size();
        bytes_ = total * (sizeof(GpuPointSource) + sizeof(glm::uvec4)) +
                 (set_.reflectors.empty() ? 0 : total * sizeof(glm::uvec4)) +
                 set_.large.size() * (sizeof(glm::uvec4) + 3 * sizeof(glm::vec4));
    }
    if (upload_due_ && !plans_only_) {
        upload(vertices);
        upload_due_ = false;
    }
    deformed_ = vertices.content();
    std::vector<bool> drawn(scene_.nodes.size(), false);
    for (const scene::DrawInstance& draw : pose.draws) {
        drawn[at(draw.node)] = true;
    }
    const glm::dmat4 render_from_world = space.render_from_world();
    surfaces_.clear();
    for (const scene::PointSurface& surface : parts_.surfaces) {
        const scene::Node& node = scene_.nodes[at(surface.node)];
        const scene::Primitive& primitive = scene_.meshes[at(surface.mesh)].primitives[at(surface.primitive)];
        glm::dmat4 m(1.0);  // what joints placed is in render space already
        if (node.skin == scene::k_none) {
            m = render_from_world * pose.world_from_node[at(surface.node)];
            m = node.instances.empty() ? m : m * node.instances[at(surface.instance)];
        } else if (primitive.joints.empty()) {
            m = render_from_world;
        }
        GpuPointSurface out{};
        for (int row = 0; row < 3; ++row) {
            out.render_from_model[row] = glm::vec4(glm::dvec4(m[0][row], m[1][row], m[2][row], m[3][row]));
        }
        const bool has_material = primitive.material != scene::k_none;
        out.ids = {has_material ? primitive.material : static_cast<int>(pose.materials.size()),
                   drawn[at(surface.node)] ? 1 : 0, 0, 0};
        surfaces_.push_back(out);
    }
    content_ = ContentHash()
                   .add(samplings_)
                   .add(deformed_)
                   .add_all(std::span<const GpuPointSurface>(surfaces_))
                   .key();
    if (!upload_due_) {
        find_changes(surfaces_);
    }
    if (surface_buffer_.bytes() != surfaces_.size() * sizeof(GpuPointSurface)) {
        surface_buffer_ =
            gl::Buffer("point surfaces", surfaces_.size() * sizeof(GpuPointSurface), GL_DYNAMIC_STORAGE_BIT);
        uploaded_surfaces_.clear();
    }
    // Emitters stand on surfaces that may have no point.
    const bool uploaded = std::equal(surfaces_.begin(), surfaces_.end(), uploaded_surfaces_.begin(),
                                     uploaded_surfaces_.end(), same);
    if (!uploaded) {
        surface_buffer_.update(std::span<const GpuPointSurface>(surfaces_));
        uploaded_surfaces_ = surfaces_;
    }
}

size_t PointStore::allocated_bytes() const {
    size_t sum = 0;
    for (const gl::Buffer* buffer :
         {&triangle_sources_, &triangles_, &point_materials_, &sources_, &points_}) {
        sum += *buffer ? buffer->bytes() : 0;
    }
    return sum;
}

void PointStore::update_done() {
    updated_surfaces_ = surfaces_;
    updated_deformed_ = deformed_;
    changed_.clear();
    large_changed_ = false;
}

void PointStore::bind_for_update() const {
    positions_->bind_storage(SSBO_POSITIONS);
    sources_.bind_storage(SSBO_POINT_SOURCES);
    surface_buffer_.bind_storage(SSBO_POINT_SURFACES);
    points_.bind_storage(SSBO_POINTS);
}

void PointStore::bind_for_triangle_update() const {
    positions_->bind_storage(SSBO_POSITIONS);
    triangle_sources_.bind_storage(SSBO_POINT_SOURCES);
    surface_buffer_.bind_storage(SSBO_POINT_SURFACES);
    triangles_.bind_storage(SSBO_TRIANGLES);
}

}  // namespace bounce::gpu
