# SPDX-License-Identifier: Apache-2.0
"""The example scenes build, export whole and hold what they are meant to show."""

import json
import os
import subprocess

import bounce_schema
import pytest
from conftest import ROOT
from gltf_eval import Gltf

TRIANGLES = {"cornell": (62_986, 62_986), "colonnade": (20_000, 100_000), "table": (20_000, 100_000),
             "u_room": (300, 5_000), "ring": (5_000, 50_000), "courtyard": (3_000, 50_000)}
FRAMES = {"courtyard": 240}
# Each is told in two other ways; bounce bench invariance without --change has all of them (docs/invariance.md).
CHANGES = {"cornell": ("scale 1e-3", "light 1e6"), "colonnade": ("scale 2^20", "move 1e6"), "table": ("move 1e6", "reorder"),
           "u_room": ("scale 1e3", "turn 90, up"), "ring": ("scale 1e5", "split meshes"), "courtyard": ("light 1e-6", "merge meshes")}


@pytest.fixture(scope="module", params=TRIANGLES)
def example(request, blender, export, tmp_path_factory):
    folder = tmp_path_factory.mktemp(request.param)
    blender("-P", ROOT / "examples" / f"{request.param}.py", "--", folder / "scene.blend")
    export(folder / "scene.blend", folder / "scene.glb", "--no-draco")
    gltf = Gltf(folder / "scene.glb")
    gltf.path = folder / "scene.glb"
    return request.param, gltf


def test_example(example):
    name, gltf = example
    bounce_schema.validate(gltf.json)
    root = gltf.bounce
    assert root["unsupported"] == []
    assert root["frames"] == {"start": 1, "end": FRAMES.get(name, 48), "fps": 24}
    assert (root["render"]["width"], root["render"]["height"]) == (640, 360)
    assert root["view"]["view_transform"] == "Standard" and "camera" in root
    drawn = [node["mesh"] for node in gltf.json["nodes"] if "mesh" in node]
    triangles = sum(gltf.json["accessors"][p["indices"]]["count"] // 3
                    for mesh in drawn for p in gltf.json["meshes"][mesh]["primitives"])
    low, high = TRIANGLES[name]
    assert low <= triangles <= high


def material_of(gltf, node):
    return gltf.json["meshes"][gltf.json["nodes"][gltf.node(node)]["mesh"]]["primitives"][0]["material"]


def test_example_moves(example):
    name, gltf = example
    channels = gltf.channels()
    paths = {key[1] for key in channels if isinstance(key, tuple)}
    pointers = {key.rsplit("/", 1)[1] for key in channels if isinstance(key, str)}
    if name == "cornell":
        assert paths == {"rotation"}
    elif name == "colonnade":
        assert {(gltf.node("Sun"), "rotation"), (gltf.node("Camera"), "translation")} <= set(channels)
        assert len({n["mesh"] for n in gltf.json["nodes"] if n["name"].startswith("Column ")}) == 1, "not shared"
    elif name == "u_room":
        assert (gltf.node("Spot"), "rotation") in channels
    elif name == "ring":
        assert {(gltf.node("Cloth"), "weights"), (gltf.node("Cloth"), "translation")} <= set(channels)
        assert gltf.json["materials"][material_of(gltf, "Ring")]["pbrMetallicRoughness"].get("metallicFactor", 1) == 1
    elif name == "courtyard":
        moving = {("Searchlight", "rotation"), ("Searchlight", "translation"), ("Ball", "rotation"),
                  ("Ball", "translation"), ("Gate hinge", "rotation"), ("Camera", "translation"), ("Camera", "rotation")}
        assert {(gltf.node(node), path) for node, path in moving} <= set(channels)
    else:
        assert {"translation", "rotation", "weights"} <= paths
        assert {"power_w", "color", "cone_angle_rad"} <= pointers
        assert len(gltf.json["skins"]) == 1


@pytest.mark.skipif("BOUNCE_BINARY" not in os.environ, reason="BOUNCE_BINARY does not say where the program is")
def test_example_told_in_other_numbers_has_the_same_picture(example, tmp_path):
    name, gltf = example
    changes = [word for change in CHANGES[name] for word in ("--change", change)]
    done = subprocess.run([os.environ["BOUNCE_BINARY"], "bench", "invariance", gltf.path, "-o", tmp_path / "out", "--quick",
                           "--size", "64x36", *changes], capture_output=True, text=True, check=False)
    assert done.returncode == 0, done.stdout + done.stderr
    (table,) = json.loads((tmp_path / "out/results.json").read_text())["tables"]
    assert len(table["rows"]) == 4  # two changes, two settings


@pytest.mark.skipif("BOUNCE_BINARY" not in os.environ, reason="BOUNCE_BINARY does not say where the program is")
def test_example_runs_the_passes_that_it_needs(example, tmp_path):
    """Of a frame by itself, and of the third of an animation, which has what did not change since the second."""
    name, gltf = example
    expected = json.loads((ROOT / "tests/data/example_passes.json").read_text())[name]
    program = os.environ["BOUNCE_BINARY"]
    done = subprocess.run([program, "info", gltf.path, "--plan", "--json", "--size", "160x90"], capture_output=True,
                          text=True, check=False)
    assert done.returncode == 0, done.stderr
    plan = json.loads(done.stdout)["plan"]
    assert plan["passes"] == expected["first"]
    assert all(item["pass"] and item["reason"] for item in plan["left_out"])
    done = subprocess.run([program, "render", gltf.path, "-o", tmp_path / "a.####.exr", "--frames", "1-3", "--size", "64x36",
                           "--no-pass-times", "--stats", tmp_path / "stats.json"], capture_output=True, text=True, check=False)
    assert done.returncode == 0, done.stderr
    stats = json.loads((tmp_path / "stats.json").read_text())
    assert stats["frames"][2]["executed"] == expected["third"]
    unchanged = {item["pass"] for item in stats["left_out"] if item["reason"] == "what it makes is as in the frame before"}
    missing = set(expected["first"]) - set(expected["third"])
    assert missing - {"points"} <= unchanged | {"deform"}


def test_example_without_a_target_is_bad_usage(blender):
    done = blender("-P", ROOT / "examples/cornell.py", check=False)
    assert done.returncode == 2 and "OUT.blend" in done.stderr
