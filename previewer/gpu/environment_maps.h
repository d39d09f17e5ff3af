// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "gl/texture.h"
#include "gpu/shared_types.h"
#include "scene/scene.h"

namespace bounce::gpu {

// The world's image on the GPU (shaders/lib/environment.glsl, environment_glossy.glsl).
struct EnvironmentMaps {
    // Uploads the image with levels that average radiance by solid angle, and the lobes' table; `glossy` is
    // still to be drawn (passes/environment_prefilter.h). Throws input_error where the image is too large for
    // this OpenGL.
    explicit EnvironmentMaps(const scene::Environment& environment);

    gl::Texture image;
    gl::Texture glossy;  // ENVIRONMENT_LEVELS levels
    gl::Texture brdf;

    // For an image turned by a rotation, of a strength.
    [[nodiscard]] WorldUniforms uniforms(const glm::dmat3& render_from_environment, double strength) const;
};

}  // namespace bounce::gpu
