// SPDX-License-Identifier: Apache-2.0
#include "viewer/viewpoint.h"

#include <algorithm>

namespace bounce::viewer {

void Viewpoint::look_through(int node) {
    node_ = node;
    controls_.reset();
}

void Viewpoint::look_through_next(const Stage& stage) {
    const std::vector<int>& cameras = stage.cameras();
    const auto found = std::find(cameras.begin(), cameras.end(), node_);
    const bool at_end = found == cameras.end() || found + 1 == cameras.end();
    look_through(at_end ? cameras.front() : *(found + 1));
}

CameraControls& Viewpoint::free(const Stage& stage, int width, int height) {
    if (!controls_) {
        controls_.emplace(view(stage, width, height), stage.bounds());
    }
    return *controls_;
}

void Viewpoint::move_to(const Stage& before, const Stage& after) {
    const int found = node_ == scene::k_none ? scene::k_none : after.find_camera(before.camera_name(node_));
    node_ = found == scene::k_none ? after.scene().active_camera_node : found;
}

CameraView Viewpoint::view(const Stage& stage, int width, int height) const {
    return controls_ ? controls_->view() : stage.camera_view(node_, width, height);
}

}  // namespace bounce::viewer
