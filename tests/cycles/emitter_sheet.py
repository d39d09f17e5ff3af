# SPDX-License-Identifier: Apache-2.0
"""A room with two boxes and a sphere, lit by surfaces that emit and by nothing else.

    blender -b --factory-startup -P tests/cycles/emitter_sheet.py -- panel panel.blend

EMITTER is one of the names below; `bounce evaluate` compares the file with Cycles (docs/lights.md).
panel: a flat square a centimetre under the ceiling. screen: a picture on a wall. bulbs: twelve small spheres on
a string. moving: a ring that flies through the room while its strength doubles (frames 1 to 48).
"""
import argparse
import math
import os
import sys
from pathlib import Path

import bpy

sys.path[:0] = [str(Path(__file__).resolve().parents[2] / "examples"), str(Path(__file__).resolve().parent)]
import common  # noqa: E402
from box_room import HALF_WIDTH, HEIGHT, add_room_camera, build_room  # noqa: E402


def emission(name, color, strength):
    """A black surface that emits color times strength, W/(m2 sr)."""
    material = common.principled(name, (0.0, 0.0, 0.0), 1.0)
    shader = material.node_tree.nodes["Principled BSDF"]
    shader.inputs["Specular"].default_value = 0.0
    shader.inputs["Emission"].default_value = (*color, 1.0)
    shader.inputs["Emission Strength"].default_value = strength
    return material


def build_panel():
    x, y, z = 0.6, 0.4, HEIGHT - 0.01
    common.quad("Panel", [(-x, -y, z), (-x, y, z), (x, y, z), (x, -y, z)], emission("Lamp", (1.0, 0.9, 0.75), 12.0))


def picture():
    """Coloured bars over a dark ground with a bright disk: 64 x 36 texels, sRGB."""
    width, height = 64, 36
    image = bpy.data.images.new("Programme", width, height)
    pixels = []
    for y in range(height):
        for x in range(width):
            bar = (x * 4 // width, y * 2 // height)
            color = ((0.9, 0.2, 0.1), (0.2, 0.8, 0.3), (0.1, 0.3, 0.9), (0.05, 0.05, 0.05))[(bar[0] + 2 * bar[1]) % 4]
            bright = math.hypot(x - 0.7 * width, y - 0.5 * height) < 7
            pixels.extend((*((1.0, 0.95, 0.8) if bright else color), 1.0))
    image.pixels = pixels
    image.pack()
    return image


def build_screen():
    material = emission("Screen", (1.0, 1.0, 1.0), 9.0)
    nodes, links = material.node_tree.nodes, material.node_tree.links
    texture = nodes.new("ShaderNodeTexImage")
    texture.image = picture()
    links.new(texture.outputs["Color"], nodes["Principled BSDF"].inputs["Emission"])
    x = HALF_WIDTH - 0.05
    quad = common.quad("Screen", [(x, 1.4, 0.8), (x, -0.6, 0.8), (x, -0.6, 1.9), (x, 1.4, 1.9)], material)
    uv = quad.data.uv_layers.new()
    for loop, place in zip(uv.data, ((0, 0), (1, 0), (1, 1), (0, 1))):
        loop.uv = place


def build_bulbs():
    material = emission("Filament", (1.0, 0.75, 0.4), 120.0)
    for i in range(12):
        x = -2.0 + 4.0 * i / 11
        z = 2.2 + 0.5 * (x / 2.0) ** 2
        common.lathe(f"Bulb {i}", [(0.05 * math.sin(math.pi * k / 8), -0.05 * math.cos(math.pi * k / 8))
                                   for k in range(9)], 16, material, (x, 0.3 * math.sin(2.0 * i), z))


def build_moving():
    material = emission("Ring", (0.7, 0.85, 1.0), 10.0)
    bpy.ops.mesh.primitive_torus_add(major_radius=0.35, minor_radius=0.08, location=(-1.5, -0.6, 2.3))
    ring = bpy.context.object
    ring.data.materials.append(material)
    common.key(ring, "location", [(1, (-1.5, -0.6, 2.3)), (48, (1.4, 0.2, 1.6))], "LINEAR")
    common.key(ring, "rotation_euler", [(1, (0.3, 0.0, 0.0)), (48, (2.0, 0.7, 1.0))], "LINEAR")
    strength = material.node_tree.nodes["Principled BSDF"].inputs["Emission Strength"]
    common.key(strength, "default_value", [(1, 10.0), (48, 20.0)], "LINEAR")


EMITTERS = {"panel": build_panel, "screen": build_screen, "bulbs": build_bulbs, "moving": build_moving}


def main():
    parser = argparse.ArgumentParser(prog="emitter_sheet.py")
    parser.add_argument("emitter", choices=sorted(EMITTERS))
    parser.add_argument("output", metavar="OUT.blend")
    arguments = parser.parse_args(sys.argv[sys.argv.index("--") + 1:] if "--" in sys.argv else [])
    common.new_scene(f"Lit by {arguments.emitter}")
    common.set_world((0.0, 0.0, 0.0))
    build_room()
    EMITTERS[arguments.emitter]()
    add_room_camera()
    bpy.ops.wm.save_as_mainfile(filepath=os.path.abspath(arguments.output), compress=True)


main()
