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
    # What mixes the surface with a Transparent BSDF: (node name, socket identifier) of the Mix Shader's factor.
    mix_factor: tuple = None
    # The factor is the part of the Transparent BSDF, not of the surface.
    mix_is_transparency: bool = False
    # Alpha comes from an image; where it is compared with a constant, that constant.
    alpha_image: bool = False
    alpha_cutoff: float = None
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
    _analyse_mix(tree, base, model)
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
    if node.type == "MIX_SHADER":
        mixed = _mixed_with_transparent(node)
        if mixed is not None and model.mix_factor is None:
            child, model.mix_is_transparency = mixed
            model.mix_factor = (node.name, node.inputs[0].identifier)
            # Blender's exporter reads the surface's node alone.
            model.is_exact = False
            return _closures(child, model)
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


def _mixed_with_transparent(node):
    """(other shader, whether the factor is the transparent part) where a Mix Shader has a clear Transparent BSDF."""
    first, second = (sockets.source(socket)[0] for socket in node.inputs[1:3])
    if first is None or second is None:
        return None
    if _is_clear(first):
        return second, False
    return (first, True) if _is_clear(second) else None


def _is_clear(node):
    return node.type == "BSDF_TRANSPARENT" and sockets.constant(node.inputs["Color"]) == [1.0, 1.0, 1.0]


def _analyse_mix(tree, base, model):
    """A Mix Shader's factor as alpha: a constant, or an image where nothing else says alpha."""
    if model.mix_factor is None:
        return
    socket = mix_socket(tree, model)
    if sockets.constant(socket) is not None:
        _note_animatable(model, socket)
        return
    own = None if base is None or base.type != "BSDF_PRINCIPLED" else sockets.constant(base.inputs["Alpha"])
    if base is None or model.mix_is_transparency or (base.type == "BSDF_PRINCIPLED" and own != 1.0):
        model.issues.append(f"Mix Shader with a Transparent BSDF, whose factor comes from "
                            f"{sockets.describe(sockets.source(socket)[0])}: exported opaque")
        model.mix_factor = None
    else:
        _use_alpha(model, "Mix Shader: Factor", socket)


def mix_socket(tree, model):
    node, identifier = model.mix_factor
    return next(socket for socket in tree.nodes[node].inputs if socket.identifier == identifier)


def _use_alpha(model, what, socket):
    chain, model.alpha_cutoff = textures.follow_alpha(socket)
    _use_chain(model, what, chain)
    model.alpha_image = chain.has_image and (not chain.problem or chain.image_is_taken)


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
        for name in ("Metallic", "Roughness", "Emission"):
            _use_input(model, node, name)
        for name in ("Specular", "Emission Strength"):
            _require_constant(model, node, name)
        _analyse_alpha(node, model)
        _analyse_reflection(node, model)
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


def _analyse_alpha(node, model):
    socket = node.inputs["Alpha"]
    if sockets.constant(socket) is not None:
        _note_animatable(model, socket)
        return
    _use_alpha(model, f"{sockets.describe(node)}: Alpha", socket)
    if not model.alpha_image:
        model.unreadable.add((node.name, socket.identifier))


def _analyse_reflection(node, model):
    tint = input_of(node, "Specular Tint")
    neutral = (0.0, [1.0, 1.0, 1.0])  # a number before Blender 4.0, a colour since
    if tint is not None and sockets.constant(tint) not in neutral:
        model.issues.append("Principled BSDF: Specular Tint")
    if node.distribution == "MULTI_GGX":
        model.issues.append("Principled BSDF: Multiscatter GGX, exported as GGX")
    roughness = node.inputs.get("Diffuse Roughness")
    if roughness is not None and sockets.constant(roughness) != 0.0:
        model.issues.append("Principled BSDF: Diffuse Roughness")


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
    model.issues.extend(f"{what}: {note}" for note in chain.notes)
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
    result["baseColorFactor"][3] *= _mix_alpha(material.node_tree, model)
    if model.emission is not None:
        result["emissive"] = _emission_values(nodes[model.emission], model)
    elif model.base is not None and nodes[model.base].type == "BSDF_PRINCIPLED":
        node = nodes[model.base]
        result["emissive"] = _scaled(node, "Emission", "Emission Strength", model)
    return {name: value for name, value in result.items() if value is not None}


def _base_values(node, model):
    if node.type != "BSDF_PRINCIPLED":
        color = _factor(node, "Color", model)
        result = {"baseColorFactor": [*_unit(color), 1.0]}
        if is_metal(node):
            result.update(metallicFactor=1.0, roughnessFactor=_value(node, "Roughness", model))
        return result
    color, alpha = _factor(node, "Base Color", model), _factor(node, "Alpha", model)
    specular = sockets.constant(input_of(node, "Specular"))
    return {
        "baseColorFactor": [*_unit(color), min(1.0, max(0.0, alpha))],
        "metallicFactor": _value(node, "Metallic", model),
        "roughnessFactor": _value(node, "Roughness", model),
        "specular": _specular(node, input_of(node, "Specular").default_value if specular is None else specular),
    }


def _specular(node, level):
    """F0 / 0.08. Since Blender 4.0 the index of refraction says F0 and the level, neutral at one half, scales it."""
    if "Specular IOR Level" not in node.inputs:
        return level
    ior = sockets.constant(node.inputs["IOR"])
    ior = node.inputs["IOR"].default_value if ior is None else ior
    return 2.0 * level * ((ior - 1.0) / (ior + 1.0)) ** 2 / 0.08


def _mix_alpha(tree, model):
    """Part of the surface in a Mix Shader with a Transparent BSDF; 1 where an image says it."""
    if model.mix_factor is None:
        return 1.0
    factor = sockets.constant(mix_socket(tree, model))
    if factor is None:
        return textures.constant_factor(mix_socket(tree, model), 1)[0]
    factor = min(1.0, max(0.0, factor))
    return 1.0 - factor if model.mix_is_transparency else factor


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


def _factor(node, name, model):
    """What glTF's factor has to be: the constant, or the constant that a texture is multiplied by."""
    value = _value(node, name, model)
    if value is not None:
        return value
    size = 1 if name == "Alpha" else 3
    factor = textures.constant_factor(input_of(node, name), size)
    return factor[0] if size == 1 else factor


def _unit(color):
    return [min(1.0, max(0.0, c)) for c in color]
