# SPDX-License-Identifier: Apache-2.0
"""Imports a .glb by Blender's own importer and writes down what arrived."""

import json
import sys
from pathlib import Path

import bpy
import numpy as np

# Blender 3.4's importer uses an alias that numpy dropped in 1.24; Debian 12 pairs these two.
if not hasattr(np, "bool"):
    np.bool = bool

source, target = (Path(p) for p in sys.argv[sys.argv.index("--") + 1:])
bpy.ops.wm.read_factory_settings(use_empty=True)
# The glTF add-on must be on for its importer to exist.
bpy.ops.preferences.addon_enable(module="io_scene_gltf2")
bpy.ops.import_scene.gltf(filepath=str(source))
result = {}
for obj in bpy.data.objects:
    if obj.type != "MESH":
        continue
    mesh = obj.data
    mesh.calc_normals_split()
    result[obj.name] = {
        "positions": [list(obj.matrix_world @ v.co) for v in mesh.vertices],
        "triangles": [list(p.vertices) for p in mesh.polygons],
        "normals": [list(loop.normal) for loop in mesh.loops],
        "uvs": [list(layer.uv) for layer in mesh.uv_layers[0].data] if mesh.uv_layers else [],
        "groups": sorted({obj.vertex_groups[g.group].name for v in mesh.vertices for g in v.groups}),
        "weights": [[(obj.vertex_groups[g.group].name, g.weight) for g in v.groups] for v in mesh.vertices],
        "keys": [k.name for k in mesh.shape_keys.key_blocks] if mesh.shape_keys else [],
    }
target.write_text(json.dumps(result))
