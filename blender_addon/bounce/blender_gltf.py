# SPDX-License-Identifier: GPL-3.0-or-later
"""Drives Blender's own glTF exporter."""

import contextlib
import io
import os

import addon_utils
import bpy

from . import draco_library
from .errors import ExportError

_MODULE = "io_scene_gltf2"


def require():
    """The exporter is part of Blender, but it can be switched off, and it does not load without numpy."""
    if _MODULE not in bpy.context.preferences.addons:
        addon_utils.enable(_MODULE)
    if not hasattr(bpy.types, "EXPORT_SCENE_OT_gltf"):
        raise ExportError("Blender's glTF add-on (io_scene_gltf2) cannot be enabled; does Blender's Python have numpy?")
    package = __package__
    if package not in bpy.context.preferences.addons:
        raise ExportError(f"the add-on '{package}' is not enabled, so Blender's glTF exporter would not see it")


def own_draco_library():
    """Where Blender's own Draco library would be; it need not exist."""
    from io_scene_gltf2.io.com import gltf2_io_draco_compression_extension as draco

    before = os.environ.pop(draco_library.VARIABLE, None)
    try:
        return draco.dll_path()
    finally:
        if before is not None:
            os.environ[draco_library.VARIABLE] = before


def run(path, options, compress, textures, normal_maps):
    """Exports the active scene as it stands. Which of it is decided by the hooks, not by the options here."""
    arguments = {
        "filepath": str(path),
        "export_format": "GLB" if path.suffix.lower() == ".glb" else "GLTF_SEPARATE",
        "export_texcoords": textures,
        "export_tangents": normal_maps,
        "export_materials": "EXPORT",
        "export_cameras": True,
        "export_lights": True,
        "export_yup": True,
        "use_active_scene": True,
        # Modifiers are applied beforehand, which keeps shape keys; motion is baked by our own hooks.
        "export_apply": False,
        "export_animations": False,
        "export_current_frame": True,
        "export_skins": True,
        "export_all_influences": False,
        "export_morph": True,
        "export_morph_normal": True,
        "export_draco_mesh_compression_enable": compress,
    }
    if compress:
        arguments.update(
            export_draco_mesh_compression_level=options.draco_level,
            export_draco_position_quantization=options.position_bits,
            export_draco_normal_quantization=options.normal_bits,
            export_draco_texcoord_quantization=options.texcoord_bits,
            export_draco_color_quantization=options.color_bits,
            export_draco_generic_quantization=options.generic_bits,
        )
    known = bpy.ops.export_scene.gltf.get_rna_type().properties.keys()
    unknown = sorted(set(arguments) - set(known))
    if unknown:
        raise ExportError(f"the glTF exporter of Blender {bpy.app.version_string} has no option {', '.join(unknown)}")
    progress = io.StringIO()
    try:
        with contextlib.redirect_stdout(progress):
            result = bpy.ops.export_scene.gltf(**arguments)
    except RuntimeError as error:
        print(progress.getvalue())
        # The operator's exception arrives as a whole traceback in the message; its last line says what happened.
        raise ExportError(f"Blender's glTF exporter failed: {_last_line(error)}") from error
    _print_complaints(progress.getvalue())
    if result != {"FINISHED"}:
        raise ExportError(f"Blender's glTF exporter returned {sorted(result)}")


def _last_line(error):
    lines = [line.strip() for line in str(error).splitlines() if line.strip()]
    named = [line for line in lines if "Error" in line and not line.startswith("Location")]
    return (named or lines or ["no reason given"])[-1]


def _print_complaints(progress):
    """The exporter's warnings, without its progress notes and without its regret that there is no Draco, of which the
    report speaks where it was wanted."""
    for line in progress.splitlines():
        if ("WARNING" in line or "ERROR" in line) and "Draco mesh compression is not available" not in line:
            print(line)
