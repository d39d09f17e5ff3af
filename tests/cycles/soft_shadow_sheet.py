# SPDX-License-Identifier: Apache-2.0
"""A post, a sphere and a slab over a floor under one light with a size: penumbrae at contact, middle and far.

    blender -b --factory-startup -P tests/cycles/soft_shadow_sheet.py -- area-square area-square.blend

LIGHT is one of the names below; `bounce evaluate` compares the file with Cycles (docs/lights.md).
"""
import argparse
import math
import os
import sys
from pathlib import Path

import bpy

ROOT = Path(__file__).resolve().parents[2]
sys.path[:0] = [str(ROOT / folder) for folder in ("examples", "examples/sheets")]
import common  # noqa: E402
import light_stage  # noqa: E402
from light_stage import ABOVE, ASIDE, TARGET  # noqa: E402

# type, place, watts (sun: W/m2), settings.
LIGHTS = {
    "point-small": ("POINT", ABOVE, 250.0, {"shadow_soft_size": 0.05}),
    "point-large": ("POINT", ABOVE, 250.0, {"shadow_soft_size": 0.4}),
    "point-among": ("POINT", (-0.2, 0.5, 0.9), 60.0, {"shadow_soft_size": 0.12}),
    "spot-small": ("SPOT", ASIDE, 500.0, {"shadow_soft_size": 0.05, "spot_size": math.radians(60)}),
    "spot-large": ("SPOT", ASIDE, 500.0, {"shadow_soft_size": 0.35, "spot_size": math.radians(60)}),
    "sun-half": ("SUN", ASIDE, 3.0, {"angle": math.radians(0.526)}),
    "sun-ten": ("SUN", ASIDE, 3.0, {"angle": math.radians(10)}),
    "area-square": ("AREA", ABOVE, 250.0, {"shape": "SQUARE", "size": 0.8}),
    "area-rectangle": ("AREA", ABOVE, 250.0, {"shape": "RECTANGLE", "size": 2.0, "size_y": 0.2}),
    "area-disk": ("AREA", ABOVE, 250.0, {"shape": "DISK", "size": 1.0}),
    "area-ellipse": ("AREA", ABOVE, 250.0, {"shape": "ELLIPSE", "size": 1.6, "size_y": 0.4}),
    "area-spread": ("AREA", ABOVE, 60.0, {"shape": "SQUARE", "size": 0.8, "spread": math.radians(70)}),
    "area-low": ("AREA", (-0.9, 0.0, 0.7), 40.0, {"shape": "SQUARE", "size": 1.0}),
}


def build(name):
    light_stage.build(f"Soft shadow of {name}")
    kind, place, energy, settings = LIGHTS[name]
    light = common.add_light(name, kind, place, energy, **settings)
    common.look_at(light, TARGET)


def main():
    parser = argparse.ArgumentParser(prog="soft_shadow_sheet.py")
    parser.add_argument("light", choices=sorted(LIGHTS))
    parser.add_argument("output", metavar="OUT.blend")
    arguments = parser.parse_args(sys.argv[sys.argv.index("--") + 1:] if "--" in sys.argv else [])
    build(arguments.light)
    bpy.ops.wm.save_as_mainfile(filepath=os.path.abspath(arguments.output), compress=True)


main()
