# SPDX-License-Identifier: GPL-3.0-or-later
"""A Blender material in glTF's metallic-roughness words: which sockets say what, and what has no words."""

from dataclasses import dataclass, field

from . import sockets, textures

# Inputs of the Principled BSDF by their names before and since Blender 4.0.
_ALIASES = {
    "Specular": ("Specular", "Specular IOR Level"),
    "Emission": ("Emission", "Emission Color"),
    "Subsurface": ("Subsurface", "Subsurface Weight"),
    "Transmission": ("Transmission", "Transmission Weight"),
    "Clearcoat": ("Clearcoat", "Coat Weight"),
    "Sheen": ("Sheen", "Sheen Weight"),
}
_MUST_BE_ZERO = ("Subsurface", "Transmission", "Clearcoat", "Sheen", "Anisotropic")
# What Cycles shades a surface with that has no material.
DEFAULT_BASE_COLOR = [0.8, 0.8, 0.8, 1.0]


@dataclass
class Model:
    diffuse: str = "lambert"
    # Node names of the closures that the export takes; either may be absent.
    base: str = None
    emission: str = None
    # The surface's own tree says it all: no closure was passed over.
    is_exact: bool = True
    uv_maps: set = field(default_factory=set)
    color_attribute: str = None
    normal_map: bool = False
    issues: list = field(default_factory=list)
    # Inputs fed by what glTF cannot say; the colour or value that they would have unconnected goes instead.
    unreadable: set = field(default_factory=set)
    # Data paths in the node tree whose animation is exported.
    animatable: set = field(default_factory=set)


def input_of(node, name):
    for alias in _ALIASES.get(name, (name,)):
        socket = node.inputs.get(alias)
        if socket is not None:
            return socket
    return None


def analyse(material, blender_version):
    model = Model()
    if not material.use_nodes or material.node_tree is None:
        return model
    tree = material.node_tree
    output = sockets.output_node(tree)
    if output is None:
        return model
    for name in ("Volume", "Displacement"):
        if output.inputs[name].is_linked:
            model.issues.append(name.lower())
    node, from_socket = sockets.source(output.inputs["Surface"])
    if node is None:
        return model
    if from_socket.type == "RGBA":
        # A colour put straight into the surface glows by that colour.
        model.emission = node.name
        _use_chain(model, "Surface", textures.follow(output.inputs["Surface"], allow_color_attribute=True))
        return model
    base, emission = _closures(node, model)
    if base is not None:
        model.base = base.name
        _analyse_base(base, model, blender_version)
    if emission is not None:
        model.emission = emission.name
        _use_input(model, emission, "Color")
        _require_constant(model, emission, "Strength")
    if base is not None and emission is not None and base.type == "BSDF_PRINCIPLED" and _glows(base):
        model.issues.append("the Principled BSDF's Emission beside an Emission node")
    return model


def _closures(node, model):
    """(surface closure, emission closure) of a shader node; either may be None."""
    if node.type == "EMISSION":
        return None, node
    if node.type == "ADD_SHADER":
        pairs = [_closures(child, model) for child in _shaders_before(node)]
        bases = [base for base, _ in pairs if base is not None]
        emissions = [emission for _, emission in pairs if emission is not None]
        if len(bases) <= 1 and len(emissions) <= 1:
            return (bases or [None])[0], (emissions or [None])[0]
        model.issues.append(sockets.describe(node))
        model.is_exact = False
        return (bases or [None])[0], (emissions or [None])[0]
    if node.inputs.get("Color") is not None or node.type == "BSDF_PRINCIPLED":
        return node, None
    model.issues.append(sockets.describe(node))
    model.is_exact = False
    for child in _shaders_before(node):
        base, emission = _closures(child, model)
        if base is not None or emission is not None:
            return base, emission
    return None, None


def _shaders_before(node):
    for socket in node.inputs:
        if socket.type == "SHADER":
            child = sockets.source(socket)[0]
            if child is not None:
                yield child


def _analyse_base(node, model, blender_version):
    if node.type == "BSDF_PRINCIPLED":
        model.diffuse = "disney" if blender_version < (4, 0) else "lambert"
        for name in _MUST_BE_ZERO:
            socket = input_of(node, name)
            if socket is not None and sockets.constant(socket) != 0.0:
                model.issues.append(f"Principled BSDF: {name}")
        _use_input(model, node, "Base Color", allow_color_attribute=True)
        for name in ("Metallic", "Roughness", "Emission", "Alpha"):
            _use_input(model, node, name)
        for name in ("Specular", "Emission Strength"):
            _require_constant(model, node, name)
    else:
        _use_input(model, node, "Color", allow_color_attribute=True)
        if node.type == "BSDF_DIFFUSE":
            if sockets.constant(node.inputs["Roughness"]) != 0.0:
                model.issues.append("Diffuse BSDF: Roughness (Oren-Nayar)")
        elif is_metal(node):
            model.issues.append(f"{sockets.describe(node)}, exported as a metal")
            _use_input(model, node, "Roughness")
        else:
            model.issues.append(f"{sockets.describe(node)}, exported as a Diffuse BSDF of its colour")
    if "Normal" in node.inputs:
        chain = textures.follow_normal(node.inputs["Normal"])
        _use_chain(model, "Normal", chain)
        model.normal_map = chain.has_image and not chain.problem


def is_metal(node):
    return node.type in {"BSDF_GLOSSY", "BSDF_ANISOTROPIC"}


def _glows(principled):
    emission = sockets.constant(input_of(principled, "Emission"))
    strength = sockets.constant(principled.inputs["Emission Strength"])
    return not (emission is not None and max(emission) == 0.0) and strength != 0.0


def _use_input(model, node, name, allow_color_attribute=False):
    socket = input_of(node, name)
    if socket is None:
        return
    if sockets.constant(socket) is not None:
        _note_animatable(model, socket)
        return
    chain = textures.follow(socket, allow_color_attribute)
    if chain.problem and not chain.image_is_taken:
        model.unreadable.add((node.name, socket.identifier))
    _use_chain(model, f"{sockets.describe(node)}: {name}", chain)


def _require_constant(model, node, name):
    socket = input_of(node, name)
    if sockets.constant(socket) is None:
        model.issues.append(f"{sockets.describe(node)}: {name} comes from "
                            f"{sockets.describe(sockets.source(socket)[0])}")
    elif name != "Specular":
        _note_animatable(model, socket)


def _note_animatable(model, socket):
    feeding = sockets.source(socket)[1]
    model.animatable.add((socket if feeding is None else feeding).path_from_id() + ".default_value")


def _use_chain(model, what, chain):
    if chain.problem:
        instead = "; its image is exported as it is" if chain.image_is_taken else ""
        model.issues.append(f"{what} comes from {chain.problem}{instead}")
        return
    model.uv_maps |= chain.uv_maps
    if chain.color_attribute is not None:
        model.color_attribute = chain.color_attribute


def values(material, model):
    """Constants at the current frame, by glTF's names; `emissive` is colour times strength, not yet clamped."""
    if not material.use_nodes or material.node_tree is None:
        return {"baseColorFactor": [*(float(c) for c in material.diffuse_color[:3]), 1.0],
                "metallicFactor": 0.0, "roughnessFactor": 1.0, "specular": 0.0}
    nodes = material.node_tree.nodes
    result = {"specular": 0.0, "metallicFactor": 0.0, "roughnessFactor": 1.0}
    if model.base is None:
        # Nothing, or only light, leaves this surface.
        result["baseColorFactor"] = [0.0, 0.0, 0.0, 1.0]
    else:
        result.update(_base_values(nodes[model.base], model))
    if model.emission is not None:
        result["emissive"] = _emission_values(nodes[model.emission], model)
    elif model.base is not None and nodes[model.base].type == "BSDF_PRINCIPLED":
        node = nodes[model.base]
        result["emissive"] = _scaled(node, "Emission", "Emission Strength", model)
    return {name: value for name, value in result.items() if value is not None}


def _base_values(node, model):
    if node.type != "BSDF_PRINCIPLED":
        color = _value(node, "Color", model)
        result = {"baseColorFactor": None if color is None else [*_unit(color), 1.0]}
        if is_metal(node):
            result.update(metallicFactor=1.0, roughnessFactor=_value(node, "Roughness", model))
        return result
    color, alpha = _value(node, "Base Color", model), _value(node, "Alpha", model)
    specular = sockets.constant(input_of(node, "Specular"))
    return {
        "baseColorFactor": None if color is None or alpha is None else [*_unit(color), alpha],
        "metallicFactor": _value(node, "Metallic", model),
        "roughnessFactor": _value(node, "Roughness", model),
        "specular": input_of(node, "Specular").default_value if specular is None else specular,
    }


def _emission_values(node, model):
    if "Strength" in node.inputs:
        return _scaled(node, "Color", "Strength", model)
    # A colour in the surface's place.
    return [float(c) for c in node.outputs[0].default_value][:3] if node.type == "RGB" else None


def _scaled(node, color_name, strength_name, model):
    color, strength = _value(node, color_name, model), sockets.constant(node.inputs[strength_name])
    feeding = sockets.source(input_of(node, color_name))[0]
    if color is None and feeding is not None and feeding.type == "TEX_IMAGE":
        # The factor of a textured emission is its strength alone.
        color = [1.0, 1.0, 1.0]
    if color is None or strength is None:
        return None
    return [max(0.0, c * strength) for c in color]


def _value(node, name, model):
    """The constant of an input; None where a texture says it."""
    socket = input_of(node, name)
    value = sockets.constant(socket)
    if value is None and (node.name, socket.identifier) in model.unreadable:
        value = sockets.unconnected(socket)
    return value


def _unit(color):
    return [min(1.0, max(0.0, c)) for c in color]
