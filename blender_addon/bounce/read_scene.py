# SPDX-License-Identifier: GPL-3.0-or-later
"""Frame range, render, view and cameras in the words of BOUNCE_scene."""

from . import camera_math

_FIT = {"AUTO": "auto", "HORIZONTAL": "horizontal", "VERTICAL": "vertical"}


def frames(scene):
    return {
        "start": scene.frame_start,
        "end": scene.frame_end,
        "fps": scene.render.fps / scene.render.fps_base,
    }


def render(scene):
    settings = scene.render
    # Whole numbers, as in Blender: 300 * 0.41 is less than 123 in floats.
    percentage = settings.resolution_percentage
    return {
        "width": max(1, settings.resolution_x * percentage // 100),
        "height": max(1, settings.resolution_y * percentage // 100),
        "pixel_aspect_x": settings.pixel_aspect_x,
        "pixel_aspect_y": settings.pixel_aspect_y,
        # Absent only where Cycles is not enabled, which then renders nothing to compare with.
        "film_exposure": scene.cycles.film_exposure if hasattr(scene, "cycles") else 1.0,
    }


def view(scene):
    settings = scene.view_settings
    return {
        "display_device": scene.display_settings.display_device,
        "view_transform": settings.view_transform,
        "look": settings.look,
        "exposure": settings.exposure,
        "gamma": settings.gamma,
    }


def frame_size(scene):
    """Width and height as the camera's frame sees them: pixels times their aspect."""
    settings = scene.render
    return (
        settings.resolution_x * settings.pixel_aspect_x,
        settings.resolution_y * settings.pixel_aspect_y,
    )


def camera_values(camera):
    """Values that may vary over time, at the current frame."""
    values = {"shift_x": float(camera.shift_x), "shift_y": float(camera.shift_y)}
    if camera.type == "ORTHO":
        values["ortho_scale"] = float(camera.ortho_scale)
    else:
        values["focal_length_mm"] = float(camera.lens)
    return values


def camera_fixed(camera):
    return {
        "sensor_fit": _FIT[camera.sensor_fit],
        "sensor_width_mm": float(camera.sensor_width),
        "sensor_height_mm": float(camera.sensor_height),
    }


def camera_yfov(camera, values, scene):
    return camera_math.yfov({**camera_fixed(camera), **values}, *frame_size(scene))


def camera_magnification(camera, values, scene):
    return camera_math.magnification({**camera_fixed(camera), **values}, *frame_size(scene))
