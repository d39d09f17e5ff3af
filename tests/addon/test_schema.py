# SPDX-License-Identifier: Apache-2.0
"""Every export obeys the schema, and the schema refuses what does not."""

import copy

import jsonschema
import pytest

import bounce_schema


@pytest.mark.parametrize("name", ["motion", "lights", "materials"])
def test_exports_are_valid(built, name):
    bounce_schema.validate(built(name).gltf.json)


@pytest.mark.parametrize("spoil", [
    lambda root: root.pop("frames"),
    lambda root: root.update(surplus=1),
    lambda root: root["lights"][0].update(radius_m=-1.0),
    lambda root: root["lights"][0].update(type="laser"),
    lambda root: root["lights"][0].update(spread_rad=1.0),
    lambda root: root["world"].update(color=[1.0, 2.0]),
    lambda root: root["frames"].update(fps=0),
    lambda root: root["unsupported"].append({"object": "Cube"}),
])
def test_schema_refuses(built, spoil):
    document = copy.deepcopy(built("lights").gltf.json)
    spoil(document["extensions"]["BOUNCE_scene"])
    with pytest.raises(jsonschema.ValidationError):
        bounce_schema.validate(document)
