// SPDX-License-Identifier: Apache-2.0
#include "gpu/emitter_store.h"

#include <span>

namespace bounce::gpu {

EmitterStore::EmitterStore(const scene::Scene& scene, const PointStore& points)
    : scene_(scene), points_(points), emitters_(scene, points.parts()) {}

void EmitterStore::set_pose(const scene::Pose& pose, const VertexStore& vertices, size_t count) {
    positions_ = &vertices.positions();
    std::vector<glm::vec3> radiance;
    radiance.reserve(pose.materials.size());
    for (const scene::Material& material : pose.materials) {
        radiance.push_back(material.unlit ? glm::vec3(0.0F) : material.emission * material.emission_strength);
    }
    std::vector<bool> drawn(scene_.nodes.size(), false);
    for (const scene::DrawInstance& draw : pose.draws) {
        drawn[static_cast<size_t>(draw.node)] = true;
    }
    std::vector<bool> shown;
    shown.reserve(points_.parts().surfaces.size());
    for (const scene::PointSurface& surface : points_.parts().surfaces) {
        shown.push_back(drawn[static_cast<size_t>(surface.node)]);
    }
    const bool changed = radiance != radiance_ || shown != shown_ || count != count_;
    if (!changed) {
        return;
    }
    samples_ = emitters_.sample(radiance, shown, count);
    radiance_ = std::move(radiance);
    shown_ = std::move(shown);
    count_ = count;
    std::vector<GpuEmitterSource> sources;
    sources.reserve(samples_.size());
    for (const scene::EmitterSample& sample : samples_) {
        const scene::PointSample& point = sample.point;
        const scene::PointSurface& surface = points_.parts().surfaces[point.surface];
        const scene::Primitive& primitive =
            scene_.meshes[static_cast<size_t>(surface.mesh)].primitives[static_cast<size_t>(surface.primitive)];
        sources.push_back({points_.place(point.surface, point.triangle, vertices),
                           {point.second, point.third, sample.back ? -point.share : point.share, 0.0F},
                           glm::vec4(radiance_[static_cast<size_t>(primitive.material)] * sample.texture, 0.0F)});
    }
    sources_ = gl::Buffer::of("emitter sources", std::span<const GpuEmitterSource>(sources));
}

void EmitterStore::bind_for_update() const {
    positions_->bind_storage(SSBO_POSITIONS);
    sources_.bind_storage(SSBO_POINT_SOURCES);
    points_.bind_surfaces();
}

}  // namespace bounce::gpu
