# SPDX-License-Identifier: Apache-2.0
"""A gold ring throws a caustic over the floor; a cloth sways into the spot's light and takes part of it away.

    blender -b --factory-startup -P examples/ring.py -- ring.blend
"""

import math
import sys
from pathlib import Path

import bpy
from mathutils import Vector

sys.path.insert(0, str(Path(__file__).resolve().parent))
import common  # noqa: E402

RADIUS, THICKNESS, RING_HEIGHT = 0.62, 0.07, 0.34
RING_ROUGHNESS = 0.3
CLOTH_COLUMNS, CLOTH_ROWS = 48, 40
CLOTH_WIDTH, CLOTH_LENGTH, ROD_HEIGHT = 1.0, 1.2, 1.5


def build_room():
    plaster = common.principled("Plaster", (0.7, 0.69, 0.66))
    blue = common.principled("Blue wall", (0.1, 0.28, 0.55))
    common.quad("Floor", [(-2, -2, 0), (2.4, -2, 0), (2.4, 1.5, 0), (-2, 1.5, 0)], plaster)
    common.quad("Back wall", [(-2, 1.5, 0), (2.4, 1.5, 0), (2.4, 1.5, 2.4), (-2, 1.5, 2.4)], plaster)
    common.quad("Side wall", [(-2, -2, 0), (-2, 1.5, 0), (-2, 1.5, 2.4), (-2, -2, 2.4)], blue)


def build_ring():
    """A band with rounded rims, lying on the floor; its inner side gathers the light into the caustic."""
    round_off = THICKNESS / 2
    inner, outer = RADIUS - round_off, RADIUS + round_off
    profile = [(RADIUS, 0.0), (outer - 0.02, 0.0), (outer, 0.02), (outer, RING_HEIGHT - round_off)]
    profile += [(RADIUS + round_off * math.cos(a), RING_HEIGHT - round_off + round_off * math.sin(a))
                for a in (math.pi * i / 12 for i in range(1, 12))]
    profile += [(inner, RING_HEIGHT - round_off), (inner, 0.02), (inner + 0.02, 0.0), (RADIUS, 0.0)]
    gold = common.principled("Gold", (1.0, 0.72, 0.32), roughness=RING_ROUGHNESS, metallic=1.0)
    common.lathe("Ring", profile, 160, gold)


def cloth_point(u, t, sway, ripple):
    """A point of the cloth, hanging from its rod along Y; sway swings the hem, ripple runs folds through it."""
    swing = sway * t * (0.35 + 0.65 * t)
    fold = (0.02 + 0.06 * t) * math.sin(u * 5 * math.pi + ripple)
    x = CLOTH_LENGTH * 0.75 * math.sin(swing) + fold
    z = ROD_HEIGHT - CLOTH_LENGTH * t * math.cos(0.6 * swing)
    return Vector((x, (u - 0.5) * CLOTH_WIDTH, z))


def build_cloth():
    places = [(c / CLOTH_COLUMNS, r / CLOTH_ROWS)
              for r in range(CLOTH_ROWS + 1) for c in range(CLOTH_COLUMNS + 1)]
    faces = [
        (r * (CLOTH_COLUMNS + 1) + c, r * (CLOTH_COLUMNS + 1) + c + 1,
         (r + 1) * (CLOTH_COLUMNS + 1) + c + 1, (r + 1) * (CLOTH_COLUMNS + 1) + c)
        for r in range(CLOTH_ROWS) for c in range(CLOTH_COLUMNS)
    ]
    cloth = common.add_mesh("Cloth", [cloth_point(u, t, 0.0, 0.0) for u, t in places], faces,
                            common.diffuse("Red cloth", (0.68, 0.07, 0.05)), smooth=True)
    cloth.shape_key_add(name="Basis")
    for name, sway, ripple in (("In", -0.7, 0.9), ("Out", 0.7, -0.9), ("Ripple", 0.0, math.pi)):
        for vertex, (u, t) in zip(cloth.shape_key_add(name=name).data, places):
            vertex.co = cloth_point(u, t, sway, ripple)
    keys = cloth.data.shape_keys.key_blocks
    for frame in range(common.FRAME_START, common.FRAME_END + 1):
        t = (frame - common.FRAME_START) / (common.FRAME_END - common.FRAME_START + 1)
        sway = math.cos(2 * math.pi * t)
        values = {"In": max(-sway, 0.0), "Out": max(sway, 0.0), "Ripple": 0.5 - 0.5 * math.cos(4 * math.pi * t)}
        for name, value in values.items():
            keys[name].value = value
            keys[name].keyframe_insert("value", frame=frame)
    common.name_action(cloth.data.shape_keys, "Cloth sways")
    # It also slides along its rails, into the light and out of it.
    common.key(cloth, "location", [
        (common.FRAME_START, (1.0, 0.72, 0.0)), (common.FRAME_END // 2, (0.95, 0.2, 0.0)),
        (common.FRAME_END, (1.0, 0.68, 0.0)),
    ])
    common.name_action(cloth, "Cloth slides")


def build():
    common.new_scene("Ring")
    common.set_world((0.0, 0.0, 0.0))
    build_room()
    build_ring()
    build_cloth()
    spot = common.add_light("Spot", "SPOT", (2.3, -0.55, 1.2), 330.0, (1.0, 0.95, 0.87),
                            shadow_soft_size=0.0, spot_size=math.radians(52), spot_blend=0.3)
    common.look_at(spot, (-0.4, 0.2, 0.25))
    common.add_camera((-0.3, -2.35, 2.0), (-0.02, 0.05, 0.3), 36.0)


common.run(build)
