# SPDX-License-Identifier: Apache-2.0
"""The sheets that hold frames and view transforms against Blender's own, in part: all of scripts/camera_sheet takes minutes."""
import os
import pathlib
import shutil
import subprocess

import pytest

ROOT = pathlib.Path(__file__).resolve().parents[2]
BLENDER = shutil.which(os.environ.get("BLENDER", "blender"))
pytestmark = pytest.mark.skipif(BLENDER is None, reason="Blender is not installed here")
# One of each kind: fit, shift, pixels that are not square, sizes in per cent, clip planes, motion.
CAMERAS = ["perspective-vertical-portrait", "perspective-tall-pixels", "orthographic-shift-portrait", "orthographic-clip",
           "percentage-41", "animated-focal-length"]


def sheet(script, folder, *arguments):
    return subprocess.run([ROOT / "scripts" / script, "-o", folder, *arguments], capture_output=True, text=True, timeout=290,
                          check=False)


def test_edges_lie_where_blender_has_them(binary, tmp_path):
    done = sheet("camera_sheet", tmp_path, "--only", *CAMERAS)
    assert done.returncode == 0, done.stdout + done.stderr
    assert (tmp_path / "sheet.png").stat().st_size > 0


def test_a_displacement_is_found(binary, tmp_path):
    """The same sheet with a limit below what any two renderers agree to."""
    done = sheet("camera_sheet", tmp_path, "--only", CAMERAS[0], "--limit", "0.0001")
    assert done.returncode == 1, done.stdout + done.stderr


def test_views_are_blenders(binary, tmp_path):
    done = sheet("view_sheet", tmp_path)
    assert done.returncode == 0, done.stdout + done.stderr


LIGHTS = ["point-hard", "spot-large-narrow", "area-disk", "negative-power-sun", "zero-size-area"]


def test_lights_are_blenders(binary, tmp_path):
    done = sheet("light_sheet", tmp_path, "--samples", "32", "--only", *LIGHTS)
    assert done.returncode == 0, done.stdout + done.stderr
    assert (tmp_path / "sheet.png").stat().st_size > 0


def test_a_wrong_light_is_found(binary, tmp_path):
    """Direct light's layer of bounced light alone is black."""
    done = sheet("light_sheet", tmp_path, "--samples", "4", "--only", LIGHTS[0], "--", "--technique", "ism", "--show", "indirect")
    assert done.returncode == 1, done.stdout + done.stderr
