# SPDX-License-Identifier: GPL-3.0-or-later
"""What stays behind because nothing that is shown reads it, in words."""

import bpy

from . import read_world
from .visibility import animated_paths


def unused_data(used, models, scene):
    """(name, what, reason) of materials and images of this file; `used` are pointers of materials in slots."""
    shown = set()
    for key, (material, model) in models.items():
        if key not in used:
            yield material.name, "material", "no object that is shown has it"
        elif material.use_nodes and material.node_tree is not None:
            shown.update(image.name_full for image in _images(material.node_tree))
    trees = [light.node_tree for light in bpy.data.lights if light.use_nodes and light.node_tree is not None]
    for tree in trees:
        shown.update(image.name_full for image in _images(tree))
    world = read_world.image_of(scene.world) if scene.world is not None else None
    for image in bpy.data.images:
        if image.type == "IMAGE" and image.name_full not in shown and image != world:
            yield image.name, "image", "no material that is used has it"


def _images(tree):
    for node in tree.nodes:
        if getattr(node, "image", None) is not None:
            yield node.image
        if node.type == "GROUP" and node.node_tree is not None:
            yield from _images(node.node_tree)


def note_still(export, vnode, channels):
    """Keys that move nothing are one value, the node's."""
    paths = animated_paths(vnode.blender_object) & {"location", "rotation_euler", "rotation_quaternion", "scale"}
    if paths and not any(channel.node is vnode.node for channel in channels):
        export.left_out.append((vnode.blender_object.name, "animation", "it stands still in all frames"))
