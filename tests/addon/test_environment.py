# SPDX-License-Identifier: Apache-2.0
"""Images of the world: their pixels in the file, their turn, and what is said where one is not represented."""

import json

import bounce_schema
import numpy as np
import pytest
from conftest import SCRIPTS
from gltf_eval import Gltf

oiio = pytest.importorskip("OpenImageIO")

ROWS, COLUMNS = np.mgrid[7:-1:-1, 0:16]  # from the top
PIXELS = np.stack([COLUMNS / 10, ROWS / 8, np.full(ROWS.shape, 0.25)], axis=2)


class Exported:
    def __init__(self, folder, name):
        self.gltf = Gltf(folder / f"{name}.glb")
        self.truth = json.loads((folder / f"{name}.json").read_text())
        self.world = self.gltf.bounce["world"]
        self.unsupported = {entry["what"] for entry in self.gltf.bounce["unsupported"]}
        self.folder = folder

    def image_bytes(self):
        view = self.gltf.json["bufferViews"][self.world["image"]["bufferView"]]
        start = view.get("byteOffset", 0)
        return self.gltf.binary[start:start + view["byteLength"]]

    def pixels(self, tmp_path):
        file = tmp_path / "image.exr"
        file.write_bytes(self.image_bytes())
        return np.asarray(oiio.ImageBuf(str(file)).get_pixels(oiio.FLOAT))[:, :, :3]


@pytest.fixture(scope="module")
def exported(blender, export, tmp_path_factory):
    folder = tmp_path_factory.mktemp("environments")
    blender("--python-exit-code", "3", "-P", SCRIPTS / "environments.py", "--", folder)
    done = {}

    def get(name):
        if name not in done:
            export(folder / f"{name}.blend", folder / f"{name}.glb", "--no-draco")
            done[name] = Exported(folder, name)
            bounce_schema.validate(done[name].gltf.json)
        return done[name]

    return get


def look_up(rotation, direction):
    """The direction in the image of one of the world: `rotation` turns the image, x, y, z, w."""
    axis, w = -np.array(rotation[:3]), rotation[3]
    direction = np.array(direction)
    return direction + 2 * np.cross(axis, np.cross(axis, direction) + w * direction)


def test_a_linear_file_travels_as_it_is(exported):
    scene = exported("exr")
    assert scene.image_bytes() == (scene.folder / "sky.exr").read_bytes()
    assert scene.world["image"]["mimeType"] == "image/x-exr" and scene.world["strength"] == 1
    assert scene.unsupported == set()
    weight = np.cos((ROWS[:, 0] + 0.5) / 8 * np.pi - np.pi / 2)
    mean = (PIXELS.mean(axis=1) * weight[:, None]).sum(axis=0) / weight.sum()
    assert scene.world["color"] == pytest.approx(mean, rel=1e-3)


@pytest.mark.parametrize("frame", [1, 2, 3])
def test_its_turn_is_the_mappings(exported, frame):
    scene = exported("exr")
    rotation = scene.gltf.at(frame).pointer("/extensions/BOUNCE_scene/world/rotation")
    # (0.36, 0.48, 0.8) of Blender.
    assert look_up(rotation, (0.36, 0.8, -0.48)) == pytest.approx(scene.truth[str(frame)]["looked_up"], abs=1e-5)


def test_bytes_become_scene_linear(exported, tmp_path):
    scene = exported("png")
    encoded = PIXELS.clip(0, 1)
    linear = np.where(encoded <= 0.04045, encoded / 12.92, ((encoded + 0.055) / 1.055) ** 2.4)
    # One step of 8 bits is 1/255, and the curve's steepest slope 2.3.
    assert scene.pixels(tmp_path) == pytest.approx(linear, abs=2.3 / 255)
    assert look_up(scene.world["rotation"], (0.36, 0.8, -0.48)) == pytest.approx(scene.truth["1"]["looked_up"], abs=1e-5)
    assert scene.unsupported == {"world 'World': Environment Texture: the Location of its Mapping; exported without it"}


def test_pixels_without_a_file_travel_too(exported, tmp_path):
    scene = exported("generated")
    assert scene.pixels(tmp_path) == pytest.approx(PIXELS, abs=1e-3)
    assert scene.unsupported == {"world 'World': Environment Texture with interpolation Closest; exported as Linear"}


def test_a_missing_image_is_magenta_as_in_cycles(exported):
    for name, why in (("missing", "whose file is missing (gone.exr)"), ("empty", "without an image")):
        scene = exported(name)
        assert scene.world == {"color": [1, 0, 1], "strength": 1}
        assert scene.unsupported == {f"world 'World': Environment Texture {why}; exported as magenta, which Cycles shows"}


def test_a_mirror_ball_is_its_mean_colour(exported):
    scene = exported("ball")
    assert "image" not in scene.world and scene.world["color"][2] == pytest.approx(0.25, rel=1e-3)
    assert scene.unsupported == {
        "world 'World': Environment Texture with mirror ball projection; exported as its mean colour"}
