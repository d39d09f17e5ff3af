// SPDX-License-Identifier: Apache-2.0
#include "gpu/emitter_store.h"

#include <numbers>
#include <span>

#include "scene/emission.h"

namespace bounce::gpu {

EmitterStore::EmitterStore(const scene::Scene& scene, const PointStore& points)
    : scene_(scene),
      points_(points),
      emitters_(scene, points.parts()),
      peak_(scene::peak_radiance(scene, scene::default_animation(scene))) {}

void EmitterStore::set_pose(const scene::Pose& pose, const VertexStore& vertices, size_t count,
                            std::span<const scene::EmissivePanel> panels, uint32_t seed) {
    positions_ = &vertices.positions();
    const std::vector<glm::vec3> radiance = scene::emitted_radiance(pose.materials);
    bool resample = count != count_ || seed != seed_;
    // Another animation than the file's first may light what is dark in that; for this moment alone, so that
    // no frame depends on those before.
    std::vector<glm::vec3> peak = peak_;
    for (size_t i = 0; i < peak.size(); ++i) {
        if (!(scene::emitted_luminance(peak[i]) > 0.0) && scene::emitted_luminance(radiance[i]) > 0.0) {
            peak[i] = radiance[i];
        }
    }
    resample |= peak != sampled_peak_;
    std::vector<bool> drawn(scene_.nodes.size(), false);
    for (const scene::DrawInstance& draw : pose.draws) {
        drawn[static_cast<size_t>(draw.node)] = true;
    }
    std::vector<bool> shown;
    shown.reserve(points_.parts().surfaces.size());
    for (const scene::PointSurface& surface : points_.parts().surfaces) {
        shown.push_back(drawn[static_cast<size_t>(surface.node)]);
    }
    std::vector<std::pair<int, int>> taken;  // a node's panels come and go together
    taken.reserve(panels.size());
    for (const scene::EmissivePanel& panel : panels) {
        taken.emplace_back(panel.node, panel.instance);
    }
    resample |= shown != shown_ || taken != taken_;
    if (!resample && radiance == radiance_) {
        return;
    }
    if (resample) {
        samples_ = emitters_.sample(peak, shown, count, panels, seed);
        sampled_peak_ = peak;
    }
    radiance_ = radiance;
    shown_ = std::move(shown);
    taken_ = std::move(taken);
    count_ = count;
    seed_ = seed;
    std::vector<GpuEmitterSource> sources;
    sources.reserve(samples_.size());
    power_w_ = 0.0;
    for (const scene::EmitterSample& sample : samples_) {
        const scene::PointSample& point = sample.point;
        const scene::PointSurface& surface = points_.parts().surfaces[point.surface];
        const scene::Primitive& primitive = scene_.meshes[static_cast<size_t>(surface.mesh)]
                                                .primitives[static_cast<size_t>(surface.primitive)];
        const glm::vec3 sent = radiance_[static_cast<size_t>(primitive.material)] * sample.texture;
        power_w_ += std::numbers::pi * sample.area_m2 * scene::emitted_luminance(sent);
        sources.push_back({points_.place(point.surface, point.triangle, vertices),
                           {point.second, point.third, sample.back ? -point.share : point.share, 0.0F},
                           glm::vec4(sent, 0.0F)});
    }
    ++uploads_;
    sources_ = gl::Buffer::of("emitter sources", std::span<const GpuEmitterSource>(sources));
}

void EmitterStore::bind_for_update() const {
    positions_->bind_storage(SSBO_POSITIONS);
    sources_.bind_storage(SSBO_POINT_SOURCES);
    points_.bind_surfaces();
}

}  // namespace bounce::gpu
