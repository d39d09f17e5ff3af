# SPDX-License-Identifier: Apache-2.0
"""The add-on's modules that need no Blender."""

import math
from types import SimpleNamespace

import numpy as np
import pytest
from bounce import camera_math, draco_library, light_pattern, lights, read_world, sockets, textures, tracks, trs
from bounce.pointers import Pointer


def test_punctual_intensity():
    assert lights.punctual_intensity("point", power_w=4 * math.pi) == pytest.approx(683.0)
    assert lights.punctual_intensity("spot", power_w=4 * math.pi) == pytest.approx(683.0)
    assert lights.punctual_intensity("sun", irradiance_w_m2=2.0) == pytest.approx(1366.0)


@pytest.mark.parametrize("cone, blend", [(1.0, 0.0), (1.0, 0.15), (1.0, 1.0), (math.pi, 0.0), (0.02, 0.5)])
def test_punctual_cone_is_legal(cone, blend):
    inner, outer = lights.punctual_cone(cone, blend)
    assert 0.0 <= inner < outer <= math.pi / 2


def test_punctual_cone_is_full_where_blenders_blend_ends():
    inner, outer = lights.punctual_cone(math.radians(60), 0.5)
    assert outer == pytest.approx(math.radians(30))
    edge = math.cos(outer)
    assert (math.cos(inner) - edge) / ((1 - edge) * 0.5) == pytest.approx(1.0)


def test_area_light_has_no_punctual_twin():
    assert lights.punctual_light({"type": "area", "name": "A", "color": [1, 1, 1]}) is None


CAMERA = {"sensor_width_mm": 36.0, "sensor_height_mm": 24.0, "focal_length_mm": 50.0, "ortho_scale": 6.0}


@pytest.mark.parametrize("fit, width, height, half_tangent", [
    ("auto", 1600, 900, 18 / 50 * 900 / 1600),
    ("auto", 900, 1600, 18 / 50),
    ("horizontal", 900, 1600, 18 / 50 * 1600 / 900),
    ("vertical", 1600, 900, 12 / 50),
])
def test_yfov(fit, width, height, half_tangent):
    assert math.tan(camera_math.yfov({**CAMERA, "sensor_fit": fit}, width, height) / 2) == pytest.approx(half_tangent)


@pytest.mark.parametrize("fit, width, height, wanted", [
    ("auto", 200, 100, (3.0, 1.5)), ("auto", 100, 200, (1.5, 3.0)), ("vertical", 200, 100, (6.0, 3.0)),
])
def test_magnification(fit, width, height, wanted):
    assert camera_math.magnification({**CAMERA, "sensor_fit": fit}, width, height) == pytest.approx(wanted)


def test_pointers():
    def index_of(kind, owner):
        return {"light": 3, "node": 7}[kind]

    assert Pointer("light", "x", "power_w").resolve(index_of) == "/extensions/BOUNCE_scene/lights/3/power_w"
    assert Pointer("node", "x", "extensions/KHR_node_visibility/visible").resolve(index_of) == \
        "/nodes/7/extensions/KHR_node_visibility/visible"
    assert Pointer("world", None, "color").resolve(index_of) == "/extensions/BOUNCE_scene/world/color"


def test_constancy_ignores_rounding_but_not_motion():
    assert tracks.is_constant([[1000.0, 0.0], [1000.0004, 0.0]])
    assert not tracks.is_constant([[1.0], [1.0001]])
    # A small value beside a large one still counts.
    assert not tracks.is_constant([[1000.0, 0.0], [1000.0, 0.01]])
    assert tracks.is_constant(np.array([True, True])) and not tracks.is_constant(np.array([True, False]))


def test_key_times_start_at_zero():
    assert tracks.key_times([10, 11, 13], 24) == pytest.approx([0.0, 1 / 24, 3 / 24])


def test_quaternions_take_the_near_sign():
    angles = np.linspace(0.0, 4 * math.pi, 40)
    exact = np.stack([np.sin(angles / 2), 0 * angles, 0 * angles, np.cos(angles / 2)], axis=1)
    flipped = exact * np.where(exact[:, 3:] < 0.0, -1.0, 1.0)
    assert (np.sum(flipped[1:] * flipped[:-1], axis=1) < 0).any()
    assert tracks.continuous_quaternions(flipped) == pytest.approx(exact)


def random_matrices(count=200, mirrored=False):
    generator = np.random.default_rng(5)
    quaternions = generator.normal(size=(count, 4))
    quaternions /= np.linalg.norm(quaternions, axis=1, keepdims=True)
    scales = generator.uniform(0.2, 3.0, size=(count, 3)) * (-1.0 if mirrored else 1.0)
    return trs.compose(generator.normal(size=(count, 3)), quaternions, scales)


@pytest.mark.parametrize("mirrored", [False, True])
def test_decompose_undoes_compose(mirrored):
    matrices = random_matrices(mirrored=mirrored)
    assert trs.compose(*trs.decompose(matrices)) == pytest.approx(matrices, abs=1e-12)


def test_half_turns_decompose():
    turns = np.array([np.diag([1, -1, -1, 1]), np.diag([-1, 1, -1, 1]), np.diag([-1, -1, 1, 1])], dtype=float)
    assert trs.compose(*trs.decompose(turns)) == pytest.approx(turns, abs=1e-12)


def test_collapsed_scale_stays_finite():
    flat = np.diag([1.0, 0.0, 2.0, 1.0])[None]
    assert all(np.isfinite(part).all() for part in trs.decompose(flat))
    assert np.isfinite(trs.inverse(np.zeros((1, 4, 4)))).all()


def test_shear_is_measured():
    sheared = np.eye(4)[None].copy()
    sheared[0, 0, 1] = 0.5
    assert trs.relative_error(trs.compose(*trs.decompose(sheared)), sheared) > 0.1
    straight = random_matrices()
    assert trs.relative_error(trs.compose(*trs.decompose(straight)), straight) < 1e-9


def test_axes():
    up = np.eye(4)
    up[:3, 3] = (1.0, 2.0, 3.0)
    assert trs.object_in_gltf(up[None])[0, :3, 3] == pytest.approx([1.0, 3.0, -2.0])
    # Blender's unturned camera looks down, and so does its node.
    assert trs.oriented_in_gltf(np.eye(4)[None])[0, :3, :3] @ [0, 0, -1] == pytest.approx([0, -1, 0])


def socket(value=None, link=None, name="Color"):
    return SimpleNamespace(default_value=value, is_linked=link is not None, links=[link] if link else [], name=name)


def link(node, output):
    return SimpleNamespace(from_node=node, from_socket=output, is_muted=False)


def test_constants_pass_reroutes_and_value_nodes():
    output = socket((0.1, 0.2, 0.3, 1.0))
    rgb = SimpleNamespace(type="RGB", inputs=[])
    reroute = SimpleNamespace(type="REROUTE", inputs=[socket(link=link(rgb, output))])
    assert sockets.constant(socket(link=link(reroute, socket()))) == [0.1, 0.2, 0.3]
    noise = SimpleNamespace(type="TEX_NOISE", inputs=[], bl_label="Noise Texture")
    assert sockets.constant(socket(link=link(noise, socket()))) is None
    assert textures.follow(socket(link=link(noise, socket()))).problem == "Noise Texture"


def test_environment_mean_weighs_rows_by_solid_angle():
    # White from 30 degrees above the horizon up: a quarter of the sphere, though a third of the image.
    pixels = np.zeros((180, 4, 3))
    pixels[120:] = 1.0
    pixels[0, 0] = np.nan  # counts as 0
    assert read_world.mean_radiance(pixels) == pytest.approx([0.25] * 3, rel=1e-3)


def test_draco_is_looked_for_in_order(tmp_path):
    addon = tmp_path / "checkout/blender_addon/bounce"
    addon.mkdir(parents=True)
    own = tmp_path / "blender_own.so"
    assert draco_library.locate(own, addon, {}) is None
    built = tmp_path / "checkout/build/release" / draco_library.FILE_NAME
    built.parent.mkdir(parents=True)
    built.touch()
    environment = {}
    assert draco_library.locate(own, addon, environment) == built
    assert environment == {draco_library.VARIABLE: str(built)}
    packed = addon / draco_library.FILE_NAME
    packed.touch()
    assert draco_library.locate(own, addon, {}) == packed
    own.touch()
    environment = {}
    assert draco_library.locate(own, addon, environment) == own and environment == {}
    assert draco_library.locate(own, addon, {draco_library.VARIABLE: str(built)}) == built
    assert draco_library.locate(own, addon, {draco_library.VARIABLE: str(tmp_path / "gone.so")}) is None


class _Bytes:
    """An image of 2 x 1 bytes, black and white, in sRGB."""

    size, channels, is_float = (2, 1), 4, False
    colorspace_settings = SimpleNamespace(name="sRGB")
    stored = np.array([0, 0, 0, 1, 1, 1, 1, 1], dtype=np.float32)

    @property
    def pixels(self):
        return SimpleNamespace(foreach_get=lambda values: values.__setitem__(slice(None), self.stored))

    def as_pointer(self):
        return id(self)


@pytest.mark.parametrize("interpolation, extension, mean",
                         # A quarter black, a quarter white, between them the mean of the decoded ramp, which is 0.3103.
                         [("Closest", "EXTEND", 0.5), ("Linear", "EXTEND", 0.25 + 0.5 * 0.3103), ("Linear", "REPEAT", 0.3103)])
def test_a_lights_image_is_interpolated_as_it_is_encoded(interpolation, extension, mean):
    light_pattern.forget()
    node = SimpleNamespace(image=_Bytes(), interpolation=interpolation, extension=extension)
    color, pattern = light_pattern.read(node, False)
    assert color == pytest.approx([mean] * 3, abs=2e-3)
    assert np.mean(pattern["rgb"]) == pytest.approx(1.0, abs=1e-5)
