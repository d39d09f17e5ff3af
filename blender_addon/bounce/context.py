# SPDX-License-Identifier: GPL-3.0-or-later
"""What one export knows, shared by its stages and by the exporter's hooks."""

_current = None


class ExportContext:
    def __init__(self, scene, options, visibility, models, samples, prepared, unsupported):
        self.scene = scene
        self.options = options
        self.visibility = visibility
        self.models = models  # material pointer -> (material, Model)
        self.samples = samples
        self.prepared = prepared
        self.unsupported = unsupported
        self.failure = None
        self.left_out = [*prepared.left_out]  # (name, what, reason)
        # Filled by the hooks.
        self.light_nodes = {}  # light pointer -> [(light, gltf node)]
        self.cameras = {}  # camera pointer -> (camera, gltf camera)
        self.materials = {}  # material pointer -> [gltf material]
        self.default_material = None  # of primitives without one
        self.world_image = None  # as in the document
        self.kept_in_order = []  # names of compressed meshes whose vertices stay in order for their shape keys

    def source_of(self, obj):
        """The pointer under which an object's samples are kept: a stand-in moves as what it stands for."""
        key = obj.as_pointer()
        return self.prepared.source.get(key, key)

    def light_index(self, light_key):
        return list(self.light_nodes).index(light_key)


def current():
    return _current


class active:
    """Makes a context the one that the hooks see. Outside of it they do nothing: other glTF exports of the same
    Blender stay what they are."""

    def __init__(self, context):
        self._context = context

    def __enter__(self):
        global _current
        _current = self._context
        return self._context

    def __exit__(self, *exception):
        global _current
        _current = None
