# SPDX-License-Identifier: Apache-2.0
"""What a machine may fail at in the middle of a run: one sentence, the right exit code, and frames written before stay.
$BOUNCE_LOSE_CONTEXT and $BOUNCE_GPU_MEMORY have the driver's failures happen where no driver here lets itself be made to."""
import shutil

import gltf_scenes
import pytest
from conftest import ROOT

SMALL = ["--size", "32x18", "--rsm-size", "32", "--shadow-size", "64", "--vpls", "16", "--ism-size", "32", "--antialias", "off"]


@pytest.fixture
def room(tmp_path):
    return gltf_scenes.write_glb(tmp_path / "room.glb", gltf_scenes.room(), gltf_scenes.room_buffer())


def failed(result, *words, code=1):
    assert result.returncode == code, (result.returncode, result.stderr)
    errors = [line for line in result.stderr.splitlines() if line.startswith("error: ")]
    assert len(errors) == 1, result.stderr
    assert "defect of bounce" not in errors[0]
    for word in words:
        assert word in errors[0], errors[0]


def test_a_lost_context_keeps_the_frames_before(bounce, room, tmp_path):
    whole = bounce("render", room, "-o", "whole.####.exr", "--frames", "1-3", *SMALL)
    assert whole.returncode == 0, whole.stderr
    result = bounce("render", room, "-o", "out.####.exr", "--frames", "1-4", *SMALL, environment={"BOUNCE_LOSE_CONTEXT": "3"})
    failed(result, "reset the GPU", "frames written before are whole")
    assert sorted(path.name for path in tmp_path.glob("out.*")) == ["out.0001.exr", "out.0002.exr"]
    for frame in (1, 2):
        assert (tmp_path / f"out.000{frame}.exr").read_bytes() == (tmp_path / f"whole.000{frame}.exr").read_bytes()


def test_memory_that_runs_out_names_what_it_was_for(bounce, room, tmp_path):
    result = bounce("render", room, "-o", "out.exr", "--shadow-size", "4096", *SMALL[:4], *SMALL[6:],
                    environment={"BOUNCE_GPU_MEMORY": "30000000"})
    failed(result, "the GPU has no memory left for", "MiB", "lower --size")
    assert not (tmp_path / "out.exr").exists()


def test_memory_for_the_scene_itself(bounce, room, tmp_path):
    failed(bounce("render", room, "-o", "out.exr", *SMALL, environment={"BOUNCE_GPU_MEMORY": "100"}), "no memory left for the buffer")
    assert not (tmp_path / "out.exr").exists()


def test_a_shader_that_does_not_compile(bounce, room, tmp_path):
    shutil.copytree(ROOT / "shaders", tmp_path / "shaders")
    with open(tmp_path / "shaders" / "passes" / "composite.comp", "a") as shader:
        shader.write("\nthis is no GLSL\n")
    result = bounce("render", room, "-o", "out.exr", *SMALL, environment={"BOUNCE_SHADER_DIR": str(tmp_path / "shaders")})
    failed(result, "composite.comp does not compile")
    assert not (tmp_path / "out.exr").exists()


@pytest.mark.parametrize("options, words", [
    (("--vpls", "16384", "--ism-size", "256"), ("atlas", "lower --vpls")),
    (("--size", "100000x4"), ("too large",)),
], ids=["atlas", "picture"])
def test_more_than_the_driver_holds(bounce, room, tmp_path, options, words):
    failed(bounce("render", room, "-o", "out.exr", *options), *words, code=2)
    assert not (tmp_path / "out.exr").exists()
