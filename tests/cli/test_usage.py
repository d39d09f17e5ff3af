# SPDX-License-Identifier: Apache-2.0
"""What a user may get wrong on the command line: exit code 2 and one line that says so."""
import json

import gltf_scenes
import pytest

SUBCOMMANDS = ["render", "view", "info", "compare", "convert", "evaluate", "bench"]


def refused(result, *words):
    assert result.returncode == 2, (result.returncode, result.stderr)
    assert len(result.stderr.splitlines()) == 1, result.stderr
    assert result.stdout == ""
    for word in words:
        assert word in result.stderr


@pytest.mark.parametrize("subcommand", SUBCOMMANDS)
def test_help_of_each_subcommand(bounce, subcommand):
    result = bounce(subcommand, "--help")
    assert result.returncode == 0
    assert result.stderr == ""
    assert "Usage" in result.stdout
    assert subcommand in result.stdout


def test_help_names_every_subcommand(bounce):
    result = bounce("--help")
    assert result.returncode == 0
    for subcommand in SUBCOMMANDS:
        assert subcommand in result.stdout


def test_version(bounce):
    result = bounce("--version")
    assert result.returncode == 0
    assert result.stdout.startswith("bounce ")


def test_no_subcommand(bounce):
    refused(bounce(), "--help")


def test_unknown_subcommand(bounce):
    refused(bounce("rendr", "scene.glb"))


def test_unknown_option(render, scene):
    refused(render(scene, "-o", "a.png", "--sise", "3x3"), "--sise")


def test_missing_scene_and_missing_output(bounce, scene):
    refused(bounce("render", "-o", "a.png"), "scene")
    refused(bounce("render", scene), "--output")


@pytest.mark.parametrize("size", ["", "640", "640x", "x360", "0x10", "-4x4", "640x360x2", "20000x20", "wide", "99999999999x1"])
def test_bad_size(bounce, scene, size, tmp_path):
    refused(bounce("render", scene, "-o", "a.png", f"--size={size}"), "size")
    assert not (tmp_path / "a.png").exists()


@pytest.mark.parametrize("frames", ["a", "1-", "5-1", "1,,2", "1-4x0", "1-4x", ",", "1 2", "1-2000000000", "99999999999"])
def test_bad_frames(render, scene, frames):
    refused(render(scene, "-o", "a.####.png", f"--frames={frames}"), "frames")


def test_empty_frames_is_not_a_list(render, scene):
    refused(render(scene, "-o", "a.####.png", "--frames="))


def test_several_frames_into_one_file(render, scene, tmp_path):
    refused(render(scene, "-o", "a.png", "--frames", "10-12"), "####", "3 frames")
    assert not (tmp_path / "a.png").exists()


def test_several_frames_and_only_one_of_two_outputs_numbered(render, scene):
    refused(render(scene, "-o", "a.####.png", "-o", "b.png", "--frames", "10,11"), "####")


def test_unknown_camera_and_animation(render, scene, tmp_path):
    refused(render(scene, "-o", "a.png", "--camera", "Nobody"), "Nobody", "scene.glb")
    refused(render(scene, "-o", "a.png", "--animation", "Dance"), "Dance", "scene.glb")
    assert not (tmp_path / "a.png").exists()


@pytest.mark.parametrize(
    "option",
    [
        ("--technique", "radiosity"),
        ("--show", "everything"),
        ("--rsm-samples", "0", "--technique", "rsm"),
        ("--rsm-samples", "many", "--technique", "rsm"),
        ("--rsm-samples", "99999999999999999999", "--technique", "rsm"),
        ("--rsm-lowres", "1", "--technique", "rsm"),
        ("--rsm-size", "0"),
        ("--rsm-size", "some"),
        ("--shadow-size", "100000"),
        ("--light", "-1"),
        ("--repeat", "0"),
        ("--rsm-interpolation", "maybe"),
    ],
    ids=" ".join,
)
def test_bad_values(bounce, scene, option):
    refused(bounce("render", scene, "-o", "a.png", *option), option[0])


@pytest.mark.parametrize(
    "option, words",
    [
        (["--vpls", "0"], ["--vpls is 0", "1 to 16384"]),
        (["--vpls", "100000"], ["--vpls", "16384"]),
        (["--bounces", "5"], ["--bounces is 5", "1 to 4"]),
        (["--bounces", "2", "--bounce-vpls", "0"], ["--bounce-vpls is 0"]),
        (["--ism-size", "100"], ["--ism-size is 100", "power of two from 32 to 256"]),
        (["--ism-size", "512"], ["--ism-size is 512", "256"]),
        (["--points", "0"], ["--points", "auto"]),
        (["--points", "70000"], ["--points", "65536"]),
        (["--interleave", "3"], ["--interleave is 3", "1, 2, 4, 8 or 16"]),
        (["--splat", "points", "--pull-push-levels", "4"], ["--pull-push-levels", "1 to 3"]),
        (["--splat", "points", "--pull-threshold", "2"], ["--pull-threshold", "0 to 1"]),
        (["--vpl", "256", "--show", "ism"], ["--vpl is 256", "255"]),
        (["--vpl", "-1", "--show", "ism"], ["--vpl is -1"]),
        (["--bounce", "2", "--show", "vpls"], ["--bounce is 2"]),
        (["--technique", "rsm", "--vpls", "64"], ["--vpls", "technique rsm"]),
        (["--rsm-samples", "64"], ["--rsm-samples", "technique ism"]),
        (["--visibility", "none", "--points", "64"], ["--points", "--visibility none"]),
        (["--visibility", "shadow-maps", "--splat", "points"], ["--splat", "--visibility shadow-maps"]),
        (["--pull-push", "fill"], ["--pull-push", "--splat compute, points or tessellation"]),
        (["--preset", "ism2008", "--technique", "rsm"], ["--preset ism2008", "--technique"]),
        (["--preset", "rsm2005", "--vpls", "64"], ["--vpls", "technique rsm"]),
        (["--preset", "lv2009", "--points", "64"], ["--points", "--visibility simplified"]),
        (["--preset", "ism2008", "--simplify", "0.5"], ["--simplify", "--visibility simplified"]),
        (["--preset", "ism2008", "--map-projection", "faces"], ["--map-projection", "--visibility ism"]),
        (["--preset", "lv2009", "--simplify", "0"], ["--simplify is 0"]),
        (["--preset", "lv2009", "--simplify", "many"], ["--simplify is 'many'"]),
        (["--preset", "lv2009", "--simplify", "1.5"], ["--simplify is 1.5"]),
        (["--preset", "lv2009", "--ism-size", "2048"], ["--ism-size is 2048", "1024"]),
        (["--show", "ism", "--visibility", "none"], ["--show ism", "visibility none"]),
        (["--show", "ism-splats"], ["--show ism-splats", "disks"]),
        (["--show", "removed"], ["--show removed", "near field"]),
        (["--show", "interpolation"], ["--show interpolation", "rsm"]),
        (["--measure-removed"], ["--measure-removed", "--stats"]),
    ],
    ids=lambda value: " ".join(value),
)
def test_what_cannot_be_drawn_is_refused_before_the_scene_is_read(bounce, tmp_path, option, words):
    refused(bounce("render", "nowhere.glb", "-o", "a.png", *option), *words)
    if option != ["--measure-removed"]:
        refused(bounce("view", "nowhere.glb", *option), *words)
    assert not list(tmp_path.iterdir())


def test_motion_is_of_two_frames_and_not_for_the_window(bounce):
    refused(bounce("view", "nowhere.glb", "--show", "motion"), "--show motion", "bounce render")


def test_an_atlas_beyond_the_driver_names_what_to_lower(render, scene, tmp_path):
    """16,384 maps of 256 texels make an atlas of 32,768 a side, which no driver holds today."""
    result = render(scene, "-o", "a.png", "--vpls", "16384", "--ism-size", "256")
    refused(result, "--vpls", "--ism-size", "lower")
    assert not (tmp_path / "a.png").exists()


def test_several_bounces_among_black_surfaces_are_refused(render, tmp_path):
    document = gltf_scenes.lit_square()
    document["materials"][0]["pbrMetallicRoughness"]["baseColorFactor"] = [0, 0, 0, 1]
    black = gltf_scenes.write_glb(tmp_path / "black.glb", document)
    refused(render(black, "-o", "a.png", "--bounces", "4"), "--bounces is 4", "black.glb", "base colour")
    assert not (tmp_path / "a.png").exists()
    result = render(black, "-o", "a.png", "--frames", "12", "--technique", "ism")
    assert result.returncode == 0, result.stderr
    assert "note: no bounced light: no surface reflects light" in result.stderr


def test_presets_and_what_differs_from_them(render, scene, tmp_path):
    for preset in ("auto", "rsm2005", "ism2008", "lv2009"):
        result = render(scene, "-o", "a.png", "--frames", "12", "--preset", preset)
        assert result.returncode == 0, result.stderr
    result = render(scene, "-o", "a.png", "--frames", "12", "--preset", "ism2008", "--vpls", "32", "--stats", "s.json")
    assert result.returncode == 0, result.stderr
    settings = json.loads((tmp_path / "s.json").read_text())["settings"]
    assert settings["vpls"] == 32, "an option given is stronger than the preset"
    assert (settings["splat"], settings["pull_push"], settings["ism_size"]) == ("points", "paper", 128)
    assert not settings["near_field"]


def test_help_names_the_groups_and_every_option_says_something(bounce):
    text = bounce("render", "--help").stdout
    for group in ("Light transport", "Virtual point lights", "Shadow maps of virtual point lights",
                  "Reflective shadow maps", "What the picture shows"):
        assert group in text
    lines = text.splitlines()
    options = [i for i, line in enumerate(lines) if line.startswith("  -")]
    assert len(options) > 30
    for i in options:
        # Beside a short option, below a long one.
        assert lines[i][30:].strip() or lines[i + 1].startswith(" " * 30), f"no help: {lines[i]}"


def test_an_output_without_a_format(render, scene, tmp_path):
    result = render(scene, "-o", "picture.nosuchformat")
    assert result.returncode in (1, 2)
    assert "picture.nosuchformat" in result.stderr
    assert [path.name for path in tmp_path.iterdir()] == ["scene.glb"]


def test_show_of_a_light_that_is_not_there(render, scene, tmp_path):
    refused(render(scene, "-o", "a.png", "--show", "rsm-flux", "--light", "7"), "--light")
    refused(render(scene, "-o", "a.png", "--show", "rsm-flux", "--technique", "direct"), "technique direct")
    assert not (tmp_path / "a.png").exists()
