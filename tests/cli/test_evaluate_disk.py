# SPDX-License-Identifier: Apache-2.0
"""`bounce evaluate` on a disk that fills up: one sentence, whole files or none, and with room again it goes on."""

import json
import os
import resource
import shlex
import shutil
import subprocess

import pytest
from fake_engines import arguments_of, environment_of, jobs


def errors(text):
    return [line for line in text.splitlines() if line.startswith("error: ")]


def whole_files_alone(folder):
    files = [path for path in folder.rglob("*") if path.is_file()]
    assert not [path for path in files if ".part" in path.name], "a temporary file stayed behind"
    assert not [path for path in files if path.stat().st_size == 0], "an empty file under a name of its own"


def test_a_page_that_has_no_room(binary, bounce, scene, engines, tmp_path):
    """No file may have more than 100 kB: the page alone is larger."""
    environment = environment_of(engines, tmp_path)
    command = [*arguments_of(engines, scene, "report"), "--peers", "none"]
    full = subprocess.run(
        [binary, *map(str, command)], cwd=tmp_path, env={**os.environ, **environment}, capture_output=True, text=True, check=False,
        timeout=120, preexec_fn=lambda: resource.setrlimit(resource.RLIMIT_FSIZE, (100_000, resource.RLIM_INFINITY)))
    assert full.returncode == 1, full.stderr
    assert errors(full.stderr) == ["error: cannot write report/index.html: the disk may be full"]
    assert not (tmp_path / "report/results.json").exists(), "it is written last, and says that the report is whole"
    assert not (tmp_path / "report/index.html").exists()
    whole_files_alone(tmp_path)
    before = len(jobs(engines))
    again = bounce(*command, "--resume", environment=environment)
    assert again.returncode == 0, again.stderr
    assert len(jobs(engines)) == before, "all was there, and Blender is not started again"
    assert json.loads((tmp_path / "report/results.json").read_text(encoding="utf-8"))["curves"]


def can_mount():
    """In a name space of one's own, as any user where the system allows that."""
    if shutil.which("unshare") is None:
        return False
    return subprocess.run(["unshare", "-rm", "sh", "-c", "mount -t tmpfs none /mnt"], capture_output=True, check=False).returncode == 0


# What is full, how much room it has, and what is said. In an output folder of 12 kB there is room for the measured point
# alone; TMPDIR's 16 kB do not hold the scripts, its 32 kB those and not all pictures. In the cache folder the driver keeps its shaders as well.
FULL = [("report", "12k", 1, "the disk may be full"),
        ("cache", "8k", 0, "is not kept for later runs"),
        ("temporary", "16k", 1, "there is no room for temporary files"),
        ("temporary", "32k", 1, "there is no room for temporary files")]


@pytest.mark.skipif(not can_mount(), reason="no disk can be mounted here: unshare -rm is not allowed")
@pytest.mark.parametrize(("place", "size", "code", "words"), FULL)
def test_a_full_disk(binary, scene, engines, tmp_path, place, size, code, words):
    environment = {**environment_of(engines, tmp_path), "TMPDIR": str(tmp_path / "temporary")}
    if place == "cache":
        environment["MESA_SHADER_CACHE_DIR"] = ""
    for name in ("report", "cache", "temporary", "seen"):
        (tmp_path / name).mkdir()
    command = shlex.join([binary, *map(str, arguments_of(engines, scene, "report")), "--peers", "none"])
    # The disk is there for this one shell.
    steps = f"""
        mount -t tmpfs -o size={size} none {place}
        {command} 2> seen/full.txt; echo $? > seen/full
        cp -r report seen/report; cp -r cache seen/cache; cp -r temporary seen/temporary
        mount -o remount,size=100m {place}
        {command} --resume 2> seen/again.txt; echo $? > seen/again
        cp report/results.json seen/"""
    subprocess.run(["unshare", "-rm", "sh", "-c", steps], cwd=tmp_path, env={**os.environ, **environment}, check=True,
                   capture_output=True, timeout=120)
    seen = tmp_path / "seen"
    said = (seen / "full.txt").read_text(encoding="utf-8")
    assert (seen / "full").read_text() == f"{code}\n", said
    assert len(errors(said)) == (1 if code else 0), said
    assert words in "\n".join(errors(said) or said.splitlines()), said
    assert (seen / "report/results.json").exists() == (code == 0)
    whole_files_alone(seen)
    assert not list((seen / "temporary").iterdir())
    again = (seen / "again.txt").read_text(encoding="utf-8")
    assert (seen / "again").read_text() == "0\n", again
    assert "warning" not in again
    assert json.loads((seen / "results.json").read_text(encoding="utf-8"))["curves"]
