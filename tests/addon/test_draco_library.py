# SPDX-License-Identifier: Apache-2.0
"""The Draco library by itself: what goes in comes out, within the quantisation that was asked for."""

import numpy as np
import pytest
from draco_codec import Codec

BITS = {"POSITION": 14, "NORMAL": 10, "TEXCOORD_0": 12, "COLOR_0": 10, "WEIGHTS_0": 12}


@pytest.fixture(scope="module")
def codec(draco_library):
    return Codec(draco_library)


def torus(around=48, along=24):
    """Attributes and indices of a torus with a seam in its texture coordinates, as Blender would split it."""
    u, v = np.meshgrid(np.arange(around + 1), np.arange(along + 1), indexing="ij")
    u, v = u.ravel(), v.ravel()
    a, b = u * 2 * np.pi / around, v * 2 * np.pi / along
    normal = np.stack([np.cos(a) * np.cos(b), np.sin(a) * np.cos(b), np.sin(b)], axis=1)
    position = 2.0 * np.stack([np.cos(a), np.sin(a), 0 * a], axis=1) + 0.5 * normal
    weight = np.stack([u / around, 1 - u / around, 0 * a, 0 * a], axis=1)
    attributes = {
        "POSITION": position.astype(np.float32), "NORMAL": normal.astype(np.float32),
        "TEXCOORD_0": np.stack([u / around, v / along], axis=1).astype(np.float32),
        "COLOR_0": (np.stack([u / around, v / along, 0 * a, 1 + 0 * a], axis=1) * 65535).astype(np.uint16),
        "JOINTS_0": np.stack([u % 7, v % 5, u % 2, 0 * u], axis=1).astype(np.uint8),
        "WEIGHTS_0": weight.astype(np.float32),
    }
    corner = (np.arange(around)[:, None] * (along + 1) + np.arange(along)).ravel()
    quads = [corner, corner + along + 1, corner + along + 2, corner, corner + along + 2, corner + 1]
    return attributes, np.stack(quads, axis=1).ravel().astype(np.uint32)


def tolerance(name, values):
    if values.dtype != np.float32:
        return 0.0
    if name == "NORMAL":
        # Octahedral: half a cell of 2^10 over a square that folds around the sphere.
        return 2.0 * 2.0 / 2 ** BITS[name]
    # One grid spans the attribute's largest extent; rounding errs by half a cell.
    extent = (values.max(axis=0) - values.min(axis=0)).max()
    return 0.5 * extent / (2 ** BITS[name] - 1) * 1.01 + 1e-6


def match(decoded, original):
    """For each decoded vertex the original one with the same texture coordinate and joints, which are unique."""
    uv, wanted = decoded["TEXCOORD_0"], original["TEXCOORD_0"]
    nearest = np.abs(uv[:, None] - wanted[None]).sum(axis=2).argmin(axis=1)
    return nearest


def turned(corners):
    """Triangles as a set, each begun at its smallest corner; the turn of its corners is its front side."""
    return {tuple(np.roll(triangle, -np.argmin(triangle)).tolist()) for triangle in corners}


@pytest.mark.parametrize("level", [0, 5, 7, 10])
def test_round_trip(codec, level):
    attributes, indices = torus()
    data, ids, vertices, index_count = codec.encode(attributes, indices, level=level)
    decoded, decoded_indices = codec.decode(data, ids, attributes)
    assert len(decoded["POSITION"]) == vertices and len(decoded_indices) == index_count == len(indices)
    assert len(data) < sum(a.nbytes for a in attributes.values()) / 4
    original_of = match(decoded, attributes)
    for name, values in attributes.items():
        error = np.abs(decoded[name].astype(np.float64) - values[original_of].astype(np.float64)).max()
        assert error <= tolerance(name, values), name
    # The same triangles, with the same corners in the same turn.
    mapped = original_of[decoded_indices].reshape(-1, 3)
    assert turned(mapped) == turned(indices.reshape(-1, 3))


def test_order_is_kept_for_morph_targets(codec):
    attributes, indices = torus()
    # Doubled vertices must not be merged: the targets count on them.
    attributes = {name: np.concatenate([values, values[:3]]) for name, values in attributes.items()}
    indices = np.concatenate([indices, np.arange(len(indices[:3]), dtype=np.uint32) + len(attributes["POSITION"]) - 3])
    data, ids, vertices, _ = codec.encode(attributes, indices, preserve_order=True)
    decoded, decoded_indices = codec.decode(data, ids, attributes)
    assert vertices == len(attributes["POSITION"])
    assert (decoded_indices == indices).all()
    for name, values in attributes.items():
        assert np.abs(decoded[name].astype(np.float64) - values.astype(np.float64)).max() <= tolerance(name, values)


def test_no_quantisation_is_exact(codec):
    attributes, indices = torus()
    data, ids, _, _ = codec.encode(attributes, indices, bits=(0, 0, 0, 0, 0), preserve_order=True)
    decoded, _ = codec.decode(data, ids, attributes)
    for name, values in attributes.items():
        assert (decoded[name] == values).all(), name


@pytest.mark.parametrize("index_type", [np.uint8, np.uint16, np.uint32])
def test_index_types(codec, index_type):
    attributes, indices = torus(10, 8)
    data, ids, vertices, _ = codec.encode(attributes, indices.astype(index_type))
    _, decoded = codec.decode(data, ids, attributes, index_type)
    assert decoded.dtype == index_type and decoded.max() == vertices - 1


def test_normalised_integers_are_marked(codec):
    attributes, indices = torus(6, 5)
    data, ids, _, _ = codec.encode(attributes, indices)
    decoder = codec.dll.decoderCreate()
    assert codec.dll.decoderDecode(decoder, data, len(data))
    marked = {name: codec.dll.decoderAttributeIsNormalized(decoder, ids[name]) for name in ("COLOR_0", "JOINTS_0")}
    codec.dll.decoderRelease(decoder)
    assert marked == {"COLOR_0": True, "JOINTS_0": False}


def test_degenerate_triangles(codec):
    attributes, indices = torus(6, 5)
    three = {name: values[:3] for name, values in attributes.items()}
    alone = np.array([0, 1, 1, 2, 2, 0], dtype=np.uint32)
    data, ids, _, count = codec.encode(three, alone)
    _, decoded = codec.decode(data, ids, three)
    assert len(decoded) == count == len(alone)
    mixed = np.concatenate([indices, alone])
    data, ids, _, count = codec.encode(attributes, mixed)
    _, decoded = codec.decode(data, ids, attributes)
    assert len(decoded) == count >= len(indices)


def test_bad_input_is_refused(codec, capfd):
    attributes, indices = torus(6, 5)
    assert codec.encode(attributes, indices + np.uint32(1000)) is None
    assert "in a primitive of 42 vertices" in capfd.readouterr().err
    assert codec.encode(attributes, indices[:0]) is None
    assert codec.encode(attributes, indices[:9], preserve_order=True) is None
    assert "vertices that no triangle uses" in capfd.readouterr().err
    data, ids, _, _ = codec.encode(attributes, indices)
    assert codec.decode(data[: len(data) // 2], ids, attributes) is None
    assert codec.decode(b"", ids, attributes) is None
    assert codec.decode(b"DRACO" + bytes(200), ids, attributes) is None
