# SPDX-License-Identifier: Apache-2.0
"""Other people's .blend files, of Blender 2.65 to 3.4: each exports without an exception, to a valid file."""

import os
from pathlib import Path

import bounce_schema
import numpy as np
import pytest
from conftest import ROOT
from gltf_eval import Gltf


def _scenes():
    named = os.environ.get("BOUNCE_SCENES_DIR")
    folder = (Path(named) if named else ROOT.parent / "shared/scenes") / "blend"
    return sorted(folder.rglob("*.blend")) if folder.is_dir() else []


@pytest.fixture(scope="module", params=_scenes() or [None], ids=lambda path: path.stem if path else "none")
def exported(request, export, scenes_folder, tmp_path_factory):
    path = tmp_path_factory.mktemp("scene") / "out.glb"
    done = export(request.param, path, "--no-draco")
    return Gltf(path), done.stdout


def test_scene_exports(exported):
    gltf, log = exported
    bounce_schema.validate(gltf.json)
    assert gltf.json["nodes"], "an empty file"
    for entry in gltf.bounce["unsupported"]:
        assert f"not represented: {entry['object']}: {entry['what']}" in log
    for light in gltf.bounce["lights"]:
        assert light["name"]


def test_scene_evaluates(exported):
    """First, middle and last frame have finite vertices everywhere."""
    gltf, _ = exported
    frames = gltf.bounce["frames"]
    for frame in {frames["start"], (frames["start"] + frames["end"]) // 2, frames["end"]}:
        moment = gltf.at(frame)
        for i, node in enumerate(gltf.json["nodes"]):
            assert np.isfinite(moment.world(i)).all()
            if "mesh" in node:
                assert np.isfinite(moment.vertices(i)).all()
