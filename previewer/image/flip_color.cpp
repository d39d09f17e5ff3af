// SPDX-License-Identifier: Apache-2.0
#include "image/flip_color.h"

#include <cmath>

#include <glm/geometric.hpp>
#include <glm/mat3x3.hpp>
#include <glm/matrix.hpp>
#include <glm/vec2.hpp>

namespace bounce::flip {
namespace {

// XYZ from linear RGB as exact fractions of the sRGB primaries; glm's constructor takes columns.
const glm::mat3 k_xyz_from_linear{
    10135552.0F / 24577794.0F, 2613072.0F / 12288897.0F, 1425312.0F / 73733382.0F,   // red
    8788810.0F / 24577794.0F,  8788810.0F / 12288897.0F, 8788810.0F / 73733382.0F,   // green
    4435075.0F / 24577794.0F,  887015.0F / 12288897.0F,  70074185.0F / 73733382.0F,  // blue
};
const glm::mat3 k_linear_from_xyz = glm::inverse(k_xyz_from_linear);
const glm::vec3 k_white = k_xyz_from_linear * glm::vec3(1.0F);

// The curve of CIELab: a cube root with a line below (6/29)^3.
float lab_curve(float t) {
    constexpr float delta = 6.0F / 29.0F;
    return t > delta * delta * delta ? std::cbrt(t) : t / (3.0F * delta * delta) + 4.0F / 29.0F;
}

}  // namespace

glm::vec3 ycxcz_from_linear(const glm::vec3& linear) {
    const glm::vec3 xyz = (k_xyz_from_linear * linear) / k_white;
    return {116.0F * xyz.y - 16.0F, 500.0F * (xyz.x - xyz.y), 200.0F * (xyz.y - xyz.z)};
}

glm::vec3 linear_from_ycxcz(const glm::vec3& ycxcz) {
    const float y = (ycxcz.x + 16.0F) / 116.0F;
    const glm::vec3 xyz{y + ycxcz.y / 500.0F, y, y - ycxcz.z / 200.0F};
    return k_linear_from_xyz * (xyz * k_white);
}

glm::vec3 lab_from_linear(const glm::vec3& linear) {
    const glm::vec3 xyz = (k_xyz_from_linear * linear) / k_white;
    const float x = lab_curve(xyz.x);
    const float y = lab_curve(xyz.y);
    const float z = lab_curve(xyz.z);
    return {116.0F * y - 16.0F, 500.0F * (x - y), 200.0F * (y - z)};
}

glm::vec3 hunt_adjusted(const glm::vec3& lab) {
    return {lab.x, 0.01F * lab.x * lab.y, 0.01F * lab.x * lab.z};
}

float hyab(const glm::vec3& a, const glm::vec3& b) {
    const glm::vec3 difference = a - b;
    return std::abs(difference.x) + glm::length(glm::vec2(difference.y, difference.z));
}

}  // namespace bounce::flip
