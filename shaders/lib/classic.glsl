// SPDX-License-Identifier: Apache-2.0
//
// Five faces of a cube over a light's hemisphere, in the frame of its map (tangent, bitangent, normal): right, up and
// forward of a face, right x up = -forward as OpenGL draws.
#ifndef LIB_CLASSIC
#define LIB_CLASSIC

const int CLASSIC_FACES = 5;

void classic_face(int face, out vec3 right, out vec3 up, out vec3 forward) {
    const vec3 s = vec3(1.0, 0.0, 0.0);
    const vec3 t = vec3(0.0, 1.0, 0.0);
    const vec3 n = vec3(0.0, 0.0, 1.0);
    right = face == 0 ? n : face == 1 ? t : face == 2 ? s : face == 3 ? n : t;
    up = face == 0 ? t : face == 1 ? n : face == 2 ? n : s;
    forward = -cross(right, up);
}

// The face that a direction with z >= 0 lies on.
int classic_face_of(vec3 d) {
    vec3 a = abs(d);
    return a.z >= a.x && a.z >= a.y ? 4 : a.x >= a.y ? (d.x > 0.0 ? 0 : 1) : (d.y > 0.0 ? 2 : 3);
}

#endif
