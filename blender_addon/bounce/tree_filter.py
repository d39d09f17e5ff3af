# SPDX-License-Identifier: GPL-3.0-or-later
"""Decides which nodes of the exporter's tree are written: what the render shows and what moves it, nothing else."""

import numpy as np

from . import read_lights

# Types that hiding in renders makes vanish. An armature or an empty shows nothing either way.
_SHOWING = {"MESH", "LIGHT"}
# Types that a node may have for its children's sake alone, since they show nothing themselves.
_CARRYING = {"EMPTY", "ARMATURE", "LATTICE", "SPEAKER", "CAMERA"}


def is_rendered(obj):
    return obj.type in _SHOWING or _is_instance(obj)


def _is_instance(obj):
    return obj.instance_type == "COLLECTION" and obj.instance_collection is not None


def tag(vtree, export):
    used_armatures = {
        vnode.armature for vnode in vtree.nodes.values()
        if vnode.blender_bone is None and vnode.armature is not None and _is_shown(vnode, vtree, export)
    }
    _detach_children_of_blinking(vtree, export)
    for root in list(vtree.roots):
        _tag(root, vtree, export, used_armatures)
    export.left_out.extend(_reasons(vtree, export))


def _tag(uuid, vtree, export, used_armatures):
    """Keeps a node that shows something, or that carries one that does. Returns whether anything under it was kept.

    A hidden mesh carries nothing, it would be seen; the exporter hangs its children on the next node above.
    """
    vnode = vtree.nodes[uuid]
    children_kept = [_tag(child, vtree, export, used_armatures) for child in vnode.children]
    if vnode.blender_bone is not None:
        keep = vnode.armature in used_armatures or any(children_kept) or export.options.keep_all
    else:
        shown = _is_shown(vnode, vtree, export) and _shows_something(vnode, export)
        carries = vnode.blender_object.type in _CARRYING and any(children_kept)
        keep = shown or carries or uuid in used_armatures
        if export.options.keep_all:
            keep = keep or vnode.blender_object.type in _CARRYING
    vnode.keep_tag = keep
    return keep or any(children_kept)


def _is_shown(vnode, vtree, export):
    instancer = _instancer(vnode, vtree)
    if instancer is None:
        shown = export.visibility.direct
    else:
        if not _is_shown(instancer, vtree, export):
            return False
        shown = export.visibility.instanced(instancer.blender_object.instance_collection)
    obj = vnode.blender_object
    if obj.as_pointer() not in shown:
        return False
    visible = export.samples.visible.get(export.source_of(obj))
    return visible is None or bool(visible.any())


def _shows_something(vnode, export):
    obj = vnode.blender_object
    if obj.type == "MESH":
        return len(obj.data.polygons) > 0
    if obj.type == "LIGHT":
        return not read_lights.is_portal(obj.data) and (export.options.keep_all or not _is_dark(obj.data, export))
    return obj.type == "CAMERA" or obj.as_pointer() in export.prepared.native


def _is_dark(light, export):
    """Whether a light gives nothing in any frame."""
    values = export.samples.values["light", light.as_pointer()]
    return any(name in values and not np.any(values[name]) for name in ("power_w", "irradiance_w_m2", "color"))


def _reasons(vtree, export):
    """Of every object that no node stands for, why."""
    kept, left = set(), {}
    for vnode in vtree.nodes.values():
        obj = vnode.blender_object
        if vnode.blender_bone is not None or obj.as_pointer() in export.prepared.replaced:
            continue
        if vnode.keep_tag:
            kept.add(obj.name)
        elif obj.type in _CARRYING:
            left[obj.name] = (f"{obj.type.lower()}", "it shows nothing and carries nothing that is shown")
        elif not _is_shown(vnode, vtree, export):
            left[obj.name] = (obj.type.lower(), "renders do not show it in any frame")
        elif obj.type == "LIGHT":
            left[obj.name] = ("light", "a portal is no light of its own" if read_lights.is_portal(obj.data)
                              else "it has no power in any frame")
        elif obj.type == "MESH":
            left[obj.name] = ("mesh", "it has no faces")
        else:
            left[obj.name] = (obj.type.lower(), "it has no faces or no words in the file")
    return [(name, *why) for name, why in left.items() if name not in kept]


def _instancer(vnode, vtree):
    """The nearest instancing empty above, or None."""
    uuid = vnode.parent_uuid
    while uuid is not None:
        parent = vtree.nodes[uuid]
        if parent.blender_bone is None and _is_instance(parent.blender_object):
            return parent
        uuid = parent.parent_uuid
    return None


def _detach_children_of_blinking(vtree, export):
    """glTF hides a node's children with it, Blender does not: what blinks may not have children."""
    for uuid, vnode in vtree.nodes.items():
        obj = vnode.blender_object
        if vnode.blender_bone is not None or obj.type not in _SHOWING:
            continue
        visible = export.samples.visible.get(export.source_of(obj))
        if visible is None or visible.all() or not visible.any():
            continue
        for child in vnode.children:
            vtree.nodes[child].parent_uuid = vnode.parent_uuid
            siblings = vtree.roots if vnode.parent_uuid is None else vtree.nodes[vnode.parent_uuid].children
            siblings.append(child)
        vnode.children = []
