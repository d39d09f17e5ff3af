# SPDX-License-Identifier: Apache-2.0
"""render --samples: the mean of several frames."""
import json

import pytest


def refused(result, *words):
    assert result.returncode == 2, (result.returncode, result.stderr)
    assert len(result.stderr.splitlines()) == 1, result.stderr
    for word in words:
        assert word in result.stderr, result.stderr


def compare(bounce, tmp_path, a, b):
    assert bounce("compare", a, b, "--json", "out.json").returncode == 0
    return json.loads((tmp_path / "out.json").read_text())


@pytest.mark.parametrize("layer", ["shaded", "direct"])
def test_one_sample_is_the_frame_as_it_is(bounce, render, scene, tmp_path, layer):
    assert render(scene, "-o", "a.exr", "--frames", "12", "--show", layer).returncode == 0
    assert render(scene, "-o", "b.exr", "--frames", "12", "--show", layer, "--samples", "1").returncode == 0
    assert compare(bounce, tmp_path, "a.exr", "b.exr")["max_abs"] == 0
    assert render(scene, "-o", "c.exr", "--frames", "12", "--show", layer, "--samples", "4").returncode == 0
    many = compare(bounce, tmp_path, "c.exr", "a.exr")
    assert many["max_abs"] > 0 and abs(many["bias"]) < 0.1 and many["nan"] == 0


def test_sequences_and_statistics(render, scene, tmp_path):
    assert render(scene, "-o", "f.####.exr", "--frames", "11,12", "--samples", "3", "--stats", "stats.json").returncode == 0
    assert sorted(path.name for path in tmp_path.glob("f.*")) == ["f.0011.exr", "f.0012.exr"]
    stats = json.loads((tmp_path / "stats.json").read_text())
    assert stats["settings"]["samples"] == 3 and stats["settings"]["antialias"] is False
    for frame in stats["frames"]:
        assert [entry["name"] for entry in frame["passes"]] == frame["executed"], "each pass once, with the times of all"
        assert "antialias" not in frame["executed"]
        assert frame["wall_ms"] > 0


def test_repeats_do_not_add_up(bounce, render, scene, tmp_path):
    assert render(scene, "-o", "a.exr", "--frames", "12", "--samples", "3").returncode == 0
    assert render(scene, "-o", "b.exr", "--frames", "12", "--samples", "3", "--repeat", "2", "--stats", "s.json").returncode == 0
    assert compare(bounce, tmp_path, "a.exr", "b.exr")["max_abs"] == 0


@pytest.mark.parametrize("count", ["0", "-1", "4097", "few"])
def test_bad_counts(render, scene, count):
    refused(render(scene, "-o", "a.exr", f"--samples={count}"), "samples")


def test_what_has_no_mean(render, scene):
    for layer in ("rsm-normal", "motion", "vpls"):
        refused(render(scene, "-o", "a.exr", "--samples", "4", "--show", layer), "--samples", layer)
    refused(render(scene, "-o", "a.exr", "--samples", "4", "--antialias", "on"), "--antialias", "--samples")
