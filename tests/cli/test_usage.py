# SPDX-License-Identifier: Apache-2.0
"""What a user may get wrong on the command line: exit code 2 and one line that says so."""
import pytest

SUBCOMMANDS = ["render", "view", "info", "compare", "evaluate", "bench"]


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
        ("--rsm-samples", "0"),
        ("--rsm-samples", "many"),
        ("--rsm-samples", "99999999999999999999"),
        ("--rsm-lowres", "1"),
        ("--shadow-size", "100000"),
        ("--light", "-1"),
        ("--repeat", "0"),
        ("--rsm-interpolation", "maybe"),
    ],
    ids=" ".join,
)
def test_bad_values(bounce, scene, option):
    refused(bounce("render", scene, "-o", "a.png", *option), option[0])


def test_an_output_without_a_format(render, scene, tmp_path):
    result = render(scene, "-o", "picture.nosuchformat")
    assert result.returncode in (1, 2)
    assert "picture.nosuchformat" in result.stderr
    assert [path.name for path in tmp_path.iterdir()] == ["scene.glb"]


def test_show_of_a_light_that_is_not_there(render, scene, tmp_path):
    refused(render(scene, "-o", "a.png", "--show", "rsm-flux", "--light", "7"), "--light")
    refused(render(scene, "-o", "a.png", "--show", "rsm-flux", "--technique", "direct"), "--technique")
    assert not (tmp_path / "a.png").exists()
