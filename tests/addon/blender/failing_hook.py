# SPDX-License-Identifier: Apache-2.0
"""Exports with a hook that raises, over a file that is already there. Exits with 0 if the export fails as it should."""

import sys
from pathlib import Path

import addon_utils
import bpy

addon_folder, target, hook = sys.argv[sys.argv.index("--") + 1:]
sys.path.insert(0, addon_folder)
addon_utils.enable("bounce", default_set=True)

from bounce import document, gltf_materials, transforms  # noqa: E402
from bounce.errors import ExportError  # noqa: E402
from bounce.export import export  # noqa: E402
from bounce.options import Options  # noqa: E402


def broken(*arguments):
    raise ValueError("broken on purpose")


owner, name = {"mesh": (gltf_materials, "finish_primitives"), "placement": (transforms, "place"),
               "document": (document, "finish")}[hook]
setattr(owner, name, broken)
subdivided = bpy.data.objects["Morphed"]
levels = subdivided.modifiers["Subdivision"].levels
mesh = subdivided.data
try:
    export(target, Options(draco=False))
except ExportError as error:
    assert "broken on purpose" in str(error), error
else:
    sys.exit("the export did not fail")
# The scene is as it was.
assert subdivided.modifiers["Subdivision"].levels == levels and subdivided.data == mesh
assert bpy.context.scene.frame_current == 5
assert [path.name for path in Path(target).parent.iterdir()] == [Path(target).name], "something was left behind"
