# SPDX-License-Identifier: GPL-3.0-or-later
"""The equirectangular image of a world: which node gives it, how it is turned, and the bytes that travel."""

import tempfile
from pathlib import Path

import bpy
import mathutils
import numpy as np

from . import sockets

# What Cycles shows where an image has no file.
MISSING = [1.0, 0.0, 1.0]

_EXR, _HDR = b"\x76\x2f\x31\x01", b"#?"
# Colour spaces whose values are what Cycles calculates with.
_AS_STORED = {"Linear", "Linear Rec.709", "Non-Color", "Raw"}


def has_pixels(image):
    """An image whose file is missing has none."""
    return image is not None and len(image.pixels) > 0


def is_drawn(node):
    """Whether the node's image goes into the file; otherwise its mean colour stands for it."""
    return (node.type == "TEX_ENVIRONMENT" and node.projection == "EQUIRECTANGULAR" and has_pixels(node.image)
            and node.image.source in {"FILE", "GENERATED"} and node.image.type != "MULTILAYER")


def _mapping(node):
    """(Mapping node or None, words for what is not followed or None)."""
    feeding, output = sockets.source(node.inputs["Vector"])
    if feeding is None or _is_direction(feeding, output):
        return None, None
    if feeding.type != "MAPPING":
        return None, f"Vector comes from {sockets.describe(feeding)}"
    before, output = sockets.source(feeding.inputs["Vector"])
    if before is None:
        return None, "Mapping without a Vector"
    if not _is_direction(before, output):
        return None, f"Vector comes from {sockets.describe(before)}"
    return feeding, None


def _is_direction(node, output):
    """Outputs that are the direction one looks along, where a world is shaded."""
    return (node.type == "TEX_COORD" and (output.name == "Generated" or (output.name == "Object" and node.object is None))
            or node.type == "NEW_GEOMETRY" and output.name == "Position")


def rotation(node):
    """The turn of the image about the scene, a quaternion x, y, z, w in glTF's axes."""
    mapping = _mapping(node)[0]
    angles = sockets.constant(mapping.inputs["Rotation"]) if mapping is not None else None
    turn = mathutils.Euler(angles or (0.0, 0.0, 0.0), "XYZ").to_quaternion()
    if mapping is not None and mapping.vector_type != "TEXTURE":
        turn.invert()  # these turn the direction that is looked up; that node's other type undoes it
    return [turn.x, turn.z, -turn.y, turn.w]


def issues(node):
    """Words for what of the node is not represented."""
    name = sockets.describe(node)
    image = node.image
    if image is None:
        yield f"{name} without an image; exported as magenta, which Cycles shows"
        return
    if not has_pixels(image):
        yield f"{name} whose file is missing ({image.name}); exported as magenta, which Cycles shows"
        return
    if not is_drawn(node):
        why = ("with mirror ball projection" if node.projection != "EQUIRECTANGULAR"
               else f"with a {image.source.lower()} image" if image.type != "MULTILAYER" else "with a multilayer image")
        yield f"{name} {why}; exported as its mean colour"
        return
    mapping, problem = _mapping(node)
    if problem:
        yield f"{name}: {problem}; exported without it"
    if mapping is not None:
        yield from _mapping_issues(name, mapping)
    if node.interpolation != "Linear":
        yield f"{name} with interpolation {node.interpolation}; exported as Linear"
    if not image.is_float and image.colorspace_settings.name not in {*_AS_STORED, "sRGB"}:
        yield f"{name}: colour space {image.colorspace_settings.name}; exported as sRGB"


def _mapping_issues(name, mapping):
    for socket, neutral in (("Location", 0.0), ("Scale", 1.0)):
        # A Mapping of vectors or normals has no location.
        if socket in mapping.inputs and mapping.inputs[socket].enabled:
            value = sockets.constant(mapping.inputs[socket])
            if value is None or any(abs(v - neutral) > 1e-6 for v in value):
                yield f"{name}: the {socket} of its Mapping; exported without it"
    if sockets.constant(mapping.inputs["Rotation"]) is None:
        yield f"{name}: the Rotation of its Mapping comes from a node; exported without it"


def pixels(image):
    """Scene-linear values [row from the bottom, column, 3]."""
    width, height = image.size
    values = np.empty(width * height * image.channels, dtype=np.float32)
    image.pixels.foreach_get(values)
    values = values.reshape(height, width, -1)
    values = values[:, :, :3] if values.shape[2] >= 3 else np.repeat(values[:, :, :1], 3, axis=2)
    # Blender converts images of floats as it loads them, and keeps bytes as they are.
    if not image.is_float and image.colorspace_settings.name not in _AS_STORED:
        values = np.where(values <= 0.04045, values / 12.92, ((values + 0.055) / 1.055) ** 2.4)
    return values


def encoded(image):
    """(bytes, MIME type) of an OpenEXR or Radiance HDR image with scene-linear values: the image's own file where it is
    such a one."""
    if image.source == "FILE" and not image.is_dirty and image.colorspace_settings.name in _AS_STORED:
        data = _own_file(image)
        if data.startswith(_EXR):
            return data, "image/x-exr"
        if data.startswith(_HDR):
            return data, "image/vnd.radiance"
    return _as_exr(image), "image/x-exr"


def _own_file(image):
    if image.packed_file is not None:
        return bytes(image.packed_file.data)
    path = Path(bpy.path.abspath(image.filepath, library=image.library))
    return path.read_bytes() if path.is_file() else b""


def _as_exr(image):
    width, height = image.size
    values = np.ones((height, width, 4), dtype=np.float32)
    values[:, :, :3] = pixels(image)
    copy = bpy.data.images.new("Bounce world", width, height, float_buffer=True)
    try:
        # Otherwise saving would encode the values once more.
        copy.colorspace_settings.name = "Non-Color"
        copy.pixels.foreach_set(values.ravel())
        with tempfile.TemporaryDirectory() as folder:
            copy.filepath_raw = str(Path(folder) / "world.exr")
            copy.file_format = "OPEN_EXR"
            copy.save()
            return Path(copy.filepath_raw).read_bytes()
    finally:
        bpy.data.images.remove(copy)
