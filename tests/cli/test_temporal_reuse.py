# SPDX-License-Identifier: Apache-2.0
"""--temporal-reuse: what it says of each frame, which frames it leaves alone, and what it does not go with."""
import json

import gltf_scenes
import pytest

VPLS = ["--vpls", "16", "--near-field", "off"]


@pytest.fixture
def still(tmp_path):
    """The lit square, its spot at full power in all of its frames, 10 to 13, and something over it."""
    document = gltf_scenes.lit_square()
    del document["animations"]
    document["extensions"]["BOUNCE_scene"]["lights"][0]["power_w"] = 100
    document["nodes"].append({"name": "Screen", "mesh": 0, "translation": [0.9, 0, 0.6], "rotation": [0, 0.7071068, 0, 0.7071068]})
    document["scenes"][0]["nodes"].append(len(document["nodes"]) - 1)
    return gltf_scenes.write_glb(tmp_path / "still.glb", document)


@pytest.fixture
def frames_of(render, tmp_path):
    def run(scene, name, *arguments):
        result = render(scene, "-o", f"{name}.####.exr", "--stats", f"{name}.json", *VPLS, *arguments)
        assert result.returncode == 0, result.stderr
        return json.loads((tmp_path / f"{name}.json").read_text()), result.stderr

    return run


def test_every_frame_says_what_it_took(frames_of, still):
    stats, _ = frames_of(still, "on", "--temporal-reuse", "on", "--frames", "10-12")
    assert stats["settings"]["temporal_reuse"] is True
    first, *others = [frame["temporal_reuse"] for frame in stats["frames"]]
    assert first == {"reused_share": 0, "reset": "there is no frame before it"}
    assert "no light of the frames before is reused: there is no frame before it" in stats["notes"]
    assert others == [{"reused_share": 1, "reset": None}] * 2
    assert "temporal reuse" in stats["frames"][1]["executed"]


def test_frames_that_do_not_follow_each_other_begin_anew(frames_of, still):
    stats, _ = frames_of(still, "gap", "--temporal-reuse", "on", "--frames", "10,12,13")
    assert [frame["temporal_reuse"]["reset"] for frame in stats["frames"]] == [
        "there is no frame before it", "there is no frame before it", None]


def test_off_is_the_default_and_keeps_nothing(frames_of, still, tmp_path):
    off, _ = frames_of(still, "off", "--frames", "10-11")
    assert off["settings"]["temporal_reuse"] is False
    assert all("temporal_reuse" not in frame and "temporal reuse" not in frame["executed"] for frame in off["frames"])
    assert {"pass": "temporal reuse", "reason": "it was not asked for"} in off["left_out"]
    on, _ = frames_of(still, "on", "--frames", "10-11", "--temporal-reuse", "on")
    assert on["memory"]["gl_peak_bytes"] > off["memory"]["gl_peak_bytes"]
    # The first frame has the lights of a frame alone, the next ones have others.
    assert (tmp_path / "on.0010.exr").read_bytes() == (tmp_path / "off.0010.exr").read_bytes()
    assert (tmp_path / "on.0011.exr").read_bytes() != (tmp_path / "off.0011.exr").read_bytes()
    assert (tmp_path / "off.0011.exr").read_bytes() == (tmp_path / "off.0010.exr").read_bytes()


def test_repetitions_and_runs_give_the_same_pictures(frames_of, tmp_path):
    """A plate glides through a room. A frame depends on those before it, and on nothing else."""
    room = gltf_scenes.write_glb(tmp_path / "room.glb", gltf_scenes.room(), gltf_scenes.room_buffer())
    reuse = ["--temporal-reuse", "on"]
    stats, _ = frames_of(room, "once", "--frames", "1-4", *reuse)
    for frame in stats["frames"][1:]:
        assert "motion" in frame["executed"]
        assert 0.5 < frame["temporal_reuse"]["reused_share"] <= 1
    frames_of(room, "often", "--frames", "1-4", "--repeat", "3", *reuse)
    for frame in ("0001", "0002", "0003", "0004"):
        assert (tmp_path / f"once.{frame}.exr").read_bytes() == (tmp_path / f"often.{frame}.exr").read_bytes()
    # Taken up in the middle it says that it begins anew.
    later, _ = frames_of(room, "later", "--frames", "3-4", *reuse)
    assert later["frames"][0]["temporal_reuse"]["reset"] == "there is no frame before it"
    assert any("there is no frame before it" in note for note in later["notes"])


def test_a_light_that_changes_ends_it(frames_of, scene, tmp_path):
    """The spot's power rises: each frame has its own light alone."""
    stats, _ = frames_of(scene, "on", "--temporal-reuse", "on", "--frames", "11-13")
    assert [frame["temporal_reuse"]["reset"] for frame in stats["frames"]][1:] == ["a light moved or changed"] * 2
    frames_of(scene, "off", "--frames", "11-13")
    assert (tmp_path / "on.0013.exr").read_bytes() == (tmp_path / "off.0013.exr").read_bytes()


@pytest.mark.parametrize(
    "options, words",
    [
        (["--technique", "rsm"], ["rsm", "ism"]),
        (["--samples", "4"], ["--samples"]),
        (["--shading", "hybrid"], ["--shading hybrid"]),
        (["--interleave", "1"], ["--interleave"]),
        (["--show", "direct"], ["--show direct"]),
    ],
    ids=lambda value: " ".join(value),
)
def test_what_it_does_not_go_with(render, still, options, words):
    result = render(still, "-o", "f.exr", "--temporal-reuse", "on", *options)
    assert result.returncode == 2, result.stderr
    assert len(result.stderr.splitlines()) == 1
    for word in ("--temporal-reuse", *words):
        assert word in result.stderr
