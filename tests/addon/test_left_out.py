# SPDX-License-Identifier: Apache-2.0
"""What nothing reads does not travel, is named with a reason, and leaves the picture as it was, bit for bit."""

import json

import pytest
from conftest import SCRIPTS
from gltf_eval import Gltf

ROCKS = 8


class Pair:
    """One scene exported twice: as ever, and with all that is left out otherwise."""

    def __init__(self, folder, done):
        self.lean, self.whole = folder / "lean.glb", folder / "whole.glb"
        self.gltf, self.all = Gltf(self.lean), Gltf(self.whole)
        self.output = done.stdout
        self.report = json.loads((folder / "report.json").read_text(encoding="utf-8"))
        self.reasons = {(e["name"], e["what"]): e["reason"] for e in self.report["left_out"]}


@pytest.fixture(scope="module")
def pair(blender, export, tmp_path_factory):
    folder = tmp_path_factory.mktemp("leftovers")
    blender("--python-exit-code", "3", "-P", SCRIPTS / "leftovers.py", "--", folder)
    done = export(folder / "scene.blend", folder / "lean.glb", "--no-draco", "--verbose", "--report",
                  folder / "report.json")
    export(folder / "scene.blend", folder / "whole.glb", "--no-draco", "--keep-all")
    return Pair(folder, done)


def names(gltf, kind):
    return {entry.get("name") for entry in gltf.json[kind]}


def mesh_of(gltf, node):
    return gltf.json["nodes"][gltf.node(node)]["mesh"]


def test_meshes_of_one_content_are_stored_once(pair):
    assert len({mesh_of(pair.gltf, f"Rock {i}") for i in range(ROCKS)}) == 1
    assert len({mesh_of(pair.all, f"Rock {i}") for i in range(ROCKS)}) == ROCKS
    rock, red, other = (mesh_of(pair.gltf, name) for name in ("Rock 0", "Red rock", "Other rock"))
    assert len({rock, red, other}) == 3, "another material or another shape is another mesh"
    primitives = [pair.gltf.json["meshes"][mesh]["primitives"][0] for mesh in (rock, red, other)]
    assert primitives[0]["material"] != primitives[1]["material"]
    assert primitives[0]["attributes"] == primitives[1]["attributes"], "the same vertices under another material"
    assert primitives[0]["attributes"]["POSITION"] != primitives[2]["attributes"]["POSITION"]
    told = [reason for (_, what), reason in pair.reasons.items() if what == "mesh" and "the same as" in reason]
    # The rocks but one, and of the small cubes all but one.
    assert len(told) >= ROCKS - 1


def test_images_of_one_content_are_stored_once(pair):
    assert len(pair.gltf.json["images"]) == 2 and len(pair.all.json["images"]) == 3
    image = {name: pair.gltf.json["textures"][m["pbrMetallicRoughness"]["baseColorTexture"]["index"]]["source"]
             for m in pair.gltf.json["materials"] if (name := m["name"]).startswith("Boards")}
    assert image["Boards 0"] == image["Boards 1"] != image["Boards 2"]
    assert any(what == "image" and "the same as" in reason for (_, what), reason in pair.reasons.items())


def test_what_nothing_reads_is_not_there(pair):
    for primitive in pair.gltf.json["meshes"][mesh_of(pair.gltf, "Rock 0")]["primitives"]:
        assert set(primitive["attributes"]) == {"POSITION", "NORMAL"}
    assert "TEXCOORD_2" in pair.all.json["meshes"][mesh_of(pair.all, "Rock 0")]["primitives"][0]["attributes"]
    assert "TEXCOORD_0" in pair.gltf.json["meshes"][mesh_of(pair.gltf, "Board 0")]["primitives"][0]["attributes"]
    image, plain = ({name for name in p["attributes"]} for p in
                    pair.gltf.json["meshes"][mesh_of(pair.gltf, "Half")]["primitives"])
    assert "TEXCOORD_0" in image and "TEXCOORD_0" not in plain
    assert not {"Nobody's", "Hidden one's"} & names(pair.gltf, "materials")
    assert [m.get("name") for m in pair.gltf.json["materials"]].count("Default") == 1
    for key in (("Rock 0", "UV map 'Third UV'"), ("Rock 0", "colour attribute 'Paint'"), ("Nobody's", "material"),
                ("Hidden one's", "material"), ("Stray", "image"), ("Image of Nobody's", "image")):
        assert key in pair.reasons, key
        assert f"left out: {key[0]}: {key[1]}: {pair.reasons[key]}" in pair.output
    kept = {"Grey", "Red", "Stone", "Wood", "Boards 0", "Floor"}
    assert not {name for name, what in pair.reasons if what in ("material", "image")} & kept


def test_what_shows_nothing_is_not_there(pair):
    left = {"Hidden": "renders do not show it", "Never": "renders do not show it", "Empty": "carries nothing",
            "No faces": "no faces", "Dark": "no power in any frame"}
    said = {name: reason for (name, what), reason in pair.reasons.items() if what in {"mesh", "light", "empty", "camera"}}
    for name, words in left.items():
        assert name not in names(pair.gltf, "nodes")
        assert words in said[name], said[name]
    # Beside each, what matters.
    for name in ("Carrier", "Carried", "Blinking", "Later", "Negative", "Lamp", "Camera", "Unused camera"):
        assert name in names(pair.gltf, "nodes"), name
        assert name not in said, said[name]
    assert {light["name"] for light in pair.gltf.bounce["lights"]} == {"Lamp", "Later", "Negative"}
    assert {"Empty", "Dark"} <= names(pair.all, "nodes")
    pointers = [key for key in pair.gltf.channels() if isinstance(key, str)]
    assert f"/nodes/{pair.gltf.node('Blinking')}/extensions/KHR_node_visibility/visible" in pointers


def test_what_stands_still_is_one_value(pair):
    moving = {key[0] for key in pair.gltf.channels() if isinstance(key, tuple)}
    assert pair.gltf.node("Moves") in moving and pair.gltf.node("Keyed but still") not in moving
    assert pair.gltf.json["nodes"][pair.gltf.node("Keyed but still")]["translation"] == pytest.approx([-1.8, 0.2, -1.0])
    assert pair.reasons["Keyed but still", "animation"] == "it stands still in all frames"
    assert ("Moves", "animation") not in pair.reasons


@pytest.mark.parametrize("technique", ["direct", "ism"])
def test_the_picture_is_the_same(pair, bounce, tmp_path, technique):
    for name, file in (("lean", pair.lean), ("whole", pair.whole)):
        bounce("render", file, "-o", tmp_path / f"{name}.####.exr", "--frames", "1,4", "--size", "64x36", "--technique", technique)
    for frame in ("0001", "0004"):
        bounce("compare", tmp_path / f"lean.{frame}.exr", tmp_path / f"whole.{frame}.exr", "--json", tmp_path / "c.json")
        found = json.loads((tmp_path / "c.json").read_text(encoding="utf-8"))
        assert found["max_abs"] == 0 and found["nan"] == found["inf"] == 0, found
    assert (tmp_path / "lean.0001.exr").read_bytes() != (tmp_path / "lean.0004.exr").read_bytes(), "nothing moves"


def test_the_file_is_smaller(pair):
    """Eight rocks of which one is stored, and of its vertices a fifth."""
    assert pair.lean.stat().st_size < 0.2 * pair.whole.stat().st_size
    assert pair.report["bytes"] == pair.lean.stat().st_size
