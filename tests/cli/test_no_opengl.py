# SPDX-License-Identifier: Apache-2.0
"""A machine without a usable OpenGL: exit code 4 and a sentence that says what to do."""
import json
import pathlib

import pytest


def refused(result, tmp_path):
    assert result.returncode == 4, (result.returncode, result.stderr)
    lines = [line for line in result.stderr.splitlines() if line.startswith("error: ")]
    assert len(lines) == 1
    assert "OpenGL 4.5" in lines[0]
    assert [path.name for path in tmp_path.iterdir()] == ["scene.glb"]


def test_no_driver_at_all(render, scene, tmp_path):
    # EGL's loader finds no vendor.
    refused(render(scene, "-o", "a.png", environment={"__EGL_VENDOR_LIBRARY_FILENAMES": "/nonexistent"}), tmp_path)


def test_a_driver_that_is_too_old(render, scene, tmp_path):
    result = render(scene, "-o", "a.png", environment={"MESA_GL_VERSION_OVERRIDE": "3.3", "LIBGL_ALWAYS_SOFTWARE": "1"})
    if result.returncode == 0:
        pytest.skip("this driver does not let itself be made older")
    refused(result, tmp_path)


def test_info_needs_none(bounce, scene):
    result = bounce("info", scene, "--json", environment={"__EGL_VENDOR_LIBRARY_FILENAMES": "/nonexistent"})
    assert result.returncode == 0
    assert json.loads(result.stdout)["counts"]["triangles"] == 2


def test_a_faulty_scene_is_told_before_a_missing_driver(render, tmp_path):
    (tmp_path / "scene.glb").write_bytes(b"")
    result = render(pathlib.Path("scene.glb"), "-o", "a.png", environment={"__EGL_VENDOR_LIBRARY_FILENAMES": "/nonexistent"})
    assert result.returncode == 3
