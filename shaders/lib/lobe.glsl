// SPDX-License-Identifier: Apache-2.0
//
// What a GGX lobe reflects of a flat light of even radiance: a linearly transformed cosine (Heitz et al. 2016,
// "Real-Time Polygonal-Light Shading with Linearly Transformed Cosines") whose fits are ours (gpu/lobe_fit.h), for the
// law in lib/brdf.glsl.
#ifndef LIB_LOBE
#define LIB_LOBE

#include "lib/brdf.glsl"
#include "shared/bindings.h"

// Columns: 1 - u^2 is the cosine to the viewer; rows: roughness; both from 0 to 1 at the middles of the first and last
// texel. Layer 0: LobeFit; layer 1: what the lobe reflects of reflectance at normal incidence, and of its rise.
layout(binding = TEX_LOBES) uniform sampler2DArray lobe_texture;

// As gpu/lobe_fit.h has it.
const float LOBE_LEAST_COSINE = 0.01;
// Seen from the cosine a light that is smaller than the first is a point, one that is larger than the second a
// polygon: below the first the sum over the polygon's edges has fewer right digits than a point, which is off by the
// square of the size.
const vec2 LOBE_POINT_SIZE = vec2(0.01, 0.02);

// A flat light as it is seen from the receiver: middle, and half of its extent along two directions; render space. A
// round one is the ellipse within.
struct FlatLight {
    vec3 middle;
    vec3 x;
    vec3 y;
    bool round_;
};

// Directions of the cosine, from render space: dot products with the rows.
struct Lobe {
    vec3 row_x;
    vec3 row_y;
    vec3 row_z;
    vec3 in_plane;  // columns of the inverse
    vec3 across;
    vec3 axis;
    float widths;   // determinant of the inverse
    float albedo;   // what it reflects of an even world, for a reflectance of 1
    vec3 fresnel;   // reflectance, the mean over the lobe
};

struct Reflected {
    vec3 radiance;  // for radiance 1 all over the light
    vec3 toward;    // unit, the middle of the reflected light
    float share;    // of the lobe that the light fills, 0 to 1
};

Lobe fitted_lobe(Surface s, vec3 v) {
    float n_dot_v = clamp(dot(s.normal, v), LOBE_LEAST_COSINE, 1.0);
    vec2 size = vec2(textureSize(lobe_texture, 0).xy);
    vec2 place = (vec2(sqrt(1.0 - n_dot_v), clamp(s.roughness, 0.0, 1.0)) * (size - 1.0) + 0.5) / size;
    vec3 fit = textureLod(lobe_texture, vec3(place, 0.0), 0.0).xyz;
    vec2 part = textureLod(lobe_texture, vec3(place, 1.0), 0.0).xy;

    // Towards where the view is mirrored; any direction where it is seen head on.
    vec3 t, b;
    orthonormal_basis(s.normal, t, b);
    vec3 x = safe_normalize(s.normal * dot(s.normal, v) - v, t);
    vec3 y = cross(s.normal, x);
    float sin_v = min(length(cross(s.normal, v)), sqrt(1.0 - LOBE_LEAST_COSINE * LOBE_LEAST_COSINE));
    float cos_v = sqrt(1.0 - sin_v * sin_v);
    float cos_shift = sqrt(1.0 - fit.z * fit.z);
    float sin_psi = sin_v * cos_shift + cos_v * fit.z;
    float cos_psi = max(cos_v * cos_shift - sin_v * fit.z, 1e-3);
    float alpha = max(s.roughness * s.roughness, 1e-3);
    float p = fit.x * alpha;
    float c = fit.y * alpha;

    Lobe lobe;
    lobe.row_x = (x * cos_psi - s.normal * sin_psi) / p;
    lobe.row_y = y / c;
    lobe.row_z = s.normal / cos_psi;
    lobe.in_plane = x * (p / cos_psi);
    lobe.across = y * c;
    lobe.axis = x * sin_psi + s.normal * cos_psi;
    lobe.widths = p * c;
    lobe.albedo = part.x + part.y;
    vec3 sum = specular_f0(s) * part.x + (s.specular > 0.0 || s.metallic > 0.0 ? part.y : 0.0);
    lobe.fresnel = sum / lobe.albedo;
    return lobe;
}

vec3 to_cosine(Lobe lobe, vec3 d) {
    return vec3(dot(lobe.row_x, d), dot(lobe.row_y, d), dot(lobe.row_z, d));
}

// Angle over sine times the normal of the edge's plane, for an edge from a to b: 2 pi times what it adds to the
// polygon's vector irradiance (Lambert 1760; Arvo 1994, "The Irradiance Jacobian for Partially Occluded Polyhedral
// Sources").
vec3 edge_vector(vec3 a, vec3 b) {
    // With b - a and not b: the light's edges are exact, and small lights live from their differences. For these
    // arctangents of drivers are too coarse as well.
    vec3 normal = cross(a, b - a);
    float s = length(normal);
    float c = dot(a, b);
    float t = s / c;
    float t2 = t * t;
    float angle = c > 0.0 && t < 0.2 ? t * (1.0 - t2 * (1.0 / 3.0 - t2 * (0.2 - t2 / 7.0))) : atan(s, c);
    return s > 0.0 ? normal * (angle / s) : vec3(0.0);
}

float cosine_of(vec3 d) {
    return d.z * inversesqrt(max(dot(d, d), 1e-30));
}

// What a polygon's part above z = 0 is to a clamped cosine.
struct Filled {
    float share;
    vec3 toward;  // unit: the mean direction, weighed by the cosine
    float even;   // lowest over highest of its cosines: 1 where it is small, 0 where the horizon cuts it
};

Filled filled_cosine(vec3 middle, vec3 x, vec3 y, bool round_) {
    int corners = round_ ? ELLIPSE_CORNERS : 4;
    float turn = 2.0 * PI / float(corners);
    mat2 turned = mat2(cos(turn), sin(turn), -sin(turn), cos(turn));
    vec2 at = round_ ? vec2(ELLIPSE_RADIUS, 0.0) : vec2(1.0, 1.0);
    vec3 first = middle + at.x * x + at.y * y;
    vec3 sum = vec3(0.0);
    vec3 leaving = vec3(0.0);
    vec3 entering = vec3(0.0);
    vec3 a = first;
    float lowest = cosine_of(first);
    float highest = lowest;
    for (int i = 1; i <= corners; ++i) {
        at = turned * at;
        vec3 b = i == corners ? first : middle + at.x * x + at.y * y;
        bool leaves = a.z >= 0.0 && b.z < 0.0;
        bool enters = a.z < 0.0 && b.z >= 0.0;
        vec3 cut = a + (b - a) * (a.z / (leaves || enters ? a.z - b.z : 1.0));
        leaving = leaves ? cut : leaving;
        entering = enters ? cut : entering;
        sum += max(a.z, b.z) >= 0.0 ? edge_vector(enters ? cut : a, leaves ? cut : b) : vec3(0.0);
        a = b;
        lowest = min(lowest, cosine_of(b));
        highest = max(highest, cosine_of(b));
    }
    // A convex polygon crosses the horizon twice or not at all; the horizon itself closes it.
    sum += edge_vector(leaving, entering);
    sum *= (sum.z < 0.0 ? -0.5 : 0.5) / PI;

    // The vector's direction is the mean without the cosine. With it the mean height is the mean square over the mean; the
    // variance is that of heights even between the lowest and the highest corner.
    Filled out_;
    out_.share = clamp(sum.z, 0.0, 1.0);
    vec3 mean = safe_normalize(sum, vec3(0.0, 0.0, 1.0));
    float between = max(highest, 0.0) - max(lowest, 0.0);
    float z = min(mean.z + between * between / (12.0 * max(mean.z, 1e-6)), max(highest, mean.z));
    float flat_ = sqrt(max(1.0 - z * z, 0.0) / max(1.0 - mean.z * mean.z, 1e-12));
    out_.toward = vec3(mean.xy * flat_, z);
    out_.even = clamp(lowest / max(max(highest, mean.z), 1e-6), 0.0, 1.0);
    return out_;
}

Reflected reflected_flat_light(Surface s, vec3 v, FlatLight flat_) {
    Lobe lobe = fitted_lobe(s, v);
    vec3 middle = to_cosine(lobe, flat_.middle);
    vec3 x = to_cosine(lobe, flat_.x);
    vec3 y = to_cosine(lobe, flat_.y);

    // As a point.
    float squared = max(dot(flat_.middle, flat_.middle), 1e-30);
    vec3 toward = flat_.middle * inversesqrt(squared);
    float solid_angle =
        abs(dot(cross(flat_.x, flat_.y), toward)) * ((flat_.round_ ? PI : 4.0) / squared);
    float size = sqrt(max(dot(x, x), dot(y, y)) / max(dot(middle, middle), 1e-30));
    float polygon = smoothstep(LOBE_POINT_SIZE.x, LOBE_POINT_SIZE.y, size);

    // As a polygon: the share that it fills of the cosine, and what that is worth. The fit is held against the law in the
    // mean direction of what is reflected; but where the light fills much of the lobe the lobe's own sums are right, and
    // where it is large one direction does not tell for all. The exponents are those with the least error in
    // tests/shaders/lobe_test.cpp.
    Filled filled = filled_cosine(middle, x, y, flat_.round_);
    vec3 mean = lobe.in_plane * filled.toward.x + lobe.across * filled.toward.y + lobe.axis * filled.toward.z;
    float stretch = length(mean);
    float density = filled.toward.z * stretch * stretch * stretch / (PI * lobe.widths);
    bool fills = polygon > 0.0 && filled.share > 0.0 && density > 1e-20;
    toward = fills ? safe_normalize(mean, s.normal) : toward;
    float law = ggx_times_cosine(s, toward, v);
    vec3 fresnel = specular_fresnel(s, toward, v);
    float worth = mix(law / (fills ? density : 1.0), lobe.albedo, pow(filled.share, mix(0.25, 1.0, filled.even)));
    vec3 filled_radiance = (filled.share * worth) * mix(fresnel, lobe.fresnel, filled.share * filled.share);

    Reflected out_;
    out_.toward = toward;
    out_.share = polygon * filled.share;
    // Not by mix(): a large light near by is as a point a number in which the other is lost.
    out_.radiance = fresnel * (law * solid_angle * (1.0 - polygon)) + (fills ? filled_radiance * polygon : vec3(0.0));
    return out_;
}

#endif
