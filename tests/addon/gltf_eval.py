# SPDX-License-Identifier: Apache-2.0
"""Reads a .glb without Draco and evaluates it at a time, as the glTF specification says. Independent of the add-on."""

import json
import struct
from pathlib import Path

import numpy as np

_COMPONENT = {5120: np.int8, 5121: np.uint8, 5122: np.int16, 5123: np.uint16, 5125: np.uint32, 5126: np.float32}
_COUNT = {"SCALAR": 1, "VEC2": 2, "VEC3": 3, "VEC4": 4, "MAT4": 16}


class Gltf:
    def __init__(self, path):
        data = Path(path).read_bytes()
        magic, version, length = struct.unpack_from("<4sII", data, 0)
        assert magic == b"glTF" and version == 2 and length == len(data), f"{path} is no .glb"
        json_length = struct.unpack_from("<I", data, 12)[0]
        self.json = json.loads(data[20:20 + json_length])
        self.binary = data[28 + json_length:]

    def array(self, accessor_index):
        accessor = self.json["accessors"][accessor_index]
        view = self.json["bufferViews"][accessor["bufferView"]]
        assert "byteStride" not in view and "sparse" not in accessor
        kind = np.dtype(_COMPONENT[accessor["componentType"]])
        count = _COUNT[accessor["type"]]
        offset = view.get("byteOffset", 0) + accessor.get("byteOffset", 0)
        values = np.frombuffer(self.binary, kind, accessor["count"] * count, offset).reshape(-1, count)
        if accessor.get("normalized"):
            return values.astype(np.float64) / np.iinfo(kind).max
        return values

    @property
    def bounce(self):
        return self.json["extensions"]["BOUNCE_scene"]

    def node(self, name):
        found = [i for i, node in enumerate(self.json["nodes"]) if node.get("name") == name]
        assert len(found) == 1, f"{len(found)} nodes named {name}"
        return found[0]

    def channels(self):
        """{(node, path) or pointer: (times, values, interpolation)} of all animations."""
        result = {}
        for animation in self.json.get("animations", []):
            for channel in animation["channels"]:
                sampler = animation["samplers"][channel["sampler"]]
                target = channel["target"]
                key = (target["node"], target["path"]) if "node" in target else \
                    target["extensions"]["KHR_animation_pointer"]["pointer"]
                assert key not in result, f"two channels for {key}"
                result[key] = (self.array(sampler["input"])[:, 0].astype(np.float64),
                               self.array(sampler["output"]).astype(np.float64), sampler["interpolation"])
        return result

    def at(self, frame):
        frames = self.bounce["frames"]
        return Moment(self, (frame - frames["start"]) / frames["fps"])


def _interpolate(times, values, interpolation, time, is_rotation=False):
    values = values.reshape(len(times), -1)
    time = np.float32(time)
    after = int(np.clip(np.searchsorted(times, time, side="right"), 1, len(times) - 1))
    before = after - 1
    t = float(np.clip((time - times[before]) / (times[after] - times[before]), 0.0, 1.0))
    if interpolation == "STEP":
        return values[after if t >= 1.0 else before]
    a, b = values[before], values[after]
    if not is_rotation:
        return a * (1 - t) + b * t
    cosine = float(np.clip(a @ b, -1.0, 1.0))
    if cosine < 0.0:
        b, cosine = -b, -cosine
    angle = np.arccos(cosine)
    if angle < 1e-6:
        q = a * (1 - t) + b * t
    else:
        q = (a * np.sin((1 - t) * angle) + b * np.sin(t * angle)) / np.sin(angle)
    return q / np.linalg.norm(q)


def trs_matrix(translation, rotation, scale):
    x, y, z, w = rotation
    matrix = np.eye(4)
    matrix[:3, :3] = np.array([
        [1 - 2 * (y * y + z * z), 2 * (x * y - z * w), 2 * (x * z + y * w)],
        [2 * (x * y + z * w), 1 - 2 * (x * x + z * z), 2 * (y * z - x * w)],
        [2 * (x * z - y * w), 2 * (y * z + x * w), 1 - 2 * (x * x + y * y)],
    ]) * np.asarray(scale)
    matrix[:3, 3] = translation
    return matrix


class Moment:
    """The file at one time."""

    def __init__(self, gltf, time):
        self.gltf, self.time = gltf, time
        self.channels = gltf.channels()
        self._world = {}
        for root in gltf.json["scenes"][gltf.json["scene"]]["nodes"]:
            self._visit(root, np.eye(4))

    def pointer(self, pointer):
        """The value that a JSON pointer has at this time, animated or not."""
        if pointer in self.channels:
            value = _interpolate(*self.channels[pointer], self.time)
        else:
            value = self.gltf.json
            for part in pointer.strip("/").split("/"):
                value = value[int(part)] if isinstance(value, list) else value[part]
            value = np.atleast_1d(value).astype(np.float64)
        return value if len(value) > 1 else float(value[0])

    def world(self, node):
        return self._world[node]

    def _part(self, node, path, default):
        if (node, path) in self.channels:
            return _interpolate(*self.channels[node, path], self.time, path == "rotation")
        return self.gltf.json["nodes"][node].get(path, default)

    def _visit(self, index, parent):
        node = self.gltf.json["nodes"][index]
        assert "matrix" not in node
        self._world[index] = parent @ trs_matrix(
            self._part(index, "translation", [0, 0, 0]), self._part(index, "rotation", [0, 0, 0, 1]),
            self._part(index, "scale", [1, 1, 1]))
        for child in node.get("children", []):
            self._visit(child, self._world[index])

    def weights(self, node):
        mesh = self.gltf.json["meshes"][self.gltf.json["nodes"][node]["mesh"]]
        return np.asarray(self._part(node, "weights", mesh.get("weights", [])), dtype=np.float64)

    def vertices(self, node):
        """World positions of a node's mesh, morphed and skinned."""
        description = self.gltf.json["nodes"][node]
        parts = []
        for primitive in self.gltf.json["meshes"][description["mesh"]]["primitives"]:
            attributes = primitive["attributes"]
            positions = self.gltf.array(attributes["POSITION"]).astype(np.float64)
            for weight, target in zip(self.weights(node), primitive.get("targets", [])):
                positions = positions + weight * self.gltf.array(target["POSITION"])
            matrices = np.broadcast_to(self._world[node], (len(positions), 4, 4))
            if "skin" in description:
                matrices = self._skin_matrices(description["skin"], attributes)
            homogeneous = np.concatenate([positions, np.ones((len(positions), 1))], axis=1)
            parts.append(np.einsum("vij,vj->vi", matrices, homogeneous)[:, :3])
        return np.concatenate(parts)

    def _skin_matrices(self, skin_index, attributes):
        skin = self.gltf.json["skins"][skin_index]
        inverse_bind = self.gltf.array(skin["inverseBindMatrices"]).reshape(-1, 4, 4).transpose(0, 2, 1)
        joints = np.array([self._world[j] for j in skin["joints"]]) @ inverse_bind
        weights = self.gltf.array(attributes["WEIGHTS_0"]).astype(np.float64)
        return np.einsum("vk,vkij->vij", weights, joints[self.gltf.array(attributes["JOINTS_0"])])
