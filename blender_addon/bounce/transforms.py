# SPDX-License-Identifier: GPL-3.0-or-later
"""Local translation, rotation and scale of every node of the export tree, over all frames.

Each node is placed against its parent *as exported*. Where a parent's shear cannot be said, the child makes up for as
much of it as it can, and what remains is measured and reported.
"""

import numpy as np

from . import trs

# Relative error of the linear part from which a lost shear is worth a word.
_VISIBLE_SHEAR = 1e-3


class Placement:
    def __init__(self, translations, rotations, scales):
        self.translations, self.rotations, self.scales = translations, rotations, scales


def place(vtree, samples, source_of):
    """(placements by vnode uuid, names of objects whose shear is lost). `source_of(obj)` is the pointer of the
    object whose matrices stand for obj."""
    frame_count = len(samples.frames)
    identity = np.broadcast_to(np.eye(4), (frame_count, 4, 4))
    placements, sheared = {}, {}

    def visit(uuid, parent_exported, prefix):
        vnode = vtree.nodes[uuid]
        wanted, prefix_for_children = _wanted(vnode, samples, source_of, prefix, parent_exported, vtree)
        if vnode.node is not None and vnode.node.skin is not None:
            # glTF ignores the transform of a skinned mesh's node; Blender's exporter leaves it out.
            exported = parent_exported
        else:
            parts = trs.decompose(trs.inverse(parent_exported) @ wanted)
            placements[uuid] = Placement(*parts)
            exported = parent_exported @ trs.compose(*parts)
            if trs.relative_error(exported, wanted) > _VISIBLE_SHEAR:
                sheared[vnode.blender_object.name] = None
        for child in vnode.children:
            visit(child, exported, prefix_for_children)

    for root in vtree.roots:
        visit(root, identity, identity)
    return placements, list(sheared)


def _wanted(vnode, samples, source_of, prefix, parent_exported, vtree):
    """World matrices in glTF's axes, and the prefix that instanced children stand behind."""
    obj = vnode.blender_object
    if vnode.blender_bone is not None:
        key = source_of(obj)
        world = prefix @ samples.world_matrix[key] @ samples.bone_matrix[key, vnode.blender_bone.name]
        return trs.oriented_in_gltf(world), prefix
    if _is_dupli(vnode, vtree):
        # Instances on faces and vertices ride on their instancer.
        local = np.array(vtree.nodes[vnode.parent_uuid].matrix_world.inverted_safe() @ vnode.matrix_world)
        return parent_exported @ trs.object_in_gltf(local[None]), prefix
    world = prefix @ samples.world_matrix[source_of(obj)]
    if obj.type in {"CAMERA", "LIGHT"}:
        return trs.oriented_in_gltf(world), prefix
    if obj.instance_type == "COLLECTION" and obj.instance_collection:
        offset = np.eye(4)
        offset[:3, 3] = -np.array(obj.instance_collection.instance_offset)
        world = world @ offset
        return trs.object_in_gltf(world), world
    return trs.object_in_gltf(world), prefix


def _is_dupli(vnode, vtree):
    if vnode.parent_uuid is None:
        return False
    parent = vtree.nodes[vnode.parent_uuid].blender_object
    return parent.is_instancer and parent.instance_type != "COLLECTION"
