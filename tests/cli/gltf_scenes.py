# SPDX-License-Identifier: Apache-2.0
"""Small glTF files made from nothing, for tests of the program."""
import base64
import json
import struct

POSITIONS = [(-1, -1, 0), (1, -1, 0), (1, 1, 0), (-1, 1, 0)]
INDICES = [0, 1, 2, 0, 2, 3]


def square_buffer():
    return b"".join(struct.pack("<3f", *p) for p in POSITIONS) + struct.pack("<6H", *INDICES)


def square():
    """A square in the XY plane: the JSON, its buffer still to be placed."""
    return {
        "asset": {"version": "2.0"},
        "scene": 0,
        "scenes": [{"nodes": [0]}],
        "nodes": [{"name": "Square", "mesh": 0}],
        "meshes": [{"primitives": [{"attributes": {"POSITION": 0}, "indices": 1}]}],
        "accessors": [
            {"bufferView": 0, "componentType": 5126, "count": 4, "type": "VEC3", "min": [-1, -1, 0], "max": [1, 1, 0]},
            {"bufferView": 1, "componentType": 5123, "count": 6, "type": "SCALAR"},
        ],
        "bufferViews": [
            {"buffer": 0, "byteOffset": 0, "byteLength": 48},
            {"buffer": 0, "byteOffset": 48, "byteLength": 12},
        ],
        "buffers": [{"byteLength": 60}],
    }


def lit_square():
    """The square before a camera, under a spot, with Blender's frames 10 to 13 at 25 a second. The spot's power
    rises from 0 at the first frame to 100 W a second later."""
    document = square()
    document["nodes"] += [
        {"name": "Camera", "camera": 0, "translation": [0, 0, 4]},
        {"name": "Side", "camera": 0, "translation": [4, 0, 0], "rotation": [0, 0.7071068, 0, 0.7071068]},
        {"name": "Spot", "translation": [0, 0, 3], "extensions": {"BOUNCE_scene": {"light": 0}}},
    ]
    document["scenes"][0]["nodes"] = [0, 1, 2, 3]
    document["cameras"] = [{"type": "perspective", "perspective": {"yfov": 0.8, "znear": 0.1, "zfar": 100}}]
    document["materials"] = [{"pbrMetallicRoughness": {"metallicFactor": 0}, "doubleSided": True}]
    document["meshes"][0]["primitives"][0]["material"] = 0
    document["bufferViews"] += [
        {"buffer": 0, "byteOffset": 60, "byteLength": 8},
        {"buffer": 0, "byteOffset": 68, "byteLength": 8},
    ]
    document["accessors"] += [
        {"bufferView": 2, "componentType": 5126, "count": 2, "type": "SCALAR", "min": [0], "max": [1]},
        {"bufferView": 3, "componentType": 5126, "count": 2, "type": "SCALAR"},
    ]
    document["buffers"][0]["byteLength"] = 76
    document["animations"] = [
        {
            "name": "Scene",
            "channels": [
                {
                    "sampler": 0,
                    "target": {
                        "path": "pointer",
                        "extensions": {"KHR_animation_pointer": {"pointer": "/extensions/BOUNCE_scene/lights/0/power_w"}},
                    },
                }
            ],
            "samplers": [{"input": 2, "output": 3}],
        }
    ]
    document["extensionsUsed"] = ["BOUNCE_scene", "KHR_animation_pointer"]
    document["extensions"] = {
        "BOUNCE_scene": {
            "version": 1,
            "generator": {"blender": [3, 4, 1], "addon": "0.1.0"},
            "frames": {"start": 10, "end": 13, "fps": 25},
            "render": {"width": 32, "height": 18, "pixel_aspect_x": 1, "pixel_aspect_y": 1, "film_exposure": 1},
            "view": {"display_device": "sRGB", "view_transform": "Standard", "look": "None", "exposure": 0, "gamma": 1},
            "camera": 1,
            "lights": [
                {
                    "name": "Spot",
                    "type": "spot",
                    "color": [1, 1, 1],
                    "power_w": 50,
                    "radius_m": 0,
                    "cone_angle_rad": 1.2,
                    "blend": 0.1,
                    "cast_shadow": True,
                }
            ],
            "unsupported": [],
        }
    }
    return document


def buffer_of(document):
    """The square's bytes and, where the document has them, the animation's keys."""
    data = square_buffer()
    if len(document.get("bufferViews", [])) > 2:
        data += struct.pack("<2f", 0, 1) + struct.pack("<2f", 0, 100)
    return data


def glb(document, data=None):
    data = buffer_of(document) if data is None else data
    text = json.dumps(document).encode()
    text += b" " * (-len(text) % 4)
    data += b"\0" * (-len(data) % 4)
    chunks = struct.pack("<I4s", len(text), b"JSON") + text + struct.pack("<I4s", len(data), b"BIN\0") + data
    return struct.pack("<4sII", b"glTF", 2, 12 + len(chunks)) + chunks


def write_glb(path, document, data=None):
    path.parent.mkdir(parents=True, exist_ok=True)
    path.write_bytes(glb(document, data))
    return path


def write_gltf(path, document, data=None):
    """One text file with its buffer embedded."""
    data = buffer_of(document) if data is None else data
    document["buffers"][0]["uri"] = "data:application/octet-stream;base64," + base64.b64encode(data).decode()
    path.write_text(json.dumps(document))
    return path


def room():
    """An open room of squares, 2 m wide: red to the left, green to the right, and a plate in the air, under a spot that
    stands still. Frames 1 to 8 at 24 a second, in which the plate glides 0.6 m to the right."""
    document = square()
    half = 0.70710678
    document["nodes"] = [
        {"name": "Floor", "mesh": 0, "translation": [0, -1, 0], "rotation": [-half, 0, 0, half]},
        {"name": "Back", "mesh": 0, "translation": [0, 0, -1]},
        {"name": "Left", "mesh": 1, "translation": [-1, 0, 0], "rotation": [0, half, 0, half]},
        {"name": "Right", "mesh": 2, "translation": [1, 0, 0], "rotation": [0, -half, 0, half]},
        {"name": "Plate", "mesh": 0, "translation": [-0.3, -0.3, 0.2], "rotation": [-half, 0, 0, half], "scale": [0.25] * 3},
        {"name": "Camera", "camera": 0, "translation": [0, 0, 3.6]},
        {"name": "Spot", "translation": [0.1, 0.95, 0.1], "rotation": [-half, 0, 0, half],
         "extensions": {"BOUNCE_scene": {"light": 0}}},
    ]
    document["scenes"][0]["nodes"] = list(range(7))
    document["cameras"] = [{"type": "perspective", "perspective": {"yfov": 0.62, "znear": 0.1, "zfar": 100}}]
    document["materials"] = [
        {"pbrMetallicRoughness": {"metallicFactor": 0, "baseColorFactor": [*color, 1]}, "doubleSided": True}
        for color in ([0.75, 0.75, 0.75], [0.7, 0.08, 0.06], [0.1, 0.6, 0.12])
    ]
    document["meshes"] = [
        {"primitives": [{"attributes": {"POSITION": 0}, "indices": 1, "material": material}]} for material in range(3)
    ]
    document["bufferViews"] += [
        {"buffer": 0, "byteOffset": 60, "byteLength": 8},
        {"buffer": 0, "byteOffset": 68, "byteLength": 24},
    ]
    document["accessors"] += [
        {"bufferView": 2, "componentType": 5126, "count": 2, "type": "SCALAR", "min": [0], "max": [7 / 24]},
        {"bufferView": 3, "componentType": 5126, "count": 2, "type": "VEC3"},
    ]
    document["buffers"][0]["byteLength"] = 92
    document["animations"] = [
        {
            "name": "Scene",
            "channels": [{"sampler": 0, "target": {"node": 4, "path": "translation"}}],
            "samplers": [{"input": 2, "output": 3}],
        }
    ]
    document["extensionsUsed"] = ["BOUNCE_scene"]
    document["extensions"] = {
        "BOUNCE_scene": {
            **lit_square()["extensions"]["BOUNCE_scene"],
            "frames": {"start": 1, "end": 8, "fps": 24},
            "camera": 5,
        }
    }
    light = document["extensions"]["BOUNCE_scene"]["lights"][0]
    light.update(power_w=60, cone_angle_rad=1.5)
    return document


def room_buffer():
    return square_buffer() + struct.pack("<2f", 0, 7 / 24) + struct.pack("<6f", -0.3, -0.3, 0.2, 0.3, -0.3, 0.2)
