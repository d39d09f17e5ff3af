# SPDX-License-Identifier: Apache-2.0
"""A table at night: a desk lamp bends on its bones after a ball that squashes by shape keys, under two moving lights.

    blender -b --factory-startup -P examples/table.py -- table.blend
"""

import math
import sys
from pathlib import Path

import bpy
from mathutils import Vector

sys.path.insert(0, str(Path(__file__).resolve().parent))
import common  # noqa: E402

TABLE_TOP = 0.75
BALL_RADIUS = 0.11
BOUNCES, BOUNCE_HEIGHT = 3, 0.42
BONES, BONE_LENGTH = 4, 0.15


def build_room():
    wall = common.principled("Teal wall", (0.12, 0.36, 0.38))
    side = common.principled("Coral wall", (0.7, 0.22, 0.13))
    floor = common.principled("Oak floor", (0.42, 0.26, 0.14))
    common.quad("Floor", [(-3, -3, 0), (3, -3, 0), (3, 1.2, 0), (-3, 1.2, 0)], floor)
    common.quad("Back wall", [(-3, 1.2, 0), (3, 1.2, 0), (3, 1.2, 2.6), (-3, 1.2, 2.6)], wall)
    common.quad("Side wall", [(-1.5, -3, 0), (-1.5, 1.2, 0), (-1.5, 1.2, 2.6), (-1.5, -3, 2.6)], side)
    common.quad("Ceiling", [(-3, -3, 2.6), (-3, 1.2, 2.6), (3, 1.2, 2.6), (3, -3, 2.6)],
                common.principled("White ceiling", (0.8, 0.8, 0.78)))


def build_table():
    wood = common.principled("Walnut", (0.4, 0.22, 0.11), roughness=0.7)
    common.box("Table top", (2.0, 1.1, 0.05), (0.0, 0.2, TABLE_TOP - 0.025), wood, bevel=0.012)
    for x in (-0.9, 0.9):
        for y in (-0.25, 0.65):
            common.box(f"Leg {x:+.1f} {y:+.1f}", (0.07, 0.07, TABLE_TOP - 0.05),
                       (x, y, (TABLE_TOP - 0.05) / 2), wood, bevel=0.01)
    paper = common.diffuse("Paper", (0.85, 0.83, 0.78))
    covers = [(0.55, 0.06, 0.06), (0.8, 0.55, 0.1), (0.1, 0.25, 0.5)]
    for i, color in enumerate(covers):
        z = TABLE_TOP + 0.045 * i
        turn = math.radians(12 - 17 * i)
        cover = common.box(f"Book {i + 1}", (0.34, 0.25, 0.043), (0.62, 0.48, z + 0.0215),
                           common.principled(f"Cover {i + 1}", color), bevel=0.004)
        pages = common.box(f"Pages {i + 1}", (0.33, 0.252, 0.031), (0.0, -0.006, 0.0), paper)
        cover.rotation_euler.z, pages.parent = turn, cover
    bowl = common.lathe("Bowl", [(0.0, 0.0), (0.06, 0.0), (0.065, 0.012), (0.12, 0.05), (0.155, 0.11), (0.16, 0.115),
                                 (0.15, 0.112), (0.115, 0.06), (0.06, 0.025), (0.0, 0.02)], 64,
                        common.principled("Glaze", (0.75, 0.72, 0.62), roughness=0.4), (0.62, 0.0, TABLE_TOP))
    common.subdivide(bowl, 1)
    fruit = common.principled("Lime", (0.35, 0.55, 0.06), roughness=0.6)
    for i, (x, y, z) in enumerate([(-0.045, -0.02, 0.075), (0.05, -0.01, 0.075), (0.0, 0.06, 0.08), (0.0, 0.01, 0.14)]):
        sphere(f"Lime {i + 1}", 0.048, 24, 12, fruit, (0.62 + x, y, TABLE_TOP + z))


def sphere(name, radius, segments, rings, material, location):
    profile = [(radius * math.sin(math.pi * i / rings), -radius * math.cos(math.pi * i / rings))
               for i in range(rings + 1)]
    return common.lathe(name, profile, segments, material, location)


def build_lamp():
    """One mesh from foot to shade, on a chain of bones; weights blend along the stem."""
    stem = 0.016
    profile = [(0.0, 0.0), (0.11, 0.0), (0.115, 0.01), (0.11, 0.022), (0.03, 0.03), (stem, 0.05)]
    height = BONES * BONE_LENGTH
    profile += [(stem, 0.05 + (height - 0.05) * i / 40) for i in range(1, 41)]
    profile += [(0.03, height + 0.005), (0.045, height + 0.03), (0.06, height + 0.05), (0.13, height + 0.17),
                (0.134, height + 0.172), (0.126, height + 0.168), (0.055, height + 0.055), (0.0, height + 0.05)]
    lamp = common.lathe("Lamp", profile, 48, common.principled("Lamp enamel", (0.85, 0.62, 0.08), roughness=0.5))
    common.subdivide(lamp, 1)

    armature = bpy.data.armatures.new("Lamp bones")
    rig = common.add_object("Lamp rig", armature, (-0.62, 0.42, TABLE_TOP))
    bpy.context.view_layer.objects.active = rig
    bpy.ops.object.mode_set(mode="EDIT")
    parent = None
    for i in range(BONES + 1):
        bone = armature.edit_bones.new(f"Stem {i + 1}" if i < BONES else "Head")
        bone.head, bone.tail = (0, 0, i * BONE_LENGTH), (0, 0, (i + 1) * BONE_LENGTH)
        bone.parent, bone.use_connect = parent, parent is not None
        parent = bone
    bpy.ops.object.mode_set(mode="OBJECT")

    lamp.parent = rig
    lamp.modifiers.new("Armature", "ARMATURE").object = rig
    groups = [lamp.vertex_groups.new(name=bone.name) for bone in armature.bones]
    for vertex in lamp.data.vertices:
        # A joint bends over half a bone's length to either side; foot and shade stay rigid.
        along = min(max(vertex.co.z / BONE_LENGTH - 0.5, 0.0), BONES)
        lower = min(int(along), BONES - 1)
        blend = along - lower
        if vertex.co.z < 0.05:
            lower, blend = 0, 0.0
        groups[lower].add([vertex.index], 1.0 - blend, "REPLACE")
        groups[lower + 1].add([vertex.index], blend, "REPLACE")
    for i, bone in enumerate(rig.pose.bones):
        bone.rotation_mode = "XYZ"
        # The lowest bone holds the foot on the table.
        key_bone(bone, 0.0 if i == 0 else 0.42)
    common.name_action(rig, "Lamp nods")
    return rig


def key_bone(bone, rest):
    for frame, x, z in ((1, 0.6, -0.95), (12, 1.0, -0.7), (24, 0.5, -1.15), (36, 1.05, -0.75), (48, 0.6, -0.95)):
        bone.rotation_euler = (rest * x, 0.0, rest * z)
        bone.keyframe_insert("rotation_euler", frame=frame)


def build_ball():
    """Three bounces; shape keys squash it on the table and stretch it in the air."""
    ball = sphere("Ball", BALL_RADIUS, 64, 32, common.principled("Rubber", (0.8, 0.1, 0.07), roughness=0.6), (0, 0, 0))
    ball.shape_key_add(name="Basis")
    for name, flat in (("Squash", 0.55), ("Stretch", 1.3)):
        shape = ball.shape_key_add(name=name)
        wide = 1.0 / math.sqrt(flat)
        for vertex in shape.data:
            x, y, z = vertex.co
            # The underside stays where it touches the table.
            vertex.co = Vector((x * wide, y * wide, (z + BALL_RADIUS) * flat - BALL_RADIUS))
    squash, stretch = ball.data.shape_keys.key_blocks["Squash"], ball.data.shape_keys.key_blocks["Stretch"]
    frames_per_bounce = (common.FRAME_END - common.FRAME_START + 1) // BOUNCES
    for frame in range(common.FRAME_START, common.FRAME_END + 1):
        t = (frame - common.FRAME_START) / frames_per_bounce % 1.0
        air = 4.0 * t * (1.0 - t)
        x = -0.12 + 0.3 * math.sin(2 * math.pi * (frame - 1) / 48)
        ball.location = (x, 0.05, TABLE_TOP + BALL_RADIUS + BOUNCE_HEIGHT * air)
        ball.keyframe_insert("location", frame=frame)
        for shape, value in ((squash, max(0.0, 1.0 - air * 4.0)), (stretch, max(0.0, 4 * air * (1 - air)) * 0.8)):
            shape.value = value
            shape.keyframe_insert("value", frame=frame)
    common.name_action(ball, "Ball bounces")
    common.name_action(ball.data.shape_keys, "Ball squashes")


def build_lights():
    point = common.add_light("Warm point", "POINT", (0, 0, 0), 34.0, (1.0, 0.72, 0.42), shadow_soft_size=0.0)
    pivot = common.add_object("Point pivot", None, (0.1, 0.1, TABLE_TOP + 0.75))
    point.parent, point.location = pivot, (0.75, 0.0, 0.0)
    common.key(pivot, "rotation_euler", [(1, (0, 0, math.radians(-110))), (49, (0, 0, math.radians(10)))], "LINEAR")
    common.name_action(pivot, "Point circles")

    spot = common.add_light("Spot", "SPOT", (0.9, -0.9, 2.35), 330.0, (0.75, 0.85, 1.0), shadow_soft_size=0.0,
                            spot_size=math.radians(50), spot_blend=0.35)
    common.look_at(spot, (0.0, 0.3, TABLE_TOP))
    start = spot.rotation_euler.copy()
    common.key(spot, "rotation_euler", [(1, start), (24, (start.x - 0.1, start.y, start.z + 0.45)), (48, start)])
    common.name_action(spot, "Spot sweeps")
    light = spot.data
    common.key(light, "energy", [(1, 330.0), (24, 520.0), (48, 330.0)])
    common.key(light, "color", [(1, (0.75, 0.85, 1.0)), (24, (1.0, 0.6, 0.75)), (48, (0.75, 0.85, 1.0))], "LINEAR")
    common.key(light, "spot_size", [(1, math.radians(50)), (24, math.radians(34)), (48, math.radians(50))])
    common.name_action(light, "Spot breathes")


def build():
    common.new_scene("Table")
    common.set_world((0.02, 0.025, 0.04))
    build_room()
    build_table()
    build_lamp()
    build_ball()
    build_lights()
    common.add_camera((0.45, -1.75, 1.4), (-0.02, 0.3, TABLE_TOP + 0.24), 30.0)


common.run(build)
