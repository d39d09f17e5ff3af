# SPDX-License-Identifier: Apache-2.0
"""render --converge: pictures that grow better until a target is met."""
import json
import os
import signal
import subprocess
import time

import pytest


def refused(result, *words):
    assert result.returncode == 2, (result.returncode, result.stderr)
    assert len(result.stderr.splitlines()) == 1, result.stderr
    for word in words:
        assert word in result.stderr, result.stderr


def compare(bounce, tmp_path, a, b):
    assert bounce("compare", a, b, "--json", "out.json").returncode == 0
    return json.loads((tmp_path / "out.json").read_text())


def test_one_pass_is_the_frame(bounce, render, scene, tmp_path):
    assert render(scene, "-o", "a.exr", "--frames", "12").returncode == 0
    assert render(scene, "-o", "b.exr", "--frames", "12", "--converge", "--passes", "1").returncode == 0
    assert compare(bounce, tmp_path, "a.exr", "b.exr")["max_abs"] == 0
    assert render(scene, "-o", "c.exr", "--frames", "12", "--converge", "--passes", "6").returncode == 0
    many = compare(bounce, tmp_path, "c.exr", "a.exr")
    assert many["max_abs"] > 0 and abs(many["bias"]) < 0.1 and many["nan"] == 0


def test_passes_repeat_to_the_bit_and_are_told(bounce, render, scene, tmp_path):
    arguments = ["--frames", "11,12", "--converge", "--passes", "5"]
    first = render(scene, "-o", "a.####.exr", *arguments, "--stats", "stats.json")
    assert first.returncode == 0 and "5 passes" in first.stderr and "estimated relMSE" in first.stderr
    assert render(scene, "-o", "b.####.exr", *arguments).returncode == 0
    assert compare(bounce, tmp_path, "a.0012.exr", "b.0012.exr")["max_abs"] == 0, "whatever was rendered before"
    for frame in json.loads((tmp_path / "stats.json").read_text())["frames"]:
        told = frame["converged"]
        assert told["passes"] == 5 and told["ended_by"] == "passes" and told["seconds"] > 0
        assert 0 < told["relmse_low"] < told["relmse"] < told["relmse_high"]
        assert told["history"][-1]["passes"] == 5


def test_targets(render, scene, tmp_path):
    easy = render(scene, "-o", "a.exr", "--frames", "12", "--converge", "--target-relmse", "0.5", "--stats", "s.json")
    assert easy.returncode == 0 and "not reached" not in easy.stderr
    told = json.loads((tmp_path / "s.json").read_text())["frames"][0]["converged"]
    assert told["ended_by"] == "relmse" and told["relmse"] <= 0.5
    # What cannot be reached ends by the time, and says what was.
    hard = render(scene, "-o", "a.exr", "--frames", "12", "--converge", "--target-relmse", "1e-12", "--time-limit", "0.5",
                  "--stats", "s.json")
    assert hard.returncode == 0 and "target of 1.00e-12 was not reached" in hard.stderr
    assert json.loads((tmp_path / "s.json").read_text())["frames"][0]["converged"]["ended_by"] == "time"
    # Nor does it take for ever without one.
    alone = render(scene, "-o", "a.exr", "--frames", "12", "--converge", "--target-relmse", "1e-12", "--stats", "s.json")
    assert alone.returncode == 0 and "was not reached and would take" in alone.stderr
    assert json.loads((tmp_path / "s.json").read_text())["frames"][0]["converged"]["ended_by"] == "target out of reach"


def test_an_interrupted_frame_is_written_as_far_as_it_came(binary, bounce, scene, tmp_path):
    process = subprocess.Popen(
        [binary, "render", scene, "-o", "a.####.exr", "--frames", "11,12", "--size", "64x36", "--converge",
         "--time-limit", "600", "--stats", "s.json"], cwd=tmp_path, stderr=subprocess.PIPE, text=True)
    time.sleep(6)
    assert process.poll() is None
    os.kill(process.pid, signal.SIGINT)
    _, errors = process.communicate(timeout=60)
    assert process.returncode == 130, errors
    assert "frame 11 is written as far as it had come" in errors
    assert sorted(path.name for path in tmp_path.glob("a.*")) == ["a.0011.exr"], "whole, and no temporary file"
    assert bounce("compare", "a.0011.exr", "a.0011.exr").returncode == 0
    told = json.loads((tmp_path / "s.json").read_text())["frames"][0]["converged"]
    assert told["ended_by"] == "interrupted" and told["passes"] > 1 and told["relmse"] > 0


@pytest.mark.parametrize("target", [["--passes", "0"], ["--passes", "-3"], ["--time-limit", "0"], ["--time-limit", "-1"],
                                    ["--target-relmse", "0"], ["--target-relmse", "nan"], ["--time-limit", "soon"]])
def test_bad_targets(render, scene, target):
    refused(render(scene, "-o", "a.exr", "--converge", *target), target[0])


def test_what_does_not_go_together(render, scene):
    refused(render(scene, "-o", "a.exr", "--passes", "4"), "--passes", "--converge")
    refused(render(scene, "-o", "a.exr", "--target-relmse", "0.1", "--preset", "ism2008"), "--target-relmse", "--converge")
    refused(render(scene, "-o", "a.exr", "--converge", "--budget-ms", "33"), "--budget-ms", "--time-limit")
    refused(render(scene, "-o", "a.exr", "--converge", "--samples", "4"), "--samples", "--converge")
    refused(render(scene, "-o", "a.exr", "--converge", "--technique", "rsm"), "--technique rsm", "--converge")
    refused(render(scene, "-o", "a.exr", "--converge", "--temporal-reuse", "on"), "--temporal-reuse", "--converge")
    for layer in ("rsm-normal", "motion", "vpls", "unblurred"):
        refused(render(scene, "-o", "a.exr", "--converge", "--show", layer), "--converge", layer)
    refused(render(scene, "-o", "a.exr", "--converge", "--measure-removed", "--stats", "s.json"), "--measure-removed", "--converge")
