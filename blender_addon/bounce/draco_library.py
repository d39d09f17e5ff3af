# SPDX-License-Identifier: GPL-3.0-or-later
"""Finds the Draco library that Blender's glTF exporter loads. No Blender needed."""

import os
import sys
from pathlib import Path

VARIABLE = "BLENDER_EXTERN_DRACO_LIBRARY_PATH"
FILE_NAME = {"win32": "extern_draco.dll", "darwin": "libextern_draco.dylib"}.get(sys.platform, "libextern_draco.so")


def candidates(addon_folder):
    """Inside the add-on (as the package script puts it), then the checkout's builds, newest first."""
    addon_folder = Path(addon_folder)
    yield addon_folder / FILE_NAME
    build = addon_folder.resolve().parent.parent / "build"
    found = [*build.glob(FILE_NAME), *build.glob(f"*/{FILE_NAME}")]
    yield from sorted(found, key=lambda path: path.stat().st_mtime, reverse=True)


def locate(blender_own_path, addon_folder, environment=os.environ):
    """The library to use, or None.

    A path that the user set in the environment comes first, then the library that Blender brings, then ours. Ours is
    put into the environment, which is where Blender's exporter and importer look.
    """
    if environment.get(VARIABLE):
        path = Path(environment[VARIABLE])
        return path if path.is_file() else None
    if blender_own_path is not None and Path(blender_own_path).is_file():
        return Path(blender_own_path)
    for path in candidates(addon_folder):
        if path.is_file():
            environment[VARIABLE] = str(path)
            return path
    return None
