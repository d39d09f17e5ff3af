# SPDX-License-Identifier: Apache-2.0
"""What a frame would do (`info --plan`), what it may take (`--memory-limit`), and what it does all the same (`--force`)."""
import json

ONE = ["--frames", "12", "--size", "32x18"]


def test_a_plan_names_passes_and_what_is_left_out_and_why(bounce, scene):
    result = bounce("info", scene, "--plan", "--json", "--size", "32x18")
    assert result.returncode == 0, result.stderr
    plan = json.loads(result.stdout)["plan"]
    assert (plan["width"], plan["height"]) == (32, 18)
    assert plan["passes"] == ["gbuffer", "composite", "depth samples", "sample sources", "antialias"]
    reasons = {item["pass"]: item["reason"] for item in plan["left_out"]}
    assert reasons["light: Spot"] == "it sends no light in this frame"
    assert {"deform", "transparent layers", "base colour textures", "area lights"} <= reasons.keys() and all(reasons.values())
    assert plan["choices"], "preset auto says what it chose"
    memory = plan["memory"]
    assert memory["peak_bytes"] == memory["lasting_bytes"] + memory["passes_bytes"] > 0
    text = bounce("info", scene, "--plan", "--preset", "rsm2005").stdout
    assert "as asked for" in text and "left out" in text and "GPU memory" in text and "spot lights" in text


def test_options_of_frames_say_nothing_without_a_plan(bounce, scene):
    result = bounce("info", scene, "--vpls", "16")
    assert result.returncode == 2 and "--vpls" in result.stderr and "--plan" in result.stderr


def test_the_plan_is_what_is_done(bounce, scene, tmp_path):
    plan = json.loads(bounce("info", scene, "--plan", "--json", "--size", "32x18").stdout)["plan"]
    assert bounce("render", scene, "-o", "a.exr", "--size", "32x18", "--stats", "s.json", "--no-pass-times").returncode == 0
    stats = json.loads((tmp_path / "s.json").read_text())
    # Points are placed by the frame that warms up.
    assert stats["frames"][0]["executed"] == [name for name in plan["passes"] if name != "points"]
    assert abs(plan["memory"]["peak_bytes"] / stats["memory"]["gl_peak_bytes"] - 1) < 0.02


def test_a_limit_of_memory_is_kept_or_refused(bounce, scene, tmp_path):
    assert bounce("render", scene, "-o", "a.exr", *ONE, "--stats", "a.json", "--no-pass-times").returncode == 0
    peak = json.loads((tmp_path / "a.json").read_text())["memory"]["gl_peak_bytes"]
    limit = peak / 2 / 2**20
    result = bounce("render", scene, "-o", "b.exr", *ONE, "--memory-limit", f"{limit:.2f}", "--stats", "b.json", "--no-pass-times")
    assert result.returncode == 0, result.stderr
    assert "to stay within" in result.stderr
    assert json.loads((tmp_path / "b.json").read_text())["memory"]["gl_peak_bytes"] <= limit * 2**20
    result = bounce("render", scene, "-o", "c.exr", *ONE, "--memory-limit", "0.01")
    assert result.returncode == 2 and len(result.stderr.splitlines()) == 1
    assert "--memory-limit" in result.stderr and not (tmp_path / "c.exr").exists()
    # More than enough changes nothing.
    assert bounce("render", scene, "-o", "d.exr", *ONE, "--memory-limit", "4096").returncode == 0
    assert (tmp_path / "d.exr").read_bytes() == (tmp_path / "a.exr").read_bytes()


def test_forcing_what_is_exact_changes_no_bit(bounce, render, scene, tmp_path):
    assert render(scene, "-o", "a.exr", "--frames", "12").returncode == 0
    assert render(scene, "-o", "b.exr", "--frames", "12", "--force", "exact", "--stats", "b.json", "--no-pass-times").returncode == 0
    stats = json.loads((tmp_path / "b.json").read_text())
    assert stats["settings"]["forced"] == "exact" and "over, layer 1" in stats["frames"][0]["executed"]
    assert bounce("compare", "a.exr", "b.exr", "--json", "c.json").returncode == 0
    assert json.loads((tmp_path / "c.json").read_text())["max_abs"] == 0


def test_a_frame_that_turns_black_says_why(render, scene):
    """The spot sends nothing at frame 10; not only the first frame of a run is looked at."""
    result = render(scene, "-o", "a.####.exr", "--frames", "12,11,10", "--technique", "direct")
    assert result.returncode == 0, result.stderr
    (note,) = [line for line in result.stderr.splitlines() if "is black" in line]
    assert "frame 10" in note and "light: Spot: it sends no light in this frame" in note
