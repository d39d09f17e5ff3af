# SPDX-License-Identifier: GPL-3.0-or-later
"""Gives every object the mesh that the render would see, while an export lasts.

Blender's exporter either applies modifiers or keeps shape keys. Here modifiers are applied beforehand, to the shape
and to each of its keys, and the exporter finds plain meshes.
"""

import bpy
import numpy as np

from .sampling import shape_keys_of

CONVERTED_TYPES = {"CURVE", "SURFACE", "FONT", "META"}


class Prepared:
    def __init__(self):
        self.source = {}  # pointer of a stand-in object -> pointer of what it stands for
        self.replaced = {}  # pointer of what is stood in for -> its stand-in
        self.native = set()  # pointers of curves that Blender's exporter converts by itself
        self.names = {}  # pointer of a made mesh -> name to export
        self.issues = []  # (object name, words)
        self.left_out = []  # (object name, what, reason)


def prepare(scene, visibility, models_of, edits, keep_all=False):
    """`models_of(obj)` are the material models of an object's slots. The scene stands at the first frame."""
    prepared = Prepared()
    objects = list(visibility.objects.values())
    for obj in objects:
        for modifier in obj.modifiers:
            if modifier.type == "ARMATURE":
                if not modifier.show_viewport and modifier.object is not None:
                    edits.set(modifier, "object", None)
                edits.set(modifier, "show_viewport", False)
    bpy.context.view_layer.update()

    swaps, shared = [], {}
    for obj in objects:
        if obj.type == "MESH":
            mesh = _own_mesh(obj, models_of(obj), shared, prepared, keep_all)
            if mesh is not None:
                swaps.append((obj, mesh))
        elif obj.type in CONVERTED_TYPES:
            _convert(obj, visibility, prepared, edits)
    for mesh in {mesh.as_pointer(): mesh for _, mesh in swaps}.values():
        # Before the swaps, so that it is undone after them: no object may hold a mesh that is removed.
        edits.undo_with(bpy.data.meshes.remove, mesh)
    for obj, mesh in swaps:
        edits.set(obj, "data", mesh)
        for modifier in obj.modifiers:
            edits.set(modifier, "show_viewport", False)
    bpy.context.view_layer.update()
    return prepared


def _shaping_modifiers(obj):
    return [m for m in obj.modifiers if m.show_viewport and m.type not in {"ARMATURE", "PARTICLE_SYSTEM", "COLLISION"}]


def _own_mesh(obj, models, shared, prepared, keep_all):
    """A mesh of its own for this object, or None where the one it has serves."""
    keys = shape_keys_of(obj)
    layers = _Layers(obj.data, models)
    masked = any(key.vertex_group for key in keys)
    if _shaping_modifiers(obj) or masked:
        mesh = _evaluate_keyed(obj, keys, prepared) if keys else _evaluate(obj)
    elif layers.superfluous() and not keep_all:
        key = (obj.data.as_pointer(), layers.kept_uvs, layers.color)
        if key in shared:
            prepared.left_out.extend((obj.name, what, "no material of it reads it") for what in layers.stripped)
            return shared[key]
        mesh = shared[key] = obj.data.copy()
    else:
        return None
    prepared.names[mesh.as_pointer()] = obj.data.name
    if not keep_all:
        layers.strip(mesh)
        prepared.left_out.extend((obj.name, what, "no material of it reads it") for what in layers.stripped)
    return mesh


class _Layers:
    """UV maps and colour attributes that the materials read; others would only split vertices and fill the file."""

    def __init__(self, mesh, models):
        used = set().union(*(model.uv_maps for model in models)) if models else set()
        names = [layer.name for layer in mesh.uv_layers]
        active = next((layer.name for layer in mesh.uv_layers if layer.active_render), None)
        wanted = {active if name == "" else name for name in used}
        # Exported texture coordinates are numbered by layer, so all before the last one used stay.
        self.kept_uvs = max((names.index(name) + 1 for name in wanted if name in names), default=0)
        self._has_more_uvs = len(names) > self.kept_uvs
        colors = [model.color_attribute for model in models if model.color_attribute is not None]
        self.color = colors[0] if colors else None
        self._mesh_has_colors = len(mesh.color_attributes) > 0
        self.stripped = [f"UV map '{name}'" for name in names[self.kept_uvs:]]
        if self.color is None:
            self.stripped += [f"colour attribute '{layer.name}'" for layer in mesh.color_attributes]

    def superfluous(self):
        return self._has_more_uvs or (self._mesh_has_colors and self.color != "")

    def strip(self, mesh):
        while len(mesh.uv_layers) > self.kept_uvs:
            mesh.uv_layers.remove(mesh.uv_layers[-1])
        if self.color is None:
            while len(mesh.color_attributes) > 0:
                mesh.color_attributes.remove(mesh.color_attributes[0])
        elif self.color:
            index = mesh.color_attributes.find(self.color)
            if index >= 0:
                mesh.color_attributes.render_color_index = index


def _evaluate(obj):
    depsgraph = bpy.context.evaluated_depsgraph_get()
    return bpy.data.meshes.new_from_object(
        obj.evaluated_get(depsgraph), preserve_all_data_layers=True, depsgraph=depsgraph
    )


def _evaluate_keyed(obj, keys, prepared):
    """The modifiers' result of the basis, with the modifiers' result of each key as its keys."""
    before = obj.show_only_shape_key, obj.active_shape_key_index
    blocks = obj.data.shape_keys.key_blocks
    try:
        obj.show_only_shape_key = True
        obj.active_shape_key_index = 0
        mesh = _evaluate(obj)
        coordinates = [_pinned_coordinates(obj, blocks.find(key.name)) for key in keys]
    finally:
        obj.show_only_shape_key, obj.active_shape_key_index = before
    if any(len(c) != len(mesh.vertices) for c in coordinates):
        prepared.issues.append((obj.name, "shape keys: its modifiers change the number of vertices with the shape"))
        bpy.data.meshes.remove(mesh)
        return _evaluate(obj)
    carrier = bpy.data.objects.new(obj.name, mesh)
    carrier.shape_key_add(name="Basis", from_mix=False)
    for key, coordinate in zip(keys, coordinates):
        block = carrier.shape_key_add(name=key.name, from_mix=False)
        block.data.foreach_set("co", coordinate.ravel())
        block.value = key.value
    bpy.data.objects.remove(carrier)
    return mesh


def _pinned_coordinates(obj, index):
    obj.active_shape_key_index = index
    return evaluated_coordinates(obj)


def evaluated_coordinates(obj):
    bpy.context.view_layer.update()
    depsgraph = bpy.context.evaluated_depsgraph_get()
    evaluated = obj.evaluated_get(depsgraph)
    mesh = evaluated.to_mesh()
    if mesh is None:
        return np.empty((0, 3), dtype=np.float32)
    coordinates = np.empty(len(mesh.vertices) * 3, dtype=np.float32)
    mesh.vertices.foreach_get("co", coordinates)
    evaluated.to_mesh_clear()
    return coordinates.reshape(-1, 3)


def _convert(obj, visibility, prepared, edits):
    """A mesh object beside a curve, surface, text or metaball. An object cannot change its type, so it stands in."""
    if any(collection.library is not None for collection in obj.users_collection):
        # Nothing can be added to a linked collection. Blender's exporter converts a curve, without its modifiers.
        if obj.type == "META" or _shaping_modifiers(obj):
            prepared.issues.append((obj.name, "from a library: " + ("metaball" if obj.type == "META" else "modifiers")))
        if obj.type != "META":
            prepared.native.add(obj.as_pointer())
        return
    mesh = _evaluate(obj)
    if mesh is None or len(mesh.polygons) == 0:
        if mesh is not None:
            bpy.data.meshes.remove(mesh)
        return
    stand_in = bpy.data.objects.new(obj.name, mesh)
    edits.undo_with(bpy.data.meshes.remove, mesh)  # takes the object with it
    stand_in.parent, stand_in.parent_type, stand_in.parent_bone = obj.parent, obj.parent_type, obj.parent_bone
    for collection in obj.users_collection:
        collection.objects.link(stand_in)
    prepared.source[stand_in.as_pointer()] = obj.as_pointer()
    prepared.replaced[obj.as_pointer()] = stand_in
    prepared.names[mesh.as_pointer()] = obj.data.name
    for shown in (visibility.direct, *visibility.all_instanced()):
        if obj.as_pointer() in shown:
            shown.add(stand_in.as_pointer())
