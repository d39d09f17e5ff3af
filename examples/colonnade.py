# SPDX-License-Identifier: Apache-2.0
"""A colonnade in the low sun. Its shade is lit by what the floor and the hanging cloths throw back.

    blender -b --factory-startup -P examples/colonnade.py -- colonnade.blend
"""

import math
import sys
from pathlib import Path

import bpy

sys.path.insert(0, str(Path(__file__).resolve().parent))
import common  # noqa: E402

BAYS, BAY = 7, 2.4
HALF_SPAN, COLUMN_HEIGHT = 2.2, 4.0
LENGTH = BAYS * BAY
SHAFT_SEGMENTS, SHAFT_RINGS, FLUTES = 60, 14, 20


def column_mesh(material):
    """A fluted shaft with entasis on a round base, under a square abacus; one mesh for all columns."""
    vertices, faces = [], []

    def append(new_vertices, new_faces):
        offset = len(vertices)
        vertices.extend(new_vertices)
        faces.extend(tuple(i + offset for i in face) for face in new_faces)

    append(*common.lathe_geometry(
        [(0.42, 0.0), (0.42, 0.1), (0.4, 0.13), (0.36, 0.16), (0.38, 0.2), (0.38, 0.26), (0.33, 0.3)], SHAFT_SEGMENTS))
    bottom, top = 0.3, COLUMN_HEIGHT - 0.45
    shaft = []
    for ring in range(SHAFT_RINGS + 1):
        t = ring / SHAFT_RINGS
        radius = 0.31 * (1.0 - 0.16 * t * t)
        for s in range(SHAFT_SEGMENTS):
            angle = 2 * math.pi * s / SHAFT_SEGMENTS
            fluted = radius * (1.0 - 0.05 * (0.5 - 0.5 * math.cos(FLUTES * angle)))
            shaft.append((fluted * math.cos(angle), fluted * math.sin(angle), bottom + t * (top - bottom)))
    _, shaft_faces = common.lathe_geometry([(1.0, 0.0)] * (SHAFT_RINGS + 1), SHAFT_SEGMENTS)
    append(shaft, shaft_faces)
    append(*common.lathe_geometry(
        [(0.26, top), (0.29, top + 0.04), (0.29, top + 0.08), (0.42, top + 0.25)], SHAFT_SEGMENTS))
    half, low, high = 0.46, COLUMN_HEIGHT - 0.2, COLUMN_HEIGHT
    append([(sx * half, sy * half, z) for z in (low, high) for sx, sy in ((-1, -1), (1, -1), (1, 1), (-1, 1))],
           [(3, 2, 1, 0), (4, 5, 6, 7), (0, 1, 5, 4), (1, 2, 6, 5), (2, 3, 7, 6), (3, 0, 4, 7)])
    mesh = bpy.data.meshes.new("Column")
    mesh.from_pydata(vertices, [], faces)
    mesh.materials.append(material)
    mesh.polygons.foreach_set("use_smooth", [True] * len(mesh.polygons))
    mesh.use_auto_smooth, mesh.auto_smooth_angle = True, math.radians(35)
    return mesh


def build_columns(stone):
    mesh = column_mesh(stone)
    for side, x in (("left", -HALF_SPAN), ("right", HALF_SPAN)):
        for bay in range(BAYS + 1):
            common.add_object(f"Column {side} {bay + 1}", mesh, (x, bay * BAY, 0.0))
        common.box(f"Architrave {side}", (1.0, LENGTH + 1.2, 0.7),
                   (x, LENGTH / 2, COLUMN_HEIGHT + 0.35), stone, bevel=0.05)


def build_hall():
    light_tile = common.principled("Light tile", (0.72, 0.64, 0.5))
    dark_tile = common.principled("Dark tile", (0.42, 0.2, 0.12))
    plaster = common.principled("Ochre plaster", (0.74, 0.5, 0.26))
    ceiling = common.principled("Whitewash", (0.8, 0.77, 0.7))
    size = 0.8
    for material, parity in ((light_tile, 0), (dark_tile, 1)):
        vertices, faces = [], []
        for i in range(-5, 5):
            for j in range(-3, int(LENGTH / size) + 3):
                if (i + j) % 2 != parity:
                    continue
                x, y = i * size, j * size
                faces.append(tuple(range(len(vertices), len(vertices) + 4)))
                vertices += [(x, y, 0.0), (x + size, y, 0.0), (x + size, y + size, 0.0), (x, y + size, 0.0)]
        common.add_mesh(material.name + "s", vertices, faces, material)
    common.box("Wall", (0.4, LENGTH + 4.8, COLUMN_HEIGHT + 0.7),
               (-4.2, LENGTH / 2, (COLUMN_HEIGHT + 0.7) / 2), plaster)
    common.box("End wall", (8.8, 0.4, COLUMN_HEIGHT + 0.7),
               (0.0, LENGTH + 2.6, (COLUMN_HEIGHT + 0.7) / 2), plaster)
    common.box("Roof", (7.2, LENGTH + 5.2, 0.3), (-0.85, LENGTH / 2, COLUMN_HEIGHT + 0.85), ceiling)
    ground = common.diffuse("Sand", (0.55, 0.45, 0.32))
    common.quad("Ground", [(-60, -60, -0.02), (60, -60, -0.02), (60, 80, -0.02), (-60, 80, -0.02)], ground)


def build_cloth(name, bay, color):
    """A cloth hanging between two columns of the left row, with folds that deepen towards its hem."""
    width, height, columns, rows = 1.5, 2.9, 72, 28
    vertices = []
    for row in range(rows + 1):
        t = row / rows
        for column in range(columns + 1):
            u = column / columns
            fold = (0.03 + 0.09 * t) * math.sin(u * 7 * math.pi + 0.6 * math.sin(3 * t))
            sag = 0.12 * (1.0 - t) * math.sin(u * math.pi)
            vertices.append((fold, (u - 0.5) * width, COLUMN_HEIGHT - 0.3 - sag - t * height))
    faces = [
        (row * (columns + 1) + c, row * (columns + 1) + c + 1,
         (row + 1) * (columns + 1) + c + 1, (row + 1) * (columns + 1) + c)
        for row in range(rows) for c in range(columns)
    ]
    common.add_mesh(name, vertices, faces, common.diffuse(name, color), smooth=True,
                    location=(-HALF_SPAN, (bay + 0.5) * BAY, 0.0))


def build_light():
    sun = common.add_light("Sun", "SUN", (8.0, 4.0, 9.0), 4.2, (1.0, 0.87, 0.68), angle=0.0)
    common.key(sun, "rotation_euler", [
        (common.FRAME_START, (math.radians(14), math.radians(56), 0.0)),
        (common.FRAME_END, (math.radians(22), math.radians(47), 0.0)),
    ], "LINEAR")
    common.name_action(sun, "Sun sinks")


def build_camera():
    camera = common.add_camera((-1.2, -2.6, 1.65), (0.0, 8.0, 1.9), 24.0)
    target = common.add_object("Camera target", None, (-0.5, 8.0, 1.85))
    track = camera.constraints.new("TRACK_TO")
    track.target, track.track_axis, track.up_axis = target, "TRACK_NEGATIVE_Z", "UP_Y"
    common.key(camera, "location", [
        (common.FRAME_START, (0.9, -1.6, 1.65)), (common.FRAME_END, (0.2, 1.2, 1.75)),
    ])
    common.name_action(camera, "Walk")
    common.key(target, "location", [
        (common.FRAME_START, (-0.9, 8.0, 1.9)), (common.FRAME_END, (-1.2, 10.0, 1.9)),
    ])
    common.name_action(target, "Look")


def build():
    common.new_scene("Colonnade")
    common.set_world((0.25, 0.42, 0.75), 0.35)
    build_columns(common.principled("Limestone", (0.74, 0.69, 0.6)))
    build_hall()
    build_cloth("Red cloth", 1, (0.62, 0.05, 0.04))
    build_cloth("Blue cloth", 3, (0.06, 0.16, 0.5))
    build_cloth("Saffron cloth", 5, (0.75, 0.38, 0.03))
    build_light()
    build_camera()


common.run(build)
