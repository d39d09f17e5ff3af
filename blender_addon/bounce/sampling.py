# SPDX-License-Identifier: GPL-3.0-or-later
"""Steps through the frame range once and writes down what Blender evaluates.

Constraints, drivers, NLA, physics and keys all end in evaluated values; reading those is right for each of them, where
reading curves would have to know each of them.
"""

import bpy
import numpy as np

from . import light_pattern, materials, read_lights, read_scene, read_world
from .visibility import animation_curves


class Samples:
    def __init__(self, frames):
        self.frames = frames
        self.world_matrix = {}  # object pointer -> [frame, 4, 4]
        self.bone_matrix = {}  # (armature object pointer, bone name) -> [frame, 4, 4] in the armature's space
        self.visible = {}  # object pointer -> [frame] of bool
        self.weights = {}  # mesh object pointer -> [frame, shape key]
        self.values = {}  # (kind, pointer) -> {name: [frame, component]}

    def at_start(self, kind, key):
        """The values of the first frame, floats as floats and vectors as lists."""
        return {
            name: track[0].tolist() if track.shape[1] > 1 else float(track[0, 0])
            for name, track in self.values[kind, key].items()
        }


def is_animated(scene):
    """Whether anything at all may change over the frames; a still scene is read once."""
    if scene.rigidbody_world is not None or bpy.app.handlers.frame_change_pre or bpy.app.handlers.frame_change_post:
        return True
    for name in ("scenes", "objects", "meshes", "armatures", "lights", "cameras", "worlds", "materials",
                 "node_groups", "shape_keys", "curves", "metaballs", "lattices"):
        for block in getattr(bpy.data, name):
            for owner in (block, getattr(block, "node_tree", None)):
                data = getattr(owner, "animation_data", None)
                if data is not None and any(True for _ in animation_curves(data)):
                    return True
            if name == "objects" and any(m.type in _TIME_MODIFIERS for m in block.modifiers):
                return True
    return False


# Modifiers that move by themselves.
_TIME_MODIFIERS = {"CLOTH", "SOFT_BODY", "OCEAN", "WAVE", "MESH_CACHE", "MESH_SEQUENCE_CACHE", "DYNAMIC_PAINT",
                   "FLUID", "NODES", "PARTICLE_INSTANCE", "EXPLODE"}


def shape_keys_of(obj):
    """The keys that become morph targets, in Blender's exporter's order."""
    keys = getattr(obj.data, "shape_keys", None)
    if keys is None:
        return []
    return [key for key in keys.key_blocks if key != key.relative_key and not key.mute]


def sample(scene, objects, models, frames):
    """`objects` by pointer; `models` are the material models by material pointer, with the material."""
    read_world.forget_images()
    recorder = _Recorder(scene, objects, models)
    for frame in frames:
        scene.frame_set(frame)
        recorder.record(bpy.context.evaluated_depsgraph_get())
    return recorder.samples(frames)


class _Recorder:
    def __init__(self, scene, objects, models):
        light_pattern.forget()
        self._scene = scene
        self._objects = objects
        self._models = models
        self._matrices = {}
        self._bones = {}
        self._visible = {}
        self._weights = {}
        self._values = {}

    def record(self, depsgraph):
        for key, obj in self._objects.items():
            self._record_object(key, obj.evaluated_get(depsgraph), obj)
        scene = self._scene.evaluated_get(depsgraph)
        self._put("view", None, {"exposure": scene.view_settings.exposure})
        if self._scene.world is not None:
            self._put("world", None, read_world.values(self._scene.world.evaluated_get(depsgraph)))
        for key, (material, model) in self._models.items():
            self._put("material", key, materials.values(material.evaluated_get(depsgraph), model))

    def _record_object(self, key, evaluated, original):
        self._matrices.setdefault(key, []).append(np.array(evaluated.matrix_world, dtype=np.float64))
        # Blender renders through a camera that renders hide.
        self._visible.setdefault(key, []).append(original.type == "CAMERA" or not evaluated.hide_render)
        data_key = original.data.as_pointer() if original.data is not None else None
        if original.type == "ARMATURE":
            for bone in evaluated.pose.bones:
                self._bones.setdefault((key, bone.name), []).append(np.array(bone.matrix, dtype=np.float64))
        elif original.type == "LIGHT":
            self._put("light", data_key, read_lights.values(evaluated.data))
        elif original.type == "CAMERA":
            self._put("camera", data_key, read_scene.camera_values(evaluated.data))
        elif shape_keys_of(original):
            self._weights.setdefault(key, []).append(_key_values(original, evaluated))

    def _put(self, kind, key, values):
        tracks = self._values.setdefault((kind, key), {})
        for name, value in values.items():
            # Two objects may share one light; it is read once a frame.
            tracks.setdefault(name, {})[self._scene.frame_current] = np.atleast_1d(value)

    def samples(self, frames):
        result = Samples(frames)
        result.world_matrix = {key: np.array(m) for key, m in self._matrices.items()}
        result.bone_matrix = {key: np.array(m) for key, m in self._bones.items()}
        result.visible = {key: np.array(v) for key, v in self._visible.items()}
        result.weights = {key: np.array(w, dtype=np.float64) for key, w in self._weights.items()}
        result.values = {
            owner: {name: np.array([track[f] for f in frames], dtype=np.float64) for name, track in tracks.items()}
            for owner, tracks in self._values.items()
        }
        return result


def _key_values(original, evaluated):
    blocks = evaluated.data.shape_keys.key_blocks if evaluated.data.shape_keys else None
    if blocks is None:
        # A mesh that modifiers rebuilt carries no keys; the key data-block is evaluated beside it.
        depsgraph = bpy.context.evaluated_depsgraph_get()
        blocks = original.data.shape_keys.evaluated_get(depsgraph).key_blocks
    if original.show_only_shape_key:
        pinned = original.active_shape_key.name
        return [float(key.name == pinned) for key in shape_keys_of(original)]
    return [blocks[key.name].value for key in shape_keys_of(original)]
