# SPDX-License-Identifier: GPL-3.0-or-later
"""The file's one animation: every channel that moves, a key a frame, the first frame at time 0."""

from dataclasses import dataclass

import numpy as np
from io_scene_gltf2.io.com import gltf2_io
from io_scene_gltf2.io.com.gltf2_io_extensions import Extension
from io_scene_gltf2.io.exp.gltf2_io_binary_data import BinaryData

from . import tracks

_FLOAT, _UNSIGNED_BYTE = 5126, 5121
_TYPE_OF_SIZE = {1: "SCALAR", 2: "VEC2", 3: "VEC3", 4: "VEC4"}


@dataclass
class Channel:
    """`path` is glTF's for a node (translation, rotation, scale, weights), or a Pointer."""

    node: object
    path: object
    values: np.ndarray
    step: bool = False
    is_bool: bool = False


def node_channels(node, placement, step):
    rotations = tracks.continuous_quaternions(placement.rotations)
    for path, values in (("translation", placement.translations), ("rotation", rotations), ("scale", placement.scales)):
        if not tracks.is_constant(values):
            yield Channel(node, path, values, step)


def build(name, channels, frames, fps):
    """A gltf2_io.Animation; None where nothing moves."""
    if not channels:
        return None
    times = _accessor(tracks.key_times(frames, fps)[:, None], with_bounds=True)
    samplers, gltf_channels = [], []
    for channel in channels:
        step = channel.step or channel.is_bool
        samplers.append(gltf2_io.AnimationSampler(
            extensions=None, extras=None, input=times, interpolation="STEP" if step else "LINEAR",
            output=_output(channel),
        ))
        gltf_channels.append(gltf2_io.AnimationChannel(
            extensions=None, extras=None, sampler=len(samplers) - 1, target=_target(channel),
        ))
    return gltf2_io.Animation(channels=gltf_channels, extensions=None, extras=None, name=name, samplers=samplers)


def _target(channel):
    if isinstance(channel.path, str):
        return gltf2_io.AnimationChannelTarget(extensions=None, extras=None, node=channel.node, path=channel.path)
    pointer = Extension("KHR_animation_pointer", {"pointer": channel.path}, required=False)
    return gltf2_io.AnimationChannelTarget(
        extensions={"KHR_animation_pointer": pointer}, extras=None, node=None, path="pointer"
    )


def _output(channel):
    values = np.asarray(channel.values)
    if channel.path == "weights":
        # glTF lists the weights of all targets of a key after one another, as scalars.
        values = values.reshape(-1, 1)
    return _accessor(values, is_bool=channel.is_bool)


def _accessor(values, with_bounds=False, is_bool=False):
    data = np.ascontiguousarray(values, dtype=np.uint8 if is_bool else np.float32)
    return gltf2_io.Accessor(
        buffer_view=BinaryData(data.tobytes()), byte_offset=None,
        component_type=_UNSIGNED_BYTE if is_bool else _FLOAT, count=len(data), extensions=None, extras=None,
        max=data.max(axis=0).tolist() if with_bounds else None, min=data.min(axis=0).tolist() if with_bounds else None,
        name=None, normalized=None, sparse=None, type=_TYPE_OF_SIZE[data.shape[1]],
    )
