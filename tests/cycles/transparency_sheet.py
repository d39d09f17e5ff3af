# SPDX-License-Identifier: Apache-2.0
"""Blended surfaces under a point light without size and a sun, to hold against Cycles (docs/lights.md).

    blender -b --factory-startup -P tests/cycles/transparency_sheet.py -- leaves leaves.blend

`leaves`: cards that cross each other, their alpha an image that fades; `panels`: coloured half-transparent panes that
cross each other over a floor.
"""
import argparse
import math
import os
import random
import sys
from pathlib import Path

import bpy
from mathutils import Euler, Vector

sys.path.insert(0, str(Path(__file__).resolve().parents[2] / "examples"))
import common  # noqa: E402

SIDE = 64


def leaf_image():
    """A leaf whose alpha fades over its outer third; green, darker at the vein."""
    image = bpy.data.images.new("Leaf", SIDE, SIDE, alpha=True)
    pixels = []
    for y in range(SIDE):
        for x in range(SIDE):
            u, v = (x + 0.5) / SIDE * 2 - 1, (y + 0.5) / SIDE * 2 - 1
            inside = 1.0 - math.hypot(u / max(0.05, 0.8 * math.cos(0.5 * math.pi * abs(v))), v)
            vein = 0.55 if abs(u) < 0.06 else 1.0
            pixels += [0.25 * vein, 0.6 * vein, 0.15 * vein, min(1.0, max(0.0, 3.0 * inside))]
    image.pixels.foreach_set(pixels)
    image.pack()
    return image


def leaf_material():
    material = common.principled("Leaf", (1, 1, 1), roughness=0.6)
    nodes, links = material.node_tree.nodes, material.node_tree.links
    texture = nodes.new("ShaderNodeTexImage")
    texture.image, texture.extension = leaf_image(), "EXTEND"
    links.new(texture.outputs["Color"], nodes["Principled BSDF"].inputs["Base Color"])
    links.new(texture.outputs["Alpha"], nodes["Principled BSDF"].inputs["Alpha"])
    return material


def leaves():
    material = leaf_material()
    rng = random.Random(7)
    vertices, faces = [], []
    for _ in range(48):
        turn = Euler([rng.uniform(-1.2, 1.2), rng.uniform(-1.2, 1.2), rng.uniform(0, 2 * math.pi)]).to_matrix()
        middle = Vector([rng.gauss(0, 0.35), rng.gauss(0, 0.35), rng.uniform(0.5, 1.3)])
        first = len(vertices)
        vertices += [middle + turn @ Vector([x, y, 0]) for x, y in ((-.22, -.22), (.22, -.22), (.22, .22), (-.22, .22))]
        faces.append(tuple(range(first, first + 4)))
    cards = common.add_mesh("Leaves", vertices, faces, material)
    layer = cards.data.uv_layers.new(name="UVMap")
    for i, loop in enumerate(layer.data):
        loop.uv = ((0, 0), (1, 0), (1, 1), (0, 1))[i % 4]
    common.box("Trunk", (0.08, 0.08, 0.9), (0, 0, 0.45), common.diffuse("Bark", (0.3, 0.2, 0.12)))


def panels():
    for i, (color, alpha, place, turn) in enumerate((
            ((0.8, 0.15, 0.1), 0.5, (-0.5, 0.0, 0.6), 0.5), ((0.1, 0.3, 0.8), 0.4, (-0.1, 0.1, 0.55), -0.6),
            ((0.8, 0.7, 0.1), 0.3, (0.45, -0.1, 0.6), 0.2), ((0.1, 0.7, 0.3), 0.6, (0.55, 0.35, 0.5), -1.1))):
        material = common.principled(f"Pane {i}", color, roughness=0.3)
        material.node_tree.nodes["Principled BSDF"].inputs["Alpha"].default_value = alpha
        pane = common.quad(f"Pane {i}", [(-.55, 0, -.5), (.55, 0, -.5), (.55, 0, .5), (-.55, 0, .5)], material)
        pane.location, pane.rotation_euler = place, (0.15 * i, 0, turn)
    common.box("Block", (0.3, 0.3, 0.3), (-0.1, 0.7, 0.15), common.diffuse("White", (0.8, 0.8, 0.8)))


def main():
    parser = argparse.ArgumentParser(prog="transparency_sheet.py")
    parser.add_argument("scene", choices=["leaves", "panels"])
    parser.add_argument("output", metavar="OUT.blend")
    arguments = parser.parse_args(sys.argv[sys.argv.index("--") + 1:] if "--" in sys.argv else [])
    common.new_scene(f"Transparency: {arguments.scene}")
    common.set_world((0.0, 0.0, 0.0))
    floor = common.diffuse("Grey", (0.6, 0.6, 0.6))
    common.quad("Floor", [(-4, -4, 0), (4, -4, 0), (4, 4, 0), (-4, 4, 0)], floor)
    {"leaves": leaves, "panels": panels}[arguments.scene]()
    common.add_light("Point", "POINT", (-1.4, -0.8, 2.4), 150.0, shadow_soft_size=0.0)
    sun = common.add_light("Sun", "SUN", (1.5, -1.0, 3.0), 1.5, angle=0.0)
    common.look_at(sun, (0.0, 0.0, 0.0))
    common.add_camera((0.4, -3.2, 1.7), (0.0, 0.1, 0.5), 38.0)
    bpy.ops.wm.save_as_mainfile(filepath=os.path.abspath(arguments.output), compress=True)


main()
