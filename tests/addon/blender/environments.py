# SPDX-License-Identifier: Apache-2.0
"""Worlds with images, one .blend each, in the folder given: what of them travels is held by test_environment.py."""

import math
import sys
from pathlib import Path

import bpy
import mathutils
import numpy as np

sys.path.insert(0, str(Path(__file__).resolve().parent))
import truth  # noqa: E402

WIDTH, HEIGHT = 16, 8


def pixels():
    """Rows from the bottom; above 1 as well, which bytes cut off."""
    rows, columns = np.mgrid[0:HEIGHT, 0:WIDTH]
    values = np.ones((HEIGHT, WIDTH, 4), dtype=np.float32)
    values[:, :, 0], values[:, :, 1], values[:, :, 2] = columns / 10, rows / 8, 0.25
    return values


def generated(is_float, color_space=None):
    image = bpy.data.images.new("Sky", WIDTH, HEIGHT, float_buffer=is_float)
    if color_space:  # before there are pixels: setting it drops them
        image.colorspace_settings.name = color_space
    image.pixels.foreach_set(pixels().ravel())
    return image


def saved(name, file_format, is_float):
    image = generated(is_float, "Non-Color" if is_float else None)
    image.filepath_raw, image.file_format = str(truth.folder() / name), file_format
    image.save()
    bpy.data.images.remove(image)
    return bpy.data.images.load(str(truth.folder() / name))


def world(image):
    scene = truth.new_scene(3)
    truth.grid("Patch")
    scene.world = bpy.data.worlds.new("World")
    scene.world.use_nodes = True
    tree = scene.world.node_tree
    node = tree.nodes.new("ShaderNodeTexEnvironment")
    node.image = image() if image else None
    tree.links.new(node.outputs["Color"], tree.nodes["Background"].inputs["Color"])
    return tree, node


def turned(tree, node, kind, angles):
    mapping = tree.nodes.new("ShaderNodeMapping")
    mapping.vector_type = kind
    mapping.inputs["Rotation"].default_value = angles
    tree.links.new(tree.nodes.new("ShaderNodeTexCoord").outputs["Generated"], mapping.inputs["Vector"])
    tree.links.new(mapping.outputs["Vector"], node.inputs["Vector"])
    return mapping


def looked_up(mapping):
    """Where the image is looked up for a direction of the world, both in glTF's axes."""
    angles = mapping.inputs["Rotation"].default_value
    matrix = mathutils.Euler(angles, "XYZ").to_matrix()
    if mapping.vector_type == "TEXTURE":
        matrix.transpose()
    found = matrix @ mathutils.Vector((0.36, 0.48, 0.8))
    return [found.x, found.z, -found.y]


def save(name, record=lambda depsgraph: {}):
    truth.save((1, 2, 3), record)
    for kind in ("scene.blend", "truth.json"):
        (truth.folder() / kind).rename(truth.folder() / f"{name}{Path(kind).suffix}")


def main():
    tree, node = world(lambda: saved("sky.exr", "OPEN_EXR", True))
    node.image.colorspace_settings.name = "Linear"
    mapping = turned(tree, node, "POINT", (0.3, 0.5, 0.0))
    for frame, angle in ((1, 0.0), (3, 3.0)):
        mapping.inputs["Rotation"].default_value[2] = angle
        mapping.inputs["Rotation"].keyframe_insert("default_value", frame=frame)
    save("exr", lambda depsgraph: {"looked_up": looked_up(
        bpy.context.scene.world.evaluated_get(depsgraph).node_tree.nodes["Mapping"])})

    tree, node = world(lambda: saved("sky.png", "PNG", False))
    node.image.pack()
    (truth.folder() / "sky.png").unlink()
    mapping = turned(tree, node, "TEXTURE", (0.2, 0.0, math.pi / 2))
    mapping.inputs["Location"].default_value = (1, 0, 0)
    save("png", lambda depsgraph: {"looked_up": looked_up(bpy.context.scene.world.node_tree.nodes["Mapping"])})

    world(lambda: generated(True))[1].interpolation = "Closest"
    bpy.data.images["Sky"].pack()
    save("generated")

    _, node = world(lambda: saved("gone.exr", "OPEN_EXR", True))
    (truth.folder() / "gone.exr").unlink()
    save("missing")
    world(None)
    save("empty")
    _, node = world(lambda: saved("ball.exr", "OPEN_EXR", True))
    node.projection = "MIRROR_BALL"
    save("ball")


main()
