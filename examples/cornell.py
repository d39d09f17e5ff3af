# SPDX-License-Identifier: Apache-2.0
"""A closed box with a red and a green wall, a turning Suzanne and one spot: half of what is seen is bounced light.

    blender -b --factory-startup -P examples/cornell.py -- cornell.blend
"""

import math
import sys
from pathlib import Path

import bpy

sys.path.insert(0, str(Path(__file__).resolve().parent))
import common  # noqa: E402

HALF_WIDTH, HALF_DEPTH, HEIGHT = 2.6, 2.0, 3.2


def build_box():
    white = common.principled("White wall", (0.76, 0.75, 0.73))
    red = common.principled("Red wall", (0.63, 0.06, 0.05))
    green = common.principled("Green wall", (0.12, 0.46, 0.09))
    w, d, h = HALF_WIDTH, HALF_DEPTH, HEIGHT
    common.quad("Floor", [(-w, -d, 0), (w, -d, 0), (w, d, 0), (-w, d, 0)], white)
    common.quad("Ceiling", [(-w, -d, h), (-w, d, h), (w, d, h), (w, -d, h)], white)
    common.quad("Back wall", [(-w, d, 0), (w, d, 0), (w, d, h), (-w, d, h)], white)
    common.quad("Red wall", [(-w, -d, 0), (-w, d, 0), (-w, d, h), (-w, -d, h)], red)
    common.quad("Green wall", [(w, -d, 0), (w, -d, h), (w, d, h), (w, d, 0)], green)


def build_suzanne():
    bpy.ops.mesh.primitive_monkey_add(size=1.7, location=(0.0, 0.1, 0.86))
    suzanne = bpy.context.object
    suzanne.name = suzanne.data.name = "Suzanne"
    suzanne.data.materials.append(common.principled("Plaster", (0.72, 0.68, 0.6)))
    suzanne.data.polygons.foreach_set("use_smooth", [True] * len(suzanne.data.polygons))
    common.subdivide(suzanne, 3)
    common.key(suzanne, "rotation_euler", [
        (common.FRAME_START, (-0.3, 0.0, math.radians(25))),
        # One frame past the end: the turntable closes without a doubled frame.
        (common.FRAME_END + 1, (-0.3, 0.0, math.radians(385))),
    ], "LINEAR")
    common.name_action(suzanne, "Suzanne turns")


def build():
    common.new_scene("Cornell")
    common.set_world((0.0, 0.0, 0.0))
    build_box()
    build_suzanne()
    spot = common.add_light("Spot", "SPOT", (1.1, -0.6, HEIGHT - 0.06), 560.0, (1.0, 0.93, 0.82),
                            shadow_soft_size=0.0, spot_size=math.radians(88), spot_blend=0.25)
    common.look_at(spot, (-0.7, 0.5, 0.2))
    common.add_camera((0.0, -6.4, 1.62), (0.0, 0.0, 1.58), 36.0)


common.run(build)
