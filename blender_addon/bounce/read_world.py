# SPDX-License-Identifier: GPL-3.0-or-later
"""Blender's world as a constant radiance."""

import numpy as np

from . import sockets


# Means by image, for as long as one sampling lasts: reading a large image anew for every frame takes minutes.
_means = {}


def forget_images():
    _means.clear()


def values(world):
    """{color, strength} at the current frame; black where issues() says that the tree cannot be represented."""
    if not world.use_nodes or world.node_tree is None:
        return {"color": [float(c) for c in world.color], "strength": 1.0}
    node = sockets.surface_node(world.node_tree, "OUTPUT_WORLD")
    if node is None or node.type != "BACKGROUND":
        return {"color": [0.0, 0.0, 0.0], "strength": 0.0}
    color = sockets.constant(node.inputs["Color"])
    if color is not None:
        color = [max(0.0, c) for c in color]
    else:
        color = _mean_of_environment(sockets.source(node.inputs["Color"])[0])
    strength = sockets.constant(node.inputs["Strength"])
    return {"color": color, "strength": 1.0 if strength is None else max(0.0, strength)}


def issues(world):
    if not world.use_nodes or world.node_tree is None:
        return
    output = sockets.output_node(world.node_tree, "OUTPUT_WORLD")
    if output is not None and output.inputs["Volume"].is_linked:
        yield f"world '{world.name}': volume"
    node = sockets.surface_node(world.node_tree, "OUTPUT_WORLD")
    if node is None:
        return
    if node.type != "BACKGROUND":
        yield f"world '{world.name}': {sockets.describe(node)}; exported black"
        return
    if sockets.constant(node.inputs["Color"]) is None:
        feeding = sockets.source(node.inputs["Color"])[0]
        instead = "its mean colour" if _is_environment(feeding) else "black"
        yield f"world '{world.name}': Color comes from {sockets.describe(feeding)}; exported as {instead}"
    if sockets.constant(node.inputs["Strength"]) is None:
        feeding = sockets.source(node.inputs["Strength"])[0]
        yield f"world '{world.name}': Strength comes from {sockets.describe(feeding)}; exported as 1"


def _is_environment(node):
    # An image whose file is missing has no pixels.
    return node.type == "TEX_ENVIRONMENT" and node.image is not None and len(node.image.pixels) > 0


def _mean_of_environment(node):
    if not _is_environment(node):
        return [0.0, 0.0, 0.0]
    if node.image.name not in _means:
        _means[node.image.name] = mean_radiance(node.image)
    return _means[node.image.name]


def mean_radiance(image):
    """The radiance that a sphere of this equirectangular image sends on average: rows weigh by the solid angle that
    they cover."""
    width, height = image.size
    pixels = np.empty(width * height * image.channels, dtype=np.float32)
    image.pixels.foreach_get(pixels)
    pixels = pixels.reshape(height, width, -1)[:, :, :3].astype(np.float64)
    weight = np.cos((np.arange(height) + 0.5) / height * np.pi - np.pi / 2)
    return [float(c) for c in (pixels.mean(axis=1) * weight[:, None]).sum(axis=0) / weight.sum()]
