# SPDX-License-Identifier: GPL-3.0-or-later
"""The bytes of a world's image as they travel in the file."""

import tempfile
from pathlib import Path

import bpy
import numpy as np

from .environment import AS_STORED, pixels

_EXR, _HDR = b"\x76\x2f\x31\x01", b"#?"


def encoded(image):
    """(bytes, MIME type) of an OpenEXR or Radiance HDR image with scene-linear values: the image's own file where it is
    such a one."""
    if image.source == "FILE" and not image.is_dirty and image.colorspace_settings.name in AS_STORED:
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
