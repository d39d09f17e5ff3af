# SPDX-License-Identifier: Apache-2.0
"""scripts/paired_times: the ratios and the interval it prints, of programs whose times are known; and one run of Bounce's own."""
import pathlib
import re
import subprocess
import sys

ROOT = pathlib.Path(__file__).resolve().parents[2]

# Says that a frame took `ms` milliseconds, a hundredth of it times `slower` more in each further run, and calls its pictures alike or not.
FAKE = """#!{python}
import json, pathlib, sys
runs = pathlib.Path(__file__).with_suffix(".runs")
count = int(runs.read_text()) if runs.exists() else 0
value = lambda name: sys.argv[sys.argv.index(name) + 1]
if sys.argv[1] == "compare":
    pathlib.Path(value("--json")).write_text(json.dumps({{"max_abs": {difference}}}))
elif {fails}:
    sys.exit("error: no such scene")
else:
    runs.write_text(str(count + 1))
    pathlib.Path(value("-o")).write_text("{picture}")
    pathlib.Path(value("--stats")).write_text(json.dumps({{"frames": [{{"wall_ms": {ms} * (1 + {slower} * count / 100)}}]}}))
"""


def fake(folder, name, ms, picture="a", difference=0.0, fails=False, slower=1):
    path = folder / name
    path.write_text(FAKE.format(python=sys.executable, ms=ms, picture=picture, difference=difference, fails=fails, slower=slower))
    path.chmod(0o755)
    return path


def paired(*arguments):
    return subprocess.run([ROOT / "scripts" / "paired_times", *arguments], capture_output=True, text=True, timeout=120, check=False)


def test_the_ratio_is_that_of_each_round(tmp_path):
    """Both grow slower from round to round alike: the ratio does not notice."""
    done = paired(fake(tmp_path, "before", 100.0), fake(tmp_path, "after", 103.0), "scene.glb", "--rounds", "10")
    assert done.returncode == 0, done.stderr
    assert "after / before: 1.0300, 95 % confidence 1.0300 to 1.0300, 10 rounds" in done.stdout
    assert "the same to the bit" in done.stdout


def test_the_interval_leaves_out_one_of_ten_at_each_end(tmp_path):
    """Ratios of 1, 1.01, ... 1.09: fewer than 2 of 10 lie on one side of the median with a probability of 11/1024."""
    done = paired(fake(tmp_path, "before", 100.0, slower=0), fake(tmp_path, "after", 100.0), "scene.glb", "--rounds", "10")
    assert "after / before: 1.0450, 95 % confidence 1.0100 to 1.0800, 10 rounds" in done.stdout


def test_pictures_that_differ_are_told(tmp_path):
    before = fake(tmp_path, "before", 1.0, picture="a")
    done = paired(before, fake(tmp_path, "after", 1.0, picture="b", difference=0.5), "scene.glb", "--rounds", "6")
    assert "pictures: different" in done.stdout
    # Another header over the same pixels.
    done = paired(before, fake(tmp_path, "after", 1.0, picture="b"), "scene.glb", "--rounds", "6")
    assert "the same to the bit" in done.stdout


def test_failures_are_one_sentence(tmp_path):
    done = paired(fake(tmp_path, "before", 1.0), fake(tmp_path, "after", 1.0, fails=True), "scene.glb")
    assert done.returncode == 1
    assert "after failed: error: no such scene" in done.stderr
    done = paired(fake(tmp_path, "before", 1.0), tmp_path / "after", "scene.glb", "--rounds", "5")
    assert done.returncode == 2
    assert "--rounds is at least 6" in done.stderr


def test_a_build_is_as_fast_as_itself_to_the_bit(binary, scene):
    """Times are not asserted: other processes run beside this one."""
    done = paired(binary, binary, scene, "--rounds", "6", "--repeat", "1", "--", "--frames", "1", "--size", "64x36")
    assert done.returncode == 0, done.stderr
    assert re.search(r"after / before: \d\.\d{4}, 95 % confidence \d\.\d{4} to \d\.\d{4}, 6 rounds", done.stdout)
    assert "the same to the bit" in done.stdout
