# SPDX-License-Identifier: GPL-3.0-or-later
"""Exports animated scenes with their lights for the Bounce previewer."""

bl_info = {
    "name": "Bounce",
    "description": "Export animated scenes with their lights for the Bounce previewer",
    "author": "The Bounce authors",
    "version": (0, 1, 0),
    "blender": (3, 4, 0),
    "location": "File > Export > Bounce (.glb)",
    "category": "Import-Export",
}

# The modules for arithmetic are also imported without Blender, by their tests.
try:
    import bpy  # noqa: F401
except ModuleNotFoundError:
    _IN_BLENDER = False
else:
    _IN_BLENDER = True

if _IN_BLENDER:
    from . import operator

    def register():
        operator.register()

    def unregister():
        operator.unregister()

    def __getattr__(name):
        # Blender's glTF exporter looks for this class in every enabled add-on. Its module needs the exporter, which
        # may be enabled after this add-on, so it is imported when it is first asked for.
        if name == "glTF2ExportUserExtension":
            from .hooks import glTF2ExportUserExtension

            return glTF2ExportUserExtension
        raise AttributeError(f"module {__name__!r} has no attribute {name!r}")
