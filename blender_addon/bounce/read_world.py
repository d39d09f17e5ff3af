# SPDX-License-Identifier: GPL-3.0-or-later
"""Blender's world: a constant radiance, or an equirectangular image with a turn and a strength."""

import numpy as np

from . import environment, sockets


# Means by image, for as long as one sampling lasts: reading a large image anew for every frame takes minutes.
_means = {}


def forget_images():
    _means.clear()


def values(world):
    """{color, strength} at the current frame, and the rotation of an image; color is the image's mean. Black where
    issues() says that the tree cannot be represented."""
    if not world.use_nodes or world.node_tree is None:
        return {"color": [float(c) for c in world.color], "strength": 1.0}
    node = sockets.surface_node(world.node_tree, "OUTPUT_WORLD")
    if node is None or node.type != "BACKGROUND":
        return {"color": [0.0, 0.0, 0.0], "strength": 0.0}
    color = sockets.constant(node.inputs["Color"])
    turn = {}
    if color is not None:
        color = [max(0.0, c) for c in color]
    else:
        feeding = sockets.source(node.inputs["Color"])[0]
        color = _color_of(feeding)
        if environment.is_drawn(feeding):
            turn = {"rotation": environment.rotation(feeding)}
    strength = sockets.constant(node.inputs["Strength"])
    return {"color": color, "strength": 1.0 if strength is None else max(0.0, strength), **turn}


def image_of(world):
    """The image that goes into the file, or None."""
    if not world.use_nodes or world.node_tree is None:
        return None
    node = sockets.surface_node(world.node_tree, "OUTPUT_WORLD")
    if node is None or node.type != "BACKGROUND":
        return None
    feeding = sockets.source(node.inputs["Color"])[0]
    return feeding.image if feeding is not None and environment.is_drawn(feeding) else None


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
        if feeding.type == "TEX_ENVIRONMENT":
            for what in environment.issues(feeding):
                yield f"world '{world.name}': {what}"
        else:
            yield f"world '{world.name}': Color comes from {sockets.describe(feeding)}; exported as black"
    if sockets.constant(node.inputs["Strength"]) is None:
        feeding = sockets.source(node.inputs["Strength"])[0]
        yield f"world '{world.name}': Strength comes from {sockets.describe(feeding)}; exported as 1"


def _color_of(node):
    if node.type != "TEX_ENVIRONMENT":
        return [0.0, 0.0, 0.0]
    if not environment.has_pixels(node.image):
        return environment.MISSING
    if node.image.name not in _means:
        _means[node.image.name] = mean_radiance(environment.pixels(node.image))
    return _means[node.image.name]


def mean_radiance(pixels):
    """The radiance that a sphere of these equirectangular pixels [row, column, 3] sends on average: rows weigh by the
    solid angle that they cover. What is negative or not finite counts as 0."""
    pixels = np.nan_to_num(pixels.astype(np.float64), nan=0.0, posinf=0.0, neginf=0.0).clip(min=0.0)
    height = len(pixels)
    weight = np.cos((np.arange(height) + 0.5) / height * np.pi - np.pi / 2)
    return [float(c) for c in (pixels.mean(axis=1) * weight[:, None]).sum(axis=0) / weight.sum()]
