// SPDX-License-Identifier: Apache-2.0
//
// Direct light from an area light without shadows. Where it sends the same radiance everywhere, irradiance is the
// polygon's in closed form (Lambert 1760; Baum et al. 1989, "Improving Radiosity Solutions Through the Use of
// Analytically Determined Form-Factors"), cut off at the horizon: exact however near the light is. A grid of points
// tells how the diffuse lobe and a spread differ from that. A glossy lobe is lib/lobe.glsl's (LOBES); with a spread it is
// that grid's. PROFILE is PROFILE_AREA.
#ifndef LIB_AREA_LIGHT
#define LIB_AREA_LIGHT

#include "lib/brdf.glsl"
#include "lib/light.glsl"

// Points a side of the grid. A spread has an edge of its own, which needs more.
const int AREA_GRID = 4;
const int AREA_GRID_SPREAD = 8;

// The part of the light that can reach a receiver: middle and half sides, as parts of the light's own half sides.
struct AreaPart {
    vec2 middle;
    vec2 half_size;
};

vec3 area_point(vec2 at) {
    return light.position.xyz + light.tangent.xyz * (at.x * light.area.x) + light.bitangent.xyz * (at.y * light.area.y);
}

// With a spread light comes only from within a circle around the receiver's foot on the light's plane; this is the
// square around it.
AreaPart reaching_part(vec3 position) {
    vec3 p = light_from_render(position);
    vec2 low = vec2(-1.0);
    vec2 high = vec2(1.0);
    if (light.area.z > 0.0) {
        vec2 foot = p.xy / max(light.area.xy, 1e-20);
        vec2 radius = vec2(max(p.z, 0.0) / light.area.z) / max(light.area.xy, 1e-20);
        low = clamp(foot - radius, -1.0, 1.0);
        high = clamp(foot + radius, -1.0, 1.0);
    }
    return AreaPart(0.5 * (low + high), 0.5 * (high - low));
}

vec2 polygon_corner(int i, AreaPart part) {
    if (light.map.w > 0.5) {
        float angle = 2.0 * PI * float(i) / float(ELLIPSE_CORNERS);
        return ELLIPSE_RADIUS * vec2(cos(angle), sin(angle));
    }
    return part.middle + part.half_size * vec2(i == 1 || i == 2 ? 1.0 : -1.0, i >= 2 && i < 4 ? 1.0 : -1.0);
}

// Twice what the edge from a to b, both seen from the receiver, adds to the polygon's irradiance at radiance 1.
float edge_term(vec3 n, vec3 a, vec3 b) {
    // With b - a and not b: the light's edges are exact, and far lights live from their differences.
    vec3 normal = cross(a, b - a);
    float s = length(normal);
    float angle = atan(s, dot(a, b));
    return s > 0.0 ? angle * dot(n, normal) / s : 0.0;
}

// Irradiance, from radiance 1 of the part of the light, on a plane through `position`.
float polygon_irradiance(vec3 position, vec3 n, AreaPart part) {
    int corners = light.map.w > 0.5 ? ELLIPSE_CORNERS : 4;
    float sum = 0.0;
    vec3 leaving = vec3(0.0);
    vec3 entering = vec3(0.0);
    vec3 a = area_point(polygon_corner(corners - 1, part)) - position;
    float height_a = dot(n, a);
    for (int i = 0; i < corners; ++i) {
        vec3 b = area_point(polygon_corner(i, part)) - position;
        float height_b = dot(n, b);
        bool leaves = height_a >= 0.0 && height_b < 0.0;
        bool enters = height_a < 0.0 && height_b >= 0.0;
        vec3 cut = a + (b - a) * (height_a / (leaves || enters ? height_a - height_b : 1.0));
        leaving = leaves ? cut : leaving;
        entering = enters ? cut : entering;
        float term = edge_term(n, enters ? cut : a, leaves ? cut : b);
        sum += max(height_a, height_b) >= 0.0 ? term : 0.0;
        a = b;
        height_a = height_b;
    }
    // A convex polygon crosses the horizon twice or not at all; the horizon itself closes it.
    sum += edge_term(n, leaving, entering);
    return 0.5 * abs(sum);
}

vec3 area_light(Surface s, vec3 v) {
    AreaPart part = reaching_part(s.position);
    int side = light.area.z > 0.0 ? AREA_GRID_SPREAD : AREA_GRID;
    bool round_ = light.map.w > 0.5;
    float lambert = 0.0;      // of the grid, at constant radiance
    vec3 diffuse = vec3(0.0);
    vec3 glossy = vec3(0.0);
    for (int i = 0; i < side * side; ++i) {
        vec2 u = (vec2(i % side, i / side) + 0.5) / float(side);
        // A disk or ellipse: radius by the square root keeps the points' areas equal.
        float angle = 2.0 * PI * (u.y + 0.5 * u.x);
        vec2 at = round_ ? sqrt(u.x) * vec2(cos(angle), sin(angle)) : part.middle + part.half_size * (u * 2.0 - 1.0);
        vec3 d = area_point(at) - s.position;
        float squared = max(dot(d, d), 1e-20);
        vec3 l = d * inversesqrt(squared);
        vec3 from_light = -light_vector_from_render(l);
        float profile = light_profile(from_light) / squared;
        float n_dot_l = max(dot(s.normal, l), 0.0);
        lambert += n_dot_l * max(from_light.z, 0.0) / squared;
        diffuse += reflected_diffuse(s, l, v, 0.0) * profile;
#ifndef LOBES
        glossy += reflected_glossy(s, l, v) * profile;
#endif
    }
    float share = round_ ? 1.0 : part.half_size.x * part.half_size.y;
    float weight = share / float(side * side);
    // The grid is right far away; near the light the polygon is, and floats can tell its edges apart.
    vec3 middle = light.position.xyz - s.position;
    float near = dot(light.area.xy, light.area.xy) / max(dot(middle, middle), 1e-20);
    if (near > 1e-3 && lambert > 0.0 && weight > 0.0 && dot(middle, light.axis.xyz) < 0.0) {
        float area = (round_ ? PI : 4.0) * light.area.x * light.area.y;
        diffuse *= polygon_irradiance(s.position, s.normal, part) / (area * weight * lambert);
    }
#ifdef LOBES
    vec3 half_x = light.tangent.xyz * light.area.x;
    vec3 half_y = light.bitangent.xyz * light.area.y;
    float whole = max((round_ ? PI : 4.0) * light.area.x * light.area.y, 1e-30);
    bool seen = dot(middle, light.axis.xyz) < 0.0;
    glossy = seen ? reflected_flat_light(s, v, FlatLight(middle, half_x, half_y, round_)).radiance / whole : vec3(0.0);
    return light.intensity.rgb * (diffuse * weight + glossy);
#else
    return light.intensity.rgb * (diffuse + glossy) * weight;
#endif
}

#endif
