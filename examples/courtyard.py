# SPDX-License-Identifier: Apache-2.0
"""Ten seconds in a courtyard: a searchlight wanders, a ball rolls past a turning gate, the camera walks an arcade.

    blender -b --factory-startup -P examples/courtyard.py -- courtyard.blend

Hardly any of the light falls under the arcades: most of what is seen there came off the court, its walls or the ball.
"""

import math
import sys
from pathlib import Path

import bpy
from mathutils import Matrix, Vector

sys.path.insert(0, str(Path(__file__).resolve().parent))
import common  # noqa: E402

FRAMES = 240
HALF_WIDTH, HALF_DEPTH, HEIGHT = 4.5, 5.5, 3.0
ARCADE, PILLAR, ARCADE_HEIGHT = 1.7, 0.34, 2.5
BALL_RADIUS = 0.55


def build_walls():
    ochre = common.principled("Ochre plaster", (0.72, 0.52, 0.3))
    rose = common.principled("Rose plaster", (0.66, 0.3, 0.24))
    green = common.principled("Green plaster", (0.26, 0.46, 0.3))
    paving = common.principled("Paving", (0.62, 0.58, 0.52))
    w, d, h = HALF_WIDTH, HALF_DEPTH, HEIGHT
    common.quad("Court", [(-w, -d, 0), (w, -d, 0), (w, d, 0), (-w, d, 0)], paving)
    common.box("Left wall", (0.3, 2 * d, h), (-w - 0.15, 0, h / 2), rose)
    common.box("Right wall", (0.3, 2 * d, h), (w + 0.15, 0, h / 2), green)
    common.box("End wall", (2 * w + 0.6, 0.3, h), (0, d + 0.15, h / 2), ochre)
    common.box("Near wall", (2 * w + 0.6, 0.3, h), (0, -d - 0.15, h / 2), ochre)


def build_arcades():
    stone = common.principled("Stone", (0.7, 0.66, 0.58))
    lime = common.principled("Limewash", (0.8, 0.78, 0.74))
    bays = 5
    bay = 2 * HALF_DEPTH / bays
    for name, side in (("Left", -1), ("Right", 1)):
        front = side * (HALF_WIDTH - ARCADE)
        common.box(f"{name} roof", (ARCADE + PILLAR / 2, 2 * HALF_DEPTH, 0.2),
                   (side * (HALF_WIDTH - ARCADE / 2 + PILLAR / 4), 0, ARCADE_HEIGHT + 0.35), lime)
        common.box(f"{name} beam", (PILLAR, 2 * HALF_DEPTH, 0.25), (front, 0, ARCADE_HEIGHT + 0.125), stone)
        for i in range(bays + 1):
            y = min(max(-HALF_DEPTH + i * bay, -HALF_DEPTH + PILLAR / 2), HALF_DEPTH - PILLAR / 2)
            common.box(f"{name} pillar {i + 1}", (PILLAR, PILLAR, ARCADE_HEIGHT), (front, y, ARCADE_HEIGHT / 2), stone,
                       bevel=0.03)


def build_ball():
    """Two halves of two colours, so that its rolling shows; it rolls to and fro along the court."""
    rings, segments = 32, 64
    profile = [(BALL_RADIUS * math.sin(math.pi * i / rings), -BALL_RADIUS * math.cos(math.pi * i / rings))
               for i in range(rings + 1)]
    ball = common.lathe("Ball", profile, segments, common.principled("Red", (0.74, 0.08, 0.05), roughness=0.6))
    ball.data.materials.append(common.principled("Cream", (0.82, 0.76, 0.62), roughness=0.6))
    for polygon in ball.data.polygons:
        polygon.material_index = 1 if polygon.center.z > 0 else 0
    ball.rotation_mode = "QUATERNION"
    previous = None
    turned = Matrix.Identity(3)
    for frame in range(common.FRAME_START, FRAMES + 1):
        t = (frame - 1) / (FRAMES - 1)
        place = Vector((0.9 * math.sin(2 * math.pi * t), 3.9 - 6.2 * (0.5 - 0.5 * math.cos(2 * math.pi * t)), BALL_RADIUS))
        if previous is not None:
            # Rolling without slipping: it turns about the axis across its way by the way over its radius.
            way = place - previous
            axis = Vector((0, 0, 1)).cross(way)
            if axis.length > 0:
                turned = Matrix.Rotation(way.length / BALL_RADIUS, 3, axis) @ turned
        previous = place
        ball.location, ball.rotation_quaternion = place, turned.to_quaternion()
        ball.keyframe_insert("location", frame=frame)
        ball.keyframe_insert("rotation_quaternion", frame=frame)
    common.name_action(ball, "Ball rolls")


def build_gate():
    """A blue leaf that turns about a post in the court, through the light."""
    post = common.add_object("Gate hinge", None, (1.6, 2.2, 0.0))
    leaf = common.box("Gate", (1.5, 0.06, 2.1), (-0.75, 0.0, 1.1), common.principled("Blue", (0.08, 0.2, 0.6)), bevel=0.01)
    leaf.parent = post
    common.key(post, "rotation_euler", [
        (1, (0, 0, 0)), (80, (0, 0, math.radians(-75))), (160, (0, 0, math.radians(50))), (FRAMES, (0, 0, 0)),
    ])
    common.name_action(post, "Gate turns")


def build_light():
    spot = common.add_light("Searchlight", "SPOT", (-1.2, -4.6, 6.5), 3200.0, (1.0, 0.93, 0.8),
                            shadow_soft_size=0.0, spot_size=math.radians(40), spot_blend=0.35)
    target = common.add_object("Searchlight target", None, (0.0, 0.0, 0.0))
    track = spot.constraints.new("TRACK_TO")
    track.target, track.track_axis, track.up_axis = target, "TRACK_NEGATIVE_Z", "UP_Y"
    common.key(target, "location", [
        (1, (0.4, 2.8, 0.0)), (70, (1.8, 0.4, 0.0)), (140, (-0.8, 1.4, 0.0)), (200, (-1.6, 3.4, 0.4)), (FRAMES, (0.4, 2.8, 0.0)),
    ])
    common.name_action(target, "Searchlight wanders")
    common.key(spot, "location", [(1, (-1.2, -4.6, 6.5)), (120, (1.8, -4.0, 6.8)), (FRAMES, (-1.2, -4.6, 6.5))])
    common.name_action(spot, "Searchlight moves")


def build_camera():
    camera = common.add_camera((-3.7, -4.9, 1.6), (-1.0, 2.0, 1.2), 22.0)
    target = common.add_object("Camera target", None, (-1.6, 3.0, 1.15))
    track = camera.constraints.new("TRACK_TO")
    track.target, track.track_axis, track.up_axis = target, "TRACK_NEGATIVE_Z", "UP_Y"
    common.key(camera, "location", [(1, (-3.75, -4.9, 1.6)), (130, (-3.6, -2.0, 1.65)), (FRAMES, (-3.45, 0.2, 1.6))])
    common.name_action(camera, "Walk")
    common.key(target, "location", [(1, (-1.6, 3.0, 1.15)), (130, (0.4, 3.2, 1.15)), (FRAMES, (1.6, 3.6, 1.2))])
    common.name_action(target, "Look")


def build():
    scene = common.new_scene("Courtyard")
    scene.frame_end = FRAMES
    common.set_world((0.0, 0.0, 0.0))
    scene.view_settings.exposure = 1.0
    build_walls()
    build_arcades()
    build_ball()
    build_gate()
    build_light()
    build_camera()


common.run(build)
