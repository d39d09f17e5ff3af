# SPDX-License-Identifier: Apache-2.0
"""What render writes: names, frames, formats, atomically or not at all."""
import json
import re
import signal
import subprocess
import time

import gltf_scenes
import pytest
from conftest import RSM, SMALL


def names(folder):
    return sorted(path.name for path in folder.iterdir())


def test_one_frame_without_a_number_is_the_first(render, scene, tmp_path):
    assert render(scene, "-o", "a.png").returncode == 0
    assert names(tmp_path) == ["a.png", "scene.glb"]


def test_hashes_are_the_padded_frame_number(render, scene, tmp_path):
    assert render(scene, "-o", "out/f.####.png").returncode == 0
    assert names(tmp_path / "out") == ["f.0010.png", "f.0011.png", "f.0012.png", "f.0013.png"]


def test_frames_that_were_asked_for(render, scene, tmp_path):
    assert render(scene, "-o", "out/f##.png", "--frames", "1-5x2,120").returncode == 0
    assert names(tmp_path / "out") == ["f01.png", "f03.png", "f05.png", "f120.png"]


def test_several_outputs_of_one_rendering(render, scene, tmp_path):
    assert render(scene, "-o", "a.####.exr", "-o", "deep/er/b.####.png", "--frames", "10,11").returncode == 0
    assert {"a.0010.exr", "a.0011.exr"} <= set(names(tmp_path))
    assert names(tmp_path / "deep" / "er") == ["b.0010.png", "b.0011.png"]


def test_formats_are_what_they_say(render, scene, tmp_path):
    assert render(scene, "-o", "a.exr", "-o", "a.png").returncode == 0
    assert (tmp_path / "a.exr").read_bytes()[:4] == b"\x76\x2f\x31\x01"
    assert (tmp_path / "a.png").read_bytes()[:8] == b"\x89PNG\r\n\x1a\n"


def test_names_with_spaces_and_other_letters(render, tmp_path):
    scene = gltf_scenes.write_glb(tmp_path / "Würfel und Räume" / "日本 室.glb", gltf_scenes.lit_square())
    result = render(scene, "-o", "Bilder für Ö/Bild ##.png", "--frames", "11")
    assert result.returncode == 0, result.stderr
    assert names(tmp_path / "Bilder für Ö") == ["Bild 11.png"]


def test_an_embedded_gltf_gives_the_same_picture(bounce, render, scene, tmp_path):
    text = gltf_scenes.write_gltf(tmp_path / "text.gltf", gltf_scenes.lit_square())
    assert render(scene, "-o", "a.exr", "--frames", "12").returncode == 0
    assert render(text, "-o", "b.exr", "--frames", "12").returncode == 0
    assert bounce("compare", "a.exr", "b.exr", "--json", "out.json").returncode == 0
    assert json.loads((tmp_path / "out.json").read_text())["max_abs"] == 0


def test_what_stood_there_before_is_replaced(render, scene, tmp_path):
    (tmp_path / "a.png").write_text("old")
    assert render(scene, "-o", "a.png").returncode == 0
    assert (tmp_path / "a.png").read_bytes()[:4] == b"\x89PNG"


LAYERS = {
    **dict.fromkeys(["shaded", "direct", "indirect", "rsm-depth", "rsm-position", "rsm-normal", "rsm-flux"], []),
    **dict.fromkeys(["vpls", "ism", "vpl-visibility", "unblurred"], []),
    "interpolation": RSM,
    "ism-splats": ["--splat", "compute"],
    "removed": ["--near-field", "off"],
    "motion": [],
}


@pytest.mark.parametrize("option", ["--show", "--layer"])
@pytest.mark.parametrize("show", LAYERS)
def test_every_layer_can_be_shown(render, scene, tmp_path, show, option):
    result = render(scene, "-o", "a.png", "-o", "a.exr", "--frames", "12", option, show, *LAYERS[show])
    assert result.returncode == 0, result.stderr
    assert names(tmp_path) == ["a.exr", "a.png", "scene.glb"]


def test_another_camera(render, scene, tmp_path):
    assert render(scene, "-o", "front.png", "--frames", "12").returncode == 0
    assert render(scene, "-o", "side.png", "--frames", "12", "--camera", "Side").returncode == 0
    assert (tmp_path / "front.png").read_bytes() != (tmp_path / "side.png").read_bytes()


def test_the_same_command_gives_the_same_bytes(render, scene, tmp_path):
    for name in ("a.png", "b.png"):
        assert render(scene, "-o", name, "--frames", "12").returncode == 0
    assert (tmp_path / "a.png").read_bytes() == (tmp_path / "b.png").read_bytes()


def failed_without_a_trace(result, tmp_path, word):
    assert result.returncode == 1, (result.returncode, result.stderr)
    assert len(result.stderr.splitlines()) == 1, result.stderr
    assert word in result.stderr
    assert not [path for path in tmp_path.rglob("*") if ".part" in path.name]


def test_a_file_where_the_folder_should_be(render, scene, tmp_path):
    (tmp_path / "out").write_text("in the way")
    failed_without_a_trace(render(scene, "-o", "out/a.png"), tmp_path, "out")
    assert (tmp_path / "out").read_text() == "in the way"


def test_a_folder_where_the_file_should_be(render, scene, tmp_path):
    (tmp_path / "a.png").mkdir()
    failed_without_a_trace(render(scene, "-o", "a.png"), tmp_path, "a.png")


def test_a_folder_that_nobody_can_write_to(render, scene, tmp_path):
    failed_without_a_trace(render(scene, "-o", "/proc/a.png"), tmp_path, "/proc")
    failed_without_a_trace(render(scene, "-o", "/proc/no/such/a.png"), tmp_path, "/proc")


def test_statistics_that_cannot_be_written_stop_the_work_before_it_starts(render, scene, tmp_path):
    failed_without_a_trace(render(scene, "-o", "a.png", "--stats", "/proc/stats.json"), tmp_path, "/proc")
    assert names(tmp_path) == ["scene.glb"]


def test_outside_a_terminal_progress_is_a_line_a_frame(render, scene):
    result = render(scene, "-o", "a.##.png", "--frames", "11-13")
    lines = [line for line in result.stderr.splitlines() if not line.startswith("note: ")]
    assert [line.split(":")[0] for line in lines] == ["render 1/3", "render 2/3", "render 3/3"]
    assert [re.search(r"frame (\d+)", line)[1] for line in lines] == ["11", "12", "13"]
    assert result.stdout == ""


@pytest.mark.parametrize("which, code", [(signal.SIGINT, 130), (signal.SIGTERM, 143)])
def test_an_interrupt_leaves_whole_files_and_no_temporaries(binary, scene, tmp_path, which, code):
    command = [binary, "render", str(scene), "-o", "out/f.####.exr", "--frames", "11-100010", *SMALL]
    with subprocess.Popen(command, cwd=tmp_path, stderr=subprocess.PIPE, text=True) as process:
        lines = [process.stderr.readline() for _ in range(3)]  # frames are on their way
        assert all(line.startswith(("render ", "note: ")) for line in lines)
        process.send_signal(which)
        rest = process.stderr.read()
        assert process.wait(timeout=60) == code
    message = rest.splitlines()[-1]
    written = int(re.search(r"interrupted; (\d+) of 100000 frames", message)[1])
    files = names(tmp_path / "out")
    assert files == [f"f.{frame:04}.exr" for frame in range(11, written + 11)], "all whole, nothing else"
    for name in files:
        assert (tmp_path / "out" / name).stat().st_size > 100


def test_a_second_interrupt_ends_it_at_once(binary, scene, tmp_path):
    # One frame that takes minutes: every texel of a large map for every pixel.
    command = [binary, "render", str(scene), "-o", "a.exr", "--frames", "12", "--size", "4096x4096",
               "--technique", "rsm", "--rsm-samples", "all", "--rsm-size", "2048"]
    with subprocess.Popen(command, cwd=tmp_path, stderr=subprocess.PIPE, text=True) as process:
        time.sleep(3)
        process.send_signal(signal.SIGINT)
        time.sleep(1)
        process.send_signal(signal.SIGINT)
        assert process.wait(timeout=20) == -signal.SIGINT
    assert names(tmp_path) == ["scene.glb"]


def test_what_the_exporter_could_not_say_is_warned_of(render, tmp_path):
    document = gltf_scenes.lit_square()
    document["extensions"]["BOUNCE_scene"]["unsupported"] = [{"object": f"Thing {i}", "what": "glass"} for i in range(6)]
    result = render(gltf_scenes.write_glb(tmp_path / "lost.glb", document), "-o", "a.exr", "--frames", "12")
    assert result.returncode == 0
    warnings = [line for line in result.stderr.splitlines() if "warning" in line]
    assert len(warnings) == 1 and "Thing 0: glass" in warnings[0] and "and 2 more, which bounce info lists" in warnings[0], result.stderr
