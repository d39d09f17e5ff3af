# SPDX-License-Identifier: GPL-3.0-or-later
"""Which objects the render would show, and making the viewport evaluate exactly those.

The exporter reads the viewport's dependency graph, where other objects may be hidden and modifiers may have other
levels than in the render.
"""

RENDERED_TYPES = {"MESH", "CURVE", "SURFACE", "FONT", "META", "CURVES", "POINTCLOUD", "VOLUME", "GPENCIL", "LIGHT"}


def animated_paths(owner):
    """Data paths that an action, a strip or a driver of this data-block moves."""
    paths = set()
    data = getattr(owner, "animation_data", None)
    if data is None:
        return paths
    for curve in animation_curves(data):
        paths.add(curve.data_path)
    return paths


def animation_curves(animation_data):
    if animation_data.action:
        yield from animation_data.action.fcurves
    for track in animation_data.nla_tracks:
        if not track.mute:
            for strip in track.strips:
                if strip.action and not strip.mute:
                    yield from strip.action.fcurves
    yield from animation_data.drivers


class Visibility:
    """Objects by pointer: `direct` are those of the view layer, `instanced(c)` those that an instance of
    collection c shows."""

    def __init__(self, scene, view_layer):
        self.direct = set()
        self._of_collection = {}
        self.objects = {}
        self.collections = []
        self._walk_layer(view_layer.layer_collection)
        if scene.camera is not None:
            # Blender renders through a camera wherever it is.
            self.direct.add(scene.camera.as_pointer())
            self.objects[scene.camera.as_pointer()] = scene.camera

    def instanced(self, collection):
        key = collection.as_pointer()
        if key not in self._of_collection:
            self._of_collection[key] = shown = set()
            self._walk_collection(collection, shown)
        return self._of_collection[key]

    def all_instanced(self):
        return self._of_collection.values()

    def _walk_layer(self, layer_collection):
        collection = layer_collection.collection
        if collection.hide_render:
            return
        self.collections.append(collection)
        if not layer_collection.exclude:
            self._add(collection.objects, self.direct)
        for child in layer_collection.children:
            self._walk_layer(child)

    def _walk_collection(self, collection, shown):
        if collection.hide_render:
            return
        self.collections.append(collection)
        self._add(collection.objects, shown)
        for child in collection.children:
            self._walk_collection(child, shown)

    def _add(self, objects, shown):
        for obj in objects:
            if obj.hide_render and obj.type != "CAMERA" and "hide_render" not in animated_paths(obj):
                continue
            shown.add(obj.as_pointer())
            self.objects[obj.as_pointer()] = obj
            if obj.instance_type == "COLLECTION" and obj.instance_collection:
                self.instanced(obj.instance_collection)


def evaluate_as_render(scene, view_layer, visibility, edits):
    _show_layers(view_layer.layer_collection, edits)
    for collection in visibility.collections:
        edits.set(collection, "hide_viewport", False)
    for obj in visibility.objects.values():
        _mute_viewport_hiding(obj, edits)
        edits.set(obj, "hide_viewport", False)
    for obj in view_layer.objects:
        if obj.as_pointer() in visibility.objects and obj.hide_get(view_layer=view_layer):
            obj.hide_set(False, view_layer=view_layer)
            edits.undo_with(_hide_again, obj, view_layer)
    if scene.render.use_simplify:
        edits.set(scene.render, "simplify_subdivision", scene.render.simplify_subdivision_render)
    for obj in visibility.objects.values():
        for modifier in obj.modifiers:
            edits.set(modifier, "show_viewport", modifier.show_render)
            if hasattr(modifier, "render_levels"):
                edits.set(modifier, "levels", modifier.render_levels)
        _render_resolution(obj, edits)
    view_layer.update()


def _show_layers(layer_collection, edits):
    edits.set(layer_collection, "hide_viewport", False)
    for child in layer_collection.children:
        _show_layers(child, edits)


def _hide_again(obj, view_layer):
    obj.hide_set(True, view_layer=view_layer)


def _mute_viewport_hiding(obj, edits):
    if obj.animation_data is None:
        return
    for curve in animation_curves(obj.animation_data):
        if curve.data_path == "hide_viewport":
            edits.set(curve, "mute", True)


def _render_resolution(obj, edits):
    if obj.type in {"CURVE", "SURFACE", "FONT"}:
        for name in ("resolution_u", "resolution_v"):
            # 0 means "as in the viewport".
            if getattr(obj.data, "render_" + name):
                edits.set(obj.data, name, getattr(obj.data, "render_" + name))
    elif obj.type == "META":
        edits.set(obj.data, "resolution", obj.data.render_resolution)
