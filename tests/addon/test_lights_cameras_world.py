# SPDX-License-Identifier: Apache-2.0
"""Lights, cameras, world and view of an export against Blender's own values, frame by frame."""

import math

import numpy as np
import pytest

FRAMES = [3, 6, 9, 12, 15]
VALUES = {
    "Point": {"power_w": "energy", "radius_m": "shadow_soft_size", "color": "color"},
    "Spot": {"power_w": "energy", "radius_m": "shadow_soft_size", "cone_angle_rad": "spot_size", "blend": "spot_blend",
             "color": "color"},
    "Sun": {"irradiance_w_m2": "energy", "angle_rad": "angle", "color": "color"},
    "Area": {"power_w": "energy", "size_x_m": "size", "size_y_m": "size_y", "spread_rad": "spread", "color": "color"},
    "Disk": {"power_w": "energy", "size_x_m": "size", "size_y_m": "size", "spread_rad": "spread", "color": "color"},
    "Still": {"power_w": "energy", "radius_m": "shadow_soft_size", "color": "color"},
}


@pytest.fixture(scope="module")
def scene(built):
    return built("lights")


def light_of(scene, node_name):
    return scene.gltf.json["nodes"][scene.gltf.node(node_name)]["extensions"]["BOUNCE_scene"]["light"]


@pytest.mark.parametrize("name", VALUES)
@pytest.mark.parametrize("frame", FRAMES)
def test_light_values(scene, name, frame):
    moment, wanted = scene.gltf.at(frame), scene.truth[str(frame)]["lights"][name]
    index = light_of(scene, name)
    for ours, blenders in VALUES[name].items():
        value = moment.pointer(f"/extensions/BOUNCE_scene/lights/{index}/{ours}")
        assert np.asarray(value) == pytest.approx(np.asarray(wanted[blenders]), rel=1e-5, abs=1e-6), ours


@pytest.mark.parametrize("name", [*VALUES, "Still again"])
@pytest.mark.parametrize("frame", FRAMES)
def test_light_matrices_look_along_minus_z(scene, name, frame):
    found = scene.gltf.at(frame).world(scene.gltf.node(name))
    assert found == pytest.approx(np.array(scene.truth[str(frame)]["lights"][name]["matrix"]), abs=1e-5)


@pytest.mark.parametrize("frame", FRAMES)
def test_punctual_lights_follow(scene, frame):
    moment, truth = scene.gltf.at(frame), scene.truth[str(frame)]["lights"]
    nodes = scene.gltf.json["nodes"]
    for name, scale in (("Point", 683 / (4 * math.pi)), ("Spot", 683 / (4 * math.pi)), ("Sun", 683)):
        light = nodes[scene.gltf.node(name)]["extensions"]["KHR_lights_punctual"]["light"]
        pointer = f"/extensions/KHR_lights_punctual/lights/{light}/intensity"
        assert moment.pointer(pointer) == pytest.approx(truth[name]["energy"] * scale, rel=1e-5)
    spot = nodes[scene.gltf.node("Spot")]["extensions"]["KHR_lights_punctual"]["light"]
    outer = moment.pointer(f"/extensions/KHR_lights_punctual/lights/{spot}/spot/outerConeAngle")
    inner = moment.pointer(f"/extensions/KHR_lights_punctual/lights/{spot}/spot/innerConeAngle")
    assert outer == pytest.approx(truth["Spot"]["spot_size"] / 2, rel=1e-5) and inner < outer
    assert "KHR_lights_punctual" not in scene.gltf.json.get("extensionsRequired", [])


def test_area_lights_are_not_punctual_and_portals_are_not_lights(scene):
    nodes = scene.gltf.json["nodes"]
    assert "KHR_lights_punctual" not in nodes[scene.gltf.node("Area")]["extensions"]
    assert "Portal" not in {node.get("name") for node in nodes}


def test_shared_light_is_written_once(scene):
    assert light_of(scene, "Still") == light_of(scene, "Still again")
    assert len(scene.gltf.bounce["lights"]) == 13


def test_light_flags(scene):
    still = scene.gltf.bounce["lights"][light_of(scene, "Still")]
    assert still["cast_shadow"] is False and still["max_bounces"] == 3
    point = scene.gltf.bounce["lights"][light_of(scene, "Point")]
    assert point["cast_shadow"] is True and "max_bounces" not in point
    assert [scene.gltf.bounce["lights"][light_of(scene, n)]["shape"] for n in ("Area", "Disk")] == ["rectangle", "disk"]


def test_light_nodes_multiply_the_panel(scene):
    light = scene.gltf.bounce["lights"][light_of(scene, "Nodes")]
    assert light["power_w"] == pytest.approx(30.0)
    assert light["color"] == pytest.approx([0.25, 0.25, 1.0])


def test_constant_values_have_no_channel_and_held_ones_step(scene):
    channels = scene.gltf.channels()
    point, spot = light_of(scene, "Point"), light_of(scene, "Spot")
    assert f"/extensions/BOUNCE_scene/lights/{point}/radius_m" not in channels
    assert f"/extensions/BOUNCE_scene/lights/{light_of(scene, 'Still')}/power_w" not in channels
    assert channels[f"/extensions/BOUNCE_scene/lights/{spot}/power_w"][2] == "STEP"
    assert channels[f"/extensions/BOUNCE_scene/lights/{point}/power_w"][2] == "LINEAR"


@pytest.mark.parametrize("frame", FRAMES)
def test_cameras(scene, frame):
    moment, truth = scene.gltf.at(frame), scene.truth[str(frame)]["cameras"]
    for name, varying in (("Main camera", {"focal_length_mm": "lens", "shift_y": "shift_y"}),
                          ("Ortho", {"ortho_scale": "ortho_scale"})):
        node = scene.gltf.node(name)
        camera = scene.gltf.json["nodes"][node]["camera"]
        assert moment.world(node) == pytest.approx(np.array(truth[name]["matrix"]), abs=1e-5)
        for ours, blenders in varying.items():
            value = moment.pointer(f"/cameras/{camera}/extensions/BOUNCE_scene/{ours}")
            assert value == pytest.approx(truth[name][blenders], rel=1e-5, abs=1e-6)


@pytest.mark.parametrize("frame", FRAMES)
def test_yfov_is_what_blenders_frame_spans(scene, frame):
    """The corners of Blender's view frame, whose height over its distance is the field of view."""
    camera = scene.gltf.json["nodes"][scene.gltf.node("Main camera")]["camera"]
    corners = np.array(scene.truth[str(frame)]["cameras"]["Main camera"]["frame"])
    half_height = (corners[:, 1].max() - corners[:, 1].min()) / 2
    # Blender gives the frame in the pixels' own shape; the yfov is that of the picture as displayed.
    wanted = 2 * math.atan(half_height / abs(corners[0, 2]))
    assert scene.gltf.at(frame).pointer(f"/cameras/{camera}/perspective/yfov") == pytest.approx(wanted, rel=1e-5)


def test_active_camera(scene):
    assert scene.gltf.bounce["camera"] == scene.gltf.node("Main camera")


@pytest.mark.parametrize("frame", FRAMES)
def test_world_and_view(scene, frame):
    moment, truth = scene.gltf.at(frame), scene.truth[str(frame)]
    assert moment.pointer("/extensions/BOUNCE_scene/world/strength") == pytest.approx(truth["world_strength"], rel=1e-6)
    assert moment.pointer("/extensions/BOUNCE_scene/world/color") == pytest.approx([0.1, 0.2, 0.4])
    assert moment.pointer("/extensions/BOUNCE_scene/view/exposure") == pytest.approx(truth["exposure"], abs=1e-6)


def test_root(scene):
    root = scene.gltf.bounce
    assert root["frames"] == {"start": 3, "end": 15, "fps": pytest.approx(30 / 1.001)}
    assert root["render"] == {"width": 400, "height": 150, "pixel_aspect_x": 1.5, "pixel_aspect_y": 1,
                              "film_exposure": 1.25}
    assert root["view"]["look"] == "High Contrast" and root["view"]["view_transform"] == "Filmic"
    assert root["version"] == 1


@pytest.mark.parametrize("name", ["Pattern", "Round pattern"])
def test_image_over_an_area_light(scene, name):
    light = next(light for light in scene.gltf.bounce["lights"] if light["name"] == name)
    # A disk in the middle of four even quarters has as much of each.
    assert light["color"] == pytest.approx([0.75, 0.375, 0.75])
    assert (light["pattern"]["width"], light["pattern"]["height"]) == (16, 16)
    cells = np.array(light["pattern"]["rgb"]).reshape(16, 16, 3)
    third = 4 / 3
    quarters = np.array([[[third, 0, 0], [0, third, 0]], [[0, 0, third], [2 * third, 2 * third, 2 * third]]])
    if name == "Pattern":  # Closest
        assert cells == pytest.approx(np.repeat(np.repeat(quarters, 8, axis=0), 8, axis=1), abs=1e-5)
    else:  # Linear, repeated: between the pixels' middles, which lie on the borders of cells, colours run into each other
        assert cells[3:5, 3:5].mean(axis=(0, 1)) == pytest.approx(quarters[0, 0], abs=0.2)
        assert cells[7:9, 7:9].mean(axis=(0, 1)) == pytest.approx([1, 1, 1], abs=0.1)


def test_unsupported(scene):
    assert scene.unsupported() == {
        ("Scene", "motion blur"),
        ("Main camera", "depth of field"),
        ("IES", "light 'IES': its node tree is not a plain Emission (Strength comes from IES Texture)"),
        ("Sheared", "light 'Sheared': sheared by its parent, and then elsewhere for each receiver in Cycles"),
        ("Lost pattern", "light 'Lost pattern': its node tree is not a plain Emission (Color comes from Image Texture)"),
    }
