# SPDX-License-Identifier: Apache-2.0
"""A renderer broken on purpose is caught by the metric meant for the defect, and the sound one is not. The defects and
their limits are those of scripts/broken_renderer, which prints the same for any scene."""
import importlib.machinery
import importlib.util
import math

import gltf_scenes
import pytest
from conftest import BINARY, ROOT

# Small: a frame costs little beside starting the program.
SIZE = "64x48"
FAST = ["--rsm-size", "64", "--shadow-size", "512", "--ism-size", "32"]


@pytest.fixture(scope="module")
def rows(tmp_path_factory):
    loader = importlib.machinery.SourceFileLoader("broken_renderer", str(ROOT / "scripts" / "broken_renderer"))
    script = importlib.util.module_from_spec(importlib.util.spec_from_loader(loader.name, loader))
    loader.exec_module(script)
    script.BOUNCE = BINARY
    folder = tmp_path_factory.mktemp("broken")
    scene = gltf_scenes.write_glb(folder / "room.glb", gltf_scenes.room(), gltf_scenes.room_buffer())
    return {(row["defect"], row["metric"]): row for row in script.measure(folder, scene, SIZE, "1-8", FAST)}


LIMITED = [
    ("light doubled", "bias"),
    ("one VPL of 256 lost", "nrmse between two runs"),
    ("one value not a number", "nan"),
    ("picture shifted by a pixel", "flip_ldr between two runs"),
    ("picture shifted by a pixel", "1 - ssim between two runs"),
    ("VPLs of every second frame, scene still", "flip_step_mean"),
    ("VPLs of every second frame, scene still", "flicker_power"),
]


@pytest.mark.parametrize("defect, metric", LIMITED)
def test_the_defect_is_caught_and_the_sound_renderer_is_not(rows, defect, metric):
    row = rows[defect, metric]
    assert row["broken"] > row["limit"], row
    assert 3 * row["sound"] <= row["limit"], row


def test_every_defect_is_here(rows):
    assert {key for key, row in rows.items() if not math.isnan(row["limit"])} == set(LIMITED)


def test_a_flicker_is_found_while_something_moves(rows):
    """The plate moves, the light does not: what the sound renderer flickers by is a third at most of what it does with
    other lights in every second frame."""
    row = rows["VPLs of every second frame, scene moving", "flicker_power"]
    assert 0 < 3 * row["sound"] < row["broken"], row
    row = rows["VPLs of every second frame, scene moving", "tid_relative"]
    assert row["sound"] < row["broken"], row


def test_a_lost_light_and_a_shift_do_not_show_in_the_bias(rows):
    for key in (("one VPL of 256 lost", "nrmse between two runs"), ("picture shifted by a pixel", "flip_ldr between two runs")):
        assert abs(rows[key]["bias"]) < 0.01, rows[key]


def test_a_value_that_is_no_number_ends_with_the_exit_code_of_a_limit(rows):
    assert rows["one value not a number", "nan"]["exit_codes"] == [0, 5]
