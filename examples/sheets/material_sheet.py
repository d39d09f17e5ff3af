# SPDX-License-Identifier: Apache-2.0
"""Spheres of the Principled BSDF over roughness and metallic under a sun or an HDR world, for scripts/material_sheet.

    blender -b --factory-startup --python-exit-code 1 -P examples/sheets/material_sheet.py -- OUT.blend LIGHT [IMAGE]

LIGHT: sun, or world with an equirectangular IMAGE. Columns have roughness ROUGHNESS from left to right, rows METALLIC from
top to bottom; spheres stand a unit apart before an orthographic camera, so that each has a square of the picture to itself
and none reflects another: with no bounces only the light is seen in them.
"""
import math
import sys
from pathlib import Path

import bpy

sys.path.insert(0, str(Path(__file__).resolve().parents[1]))
import common  # noqa: E402

ROUGHNESS = (0.1, 0.25, 0.4, 0.55, 0.7, 0.85, 1.0)
METALLIC = (0.0, 0.33, 0.67, 1.0)
RADIUS = 0.42
COLOR = (0.8, 0.45, 0.2)


def add_sphere(mesh, x, y, roughness, metallic):
    material = common.principled(f"Roughness {roughness}, metallic {metallic}", COLOR, roughness, metallic)
    sphere = bpy.data.objects.new(material.name, mesh)
    sphere.location = (x, 0.0, y)
    bpy.context.scene.collection.objects.link(sphere)
    # One mesh for all: the material is the object's.
    sphere.material_slots[0].link = "OBJECT"
    sphere.material_slots[0].material = material


def add_sun():
    sun = bpy.data.lights.new("Sun", "SUN")
    sun.energy, sun.angle = 3.0, 0.0
    holder = bpy.data.objects.new("Sun", sun)
    holder.rotation_euler = (math.radians(50), 0.0, math.radians(35))
    bpy.context.scene.collection.objects.link(holder)


def add_image_world(path):
    common.set_world((1.0, 1.0, 1.0))
    tree = bpy.context.scene.world.node_tree
    image = tree.nodes.new("ShaderNodeTexEnvironment")
    image.image = bpy.data.images.load(str(Path(path).resolve()))
    tree.links.new(image.outputs["Color"], tree.nodes["Background"].inputs["Color"])


def main():
    out, light, *image = sys.argv[sys.argv.index("--") + 1:]
    scene = common.new_scene("Material sheet")
    bpy.ops.mesh.primitive_uv_sphere_add(segments=96, ring_count=48, radius=RADIUS)
    template = bpy.context.object
    template.data.polygons.foreach_set("use_smooth", [True] * len(template.data.polygons))
    template.data.materials.append(None)
    mesh = template.data
    bpy.data.objects.remove(template)
    for row, metallic in enumerate(METALLIC):
        for column, roughness in enumerate(ROUGHNESS):
            add_sphere(mesh, column - 0.5 * (len(ROUGHNESS) - 1), 0.5 * (len(METALLIC) - 1) - row, roughness, metallic)
    camera = bpy.data.cameras.new("Camera")
    camera.type, camera.ortho_scale = "ORTHO", len(ROUGHNESS)
    holder = bpy.data.objects.new("Camera", camera)
    holder.location, holder.rotation_euler = (0.0, -10.0, 0.0), (math.radians(90), 0.0, 0.0)
    scene.collection.objects.link(holder)
    scene.camera = holder
    if light == "sun":
        add_sun()
    elif light == "world" and image:
        add_image_world(image[0])
    else:
        raise SystemExit(f"material_sheet: no such light: {light}; give sun, or world and an image")
    bpy.ops.wm.save_as_mainfile(filepath=str(Path(out).resolve()))


if __name__ == "__main__":
    main()
