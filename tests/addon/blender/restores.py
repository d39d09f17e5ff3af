# SPDX-License-Identifier: Apache-2.0
"""Exports and compares the open scene before and after. Exits with 0 if nothing in it changed."""

import sys

import addon_utils
import bpy

addon_folder, target = sys.argv[sys.argv.index("--") + 1:]
sys.path.insert(0, addon_folder)
addon_utils.enable("bounce", default_set=True)

from bounce.export import export  # noqa: E402
from bounce.options import Options  # noqa: E402


def snapshot():
    state = {}
    for kind in ("objects", "meshes", "curves", "metaballs", "materials", "collections", "lights", "cameras", "actions"):
        state[kind] = sorted(block.name_full for block in getattr(bpy.data, kind))
    for obj in bpy.data.objects:
        state["object", obj.name_full] = (
            obj.data.name_full if obj.data else None, obj.hide_viewport, obj.hide_render, obj.hide_get(),
            obj.show_only_shape_key, obj.active_shape_key_index, tuple(map(tuple, obj.matrix_basis)),
            [(m.name, m.show_viewport, getattr(m, "levels", None), getattr(m, "object", None)) for m in obj.modifiers],
        )
    for material in bpy.data.materials:
        if material.node_tree is not None:
            state["material", material.name_full] = (
                sorted(node.name for node in material.node_tree.nodes),
                sorted((link.from_node.name, link.from_socket.name, link.to_node.name, link.to_socket.identifier)
                       for link in material.node_tree.links))
    for collection in bpy.data.collections:
        state["collection", collection.name_full] = collection.hide_viewport
    state["frame"] = bpy.context.scene.frame_current
    return state


bpy.context.scene.frame_set(bpy.context.scene.frame_start + 3)
before = snapshot()
export(target, Options(draco=False))
after = snapshot()
different = [(key, before.get(key), after.get(key)) for key in before if before[key] != after.get(key)]
if different:
    sys.exit(f"the export changed the scene: {different}")
