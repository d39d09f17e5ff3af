// SPDX-License-Identifier: Apache-2.0
#ifndef LIB_MATH
#define LIB_MATH

const float PI = 3.14159265358979;

// An ellipse is a polygon of the same area; its outline is off by 1.3 % of the radius at most, to both sides.
const int ELLIPSE_CORNERS = 16;
const float ELLIPSE_RADIUS = sqrt(2.0 * PI / (float(ELLIPSE_CORNERS) * sin(2.0 * PI / float(ELLIPSE_CORNERS))));

// Octahedral map of unit vectors to [-1, 1]^2 (Cigolle et al. 2014, "A Survey of Efficient
// Representations for Independent Unit Vectors").
vec2 octahedral_encode(vec3 n) {
    vec2 p = n.xy / (abs(n.x) + abs(n.y) + abs(n.z));
    vec2 folded = (1.0 - abs(p.yx)) * vec2(p.x >= 0.0 ? 1.0 : -1.0, p.y >= 0.0 ? 1.0 : -1.0);
    return n.z >= 0.0 ? p : folded;
}

vec3 octahedral_decode(vec2 e) {
    vec3 n = vec3(e, 1.0 - abs(e.x) - abs(e.y));
    float t = max(-n.z, 0.0);
    n.x += n.x >= 0.0 ? -t : t;
    n.y += n.y >= 0.0 ? -t : t;
    return normalize(n);
}

// A unit vector, or the fallback where v has no direction.
vec3 safe_normalize(vec3 v, vec3 fallback) {
    float squared = dot(v, v);
    return squared > 1e-30 ? v * inversesqrt(squared) : fallback;
}

// Two unit vectors that span the plane across n (Duff et al. 2017, "Building an Orthonormal Basis, Revisited").
void orthonormal_basis(vec3 n, out vec3 t, out vec3 b) {
    float s = n.z >= 0.0 ? 1.0 : -1.0;
    float a = -1.0 / (s + n.z);
    float c = n.x * n.y * a;
    t = vec3(1.0 + s * n.x * n.x * a, s * c, -s * n.x);
    b = vec3(c, s + n.y * n.y * a, -n.y);
}

#endif
