# SPDX-License-Identifier: GPL-3.0-or-later
"""Which node chains before a shader input glTF can say: an image, a constant, their product, a vertex colour."""

from . import sockets

# Nodes that Blender's exporter sees through on the way to an image.
_TRANSPARENT = {"SEPARATE_COLOR", "SEPRGB", "RGB", "VALUE"}


class Chain:
    """What feeds one input: `problem` in words where glTF cannot say it, UV maps used ('' is the active one), and
    the colour attribute ('' is the active one) or None."""

    def __init__(self):
        self.problem = None
        self.uv_maps = set()
        self.color_attribute = None
        self.has_image = False
        # Blender's exporter takes the first image it meets, whatever lies between it and the shader.
        self.image_is_taken = False


def follow(socket, allow_color_attribute=False):
    chain = Chain()
    node, _ = sockets.source(socket)
    if node is None:
        return chain
    if node.type == "VERTEX_COLOR" and allow_color_attribute:
        chain.color_attribute = node.layer_name
    elif node.type == "ATTRIBUTE" and allow_color_attribute and node.attribute_type == "GEOMETRY":
        chain.color_attribute = node.attribute_name
    else:
        _visit(node, chain)
        chain.image_is_taken = _leads_to_image(node)
    return chain


def _leads_to_image(node):
    if node.type == "TEX_IMAGE":
        return node.image is not None
    feeding = (sockets.source(socket)[0] for socket in node.inputs)
    return any(_leads_to_image(child) for child in feeding if child is not None)


def follow_normal(socket):
    """A tangent-space normal map."""
    chain = Chain()
    node, _ = sockets.source(socket)
    if node is None:
        return chain
    if node.type != "NORMAL_MAP" or node.space != "TANGENT":
        chain.problem = sockets.describe(node)
        return chain
    chain.uv_maps.add(node.uv_map)
    _visit_input(node.inputs["Color"], chain)
    return chain


def _visit_input(socket, chain):
    node, _ = sockets.source(socket)
    if node is not None:
        _visit(node, chain)


def _visit(node, chain):
    if chain.problem:
        return
    if node.type == "TEX_IMAGE":
        _visit_image(node, chain)
    elif node.type in _TRANSPARENT or _is_product(node):
        for socket in node.inputs:
            _visit_input(socket, chain)
    else:
        chain.problem = sockets.describe(node)


def _is_product(node):
    """A multiplication of which one side is constant; glTF's factors say that."""
    if node.type == "MATH":
        return node.operation == "MULTIPLY" and any(sockets.constant(socket) is not None for socket in node.inputs[:2])
    if node.type not in {"MIX", "MIX_RGB"} or node.blend_type != "MULTIPLY":
        return False
    if node.type == "MIX" and node.data_type != "RGBA":
        return False
    # A MIX node has sockets for every data type; 6 and 7 are the colours.
    first, second = (6, 7) if node.type == "MIX" else (1, 2)
    if sockets.constant(node.inputs[0]) != 1.0:
        return False
    return any(sockets.constant(node.inputs[i]) is not None for i in (first, second))


def _visit_image(node, chain):
    name = sockets.describe(node)
    image = node.image
    if image is None:
        chain.problem = f"{name} without an image"
    elif image.source in {"SEQUENCE", "MOVIE"}:
        chain.problem = f"{name} with a moving image"
    elif not (image.packed_file or image.has_data or len(image.pixels) > 0):
        chain.problem = f"{name} whose file is missing ({image.name})"
    elif node.projection != "FLAT":
        chain.problem = f"{name} with {node.projection.lower()} projection"
    else:
        chain.has_image = True
        _visit_mapping(node.inputs["Vector"], name, chain)


def _visit_mapping(socket, image_name, chain):
    node, output = sockets.source(socket)
    if node is None:
        chain.uv_maps.add("")
    elif node.type == "UVMAP":
        chain.uv_maps.add(node.uv_map)
    elif node.type == "TEX_COORD" and output.name == "UV":
        chain.uv_maps.add("")
    elif node.type == "MAPPING" and all(
        sockets.constant(node.inputs[name]) is not None for name in ("Location", "Rotation", "Scale")
    ):
        _visit_mapping(node.inputs["Vector"], image_name, chain)
    else:
        chain.problem = f"{image_name} mapped by {sockets.describe(node)}"
