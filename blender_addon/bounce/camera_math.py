# SPDX-License-Identifier: GPL-3.0-or-later
"""What Blender's camera shows, as glTF's fields of view. No Blender needed."""

import math


def fit_is_horizontal(sensor_fit, width, height):
    """`auto` fits the sensor to the longer side. Width and height include the pixel aspect."""
    return width >= height if sensor_fit == "auto" else sensor_fit == "horizontal"


def yfov(camera, width, height):
    """Vertical field of view in radians. Auto always measures by the sensor's width, as Blender does."""
    sensor = camera["sensor_height_mm"] if camera["sensor_fit"] == "vertical" else camera["sensor_width_mm"]
    half = sensor / (2.0 * camera["focal_length_mm"])
    if fit_is_horizontal(camera["sensor_fit"], width, height):
        half *= height / width
    return 2.0 * math.atan(half)


def magnification(camera, width, height):
    """(xmag, ymag): half the extent that an orthographic camera shows, in metres."""
    half = camera["ortho_scale"] / 2.0
    if fit_is_horizontal(camera["sensor_fit"], width, height):
        return half, half * height / width
    return half * width / height, half
