# SPDX-License-Identifier: GPL-3.0-or-later
"""Blender's lights, as Cycles takes them, in the words of BOUNCE_scene."""

from . import light_pattern, sockets
from .lights import TYPE_OF_BLENDER, VALUES_OF_TYPE

# Cycles' default; only another value is written.
_DEFAULT_MAX_BOUNCES = 1024


def is_portal(light):
    return light.type == "AREA" and bool(getattr(getattr(light, "cycles", None), "is_portal", False))


def _emission_node(light):
    """The Emission node that alone makes up the light's node tree; None without nodes; False for any other tree."""
    if not light.use_nodes or light.node_tree is None:
        return None
    node = sockets.surface_node(light.node_tree, "OUTPUT_LIGHT")
    if node is None or node.type != "EMISSION" or sockets.constant(node.inputs["Strength"]) is None:
        return False
    if sockets.constant(node.inputs["Color"]) is None and light_pattern.image_node(light, node) is None:
        return False
    return node


def _pattern(light):
    """(mean colour, pattern) of the image over an area light; None without one."""
    node = _emission_node(light)
    image = light_pattern.image_node(light, node) if node else None
    return None if image is None else light_pattern.read(image, light.shape in {"DISK", "ELLIPSE"})


def values(light):
    """Values at the current frame. Cycles multiplies what the nodes emit by the panel's colour and power."""
    color = [float(c) for c in light.color]
    strength = float(light.energy)
    node = _emission_node(light)
    if node:
        pattern = _pattern(light)
        emitted = pattern[0] if pattern is not None else sockets.constant(node.inputs["Color"])
        color = [a * b for a, b in zip(color, emitted)]
        strength *= sockets.constant(node.inputs["Strength"])
    rectangular = getattr(light, "shape", "") in {"RECTANGLE", "ELLIPSE"}
    readers = {
        "power_w": lambda: strength,
        "irradiance_w_m2": lambda: strength,
        "radius_m": lambda: light.shadow_soft_size,
        "cone_angle_rad": lambda: light.spot_size,
        "blend": lambda: light.spot_blend,
        "angle_rad": lambda: light.angle,
        "size_x_m": lambda: light.size,
        "size_y_m": lambda: light.size_y if rectangular else light.size,
        "spread_rad": lambda: light.spread,
    }
    return {
        "color": color,
        **{name: float(readers[name]()) for name in VALUES_OF_TYPE[TYPE_OF_BLENDER[light.type]]},
    }


def fixed(light):
    """What does not vary over time."""
    description = {"name": light.name, "type": TYPE_OF_BLENDER[light.type], "cast_shadow": _casts_shadow(light)}
    if light.type == "AREA":
        description["shape"] = light.shape.lower()
        pattern = _pattern(light)
        if pattern is not None:
            description["pattern"] = pattern[1]
    max_bounces = getattr(getattr(light, "cycles", None), "max_bounces", _DEFAULT_MAX_BOUNCES)
    if max_bounces != _DEFAULT_MAX_BOUNCES:
        description["max_bounces"] = max_bounces
    return description


def _casts_shadow(light):
    # Cycles' own flag until Blender 4.1, the light's since.
    cycles = getattr(light, "cycles", None)
    return bool(cycles.cast_shadow if hasattr(cycles, "cast_shadow") else light.use_shadow)


def issues(light):
    if _emission_node(light) is False:
        node = sockets.surface_node(light.node_tree, "OUTPUT_LIGHT")
        culprit = sockets.first_unreadable(node) if node is not None else "nothing at its output"
        yield f"light '{light.name}': its node tree is not a plain Emission ({culprit})"
    node = _emission_node(light)
    image = light_pattern.image_node(light, node) if node else None
    if image is not None:
        for issue in light_pattern.issues(image):
            yield f"light '{light.name}': {issue}"
    if light.type == "SPOT" and getattr(light, "use_square", False):
        yield f"light '{light.name}': square spot"
