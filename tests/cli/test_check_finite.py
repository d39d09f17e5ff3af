# SPDX-License-Identifier: Apache-2.0
"""`bounce render --check-finite`: a shader broken on purpose is named with its pass, pixel, scene, time and seed."""
import shutil

import gltf_scenes
import pytest
from conftest import ROOT

SMALL = ["--size", "32x18", "--rsm-size", "32", "--shadow-size", "64", "--vpls", "16", "--ism-size", "32", "--antialias", "off"]
NAN = "uintBitsToFloat(0x7fc00000u)"
# Where it is put: the shader, what stands there once, what takes its place.
COMPOSITE = ("passes/composite.comp", "vec4(color * exposure, 1.0)",
             f"vec4(pixel == ivec2(20, 5) ? vec3({NAN}) : color * exposure, 1.0)")
LIGHT = ("passes/vpl_draw.comp", "    drawn[index] = vpl;\n", f"    drawn[index] = vpl;\n    if (index == 3) drawn[index].intensity.g = {NAN};\n")


@pytest.fixture
def room(tmp_path):
    return gltf_scenes.write_glb(tmp_path / "room.glb", gltf_scenes.room(), gltf_scenes.room_buffer())


@pytest.fixture
def broken(tmp_path):
    def shaders(name, old, new):
        folder = tmp_path / "shaders"
        shutil.copytree(ROOT / "shaders", folder)
        text = (folder / name).read_text()
        assert text.count(old) == 1, f"{name} has {text.count(old)} places with {old!r}"
        (folder / name).write_text(text.replace(old, new))
        return {"BOUNCE_SHADER_DIR": str(folder)}

    return shaders


def test_a_sound_frame_is_written_the_same(bounce, room, tmp_path):
    assert bounce("render", room, "-o", "plain.exr", *SMALL).returncode == 0
    result = bounce("render", room, "-o", "checked.exr", "--check-finite", *SMALL)
    assert result.returncode == 0, result.stderr
    assert (tmp_path / "plain.exr").read_bytes() == (tmp_path / "checked.exr").read_bytes()


def test_a_pixel_of_the_last_pass(bounce, room, broken, tmp_path):
    """Of the picture's rows, from its top: row 12 is the sixth from the bottom."""
    result = bounce("render", room, "-o", "out.exr", "--frames", "4", "--check-finite", *SMALL, environment=broken(*COMPOSITE))
    assert result.returncode == 1, result.stderr
    error = result.stderr.splitlines()[-1]
    for words in ("pass composite wrote NaN into color at pixel (20, 12)", "3 values", "scene room.glb", "time 0.125 s", "frame 4", "seed 0"):
        assert words in error, error
    assert not (tmp_path / "out.exr").exists()


def test_the_first_of_many_passes_is_named(bounce, room, broken):
    """A light that is no number spoils all that is gathered from it; it is the light that is named."""
    result = bounce("render", room, "-o", "out.exr", "--check-finite", *SMALL, environment=broken(*LIGHT))
    assert result.returncode == 1, result.stderr
    assert "pass vpls wrote NaN into vpls at element 3 first; 1 values" in result.stderr


def test_without_it_a_warning_and_the_picture(bounce, room, broken, tmp_path):
    result = bounce("render", room, "-o", "out.exr", *SMALL, environment=broken(*COMPOSITE))
    assert result.returncode == 0, result.stderr
    assert "1 pixels are not finite" in result.stderr and "--check-finite" in result.stderr
    assert (tmp_path / "out.exr").exists()


def test_settings_chosen_on_trial_are_checked_as_well(bounce, room, broken, tmp_path):
    """The settings that a budget chooses take the place of those that were typed; the check stays."""
    result = bounce("render", room, "-o", "out.exr", "--size", "32x18", "--budget-ms", "1000", "--check-finite", "--antialias", "off",
                    environment=broken(*COMPOSITE))
    assert result.returncode == 1, result.stderr
    assert "pass composite wrote NaN into color at pixel (20, 12)" in result.stderr
    assert not (tmp_path / "out.exr").exists()
