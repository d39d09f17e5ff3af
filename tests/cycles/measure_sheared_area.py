# SPDX-License-Identifier: Apache-2.0
"""What Cycles makes of an area light whose object is sheared: measured against the law of docs/lights.md.

    blender -b --factory-startup --python-exit-code 1 -P tests/cycles/measure_sheared_area.py

Cycles takes the light's two axes from the object's matrix and samples the solid angle of the rectangle that they would
span if they were perpendicular (Urena et al. 2013, "An Area-Preserving Parametrization for Spherical Rectangles"). With
unit axes x and y that are not, and z = x cross y, a receiver at P therefore sees a place C of the light in the direction
M (C - P), M = x x^T + y y^T + z z^T, as bright as the rectangle in those coordinates. Prints Cycles over that law at 25
places of a white floor under the light of the case area-sheared; fails where one is off by more than 4 % (noise and the
width of a pixel) or the mean by more than 1 %.
"""
import math
import os
import sys
import tempfile
from pathlib import Path

import bpy
import numpy as np

sys.path.insert(0, str(Path(__file__).resolve().parents[2] / "examples"))
import common  # noqa: E402

SIDE, FRAME_M, PIECES, POWER, WIDTH, HEIGHT = 16, 8.0, 24, 250.0, 0.6, 0.3


def build():
    scene = common.new_scene("Sheared area light")
    common.set_world((0.0, 0.0, 0.0))
    common.quad("Floor", [(-100, -100, 0), (100, -100, 0), (100, 100, 0), (-100, 100, 0)],
                common.diffuse("White", (1.0, 1.0, 1.0)))
    light = common.add_light("Light", "AREA", (-1.2, 0.9, 3.2), POWER, shape="RECTANGLE", size=WIDTH, size_y=HEIGHT)
    common.look_at(light, (0.0, 0.0, 0.3))
    parent = common.add_object("Parent", None, (0.5, 0.25, 0.0))
    parent.scale, parent.rotation_euler = (2.0, 1.0, 1.0), (0.0, 0.0, 0.4)
    light.parent = parent
    camera = bpy.data.cameras.new("Camera")
    camera.type, camera.ortho_scale = "ORTHO", FRAME_M
    scene.camera = common.add_object("Camera", camera, (0.0, 0.0, 10.0))
    return scene, light


def render(scene):
    scene.render.resolution_x = scene.render.resolution_y = SIDE
    scene.render.image_settings.file_format = "OPEN_EXR"
    scene.render.image_settings.color_depth = "32"
    scene.cycles.samples, scene.cycles.max_bounces = 1024, 0
    scene.cycles.use_denoising = scene.cycles.use_adaptive_sampling = False
    with tempfile.TemporaryDirectory() as folder:
        scene.render.filepath = os.path.join(folder, "sheared.exr")
        bpy.ops.render.render(write_still=True)
        image = bpy.data.images.load(scene.render.filepath)
        return np.array(image.pixels[:]).reshape(SIDE, SIDE, 4)[:, :, 0]


def law(matrix, place):
    """Radiance of the floor at a place."""
    u, v = matrix[:3, 0] * WIDTH, matrix[:3, 1] * HEIGHT
    width, height = np.linalg.norm(u), np.linalg.norm(v)
    x, y = u / width, v / height
    z = np.cross(x, y)
    corner = matrix[:3, 3] - 0.5 * u - 0.5 * v - place
    steps = (np.arange(PIECES) + 0.5) / PIECES
    along, across, away = corner @ x + steps[:, None] * width, corner @ y + steps[None, :] * height, corner @ z
    direction = along[..., None] * x + across[..., None] * y + away * z
    cosine = np.maximum(direction[..., 2], 0.0) / np.linalg.norm(direction, axis=-1)
    solid_angle = abs(away) * width * height / PIECES**2 / (along**2 + across**2 + away**2) ** 1.5
    return POWER / (4.0 * width * height) * (cosine * solid_angle).sum() / math.pi


def main():
    scene, light = build()
    picture = render(scene)
    matrix = np.array(light.matrix_world)
    places = range(1, SIDE, 3)
    got = np.array([[picture[j, i] for i in places] for j in places])
    expected = np.array([[law(matrix, np.array([(i + 0.5) / SIDE - 0.5, (j + 0.5) / SIDE - 0.5, 0.0]) * FRAME_M) for i in places]
                         for j in places])
    print((got / expected).round(3))
    mean = got.mean() / expected.mean()
    print(f"mean {mean:.4f}")
    if abs(got / expected - 1.0).max() > 0.04 or abs(mean - 1.0) > 0.01:
        raise SystemExit("measure_sheared_area: Cycles is not the law")


main()
