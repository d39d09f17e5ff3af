# SPDX-License-Identifier: Apache-2.0
"""A room bent around a thin dividing wall. The spot is in one arm, the camera in the other: all that is seen is bounced.

    blender -b --factory-startup -P examples/u_room.py -- u_room.blend
"""

import math
import sys
from pathlib import Path

import bpy

sys.path.insert(0, str(Path(__file__).resolve().parent))
import common  # noqa: E402

HALF, HEIGHT = 4.0, 3.0
DIVIDER_HALF, DIVIDER_END = 0.15, 1.5
COLUMN_RADIUS = 0.09


def build_shell():
    plaster = common.principled("Plaster", (0.74, 0.72, 0.68))
    floor = common.principled("Floor", (0.55, 0.47, 0.38))
    blue = common.principled("Blue wall", (0.16, 0.3, 0.6))
    terracotta = common.principled("Terracotta wall", (0.66, 0.28, 0.14))
    h, z = HALF, HEIGHT
    common.quad("Floor", [(-h, -h, 0), (h, -h, 0), (h, h, 0), (-h, h, 0)], floor)
    common.quad("Ceiling", [(-h, -h, z), (-h, h, z), (h, h, z), (h, -h, z)], plaster)
    common.quad("End wall", [(-h, h, 0), (h, h, 0), (h, h, z), (-h, h, z)], plaster)
    common.quad("Near wall", [(-h, -h, 0), (-h, -h, z), (h, -h, z), (h, -h, 0)], plaster)
    common.quad("Left wall", [(-h, -h, 0), (-h, h, 0), (-h, h, z), (-h, -h, z)], blue)
    common.quad("Right wall", [(h, -h, 0), (h, -h, z), (h, h, z), (h, h, 0)], terracotta)
    # 0.3 m thick, from the near wall to a passage along the end wall.
    common.box("Dividing wall", (2 * DIVIDER_HALF, DIVIDER_END + h, z),
               (0.0, (DIVIDER_END - h) / 2, z / 2), plaster)


def build_columns():
    stone = common.principled("Stone", (0.7, 0.66, 0.58))
    for i, (x, y) in enumerate([(-0.8, 1.7), (-1.0, 3.1), (-2.3, 0.4), (-3.1, 2.2)]):
        column = common.lathe(f"Column {i + 1}", [(COLUMN_RADIUS, 0.0), (COLUMN_RADIUS, HEIGHT)], 48, stone, (x, y, 0.0))
        column.data.polygons.foreach_set("use_smooth", [True] * len(column.data.polygons))


def build():
    common.new_scene("U-shaped room")
    common.set_world((0.0, 0.0, 0.0))
    bpy.context.scene.view_settings.exposure = 1.5
    build_shell()
    build_columns()
    spot = common.add_light("Spot", "SPOT", (0.9, -3.3, HEIGHT - 0.15), 15000.0, (1.0, 0.95, 0.86),
                            shadow_soft_size=0.0, spot_size=math.radians(50), spot_blend=0.3)
    target = common.add_object("Spot target", None, (2.9, 2.6, 0.9))
    track = spot.constraints.new("TRACK_TO")
    track.target, track.track_axis, track.up_axis = target, "TRACK_NEGATIVE_Z", "UP_Y"
    common.key(target, "location", [(common.FRAME_START, (2.9, 2.6, 0.9)), (common.FRAME_END, (3.6, 2.2, 0.9))])
    common.name_action(target, "Spot pans")
    common.add_camera((-0.5, -3.75, 1.6), (-2.3, 3.0, 1.35), 25.0)


common.run(build)
