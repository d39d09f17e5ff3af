# SPDX-License-Identifier: Apache-2.0
"""A room with two boxes and a sphere, lit by one area light, whose light bounces.

    blender -b --factory-startup -P tests/cycles/area_bounce_sheet.py -- square square.blend

LIGHT is one of the names below; `bounce evaluate` compares the file with Cycles (docs/lights.md, "Bounced light of area
lights"). tile, square, large: squares of 0.7, 1.4 and 2.2 m under the ceiling. long: a tube along it. wall: a panel that
nearly covers the red wall. moving: a panel that flies through the room and turns (frames 1 to 48).
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


def area(width, height, location, rotation=(0.0, 0.0, 0.0)):
    light = common.add_light("Light", "AREA", location, 120.0, (1.0, 0.93, 0.82), shape="RECTANGLE", size=width, size_y=height)
    light.rotation_euler = rotation
    return light


def moving():
    light = area(3.2, 0.4, (-0.6, -0.4, 2.6))
    common.key(light, "location", [(1, (-0.6, -0.4, 2.6)), (48, (0.6, 0.4, 2.2))], "LINEAR")
    common.key(light, "rotation_euler", [(1, (0.0, 0.2, 0.0)), (48, (0.4, -0.3, math.radians(140)))], "LINEAR")


UNDER_CEILING = (0.3, -0.2, HEIGHT - 0.05)
LIGHTS = {
    "tile": lambda: area(0.7, 0.7, UNDER_CEILING),
    "square": lambda: area(1.4, 1.4, UNDER_CEILING),
    "large": lambda: area(2.2, 2.2, UNDER_CEILING),
    "long": lambda: area(4.4, 0.3, (0.0, 0.0, HEIGHT - 0.05)),
    "wall": lambda: area(2.6, 3.4, (0.05 - HALF_WIDTH, 0.0, 1.5), (0.0, -math.pi / 2, 0.0)),
    "moving": moving,
}


def main():
    parser = argparse.ArgumentParser(prog="area_bounce_sheet.py")
    parser.add_argument("light", choices=sorted(LIGHTS))
    parser.add_argument("output", metavar="OUT.blend")
    arguments = parser.parse_args(sys.argv[sys.argv.index("--") + 1:] if "--" in sys.argv else [])
    common.new_scene(f"Bounced light of {arguments.light}")
    common.set_world((0.0, 0.0, 0.0))
    build_room()
    LIGHTS[arguments.light]()
    add_room_camera()
    bpy.ops.wm.save_as_mainfile(filepath=os.path.abspath(arguments.output), compress=True)


main()
