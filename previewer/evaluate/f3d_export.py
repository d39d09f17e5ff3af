# SPDX-License-Identifier: Apache-2.0
"""Writes one frame of a scene as plain glTF files for a viewer, and tells where its camera stands.

    blender -b --factory-startup [SCENE.blend] --python-exit-code 1 -P f3d_export.py -- JOB.json

JOB.json: {scene, addon, width, height, frames: [{frame, lit, unlit}]}: two files a frame, with the scene's lights and
without. Blender's own exporter writes them: modifiers applied, no animation, no compression, lights in watts per
steradian ("unitless"), because the viewer has no exposure to take candelas back with.

Lines "BOUNCE {json}" on stdout: note and error as blender_job.py tells them, and

    {event: "ready", files}
    {event: "frame", frame, seconds, position, focal_point, view_up, view_angle, background}   in glTF's axes, degrees
"""

import math
import sys
import time
from pathlib import Path

import bpy
import mathutils

sys.path.insert(0, str(Path(__file__).resolve().parent))
from blender_job import SceneError, frame_of, open_job, referred_files, run, tell


def gltf_axes(vector):
    """Blender's Z up as glTF's Y up."""
    return [vector.x, vector.z, -vector.y]


def camera_view(scene, width, height):
    """What f3d's camera options take; a camera that they cannot say is refused."""
    camera = scene.camera
    if camera.type != "CAMERA" or camera.data.type != "PERSP":
        raise SceneError("f3d's options take a perspective camera, and the scene's is not one")
    data = camera.data
    if data.shift_x or data.shift_y:
        raise SceneError("f3d's options take no shifted camera, and the scene's is shifted")
    render = scene.render
    if render.pixel_aspect_x != render.pixel_aspect_y:
        raise SceneError("f3d's options take square pixels, and the scene's are not")
    # Blender fits the larger side in AUTO; f3d's angle is the vertical one.
    vertical = data.sensor_fit == "VERTICAL" or (data.sensor_fit == "AUTO" and height > width)
    half = math.tan((data.angle_y if data.sensor_fit == "VERTICAL" else data.angle_x) / 2)
    if not vertical:
        half *= height / width
    world = camera.matrix_world
    rotation = world.to_3x3().normalized()
    position = world.translation
    return {"position": gltf_axes(position),
            "focal_point": gltf_axes(position + rotation @ mathutils.Vector((0, 0, -1))),
            "view_up": gltf_axes(rotation @ mathutils.Vector((0, 1, 0))),
            "view_angle": math.degrees(2 * math.atan(half))}


def to_srgb(value):
    value = min(max(value, 0.0), 1.0)
    return 12.92 * value if value <= 0.0031308 else 1.055 * value ** (1 / 2.4) - 0.055


def background(scene):
    """The world's colour as the screen shows it, where it is one colour; else black."""
    world = scene.world
    if world is None:
        return [0.0, 0.0, 0.0]
    if not world.use_nodes:
        return [to_srgb(channel) for channel in world.color]
    for node in world.node_tree.nodes:
        if node.type == "BACKGROUND" and not node.inputs["Color"].is_linked:
            strength = node.inputs["Strength"].default_value
            return [to_srgb(channel * strength) for channel in node.inputs["Color"].default_value[:3]]
    return [0.0, 0.0, 0.0]


def export(path, lights):
    options = {"filepath": path, "export_format": "GLB", "export_animations": False, "export_cameras": False,
               "export_lights": lights, "export_apply": True, "use_renderable": True,
               "export_draco_mesh_compression_enable": False}
    lighting = "export_import_convert_lighting_mode"
    known = {item.identifier for item in bpy.ops.export_scene.gltf.get_rna_type().properties}
    options[lighting if lighting in known else "convert_lighting_mode"] = "COMPAT"
    if "FINISHED" not in bpy.ops.export_scene.gltf(**{key: value for key, value in options.items()
                                                      if key in known}):
        raise SceneError("Blender's glTF exporter did not finish")


def main():
    job, scene, imported = open_job()
    tell("ready", files=referred_files())
    for item in job["frames"]:
        frame_of(scene, imported, item["frame"])
        view = camera_view(scene, job["width"], job["height"])
        start = time.perf_counter()
        export(item["lit"], True)
        seconds = time.perf_counter() - start
        export(item["unlit"], False)
        tell("frame", frame=item["frame"], seconds=seconds, background=background(scene), **view)


if __name__ == "__main__":
    run(main)
