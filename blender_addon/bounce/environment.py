# SPDX-License-Identifier: GPL-3.0-or-later
"""The equirectangular image of a world: which node gives it, how it is turned, and its values. The bytes that travel are
environment_file's."""

import numpy as np

from . import sockets

# What Cycles shows where an image has no file.
MISSING = [1.0, 0.0, 1.0]

# Colour spaces whose values are what Cycles calculates with.
AS_STORED = {"Linear", "Linear Rec.709", "Non-Color", "Raw"}


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
    turn = np.array([0.0, 0.0, 0.0, 1.0])
    for axis, angle in enumerate(angles or ()):  # Euler XYZ: about X first
        about = np.zeros(4)
        about[axis], about[3] = np.sin(angle / 2), np.cos(angle / 2)
        turn = _product(about, turn)
    if mapping is not None and mapping.vector_type != "TEXTURE":
        turn[:3] = -turn[:3]  # these turn the direction that is looked up; that node's other type undoes it
    x, y, z, w = turn.tolist()
    return [x, z, -y, w]


def _product(a, b):
    vector = a[3] * b[:3] + b[3] * a[:3] + np.cross(a[:3], b[:3])
    return np.append(vector, a[3] * b[3] - a[:3] @ b[:3])


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
    if not image.is_float and image.colorspace_settings.name not in {*AS_STORED, "sRGB"}:
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
    return decoded(stored_pixels(image), image)


def stored_pixels(image):
    """Values as the image has them [row from the bottom, column, 3]."""
    width, height = image.size
    values = np.empty(width * height * image.channels, dtype=np.float32)
    image.pixels.foreach_get(values)
    values = values.reshape(height, width, -1)
    return values[:, :, :3] if values.shape[2] >= 3 else np.repeat(values[:, :, :1], 3, axis=2)


def decoded(values, image):
    # Blender converts images of floats as it loads them, and keeps bytes as they are.
    if not image.is_float and image.colorspace_settings.name not in AS_STORED:
        values = np.where(values <= 0.04045, values / 12.92, ((values + 0.055) / 1.055) ** 2.4)
    return values
