# SPDX-License-Identifier: GPL-3.0-or-later
"""Which node chains before a shader input glTF can say: an image, a constant, their product, a vertex colour."""

from . import sockets

# Nodes that Blender's exporter sees through on the way to an image.
_TRANSPARENT = {"SEPARATE_COLOR", "SEPRGB", "RGB", "VALUE"}


# sRGB and what leaves an image's numbers as they are.
_SPACES = {"sRGB", "Non-Color", "Raw", "Linear"}


class Chain:
    """What feeds one input: `problem` in words where glTF cannot say it, UV maps used ('' is the active one), and
    the colour attribute ('' is the active one) or None."""

    def __init__(self):
        self.problem = None
        self.uv_maps = set()
        self.color_attribute = None
        self.has_image = False
        # What travels, but not quite as it is.
        self.notes = []
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
        _visit(node, chain, allow_color_attribute)
        chain.image_is_taken = _leads_to_image(node)
    return chain


def follow_alpha(socket):
    """(chain, cutoff): the cutoff where alpha is an image compared with a constant by a Math node, else None."""
    node, _ = sockets.source(socket)
    if node is not None and node.type == "MATH" and node.operation in {"GREATER_THAN", "LESS_THAN"}:
        image, limit = node.inputs[:2] if node.operation == "GREATER_THAN" else node.inputs[1::-1]
        cutoff = sockets.constant(limit)
        if cutoff is not None and sockets.constant(image) is None:
            chain = follow(image)
            return chain, cutoff if chain.has_image else None
    return follow(socket), None


def constant_factor(socket, size):
    """The product of the constants that an image or vertex colour is multiplied by; ones where there are none."""
    factor = [1.0] * size
    node, _ = sockets.source(socket)
    if node is None or not _is_product(node):
        return factor
    for side in _factors_of(node):
        constant = sockets.constant(side)
        if constant is None:
            constant = constant_factor(side, size)
        values = list(constant) if hasattr(constant, "__len__") else [constant] * size
        factor = [a * b for a, b in zip(factor, values)]
    return factor


def encoding(socket):
    """'srgb' or 'linear' where the colour space of the image before a shader's input is not glTF's there, else None."""
    node = _image_before(socket)
    # The exporter writes images of floats as their colour space wants.
    if node is None or node.image.is_float:
        return None
    srgb = node.image.colorspace_settings.name == "sRGB"
    # Colours are sRGB in glTF, values and normals (a Normal Map's "Color" leads to "Normal") are not.
    color = socket.type == "RGBA"
    return None if srgb == color else ("srgb" if srgb else "linear")


def _image_before(socket):
    node, _ = sockets.source(socket)
    if node is None:
        return None
    if node.type == "TEX_IMAGE":
        return node if node.image is not None else None
    before = (_image_before(child) for child in node.inputs)
    return next((image for image in before if image is not None), None)


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


def _visit_input(socket, chain, allow_color_attribute=False):
    node, _ = sockets.source(socket)
    if node is not None:
        _visit(node, chain, allow_color_attribute)


def _visit(node, chain, allow_color_attribute=False):
    if chain.problem:
        return
    if node.type == "TEX_IMAGE":
        _visit_image(node, chain)
    elif node.type == "VERTEX_COLOR" and allow_color_attribute and chain.color_attribute is None:
        chain.color_attribute = node.layer_name
    elif node.type in _TRANSPARENT:
        for socket in node.inputs:
            _visit_input(socket, chain)
    elif _is_product(node, allow_color_attribute):
        for socket in _factors_of(node):
            _visit_input(socket, chain, allow_color_attribute)
    else:
        chain.problem = sockets.describe(node)


def _is_product(node, allow_color_attribute=True):
    """A multiplication of which one side is constant, or a vertex colour beside an image; glTF says both."""
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
    sides = [node.inputs[i] for i in (first, second)]
    feeding = [sockets.source(side)[0] for side in sides]
    return any(sockets.constant(side) is not None for side in sides) or (
        allow_color_attribute and any(child is not None and child.type == "VERTEX_COLOR" for child in feeding))


def _factors_of(node):
    if node.type == "MATH":
        return node.inputs[:2]
    return [node.inputs[i] for i in ((6, 7) if node.type == "MIX" else (1, 2))]


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
        space = image.colorspace_settings.name
        if not image.is_float and space not in _SPACES:
            chain.notes.append(f"{name} in the colour space {space}, exported as non-colour data")
        if node.extension == "CLIP":
            chain.notes.append(f"{name} with extension Clip, exported as Extend")
        if node.interpolation in {"Cubic", "Smart"}:
            chain.notes.append(f"{name} with {node.interpolation.lower()} interpolation, exported as linear")
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
        scale = sockets.constant(node.inputs["Scale"])
        if node.vector_type == "TEXTURE" and sockets.constant(node.inputs["Rotation"])[2] != 0.0 and (
                scale[0] != scale[1]):
            chain.notes.append(f"{image_name} mapped by {sockets.describe(node)} of type Texture with a rotation and "
                               "uneven scale, exported without it")
        _visit_mapping(node.inputs["Vector"], image_name, chain)
    else:
        chain.problem = f"{image_name} mapped by {sockets.describe(node)}"
