# SPDX-License-Identifier: Apache-2.0
"""Measures in Cycles what an emissive square over a white Lambertian plane sends by its front and its back.

    blender -b --factory-startup --python-exit-code 1 -P tests/cycles/measure_emission.py

Prints radiance of the plane straight below, relative to the square's radiance times its form factor (docs/lights.md).
"""
import math
import os
import tempfile

import bpy
import numpy


def new_scene():
    bpy.ops.wm.read_factory_settings(use_empty=True)
    scene = bpy.context.scene
    scene.render.engine = "CYCLES"
    scene.cycles.max_bounces = 0
    scene.cycles.use_adaptive_sampling = False
    scene.cycles.use_denoising = False
    scene.cycles.samples = 4096
    scene.render.resolution_x = scene.render.resolution_y = 8
    scene.render.image_settings.file_format = "OPEN_EXR"
    scene.render.image_settings.color_depth = "32"
    scene.world = bpy.data.worlds.new("black")
    scene.world.use_nodes = True
    scene.world.node_tree.nodes["Background"].inputs["Strength"].default_value = 0.0
    camera = bpy.data.cameras.new("camera")
    camera.type = "ORTHO"
    camera.ortho_scale = 0.004
    camera.clip_start = 0.001
    scene.camera = bpy.data.objects.new("camera", camera)
    scene.collection.objects.link(scene.camera)
    return scene


def material(name, shader_type, inputs):
    result = bpy.data.materials.new(name)
    result.use_nodes = True
    nodes = result.node_tree.nodes
    nodes.clear()
    shader = nodes.new(shader_type)
    for key, value in inputs.items():
        shader.inputs[key].default_value = value
    output = nodes.new("ShaderNodeOutputMaterial")
    result.node_tree.links.new(shader.outputs[0], output.inputs[0])
    return result


def form_factor(half, height):
    r = math.hypot(half, height)
    return 4.0 / math.pi * half / r * math.atan(half / r)


def measure(height, turned_deg):
    scene = new_scene()
    bpy.ops.mesh.primitive_plane_add(size=200.0)
    bpy.context.object.data.materials.append(material("white", "ShaderNodeBsdfDiffuse", {"Color": (1.0, 1.0, 1.0, 1.0)}))
    bpy.ops.mesh.primitive_plane_add(size=1.0, location=(0.0, 0.0, height), rotation=(math.radians(turned_deg), 0.0, 0.0))
    bpy.context.object.data.materials.append(material("lamp", "ShaderNodeEmission", {"Strength": 2.0}))
    scene.camera.location = (0.0, 0.0, 0.5 * height)
    scene.render.filepath = os.path.join(tempfile.mkdtemp(), "pixel.exr")
    bpy.ops.render.render(write_still=True)
    image = bpy.data.images.load(scene.render.filepath)
    pixels = numpy.array(image.pixels[:]).reshape(8, 8, -1)
    return float(pixels[2:6, 2:6, 0].mean()) / (2.0 * form_factor(0.5, height))


for height in (0.01, 0.1, 1.0, 3.0):
    print(f"height {height:g} m: front {measure(height, 180.0):.4f}, back {measure(height, 0.0):.4f}")
