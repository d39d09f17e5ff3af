# SPDX-License-Identifier: Apache-2.0
"""The regression guard: the renderer's errors against stored references have not risen, and a renderer that is broken on
purpose is caught. An evaluation repeats its errors to the bit; a killed one goes on. Scenes, references and baselines are
those of scripts/guard."""
import concurrent.futures
import importlib.machinery
import importlib.util
import json
import math
import os
import shutil
import subprocess

import pytest
from conftest import BINARY, ROOT


def script(name):
    loader = importlib.machinery.SourceFileLoader(name, str(ROOT / "scripts" / name))
    module = importlib.util.module_from_spec(importlib.util.spec_from_loader(loader.name, loader))
    loader.exec_module(module)
    module.BOUNCE = BINARY
    return module


GUARD = script("guard")
SCENE = "u_room"  # of the three the fastest; what is not about the scenes is tested on it


@pytest.fixture
def guard(bounce, tmp_path):
    """The guard's evaluation of a scene, with more options."""

    def run(scene, output, *more, **options):
        return bounce(*GUARD.command(scene, tmp_path / output, *more)[1:], **options)

    return run


def with_doubled_light(folder):
    """A copy of the shaders with a defect."""
    shutil.copytree(ROOT / "shaders", folder)
    for name, old, new in script("broken_renderer").DOUBLED_LIGHT:
        text = (folder / name).read_text()
        assert text.count(old) == 1, f"{name}: the defect has to be written anew"
        (folder / name).write_text(text.replace(old, new))
    return folder


@pytest.fixture(scope="module")
def evaluations(tmp_path_factory):
    """All evaluations that draw every point, each made once and as many at a time as there are processors: what takes long is to
    start the processes, one a point, and that one processor does alone. By name: where it lies and the finished process, to be waited
    for."""
    folder = tmp_path_factory.mktemp("evaluations")
    repeated = GUARD.command(SCENE, folder / "repeated")
    repeated[repeated.index("--repeat") + 1] = "3"
    commands = {scene: (GUARD.command(scene, folder / scene, "--baseline", GUARD.DATA / f"{scene}.json"), {}) for scene in GUARD.SCENES}
    commands["repeated"] = (repeated, {})
    commands["doubled"] = (GUARD.command(SCENE, folder / "doubled", "--baseline", GUARD.DATA / f"{SCENE}.json"),
                           {"BOUNCE_SHADER_DIR": str(with_doubled_light(folder / "shaders"))})

    def finished(command, environment):
        return subprocess.run(command, env={**os.environ, **environment}, capture_output=True, text=True, timeout=240, check=False)

    with concurrent.futures.ThreadPoolExecutor(os.cpu_count() or 1) as pool:
        yield {name: (folder / name, pool.submit(finished, *command)) for name, command in commands.items()}


@pytest.fixture
def evaluated(evaluations):
    """What the guard's evaluation of SCENE leaves; a test that changes it takes a copy."""
    folder, process = evaluations[SCENE]
    assert process.result().returncode == 0, process.result().stderr
    return folder


def results(folder):
    return json.loads((folder / "results.json").read_text())


def points(folder):
    return {(curve["name"], point["label"]): point for curve in results(folder)["curves"] for point in curve["points"]}


@pytest.mark.parametrize("scene", GUARD.SCENES)
def test_no_error_has_risen(evaluations, scene):
    result = evaluations[scene][1].result()
    assert result.returncode == 0, result.stderr
    assert "7 points compared, 0 errors have risen, 0 points are missing" in result.stdout
    # The reference's noise is in the errors of both, so its size does not matter here.
    told = "\n".join(line for line in result.stderr.splitlines() if "noise floor" not in line)
    for word in ("warning", "note:"):  # no point is missing, none is new, and the scene is the baseline's
        assert word not in told, told


def test_doubled_light_is_caught(evaluations):
    folder, process = evaluations["doubled"]
    result = process.result()
    assert result.returncode == 5, (result.returncode, result.stderr)
    risen = [line for line in result.stderr.splitlines() if line.startswith("error: ")]
    assert any(line.startswith("error: Guard, disks: relmse is ") for line in risen), risen
    assert any(line.startswith("error: Guard, disks: bias is ") for line in risen), risen
    assert (folder / "results.json").exists(), "the report is written all the same"


def test_a_missing_point_fails(guard, evaluated, tmp_path):
    """A point more than the baseline has is a note; one less ends with 5, until a new baseline is written."""
    shutil.copytree(evaluated, tmp_path / "out")
    baseline = json.loads((GUARD.DATA / f"{SCENE}.json").read_text())
    del baseline["curves"][0]["points"][0]

    def compared(*more):
        (tmp_path / "baseline.json").write_text(json.dumps(baseline))
        return guard(SCENE, "out", "--resume", "--baseline", tmp_path / "baseline.json", *more)

    result = compared()
    assert result.returncode == 0, result.stderr
    assert "Guard, direct: the run has this point, the baseline has not" in result.stderr
    for label in ("gone", "lost"):
        baseline["curves"][0]["points"].append({"label": label, "relmse": 1, "flip_ldr": 1, "bias": 0})
    result = compared("--save-baseline", tmp_path / "new.json")
    assert result.returncode == 5, (result.returncode, result.stderr)
    told = [line for line in result.stderr.splitlines() if line.startswith("error: ")]
    assert len(told) == 1 and "Guard, gone; Guard, lost" in told[0] and "--save-baseline" in told[0], told
    assert "6 points compared, 0 errors have risen, 2 points are missing" in result.stdout
    baseline = json.loads((tmp_path / "new.json").read_text())
    assert compared().returncode == 0


def test_the_same_evaluation_twice(evaluations, evaluated, capsys):
    """Errors are the same to the bit, also where frames are drawn repeatedly. Whether times lie within the spread that the run
    with repeats printed is reported."""
    repeated, process = evaluations["repeated"]
    assert process.result().returncode == 0, process.result().stderr
    first, second = points(repeated), points(evaluated)
    assert first.keys() == second.keys() and len(first) == 7
    within = 0
    for key, point in first.items():
        for error in ("relmse", "flip_ldr", "bias"):
            assert point[error] == second[key][error], (key, error)
        for a, b in zip(point["frames"], second[key]["frames"], strict=True):
            for error in ("relmse", "relmse_exposed", "flip_ldr", "ssim", "psnr_db", "bias", "not_finite"):
                assert a[error] == b[error], (key, error)
        assert point["seconds_least"] <= point["seconds"] <= point["seconds_most"]
        within += point["seconds_least"] <= second[key]["seconds"] <= point["seconds_most"]
    with capsys.disabled():
        print(f"\n{within} of {len(first)} times of the run without repeats lie within the other's spread")


def test_resume_takes_what_is_there(guard, evaluated, tmp_path):
    shutil.copytree(evaluated, tmp_path / "out")
    before = points(tmp_path / "out")
    kept = sorted((tmp_path / "out" / "points").iterdir())
    assert len(kept) == 7
    (kept[0] / "point.json").unlink()  # as if it had been killed there
    (kept[1] / "frame.0001.exr").write_bytes(b"half")
    again = guard(SCENE, "out", "--resume")
    assert again.returncode == 0, again.stderr
    assert "5 of 7 points are there already" in again.stderr
    assert len([line for line in again.stderr.splitlines() if line.startswith("evaluate ")]) == 2
    after = points(tmp_path / "out")
    same = [key for key in before if before[key]["seconds"] == after[key]["seconds"]]
    assert len(same) >= 5
    for key, point in before.items():
        assert point["relmse"] == after[key]["relmse"], key


def test_the_settings_that_win_are_what_render_takes(bounce, evaluated, tmp_path):
    shutil.copytree(evaluated, tmp_path / "out")
    tuning = json.loads((tmp_path / "out" / "tuning.json").read_text())
    assert tuning["schema"] == "bounce.tuning/1"
    best = tuning["budgets"][-1]
    assert best["budget_ms"] == 10000
    assert best["relmse"] == min(point["relmse"] for point in points(tmp_path / "out").values())
    scene = GUARD.DATA / f"{SCENE}.glb"
    result = bounce("render", scene, "-o", "tuned.exr", "--size", "128x72", "--frames", 1, "--preset", "auto",
                    "--budget-ms", 10000, "--tuning", "out/tuning.json", "--stats", "tuned.json")
    assert result.returncode == 0, result.stderr
    assert f"settings for 10000 ms from out/tuning.json: {' '.join(best['options'])}" in result.stderr
    compared = bounce("compare", "tuned.exr", GUARD.DATA / f"{SCENE}.0001.exr", "--json", "compared.json")
    assert compared.returncode == 0, compared.stderr
    assert math.isclose(json.loads((tmp_path / "compared.json").read_text())["relmse"], best["relmse"], rel_tol=1e-9)
    # What is typed counts; another size is told.
    result = bounce("render", scene, "-o", "own.exr", "--size", "16x9", "--frames", 1, "--budget-ms", 10000, "--tuning",
                    "out/tuning.json", "--vpls", 16, "--interleave", 1, "--stats", "own.json")
    assert result.returncode == 0, result.stderr
    assert json.loads((tmp_path / "own.json").read_text())["settings"]["vpls"] == 16
    assert "was measured at 128x72, this is 16x9" in result.stderr


def refused(result, code, *words):
    assert result.returncode == code, (result.returncode, result.stderr)
    assert len(result.stderr.splitlines()) == 1, result.stderr
    for word in words:
        assert word in result.stderr


def test_refusals(guard, bounce, tmp_path):
    scene = GUARD.DATA / f"{SCENE}.glb"
    reference = GUARD.DATA / f"{SCENE}.0001.exr"

    def evaluate(*more):
        return bounce("evaluate", scene, "-o", "out", *more)

    refused(evaluate("--sweep", "colour"), 2, "--sweep colour", "ism-size")
    refused(evaluate("--sweep", "bounces"), 2, "--bounces 2")
    refused(evaluate("--reference", reference, "--reference-spp", 64), 2, "--reference-spp")
    refused(evaluate("--reference", reference, "--frames", "1,2"), 2, "####")
    refused(evaluate("--reference", reference, "--size", "64x36", "--bounces", 2), 3, "128x72", "64x36")
    refused(evaluate("--reference", reference, "--size", "128x72"), 3, "2 bounces")
    refused(evaluate("--reference", reference, "--size", "128x72", "--bounces", 2, "--frames", 7), 3, "frame 1, not of frame 7")
    refused(evaluate("--reference", tmp_path / "none.exr"), 3, "none.exr")
    refused(evaluate("--reference", reference, "--baseline", "none.json"), 3, "none.json")
    refused(bounce("render", scene, "-o", "a.exr", "--budget-ms", 0, "--tuning", "a.json"), 2, "budget-ms")
    refused(bounce("render", scene, "-o", "a.exr", "--budget-ms", 33, "--tuning", "a.json"), 3, "a.json")
    refused(guard(SCENE, "out", "--baseline", GUARD.DATA / "cornell.json"), 3, "the baseline is of cornell.glb")
    assert not (tmp_path / "out" / "points").exists(), "something was rendered before the refusal"


def scene_results(name, ratio, floor):
    """A scene's results.json, as far as the table over scenes reads it."""
    return {"scene": name,
            "own_front": {"points": 3, "compared": 2, "geometric_mean_ratio": ratio, "least_ratio": 1.5},
            "curves": [{"name": "Cycles", "reference_engine": True, "peer": False, "points": []},
                       {"name": "VPLs", "reference_engine": False, "peer": False, "points": [
                           {"label": "16 VPLs", "seconds": 0.1, "relmse": 2.6e-3}, {"label": "32 VPLs", "seconds": 0.2, "relmse": 2.5e-3}]},
                       {"name": "Presets", "reference_engine": False, "peer": False, "points": [{"label": "auto", "seconds": 0.5, "relmse": 1e-3, "bias": 0.02}]},
                       {"name": "Eevee", "reference_engine": False, "peer": True, "points": [{"label": "16 samples", "seconds": 6.0, "relmse": 5e-2}]}],
            "speedup_at_equal_error": [{"curve": "Presets", "label": "auto", "ratio": ratio and 3 * ratio,
                                        "cycles_time": "extrapolated"}] if ratio else [],
            "reference": {"noise_floor_relmse": floor, "frames": [
                {"noise_floor_relmse": floor, "smallest_relmse": 1e-3}, {"noise_floor_relmse": floor, "smallest_relmse": 8e-4}]}}


def test_the_table_over_scenes(tmp_path):
    """Figures by hand: ratios 2 and 8 have the geometric mean 4; Eevee takes 12 times as long for 50 times the error,
    and 30 times as long as the fastest point with at most a twentieth of its error, 2.5e-3."""
    examples = script("evaluate_examples")
    rows = [examples.row_of(scene_results(name, ratio, 4e-5)) for name, ratio in (("a", 2.0), ("b", 8.0), ("c", None))]
    text = examples.table(rows)
    assert "default settings: geometric mean over 2 scenes 12, worst 6 (a)" in text
    assert "fronts: geometric mean over 2 scenes 4, worst 2 (a)" in text
    assert "12x, 0.02   30x" in text and "20.0x" in text
    examples.write_summary(tmp_path / "summary.json", rows)
    summary = json.loads((tmp_path / "summary.json").read_text())
    assert math.isclose(summary["geometric_mean_front_ratio"], 4.0)
    assert math.isclose(summary["geometric_mean_ratio"], 12.0)
    assert summary["scenes"][2]["ratio"] is None


def test_the_table_knows_the_default_settings_on_another_axis():
    """Without the axis of presets the default settings are a point of another name; without a reference's noise there is no headroom."""
    examples = script("evaluate_examples")
    results = scene_results("a", 2.0, None)
    results["curves"][2] = {"name": "Technique", "reference_engine": False, "peer": False, "points": [{"label": "ism", "seconds": 0.25, "relmse": 2e-3, "bias": 0.0}]}
    row = examples.row_of(results)
    assert row["seconds"] == 0.25 and math.isnan(row["ratio"]) and math.isnan(row["headroom"])
    assert "nan" in examples.table([row])
