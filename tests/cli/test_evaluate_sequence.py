# SPDX-License-Identifier: Apache-2.0
"""Frames in a row: what `bounce evaluate` tells of them is what `bounce compare` tells of the pictures it leaves."""
import csv
import json

import gltf_scenes
import pytest

SIZE = ["--size", "64x48"]
FRAMES = ["--frames", "1-8"]


@pytest.fixture
def room(tmp_path):
    return gltf_scenes.write_glb(tmp_path / "room.glb", gltf_scenes.room(), gltf_scenes.room_buffer())


def done(process):
    assert process.returncode == 0, process.stderr
    return process


def test_a_sequence_has_the_figures_of_compare(bounce, room, tmp_path):
    done(bounce("render", room, "-o", "ref.####.exr", *FRAMES, *SIZE, "--vpls", "512"))
    done(bounce("evaluate", room, "-o", "report", "--reference", "ref.####.exr", *FRAMES, *SIZE, "--bounces", "1", "--repeat", "1",
                "--sweep", "visibility"))
    results = json.loads((tmp_path / "report/results.json").read_text(encoding="utf-8"))
    assert results["sequence"] == {"step": 1, "motion": True}
    points = [(curve["name"], point) for curve in results["curves"] for point in curve["points"]]
    assert len(points) == 4
    assert all(point["sequence"]["flicker_power"] > 0 and point["sequence"]["tid"] > 0 for _, point in points)
    assert all(point["flip_hdr"] > 0 for _, point in points), "so small that all of them have it"

    # The picture that the report keeps, one of its points.
    kept = {path.name.split(".")[0] for path in (tmp_path / "report/frames").iterdir()} - {"reference"}
    assert len(kept) == 1
    done(bounce("render", room, "-o", "motion.####.exr", *FRAMES, *SIZE, "--show", "motion"))
    name = f"report/frames/{kept.pop()}.####.exr"
    done(bounce("compare", name, "report/frames/reference.####.exr", *FRAMES, "--motion", "motion.####.exr", "--hdr-flip",
                "--json", "compare.json"))
    compared = json.loads((tmp_path / "compare.json").read_text(encoding="utf-8"))
    shown = min((point for _, point in points), key=lambda point: point["relmse"])
    assert shown["sequence"] == compared["sequence"]
    for mine, its in zip(shown["frames"], compared["frames"], strict=True):
        for metric in ("relmse", "relmse_exposed", "flip_ldr", "flip_hdr", "ssim", "psnr_db", "bias"):
            assert mine[metric] == its[metric], metric
    for metric in ("relmse_exposed", "flip_hdr", "ssim", "psnr_db"):
        assert shown[metric] == pytest.approx(compared["mean"][metric], rel=1e-12)

    with open(tmp_path / "report/results.csv", encoding="utf-8", newline="") as file:
        rows = [row for row in csv.DictReader(file) if row["label"] == shown["label"]]
    assert [row["frame"] for row in rows] == ["mean", *map(str, range(1, 9))]
    for name in ("flip_step_mean", "flip_step_reference_max", "tid_relative", "tid_reference", "flicker_share"):
        assert float(rows[0][name]) == pytest.approx(shown["sequence"][name], rel=1e-5), name
        assert rows[1][name] == ""
    assert float(rows[0]["ssim"]) == pytest.approx(shown["ssim"], rel=1e-5)


def test_one_frame_is_no_sequence(bounce, room, tmp_path):
    done(bounce("render", room, "-o", "ref.####.exr", "--frames", "3,5", *SIZE, "--vpls", "64"))
    command = ["evaluate", room, "-o", "report", "--reference", "ref.####.exr", *SIZE, "--bounces", "1", "--repeat", "1", "--sweep",
               "visibility"]

    def results(frames):
        done(bounce(*command, "--frames", frames))
        return json.loads((tmp_path / "report/results.json").read_text(encoding="utf-8"))

    one = results("3")
    assert one["sequence"] is None
    assert all(point["sequence"] is None for curve in one["curves"] for point in curve["points"])
    # Every second frame has steps, but no way from the frame just before.
    two = results("3,5")
    assert two["sequence"] == {"step": 2, "motion": False}
    figures = two["curves"][0]["points"][0]["sequence"]
    assert figures["flip_step_mean"] > 0
    assert figures["tid"] is None and figures["flicker_power"] is None
