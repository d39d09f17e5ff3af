# SPDX-License-Identifier: Apache-2.0
"""Validates every place of a document where BOUNCE_scene may stand, and the pointers of its animation."""

import json
import re
from pathlib import Path

import jsonschema

_FILE = Path(__file__).resolve().parent.parent.parent / "blender_addon/bounce/schema/BOUNCE_scene.schema.json"
SCHEMA = json.loads(_FILE.read_text())
jsonschema.Draft202012Validator.check_schema(SCHEMA)

# The pointers of docs/bounce_scene.md.
_POINTERS = [re.compile(pattern) for pattern in (
    r"/extensions/BOUNCE_scene/lights/\d+/(power_w|irradiance_w_m2|color|cone_angle_rad|blend|radius_m|angle_rad"
    r"|size_x_m|size_y_m|spread_rad)",
    r"/extensions/KHR_lights_punctual/lights/\d+/(color|intensity|spot/innerConeAngle|spot/outerConeAngle)",
    r"/cameras/\d+/perspective/yfov",
    r"/cameras/\d+/extensions/BOUNCE_scene/(focal_length_mm|ortho_scale|shift_x|shift_y)",
    r"/extensions/BOUNCE_scene/world/(color|strength|rotation)",
    r"/nodes/\d+/extensions/KHR_node_visibility/visible",
    r"/materials/\d+/pbrMetallicRoughness/(baseColorFactor|metallicFactor|roughnessFactor)",
    r"/materials/\d+/emissiveFactor",
    r"/materials/\d+/extensions/KHR_materials_emissive_strength/emissiveStrength",
    r"/extensions/BOUNCE_scene/view/exposure",
)]


def validate(document):
    """`document` is the JSON of a whole file."""
    _check(document["extensions"]["BOUNCE_scene"], None)
    for part, items in (("node", "nodes"), ("camera", "cameras"), ("material", "materials")):
        for item in document.get(items, []):
            extension = item.get("extensions", {}).get("BOUNCE_scene")
            if extension is not None:
                _check(extension, part)
    for material in document.get("materials", []):
        for texture in (*material.values(), *material.get("pbrMetallicRoughness", {}).values()):
            extension = texture.get("extensions", {}).get("BOUNCE_scene") if "index" in _keys(texture) else None
            if extension is not None:
                _check(extension, "texture")
    for pointer in pointers(document):
        assert any(pattern.fullmatch(pointer) for pattern in _POINTERS), f"{pointer} is not in the table"
        _resolve(document, pointer)
    used = set(document["extensionsUsed"])
    assert _extension_names(document) <= used, f"not in extensionsUsed: {_extension_names(document) - used}"
    assert "BOUNCE_scene" not in document.get("extensionsRequired", [])


def pointers(document):
    for animation in document.get("animations", []):
        for channel in animation["channels"]:
            if channel["target"]["path"] == "pointer":
                yield channel["target"]["extensions"]["KHR_animation_pointer"]["pointer"]


def _keys(value):
    return value.keys() if isinstance(value, dict) else ()


def _check(instance, part):
    schema = SCHEMA if part is None else {**SCHEMA, "$ref": f"#/$defs/{part}"}
    jsonschema.Draft202012Validator(schema).validate(instance)


def _resolve(document, pointer):
    value = document
    for step in pointer.strip("/").split("/"):
        value = value[int(step)] if isinstance(value, list) else value[step]


def _extension_names(value):
    names = set()
    if isinstance(value, dict):
        names.update(value.get("extensions", {}))
        for child in value.values():
            names |= _extension_names(child)
    elif isinstance(value, list):
        for child in value:
            names |= _extension_names(child)
    return names
