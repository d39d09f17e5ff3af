# SPDX-License-Identifier: Apache-2.0
"""Finding Blender, the Draco library and the scenes; exports that several tests share."""

import json
import os
import shutil
import subprocess
import sys
from pathlib import Path

import pytest

ROOT = Path(__file__).resolve().parent.parent.parent
ADDON = ROOT / "blender_addon"
SCRIPTS = Path(__file__).resolve().parent / "blender"
sys.path.insert(0, str(ADDON))
sys.path.insert(0, str(Path(__file__).resolve().parent))

from gltf_eval import Gltf  # noqa: E402

BLENDER_TIMEOUT_S = 180


def _built_draco():
    """The library named by the environment (as CTest sets it), or a build of the checkout."""
    named = os.environ.get("BOUNCE_EXTERN_DRACO")
    if named:
        assert Path(named).is_file(), f"BOUNCE_EXTERN_DRACO names {named}, which does not exist"
        return Path(named)
    found = [*ROOT.glob("build/libextern_draco.so"), *ROOT.glob("build/*/libextern_draco.so")]
    return max(found, key=lambda path: path.stat().st_mtime) if found else None


@pytest.fixture(scope="session")
def draco_library():
    path = _built_draco()
    if path is None:
        pytest.skip("libextern_draco.so is not built")
    return path


@pytest.fixture(scope="session")
def blender():
    path = shutil.which("blender")
    if path is None:
        pytest.skip("Blender is not installed")

    def run(*arguments, check=True, draco=None, environment=()):
        environment = {**os.environ, **dict(environment)}
        environment.pop("BLENDER_EXTERN_DRACO_LIBRARY_PATH", None)
        if draco is not None:
            environment["BLENDER_EXTERN_DRACO_LIBRARY_PATH"] = str(draco)
        done = subprocess.run([path, "-b", "--factory-startup", *map(str, arguments)], capture_output=True, text=True,
                              env=environment, timeout=BLENDER_TIMEOUT_S)
        if check:
            assert done.returncode == 0, f"Blender exited with {done.returncode}:\n{done.stdout}\n{done.stderr}"
        return done

    return run


@pytest.fixture(scope="session")
def bounce():
    """Runs the program; fails with what it says."""
    path = os.environ.get("BOUNCE_BINARY", str(ROOT / "build" / "release" / "bounce"))
    assert Path(path).is_file(), f"no program at {path}; build it, or set BOUNCE_BINARY"

    def run(*arguments):
        done = subprocess.run([path, *map(str, arguments)], capture_output=True, text=True, timeout=120, check=False)
        assert done.returncode == 0, done.stderr
        return done

    return run


@pytest.fixture(scope="session")
def export(blender):
    """Exports a .blend by the command line and returns the finished process."""

    def run(blend, output, *options, check=True, draco=None, addon=ADDON):
        return blender(blend, "-P", addon / "export_cli.py", "--", output, *options, check=check, draco=draco)

    return run


class Built:
    """A scene that a script in blender/ built, exported without compression, and what Blender says of it."""

    def __init__(self, folder, output):
        self.blend, self.path = folder / "scene.blend", folder / "scene.glb"
        self.output = output
        self.gltf = Gltf(self.path)
        self.truth = json.loads((folder / "truth.json").read_text())

    def unsupported(self):
        return {(entry["object"], entry["what"]) for entry in self.gltf.bounce["unsupported"]}


@pytest.fixture(scope="session")
def built(blender, export, tmp_path_factory):
    cache = {}

    def get(name):
        if name not in cache:
            folder = tmp_path_factory.mktemp(name)
            blender("--python-exit-code", "3", "-P", SCRIPTS / f"{name}.py", "--", folder)
            done = export(folder / "scene.blend", folder / "scene.glb", "--no-draco")
            cache[name] = Built(folder, done.stdout)
        return cache[name]

    return get


@pytest.fixture(scope="session")
def scenes_folder():
    named = os.environ.get("BOUNCE_SCENES_DIR")
    folder = Path(named) if named else ROOT.parent / "shared" / "scenes"
    if not (folder / "blend").is_dir():
        pytest.skip(f"no scenes in {folder} (BOUNCE_SCENES_DIR names another folder)")
    return folder
