// SPDX-License-Identifier: Apache-2.0
#include "renderer/sampled_picture.h"

#include <cassert>
#include <cmath>
#include <cstdint>
#include <utility>

#include "renderer/pixel_offsets.h"

namespace bounce {
namespace {

void add_times(std::vector<gl::PassTime>& sums, const std::vector<gl::PassTime>& times) {
    // A frame is planned the same way wherever its pixels look.
    assert(sums.size() == times.size());
    for (size_t i = 0; i < sums.size(); ++i) {
        sums[i].gpu_ms += times[i].gpu_ms;
        sums[i].cpu_ms += times[i].cpu_ms;
    }
}

}  // namespace

void PictureMean::add(const Image& picture) {
    if (count_ == 0) {
        width_ = picture.width;
        height_ = picture.height;
        sum_.assign(picture.rgb.size(), 0.0);
    }
    assert(picture.width == width_ && picture.height == height_);
    for (size_t i = 0; i < sum_.size(); ++i) {
        sum_[i] += static_cast<double>(picture.rgb[i]);
    }
    ++count_;
}

Image PictureMean::mean() const {
    Image out(width_, height_);
    for (size_t i = 0; i < sum_.size(); ++i) {
        out.rgb[i] = static_cast<float>(sum_[i] / count_);
    }
    return out;
}

size_t PictureMean::faulty_pixels() const {
    size_t faulty = 0;
    for (size_t i = 0; i < sum_.size(); i += 3) {
        faulty += std::isfinite(sum_[i] + sum_[i + 1] + sum_[i + 2]) ? 0 : 1;
    }
    return faulty;
}

FrameReport render_samples(Renderer& renderer, const Moment& now, const Settings& settings,
                           gl::TimingMode timing, PictureMean& mean) {
    FrameReport first;
    Settings with = settings;
    int64_t gathered = 0;
    const std::vector<glm::dvec2> offsets = pixel_offsets(settings.samples);
    for (size_t i = 0; i < offsets.size(); ++i) {
        CameraView camera = now.camera;
        camera.offset_px = offsets[i];
        FrameReport report = renderer.render(now.pose, camera, with, timing);
        mean.add(renderer.read_color());
        gathered += report.gathered_pixels;
        if (i == 0) {
            first = std::move(report);
            with.find_unlit = false;  // what is missing from one frame is missing from all
            continue;
        }
        add_times(first.passes, report.passes);
        if (first.removed && report.removed) {
            first.removed->indirect += report.removed->indirect;
            first.removed->removed += report.removed->removed;
        }
    }
    if (first.gathered_pixels >= 0) {
        first.gathered_pixels = static_cast<int>(gathered / settings.samples);
    }
    if (first.removed) {
        first.removed->indirect /= settings.samples;
        first.removed->removed /= settings.samples;
    }
    return first;
}

}  // namespace bounce
