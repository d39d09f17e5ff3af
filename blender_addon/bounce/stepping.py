# SPDX-License-Identifier: GPL-3.0-or-later
"""Whether Blender holds a value from key to key instead of moving it."""

from .visibility import animation_curves


def is_stepped(owner, data_paths):
    """True where everything that animates these paths is curves of constant keys."""
    data = getattr(owner, "animation_data", None)
    if data is None or data.nla_tracks or any(driver.data_path in data_paths for driver in data.drivers):
        return False
    curves = [curve for curve in animation_curves(data) if curve.data_path in data_paths]
    return bool(curves) and all(
        key.interpolation == "CONSTANT" for curve in curves for key in curve.keyframe_points
    )


_TRANSFORM = {"location", "rotation_euler", "rotation_quaternion", "rotation_axis_angle", "scale"}


def object_is_stepped(obj):
    """A transform made by the object's own constant keys alone."""
    return obj.parent is None and not obj.constraints and is_stepped(obj, _TRANSFORM)
