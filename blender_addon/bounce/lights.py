# SPDX-License-Identifier: GPL-3.0-or-later
"""Light units: Blender's panel values to BOUNCE_scene and to KHR_lights_punctual. No Blender needed."""

import math

# The luminous efficacy that KHR_lights_punctual files by Blender's exporter use (683 lm/W).
LUMENS_PER_WATT = 683.0

TYPE_OF_BLENDER = {"POINT": "point", "SPOT": "spot", "SUN": "sun", "AREA": "area"}
PUNCTUAL_TYPE = {"point": "point", "spot": "spot", "sun": "directional"}

# Which values each type carries in BOUNCE_scene, beside name, type, color and cast_shadow.
VALUES_OF_TYPE = {
    "point": ("power_w", "radius_m"),
    "spot": ("power_w", "radius_m", "cone_angle_rad", "blend"),
    "sun": ("irradiance_w_m2", "angle_rad"),
    "area": ("power_w", "size_x_m", "size_y_m", "spread_rad"),
}

# glTF wants 0 <= inner < outer <= pi/2, which a blend of 0 or a cone of 180 degrees would break.
_SMALLEST_CONE_GAP_RAD = 1e-3
_WIDEST_OUTER_CONE_RAD = math.pi / 2


def punctual_intensity(light_type, power_w=0.0, irradiance_w_m2=0.0):
    """Candela for point and spot, lux for sun. A spot's cone does not concentrate its power in Blender,
    so both divide by the whole sphere."""
    if light_type == "sun":
        return irradiance_w_m2 * LUMENS_PER_WATT
    return power_w / (4.0 * math.pi) * LUMENS_PER_WATT


def punctual_cone(cone_angle_rad, blend):
    """(inner, outer) half angles that come nearest to Blender's cone and blend.

    Blender's blend is linear in the cosine: full intensity inside the cosine cos(outer) + (1 - cos(outer)) * blend.
    """
    outer = min(cone_angle_rad / 2.0, _WIDEST_OUTER_CONE_RAD)
    edge = math.cos(outer)
    inner = math.acos(max(-1.0, min(1.0, edge + (1.0 - edge) * blend)))
    return max(0.0, min(inner, outer - _SMALLEST_CONE_GAP_RAD)), outer


def punctual_light(light):
    """The KHR_lights_punctual values of one BOUNCE_scene light; None for an area light, which has no twin there. Light that
    is taken away has none either: it is dark."""
    if light["type"] == "area":
        return None
    punctual = {
        "name": light["name"],
        "type": PUNCTUAL_TYPE[light["type"]],
        "color": [max(0.0, float(c)) for c in light["color"]],
        "intensity": punctual_intensity(
            light["type"], max(0.0, light.get("power_w", 0.0)), max(0.0, light.get("irradiance_w_m2", 0.0))
        ),
    }
    if light["type"] == "spot":
        inner, outer = punctual_cone(light["cone_angle_rad"], light["blend"])
        punctual["spot"] = {"innerConeAngle": inner, "outerConeAngle": outer}
    return punctual
