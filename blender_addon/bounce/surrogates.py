# SPDX-License-Identifier: GPL-3.0-or-later
"""Stands Principled BSDFs in for closures that Blender's exporter does not read, while an export lasts.

The exporter takes colours and textures from a Principled BSDF alone. A Diffuse BSDF's colour would be lost; with a
Principled BSDF in its place, fed by the same nodes, textures, transforms and UV maps travel as for any other material.
"""

from . import materials, sockets


def stand_in(material, model, edits):
    if model.base is None and model.is_exact:
        return
    tree = material.node_tree
    base = tree.nodes[model.base] if model.base else None
    closure = base
    if base is not None and base.type != "BSDF_PRINCIPLED":
        closure = _principled_like(tree, base, edits)
        _take_over(tree, base.outputs[0], closure.outputs[0], edits)
    if model.mix_factor is not None and closure is not None:
        factor = materials.mix_socket(tree, model)
        if sockets.constant(factor) is None:
            edits.undo_with(tree.links.remove, tree.links.new(factor.links[0].from_socket, closure.inputs["Alpha"]))
    if not model.is_exact:
        # Blender's exporter would take whichever Principled BSDF it meets first, past any Mix Shader.
        chosen = closure or tree.nodes[model.emission] if (closure or model.emission) else None
        if chosen is not None:
            _link_surface(tree, chosen, edits)


def _principled_like(tree, base, edits):
    node = tree.nodes.new("ShaderNodeBsdfPrincipled")
    edits.undo_with(tree.nodes.remove, node)
    _copy_input(tree, base.inputs["Color"], node.inputs["Base Color"])
    if "Normal" in base.inputs:
        _copy_input(tree, base.inputs["Normal"], node.inputs["Normal"])
    materials.input_of(node, "Specular").default_value = 0.0
    materials.input_of(node, "Emission").default_value = (0.0, 0.0, 0.0, 1.0)
    node.inputs["Metallic"].default_value = 1.0 if materials.is_metal(base) else 0.0
    node.inputs["Roughness"].default_value = 1.0
    if materials.is_metal(base):
        _copy_input(tree, base.inputs["Roughness"], node.inputs["Roughness"])
    return node


def _copy_input(tree, original, copy):
    if original.is_linked:
        tree.links.new(original.links[0].from_socket, copy)
    elif hasattr(original, "default_value"):
        copy.default_value = original.default_value


def _take_over(tree, original, replacement, edits):
    for target in [link.to_socket for link in original.links]:
        tree.links.new(replacement, target)
        # Linking an input again drops the link that was there.
        edits.undo_with(tree.links.new, original, target)


def _link_surface(tree, node, edits):
    surface = sockets.output_node(tree).inputs["Surface"]
    before = surface.links[0].from_socket
    tree.links.new(node.outputs[0], surface)
    edits.undo_with(tree.links.new, before, surface)
