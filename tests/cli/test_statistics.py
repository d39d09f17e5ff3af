# SPDX-License-Identifier: Apache-2.0
"""stats.json, and how frame numbers become time."""
import json

import gltf_scenes
import pytest


@pytest.fixture
def statistics(render, scene, tmp_path):
    def run(*arguments, of=scene):
        result = render(of, "-o", "out/f.####.png", "--stats", "stats.json", *arguments)
        assert result.returncode == 0, result.stderr
        return json.loads((tmp_path / "stats.json").read_text())

    return run


def test_the_contract(statistics, scene):
    stats = statistics("--frames", "11,12")
    assert stats["schema"] == "bounce.stats/1"
    assert stats["scene"].endswith(scene.name)
    assert {"vendor", "renderer", "version"} <= stats["gl"].keys()
    assert all(isinstance(value, str) and value for value in stats["gl"].values())
    assert (stats["settings"]["width"], stats["settings"]["height"]) == (16, 9)
    assert stats["settings"]["technique"] == "rsm"
    assert [frame["frame"] for frame in stats["frames"]] == [11, 12]
    for frame in stats["frames"]:
        assert frame["wall_ms"] > 0
        assert [entry["name"] for entry in frame["passes"]] == frame["executed"]
        for entry in frame["passes"]:
            assert entry.keys() == {"name", "gpu_ms", "cpu_ms"}
            assert entry["gpu_ms"] >= 0 and entry["cpu_ms"] >= 0
        assert "gbuffer" in frame["executed"] and "composite" in frame["executed"]
        assert 0 <= frame["gathered_share"] <= 1
    assert all(item["pass"] and item["reason"] for item in stats["left_out"])
    assert "deform" in [item["pass"] for item in stats["left_out"]]
    assert stats["counts"]["triangles"] == 2
    assert stats["counts"]["vpls"] == 4
    assert stats["counts"]["points"] == 0
    assert stats["memory"]["gl_peak_bytes"] > 16 * 9 * 16
    assert stats["memory"]["rss_peak_bytes"] > 1 << 20


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
