# SPDX-License-Identifier: Apache-2.0
"""Preset auto: --explain, budgets and targets without a file of measured settings."""
import json

import pytest

ONE = ["--frames", "12"]


def refused(result, *words):
    assert result.returncode == 2, (result.returncode, result.stderr)
    assert len(result.stderr.splitlines()) == 1, result.stderr
    for word in words:
        assert word in result.stderr, result.stderr


def stats_of(tmp_path):
    return json.loads((tmp_path / "s.json").read_text())


def test_explains_what_it_chose(render, scene, tmp_path):
    result = render(scene, "-o", "a.exr", *ONE, "--explain", "--stats", "s.json", "--no-pass-times")
    assert result.returncode == 0, result.stderr
    told = stats_of(tmp_path)["auto"]
    lines = result.stdout.splitlines()
    assert len(lines) == len(told["reasons"]) and all(reason["why"] in line for reason, line in zip(told["reasons"], lines))
    assert told["budget_ms"] is None and told["machine_speed"] is None and 0 < told["seen_share"] <= 1
    assert render(scene, "-o", "b.exr", *ONE).stdout == "", "without being asked it says nothing"


def test_the_same_settings_can_be_asked_for(bounce, render, scene, tmp_path):
    """What a budget chose, chosen again by its speed, and given option by option: the same picture."""
    first = render(scene, "-o", "a.exr", *ONE, "--budget-ms", "60", "--stats", "s.json", "--no-pass-times")
    assert first.returncode == 0 and "--machine-speed" in first.stderr, first.stderr
    told = stats_of(tmp_path)["auto"]
    assert told["trial_ms"] > 0 and told["machine_speed"] > 0
    again = render(scene, "-o", "b.exr", *ONE, "--budget-ms", "60", "--machine-speed", str(told["machine_speed"]))
    assert again.returncode == 0 and "--machine-speed" not in again.stderr
    options = [word for reason in told["reasons"] for word in reason["choice"].split()]
    assert "--technique" in options
    assert render(scene, "-o", "c.exr", *ONE, *options).returncode == 0
    for other in ("b.exr", "c.exr"):
        assert bounce("compare", "a.exr", other, "--json", "out.json").returncode == 0
        assert json.loads((tmp_path / "out.json").read_text())["max_abs"] == 0, other


def test_a_budget_that_nothing_fits(render, scene):
    result = render(scene, "-o", "a.exr", *ONE, "--budget-ms", "0.01", "--machine-speed", "1", "--explain")
    assert result.returncode == 0 and "Nothing fits into 0.0" in result.stdout, result.stdout


def test_a_target(render, scene, tmp_path):
    cost = []
    for target in ("1", "5e-3"):
        result = render(scene, "-o", "a.exr", *ONE, "--target-relmse", target, "--stats", "s.json", "--no-pass-times")
        assert result.returncode == 0, result.stderr
        told = stats_of(tmp_path)["auto"]
        assert told["fits"] and told["predicted_relmse"] <= float(target)
        cost.append(told["predicted_ms"])
    assert cost[0] < cost[1]


@pytest.mark.parametrize("options, words", [
    (["--explain", "--preset", "ism2008"], ["--explain", "--preset ism2008"]),
    (["--machine-speed", "1"], ["--machine-speed", "--budget-ms"]),
    (["--budget-ms", "33", "--preset", "rsm2005"], ["--preset rsm2005", "--budget-ms"]),
    (["--budget-ms", "33", "--target-relmse", "0.1"], ["--budget-ms", "--target-relmse"]),
    (["--target-relmse", "0.1", "--preset", "lv2009"], ["--target-relmse", "--converge"]),
    (["--tuning", "a.json"], ["--tuning", "--budget-ms"]),
])
def test_what_does_not_go_together(render, scene, options, words):
    refused(render(scene, "-o", "a.exr", *ONE, *options), *words)
