# SPDX-License-Identifier: Apache-2.0
"""Spheres of plastic and metal on a floor before a wall, under an equirectangular image of the world.

    blender -b --factory-startup --python-exit-code 1 -P examples/sheets/world_sheet.py -- OUT.blend IMAGE [DEGREES]

DEGREES turns the image about the vertical. docs/papers/imperfect_shadow_maps.md has what was measured with it.
"""
import math
import sys
from pathlib import Path

import bpy

sys.path.insert(0, str(Path(__file__).resolve().parents[1]))
import common  # noqa: E402

SPHERES = (("Red", (0.8, 0.3, 0.2), 0.5, 0.0), ("Mirror", (0.9, 0.9, 0.9), 0.05, 1.0), ("Gold", (0.9, 0.7, 0.3), 0.35, 1.0),
           ("Blue", (0.2, 0.4, 0.8), 0.2, 0.0))


def add_things():
    bpy.ops.mesh.primitive_plane_add(size=14)
    bpy.context.object.data.materials.append(common.principled("Floor", (0.6, 0.6, 0.6), 0.6, 0.0))
    for i, material in enumerate(SPHERES):
        bpy.ops.mesh.primitive_uv_sphere_add(segments=64, ring_count=32, radius=0.8, location=(2 * i - 3, 0, 0.8))
        sphere = bpy.context.object.data
        sphere.materials.append(common.principled(*material))
        sphere.polygons.foreach_set("use_smooth", [True] * len(sphere.polygons))
    bpy.ops.mesh.primitive_cube_add(size=1, location=(0, 1.8, 1.2))
    bpy.context.object.scale = (7, 0.2, 2.4)
    bpy.context.object.data.materials.append(common.principled("Wall", (0.7, 0.7, 0.7), 0.8, 0.0))


def add_camera(scene):
    camera = bpy.data.cameras.new("Camera")
    camera.lens = 35
    holder = bpy.data.objects.new("Camera", camera)
    holder.location, holder.rotation_euler = (0, -8, 2.6), (math.radians(79), 0, 0)
    scene.collection.objects.link(holder)
    scene.camera = holder


def add_image_world(scene, path, degrees):
    common.set_world((1.0, 1.0, 1.0))
    tree = scene.world.node_tree
    image, mapping = tree.nodes.new("ShaderNodeTexEnvironment"), tree.nodes.new("ShaderNodeMapping")
    image.image = bpy.data.images.load(str(Path(path).resolve()))
    mapping.inputs["Rotation"].default_value[2] = math.radians(degrees)
    tree.links.new(tree.nodes.new("ShaderNodeTexCoord").outputs["Generated"], mapping.inputs["Vector"])
    tree.links.new(mapping.outputs["Vector"], image.inputs["Vector"])
    tree.links.new(image.outputs["Color"], tree.nodes["Background"].inputs["Color"])


def main():
    out, image, *degrees = sys.argv[sys.argv.index("--") + 1:]
    scene = common.new_scene("World sheet")
    add_things()
    add_camera(scene)
    add_image_world(scene, image, float(degrees[0]) if degrees else 0.0)
    bpy.ops.wm.save_as_mainfile(filepath=str(Path(out).resolve()))


if __name__ == "__main__":
    main()
