# SPDX-License-Identifier: GPL-3.0-or-later
"""Finds shapes that change over time by something else than bones and shape keys, which the file cannot say."""

import numpy as np

from .edits import Edits
from .geometry import CONVERTED_TYPES, evaluated_coordinates
from .visibility import animated_paths

# Enough to catch a motion that returns to where it began.
_PROBES = 5
_NOISE_M = 1e-5
# Modifiers whose result depends on the shape alone, unless their own settings are animated.
_STILL = {"SUBSURF", "MULTIRES", "TRIANGULATE", "BEVEL", "EDGE_SPLIT", "SOLIDIFY", "WEIGHTED_NORMAL", "DECIMATE",
          "REMESH", "WELD", "SKIN", "WIREFRAME", "SMOOTH", "CORRECTIVE_SMOOTH", "LAPLACIANSMOOTH", "NORMAL_EDIT",
          "ARMATURE", "PARTICLE_SYSTEM", "COLLISION"}


def deforming(scene, objects, frames):
    """Names of the objects among `objects` whose mesh changes, bones and shape keys aside."""
    suspects = [obj for obj in objects if _is_suspect(obj)]
    if not suspects or len(frames) < 2:
        return []
    first, changed = {}, {}
    with Edits() as edits:
        for obj in suspects:
            for modifier in obj.modifiers:
                if modifier.type == "ARMATURE":
                    edits.set(modifier, "show_viewport", False)
            if obj.type == "MESH" and obj.data.shape_keys is not None:
                edits.set(obj, "active_shape_key_index", 0)
                edits.set(obj, "show_only_shape_key", True)
        for frame in sorted({frames[round(i)] for i in np.linspace(0, len(frames) - 1, _PROBES)}):
            scene.frame_set(frame)
            for obj in suspects:
                shape = evaluated_coordinates(obj)
                if _differs(first.setdefault(obj.name, shape), shape):
                    changed[obj.name] = None
    return list(changed)


def skins_adrift(objects, samples):
    """Names of skinned meshes that move against their armature; glTF has no place for that motion."""
    for obj in objects:
        armature = next((m.object for m in obj.modifiers if m.type == "ARMATURE" and m.show_render and m.object), None)
        if obj.type != "MESH" or armature is None or armature.as_pointer() not in samples.world_matrix:
            continue
        relative = np.linalg.inv(samples.world_matrix[armature.as_pointer()]) @ samples.world_matrix[obj.as_pointer()]
        if np.abs(relative - relative[0]).max() > 1e-4 * max(1.0, np.abs(relative).max()):
            yield obj.name


def _is_suspect(obj):
    if obj.type in CONVERTED_TYPES:
        return True
    if obj.type != "MESH":
        return False
    if any(path.startswith("modifiers") for path in animated_paths(obj)):
        return True
    return any(m.show_viewport and m.type not in _STILL for m in obj.modifiers)


def _differs(before, now):
    return before.shape != now.shape or (len(now) > 0 and float(np.abs(before - now).max()) > _NOISE_M)
