# SPDX-License-Identifier: Apache-2.0
"""A room with two boxes and a sphere, open to the camera: the stage of emitter_sheet.py and area_bounce_sheet.py."""
import math

import common

HALF_WIDTH, HALF_DEPTH, HEIGHT = 2.4, 2.0, 3.0


def build_room():
    white = common.diffuse("White", (0.73, 0.73, 0.73))
    red = common.diffuse("Red", (0.63, 0.06, 0.05))
    green = common.diffuse("Green", (0.12, 0.46, 0.09))
    w, d, h = HALF_WIDTH, HALF_DEPTH, HEIGHT
    common.quad("Floor", [(-w, -d, 0), (w, -d, 0), (w, d, 0), (-w, d, 0)], white)
    common.quad("Ceiling", [(-w, -d, h), (-w, d, h), (w, d, h), (w, -d, h)], white)
    common.quad("Back wall", [(-w, d, 0), (w, d, 0), (w, d, h), (-w, d, h)], white)
    common.quad("Red wall", [(-w, -d, 0), (-w, d, 0), (-w, d, h), (-w, -d, h)], red)
    common.quad("Green wall", [(w, -d, 0), (w, -d, h), (w, d, h), (w, d, 0)], green)
    tall = common.box("Tall box", (0.9, 0.9, 1.7), (-0.9, 0.6, 0.85), white)
    tall.rotation_euler = (0.0, 0.0, math.radians(18))
    short = common.box("Short box", (0.8, 0.8, 0.8), (0.9, -0.2, 0.4), common.principled("Satin", (0.6, 0.6, 0.6), 0.4))
    short.rotation_euler = (0.0, 0.0, math.radians(-17))
    common.lathe("Sphere", [(0.3 * math.sin(math.pi * i / 24), 0.3 - 0.3 * math.cos(math.pi * i / 24))
                            for i in range(25)], 48, white, (0.1, -1.0, 0.0))


def add_room_camera():
    common.add_camera((0.0, -6.2, 1.5), (0.0, 0.0, 1.45), 34.0)
