# SPDX-License-Identifier: Apache-2.0
"""Evaluates an export and compares every vertex with Blender's own evaluation at the same frame."""

import numpy as np
import pytest

OBJECTS = ["Keyed", "Axis angle", "Child", "Grandchild", "Constrained", "Tracker", "Driven", "Strips", "Skinned",
           "On bone", "Morphed", "Curve", "Under curve", "Text", "Meta", "Member", "Follower", "Blinking",
           "Child of blinking", "Hidden in viewport", "Eye closed", "Still", "Sheared", "Child of hidden", "On vertices", "Loose skin", "Linked", "Linked curve"]
FRAMES = [5, 9, 15, 22, 28]
# Single precision over a chain of a few matrices of a scene ten metres across.
TOLERANCE_M = 2e-5


@pytest.fixture(scope="module")
def motion(built):
    return built("motion")


@pytest.fixture(scope="module")
def moments(motion):
    return {frame: motion.gltf.at(frame) for frame in FRAMES}


def cloud(motion, moment, name):
    nodes = [i for i, n in enumerate(motion.gltf.json["nodes"]) if n.get("name") == name and "mesh" in n]
    assert nodes, f"no node with a mesh is named {name}"
    return np.concatenate([moment.vertices(node) for node in nodes])


def farthest(points, others):
    """The largest distance from one of `points` to its nearest of `others`."""
    return max(np.sqrt(((others - point) ** 2).sum(axis=1).min()) for point in points)


@pytest.mark.parametrize("name", OBJECTS)
@pytest.mark.parametrize("frame", FRAMES)
def test_vertices_are_where_blender_has_them(motion, moments, name, frame):
    wanted = np.array(motion.truth[str(frame)][name])
    found = cloud(motion, moments[frame], name)
    assert farthest(wanted, found) < TOLERANCE_M
    assert farthest(found, wanted) < TOLERANCE_M


def test_what_should_move_does(motion):
    """Guards the comparison above against a scene that stands still."""
    for name in set(OBJECTS) - {"Text", "Meta", "Blinking", "Child of blinking", "Hidden in viewport", "Eye closed",
                                "Still", "Linked", "Linked curve"}:
        first, last = (np.array(motion.truth[str(frame)][name]) for frame in (5, 28))
        assert np.abs(first - last).max() > 0.05, name


def test_what_the_render_hides_is_left_out(motion):
    names = {node.get("name") for node in motion.gltf.json["nodes"]}
    assert not names & {"Hidden in render", "In excluded collection"}


def test_nothing_is_written_twice(motion):
    instanced = {"Member", "Follower", "On vertices"}
    names = [node["name"] for node in motion.gltf.json["nodes"]]
    assert {name for name in names if names.count(name) > 1} == instanced


def test_only_what_moves_has_channels(motion):
    gltf = motion.gltf
    moving = {key[0] for key in gltf.channels() if isinstance(key, tuple)}
    assert gltf.node("Still") not in moving and gltf.node("Text") not in moving
    paths = {key[1] for key in gltf.channels() if isinstance(key, tuple) and key[0] == gltf.node("Child")}
    assert paths == {"translation"}


def test_one_animation_from_time_zero(motion):
    animations = motion.gltf.json["animations"]
    assert len(animations) == 1
    for times, values, _ in motion.gltf.channels().values():
        assert times[0] == 0.0 and times[-1] == pytest.approx(23 / 24, abs=1e-6) and len(times) == 24
        assert np.isfinite(values).all()


def test_quaternions_do_not_flip(motion):
    for key, (_, values, _) in motion.gltf.channels().items():
        if isinstance(key, tuple) and key[1] == "rotation":
            assert (np.sum(values[1:] * values[:-1], axis=1) > 0).all(), motion.gltf.json["nodes"][key[0]]["name"]


def test_visibility_steps(motion):
    node = motion.gltf.node("Blinking")
    pointer = f"/nodes/{node}/extensions/KHR_node_visibility/visible"
    assert motion.gltf.channels()[pointer][2] == "STEP"
    shown = [motion.gltf.at(frame).pointer(pointer) for frame in (5, 11, 12, 19, 20, 28)]
    assert shown == [0, 0, 1, 1, 0, 0]
    assert "children" not in motion.gltf.json["nodes"][node], "its child would vanish with it"
    assert "KHR_node_visibility" in motion.gltf.json["extensionsUsed"]


def test_lost_deformation_and_lost_shear_are_named(motion):
    named = {name for name, what in motion.unsupported()}
    assert named == {"Waving", "Shear copied"}
    assert "not represented: Waving: deforms over time" in motion.output


def test_shape_keys_survive_modifiers(motion):
    gltf = motion.gltf
    mesh = gltf.json["meshes"][gltf.json["nodes"][gltf.node("Morphed")]["mesh"]]
    assert [len(p["targets"]) for p in mesh["primitives"]] == [2]
    assert gltf.at(16).weights(gltf.node("Morphed")) == pytest.approx([1.0, 0.35], abs=1e-6)
