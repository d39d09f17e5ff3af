# SPDX-License-Identifier: Apache-2.0
"""The program under test, and scenes to give it."""
import os
import pathlib
import subprocess

import pytest

import fake_engines
import gltf_scenes

ROOT = pathlib.Path(__file__).resolve().parents[2]
BINARY = os.environ.get("BOUNCE_BINARY", str(ROOT / "build" / "release" / "bounce"))
# Small enough that a frame costs nothing to speak of.
SMALL = ["--size", "16x9", "--rsm-size", "16", "--shadow-size", "32"]
RSM = ["--technique", "rsm", "--rsm-samples", "4"]


@pytest.fixture(scope="session")
def binary():
    if not os.path.exists(BINARY):
        pytest.fail(f"no program at {BINARY}; build it, or set BOUNCE_BINARY")
    return BINARY


@pytest.fixture
def bounce(binary, tmp_path):
    """Runs the program in the test's folder and returns the finished process, its texts decoded."""

    def run(*arguments, environment=None, timeout=120):
        return subprocess.run(
            [binary, *map(str, arguments)],
            cwd=tmp_path,
            env={**os.environ, **(environment or {})},
            capture_output=True,
            text=True,
            timeout=timeout,
            check=False,
        )

    return run


@pytest.fixture
def render(bounce):
    """`bounce render` at a small size."""

    def run(scene, *arguments, **options):
        return bounce("render", scene, *arguments, *SMALL, **options)

    return run


@pytest.fixture
def scene(tmp_path):
    """A lit square as .glb, four frames long from frame 10 at 25 a second."""
    return gltf_scenes.write_glb(tmp_path / "scene.glb", gltf_scenes.lit_square())


@pytest.fixture
def engines(tmp_path, bounce, scene):
    """A folder with the other engines' stand-ins, which render what Bounce does."""
    folder = tmp_path / "engines"
    folder.mkdir()
    fake_engines.install(folder)
    for name in ("engine.exr", "engine.png"):
        done = bounce("render", scene, "-o", folder / name, "--frames", "10", "--technique", "direct", "--size",
                      fake_engines.SIZE)
        assert done.returncode == 0, done.stderr
    return folder
