# SPDX-License-Identifier: GPL-3.0-or-later
"""The image that an area light shines with: a coarse grid of colours over its surface.

Cycles' only coordinates on a light are Geometry's Parametric: u along the light's X, v along its Y, from corner to corner of
the square around its shape. Elsewhere one place of the image is looked up for all of the light, or none.
"""

import numpy as np

from . import environment, sockets

# Cells a side. Soft shadows and bounced light take fewer places on a light than these.
CELLS = 16


def image_node(light, emission):
    """The Image Texture that feeds the Emission's colour, where what Cycles shows of it is known; or None."""
    if light.type != "AREA":
        return None
    node, output = sockets.source(emission.inputs["Color"])
    if node is None or node.type != "TEX_IMAGE" or output.name != "Color" or not environment.has_pixels(node.image):
        return None
    feeding, coordinate = sockets.source(node.inputs["Vector"])
    if feeding is None or feeding.type != "NEW_GEOMETRY" or coordinate.name != "Parametric":
        return None
    return node if node.projection == "FLAT" and node.image.source in {"FILE", "GENERATED"} else None


# Places along a side between the pixels of a small image.
_FINE = 128

# Of one export: a light is read once a frame, its image is not animated.
_known = {}


def forget():
    """An image may be another at the next export."""
    _known.clear()


def read(node, round_shape):
    """(mean colour over the light, {"width", "height", "rgb"}): rgb over the mean, rows from v = 0 up. Where the mean of a
    channel is 0, so is the pattern's."""
    key = (node.image.as_pointer(), node.interpolation, node.extension, round_shape)
    if key not in _known:
        _known[key] = _read(node, round_shape)
    return _known[key]


def _read(node, round_shape):
    cells = _boxes(_seen(node), CELLS, CELLS)
    inside = _share_inside(CELLS, CELLS) if round_shape else np.ones((CELLS, CELLS))
    mean = (cells * inside[:, :, None]).sum(axis=(0, 1)) / inside.sum()
    relative = np.divide(cells, mean, out=np.zeros_like(cells), where=mean > 0.0)
    return mean.tolist(), {"width": CELLS, "height": CELLS, "rgb": [round(float(v), 6) for v in relative.ravel()]}


def _seen(node):
    """What the light shows, scene-linear [row, column, 3]: the image, or finely between its pixels where there are few of them."""
    stored = np.maximum(environment.stored_pixels(node.image).astype(np.float64), 0.0)
    if node.interpolation != "Closest":
        for axis in (0, 1):
            stored = _between(stored, axis, node.extension)
    # Cycles interpolates bytes as they are encoded.
    return environment.decoded(stored, node.image)


def _between(values, axis, extension):
    """Linear interpolation along an axis, at _FINE places at least."""
    count = values.shape[axis]
    places = count * -(-_FINE // count) if count < _FINE else count
    at = (np.arange(places) + 0.5) / places * count - 0.5
    low = np.floor(at).astype(int)
    part = (at - low).reshape([-1 if i == axis else 1 for i in range(values.ndim)])

    def look_up(index):
        if extension == "REPEAT":
            return np.take(values, index % count, axis=axis)
        found = np.take(values, np.clip(index, 0, count - 1), axis=axis)
        if extension == "CLIP":
            outside = (index < 0) | (index >= count)
            found = np.where(outside.reshape(part.shape), 0.0, found)
        return found

    return (1.0 - part) * look_up(low) + part * look_up(low + 1)


def _boxes(pixels, width, height):
    """Means over width x height boxes; a pixel on a border belongs to both in part."""
    return _along(_along(pixels, height).swapaxes(0, 1), width).swapaxes(0, 1)


def _along(values, count):
    edges = np.linspace(0.0, len(values), count + 1)
    sums = np.concatenate([np.zeros((1, *values.shape[1:])), np.cumsum(values, axis=0)])
    low = np.minimum(edges.astype(int), len(values) - 1)
    at = sums[low] + (edges - low).reshape(-1, *[1] * (values.ndim - 1)) * values[low]
    return np.diff(at, axis=0) * (count / len(values))


def _share_inside(width, height, steps=8):
    """The part of each cell that lies in the ellipse within the grid."""
    x = (np.arange(width * steps) + 0.5) / (width * steps) * 2.0 - 1.0
    y = (np.arange(height * steps) + 0.5) / (height * steps) * 2.0 - 1.0
    inside = (x[None, :] ** 2 + y[:, None] ** 2 <= 1.0).astype(float)
    return inside.reshape(height, steps, width, steps).mean(axis=(1, 3))


def issues(node):
    """Words for what of the node is not represented."""
    image = node.image
    name = sockets.describe(node)
    if not image.is_float and image.colorspace_settings.name not in {*environment.AS_STORED, "sRGB"}:
        yield f"{name}: colour space {image.colorspace_settings.name}; exported as sRGB"
    if node.interpolation in {"Cubic", "Smart"}:
        yield f"{name} with interpolation {node.interpolation}; exported as Linear"
    if node.extension not in {"REPEAT", "EXTEND", "CLIP"}:
        yield f"{name} with extension {node.extension}; exported as Extend"
