# SPDX-License-Identifier: GPL-3.0-or-later
"""File > Export > Bounce (.glb)."""

import bpy
from bpy_extras.io_utils import ExportHelper

from . import options as option_values
from .errors import ExportError
from .export import export


class EXPORT_SCENE_OT_bounce(bpy.types.Operator, ExportHelper):
    """Export the animated scene with its lights for the Bounce previewer"""

    bl_idname = "export_scene.bounce"
    bl_label = "Export Bounce"
    bl_options = {"PRESET"}

    filename_ext = ".glb"
    filter_glob: bpy.props.StringProperty(default="*.glb", options={"HIDDEN"})
    draco: bpy.props.BoolProperty(name="Compress Meshes", description="Compress meshes by Draco", default=True)
    draco_level: bpy.props.IntProperty(
        name="Compression Level", description="0 is fastest, 10 smallest", default=option_values.Options.draco_level,
        min=0, max=10,
    )
    animation: bpy.props.BoolProperty(name="Animation", description="Export the whole frame range", default=True)

    def execute(self, context):
        chosen = option_values.Options(draco=self.draco, draco_level=self.draco_level, animation=self.animation)
        try:
            report = export(self.filepath, chosen)
        except ExportError as error:
            self.report({"ERROR"}, str(error))
            return {"CANCELLED"}
        first, *others = report.lines()
        self.report({"INFO"}, first)
        for line in others:
            self.report({"WARNING"}, line)
        return {"FINISHED"}


def _menu(self, context):
    self.layout.operator(EXPORT_SCENE_OT_bounce.bl_idname, text="Bounce (.glb)")


def register():
    bpy.utils.register_class(EXPORT_SCENE_OT_bounce)
    bpy.types.TOPBAR_MT_file_export.append(_menu)


def unregister():
    bpy.types.TOPBAR_MT_file_export.remove(_menu)
    bpy.utils.unregister_class(EXPORT_SCENE_OT_bounce)
