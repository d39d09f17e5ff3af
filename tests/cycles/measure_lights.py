# SPDX-License-Identifier: Apache-2.0
"""Measures Cycles' light laws over a white Lambertian plane and prints them as a table.

    blender -b --factory-startup -P tests/cycles/measure_lights.py

For every angle the light is moved so that the middle of a frame 4 mm wide, seen from straight above, lies at
that angle: a pixel is a point. Values are radiance relative to the
light's axis with distance and the receiver's cosine divided out (docs/lights.md).
"""
import math
import os
import tempfile

import bpy
import numpy

HEIGHT_M = {"SPOT": 3.0, "AREA": 10.0}
POWER_W = 100.0


def new_scene():
    bpy.ops.wm.read_factory_settings(use_empty=True)
    scene = bpy.context.scene
    scene.render.engine = "CYCLES"
    scene.cycles.max_bounces = 0
    scene.cycles.use_adaptive_sampling = False
    scene.cycles.use_denoising = False
    scene.render.resolution_x = scene.render.resolution_y = 8
    scene.render.resolution_percentage = 100
    scene.render.image_settings.file_format = "OPEN_EXR"
    scene.render.image_settings.color_depth = "32"
    scene.render.image_settings.color_mode = "RGB"
    world = bpy.data.worlds.new("black")
    world.use_nodes = True
    world.node_tree.nodes["Background"].inputs["Strength"].default_value = 0.0
    scene.world = world
    material = bpy.data.materials.new("white")
    material.use_nodes = True
    nodes = material.node_tree.nodes
    nodes.clear()
    diffuse = nodes.new("ShaderNodeBsdfDiffuse")
    diffuse.inputs["Color"].default_value = (1.0, 1.0, 1.0, 1.0)
    output = nodes.new("ShaderNodeOutputMaterial")
    material.node_tree.links.new(diffuse.outputs[0], output.inputs[0])
    bpy.ops.mesh.primitive_plane_add(size=200.0)
    bpy.context.object.data.materials.append(material)
    camera = bpy.data.cameras.new("camera")
    camera.type = "ORTHO"
    camera.ortho_scale = 0.004
    scene.camera = bpy.data.objects.new("camera", camera)
    scene.camera.location = (0.0, 0.0, 50.0)
    scene.collection.objects.link(scene.camera)
    return scene


def render_middle(scene, samples):
    scene.cycles.samples = samples
    path = os.path.join(tempfile.mkdtemp(), "pixel.exr")
    scene.render.filepath = path
    bpy.ops.render.render(write_still=True)
    image = bpy.data.images.load(path)
    pixels = numpy.array(image.pixels[:]).reshape(8, 8, -1)
    bpy.data.images.remove(image)
    return float(pixels[2:6, 2:6, 0].mean())


def profile(kind, angles_deg, set_up, samples):
    scene = new_scene()
    light = bpy.data.lights.new("light", kind)
    light.energy = POWER_W
    set_up(light)
    node = bpy.data.objects.new("light", light)
    scene.collection.objects.link(node)
    height = HEIGHT_M[kind]
    values = []
    for angle_deg in angles_deg:
        angle = math.radians(angle_deg)
        node.location = (-height * math.tan(angle), 0.0, height)
        # The area's own cosine stays in: the table is relative to the law of an unspread light.
        power = 3.0 if kind == "SPOT" else 4.0
        axis = POWER_W / (4.0 * math.pi) / (math.pi * height**2) if kind == "SPOT" else POWER_W / (4.0 * math.pi * height**2)
        values.append(render_middle(scene, samples) / (axis * math.cos(angle) ** power))
    return values


def main():
    angles = [0, 5, 10, 15, 20, 24, 26, 28, 29, 29.5, 30.5]
    lines = ["spot, 60 degrees: angles " + " ".join(f"{a:g}" for a in angles)]
    for blend in (0.0, 0.15, 0.5, 1.0):
        def spot(light, blend=blend):
            light.spot_size = math.radians(60.0)
            light.spot_blend = blend
            light.shadow_soft_size = 0.0
        values = profile("SPOT", angles, spot, 16)
        lines.append(f"blend {blend:g}: " + " ".join(f"{v:.6f}" for v in values))
    angles = [0, 10, 20, 30, 40, 50]
    lines.append("area, 5 cm square: angles " + " ".join(f"{a:g}" for a in angles))
    for spread in (120.0, 60.0):
        def area(light, spread=spread):
            light.shape = "SQUARE"
            light.size = 0.05
            light.spread = math.radians(spread)
        values = profile("AREA", angles, area, 256)
        lines.append(f"spread {spread:g}: " + " ".join(f"{v:.4f}" for v in values))
    print("\n".join(lines))


main()
