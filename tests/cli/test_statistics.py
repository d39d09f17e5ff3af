# SPDX-License-Identifier: Apache-2.0
"""stats.json, and how frame numbers become time."""
import json
import os
import shutil

import gltf_scenes
import pytest
from conftest import RSM


@pytest.fixture
def statistics(render, scene, tmp_path):
    def run(*arguments, of=scene):
        result = render(of, "-o", "out/f.####.png", "--stats", "stats.json", *arguments)
        assert result.returncode == 0, result.stderr
        return json.loads((tmp_path / "stats.json").read_text())

    return run


def test_the_contract(statistics, scene):
    stats = statistics("--frames", "11,12", *RSM)
    assert stats["schema"] == "bounce.stats/1"
    assert stats["scene"].endswith(scene.name)
    assert {"vendor", "renderer", "version"} <= stats["gl"].keys()
    assert all(isinstance(value, str) and value for value in stats["gl"].values())
    assert (stats["settings"]["width"], stats["settings"]["height"]) == (16, 9)
    assert stats["settings"]["technique"] == "rsm"
    assert [frame["frame"] for frame in stats["frames"]] == [11, 12]
    assert stats["startup"].keys() == {"context_ms", "load_ms", "upload_ms", "first_frame_ms"}
    assert min(stats["startup"].values()) > 0
    told = sum(stats["startup"].values()) + sum(frame["wall_ms"] for frame in stats["frames"])
    assert told < stats["run_ms"], "the parts are of the run and do not overlap"
    for frame in stats["frames"]:
        assert frame["wall_ms"] > 0
        assert [entry["name"] for entry in frame["passes"]] == frame["executed"]
        for entry in frame["passes"]:
            assert entry.keys() == {"name", "gpu_ms", "cpu_ms", "gpu_ms_all"}
            assert entry["gpu_ms_all"] == [entry["gpu_ms"]]
            assert entry["gpu_ms"] >= 0 and entry["cpu_ms"] >= 0
        assert "composite" in frame["executed"]
        assert 0 <= frame["gathered_share"] <= 1
    # Nothing that the camera sees moves from one frame to the other.
    assert ["gbuffer" in frame["executed"] for frame in stats["frames"]] == [True, False]
    assert "gbuffer" in [item["pass"] for item in stats["left_out"]]
    assert all(item["pass"] and item["reason"] for item in stats["left_out"])
    assert "deform" in [item["pass"] for item in stats["left_out"]]
    assert stats["counts"]["triangles"] == 2
    assert stats["counts"]["rsm_samples"] == 4
    assert stats["counts"]["vpls"] == 0
    assert stats["counts"]["points"] == 0
    assert stats["settings"]["rsm_samples"] == 4
    assert "vpls" not in stats["settings"], "an option that this technique does not have"
    assert stats["memory"]["gl_peak_bytes"] > 16 * 9 * 16
    assert stats["memory"]["rss_peak_bytes"] > 1 << 20


def test_a_name_that_is_no_utf_8(statistics, scene, tmp_path):
    named = tmp_path / os.fsdecode(b"\xff.glb")
    shutil.copy(scene, named)
    assert statistics("--frames", "11", *RSM, of=named)["scene"].endswith("\N{REPLACEMENT CHARACTER}.glb")


def occluded():
    """The lit square with a small one 1 m above it and a box-like frame of points around, so that it hides something:
    a second square far below keeps neither on the scene's hull."""
    document = gltf_scenes.lit_square()
    document["nodes"] += [
        {"name": "Screen", "mesh": 0, "translation": [0, 0, 0.5], "scale": [0.3, 0.3, 1]},
        {"name": "Lid", "mesh": 0, "translation": [0, 0, 5], "scale": [1.5, 1.5, 1]},
        {"name": "Ground", "mesh": 0, "translation": [0, 0, -1], "scale": [3, 3, 1]},
    ]
    document["scenes"][0]["nodes"] += [4, 5, 6]
    return document


def test_the_contract_of_virtual_point_lights(statistics, tmp_path):
    scene = gltf_scenes.write_glb(tmp_path / "occluded.glb", occluded())
    stats = statistics("--frames", "12", "--vpls", "30", "--bounces", "2", "--bounce-vpls", "16", "--points", "100",
                       "--large-triangles", "off", "--near-field", "off", "--measure-removed", of=scene)
    settings = stats["settings"]
    assert settings["technique"] == "ism"
    assert (settings["vpls"], settings["bounces"], settings["bounce_vpls"]) == (30, 2, 16)
    assert (settings["visibility"], settings["splat"], settings["ism_size"]) == ("ism", "disks", 64)
    counts = stats["counts"]
    assert counts["vpls"] == 32 + 16, "whole blocks of 4 x 4 pixels"
    assert counts["points_a_map"] == 100
    assert counts["points"] == 3200, "each map its own"
    assert counts["large_triangles"] == 0
    assert counts["map_size"] == 64
    assert counts["atlas"] == [6 * 64, 6 * 64], "32 maps"
    removed = stats["frames"][0]["removed"]
    assert removed["indirect_mean"] > 0
    assert removed["removed_mean"] >= 0
    assert removed["bias"] == pytest.approx(-removed["removed_mean"] / (removed["indirect_mean"] + removed["removed_mean"]))
    assert stats["notes"] == []


def test_large_triangles_are_counted(statistics, tmp_path):
    scene = gltf_scenes.write_glb(tmp_path / "occluded.glb", occluded())
    counts = statistics("--frames", "12", of=scene)["counts"]
    assert counts["large_triangles"] > 0


def no_triangle(document):
    del document["nodes"][0]["mesh"]


def no_lit_surface(document):
    document["nodes"][3]["translation"] = [0, 0, -3]  # it shines down, away from the square


def no_light(document):
    del document["nodes"][3]["extensions"], document["animations"]
    document["extensions"]["BOUNCE_scene"]["lights"] = []


@pytest.mark.parametrize(
    "change, words",
    [(no_triangle, "has a triangle"), (no_lit_surface, "no light reaches a surface"), (no_light, "no light sends light")],
)
@pytest.mark.parametrize("bounces", [1, 3])
def test_a_scene_without_bounced_light_is_drawn_and_says_so(render, tmp_path, change, words, bounces):
    document = gltf_scenes.lit_square()
    change(document)
    scene = gltf_scenes.write_glb(tmp_path / "poor.glb", document)
    result = render(scene, "-o", "a.png", "--frames", "35", "--stats", "s.json", "--bounces", bounces)
    assert result.returncode == 0, result.stderr
    assert [line for line in result.stderr.splitlines() if line.startswith("note: no bounced light") and words in line]
    stats = json.loads((tmp_path / "s.json").read_text())
    assert [item for item in stats["left_out"] if words in item["reason"]]
    assert any(words in note for note in stats["notes"])
    assert (tmp_path / "a.png").stat().st_size > 0


def test_what_the_first_frame_finds_stays_in_the_statistics_of_a_sequence(render, tmp_path):
    document = gltf_scenes.lit_square()
    no_lit_surface(document)
    scene = gltf_scenes.write_glb(tmp_path / "poor.glb", document)
    result = render(scene, "-o", "a.##.png", "--frames", "35-36", "--stats", "s.json")
    assert result.returncode == 0, result.stderr
    notes = json.loads((tmp_path / "s.json").read_text())["notes"]
    assert len([note for note in notes if "no light reaches a surface" in note]) == 1


def test_frames_of_a_blender_file_are_blenders(statistics):
    stats = statistics("--frames", "9-13x2,35")
    assert [frame["time_s"] for frame in stats["frames"]] == pytest.approx([-0.04, 0.04, 0.12, 1.0])


def test_time_moves_what_is_animated(statistics):
    """The spot has no power at the first frame: its passes are not there."""
    stats = statistics("--frames", "10,35")
    dark, lit = (frame["executed"] for frame in stats["frames"])
    assert not [name for name in dark if "Spot" in name]
    assert "direct light: Spot" in lit and "rsm: Spot" in lit


def test_frame_one_of_any_other_file_is_time_zero_at_24_a_second(statistics, tmp_path):
    scene = gltf_scenes.write_glb(tmp_path / "plain.glb", gltf_scenes.square())
    stats = statistics("--frames", "1,25", of=scene)
    assert [frame["time_s"] for frame in stats["frames"]] == pytest.approx([0.0, 1.0])


def test_repeat_keeps_every_time_and_their_median(statistics):
    stats = statistics("--frames", "12", "--repeat", "3")
    times = stats["frames"][0]["wall_ms_all"]
    assert len(times) == 3
    assert stats["frames"][0]["wall_ms"] == sorted(times)[1]


def test_pass_times_can_be_left_out(statistics):
    stats = statistics("--frames", "12", "--no-pass-times")
    assert stats["frames"][0]["passes"] == []
    assert stats["frames"][0]["executed"]


def test_info_tells_the_same_scene(bounce, scene):
    result = bounce("info", scene, "--json")
    assert result.returncode == 0
    info = json.loads(result.stdout)
    assert info["schema"] == "bounce.info/1"
    assert info["frames"] == {"start": 10, "end": 13, "fps": 25}
    assert info["counts"]["triangles"] == 2
    assert [light["name"] for light in info["lights"]] == ["Spot"]
    assert [(camera["name"], camera["active"]) for camera in info["cameras"]] == [("Camera", True), ("Side", False)]
    assert info["animations"][0]["name"] == "Scene"
    assert info["features"]["animated_lights"]
