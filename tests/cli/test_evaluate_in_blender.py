# SPDX-License-Identifier: Apache-2.0
"""A glTF file in the real Blender shows what Bounce shows: by `bounce evaluate`, direct light alone.

Cycles with 64 samples differs from Bounce in these scenes by its noise, one sample a pixel at outlines, and the
highlight's lobe: relMSE 0.02 at most, bias 2 %. Another camera, pose, light or material is relMSE 0.2 and more.
"""
import json
import os
import shutil
import struct
import subprocess

import pytest
from gltf_scenes import room, room_buffer, square, square_buffer, write_glb

BLENDER = shutil.which(os.environ.get("BLENDER", "blender"))
pytestmark = pytest.mark.skipif(BLENDER is None, reason="Blender is not installed here")


def evaluated(bounce, tmp_path, scene, frames="1"):
    """Frames of the point drawn with direct light, and what was said."""
    done = bounce("evaluate", scene, "-o", "report", "--size", "96x54", "--frames", frames, "--bounces", "0", "--reference-spp",
                  "64", "--cycles-spp", "1", "--peers", "none", "--repeat", "1", timeout=280,
                  environment={"XDG_CACHE_HOME": str(tmp_path / "cache")})
    assert done.returncode == 0, done.stderr
    results = json.loads((tmp_path / "report/results.json").read_text(encoding="utf-8"))
    curve = next(curve for curve in results["curves"] if curve["name"] == "Direct light only")
    return curve["points"][0]["frames"], done.stderr


def smooth(document):
    """At a roughness at which Cycles' multiscatter highlight is nearly the plain one that is drawn (docs/lights.md)."""
    for item in document["materials"]:
        item["pbrMetallicRoughness"]["roughnessFactor"] = 0.4
    return document


def same(frames):
    for frame in frames:
        assert frame["relmse"] < 0.02 and abs(frame["bias"]) < 0.02, frame
    return True


def test_what_has_one_name_is_told_apart(bounce, tmp_path):
    """All nodes are called alike, and all materials; of two cameras the second one counts, and looks from the side."""
    document = smooth(room())
    document["nodes"].append({"camera": 0, "translation": [0.8, 0.3, 3.4], "rotation": [0, 0.0998334, 0, 0.9950042]})
    document["scenes"][0]["nodes"].append(7)
    document["extensions"]["BOUNCE_scene"]["camera"] = 7
    for item in document["nodes"] + document["materials"]:
        item["name"] = "Thing"
    frames, _ = evaluated(bounce, tmp_path, write_glb(tmp_path / "room.glb", document, room_buffer()), "1,8")
    assert len(frames) == 2 and same(frames)


def test_a_framing_that_moves(bounce, tmp_path):
    """Neither camera nor light: Bounce frames the square at each frame, and its sky lights it."""
    document = square()
    document["nodes"].append({"name": "Square", "mesh": 0, "translation": [-1, 0.5, -1]})
    document["scenes"][0]["nodes"].append(1)
    document["materials"] = [{"pbrMetallicRoughness": {"metallicFactor": 0, "baseColorFactor": [0.1, 0.2, 0.4, 1], "roughnessFactor": 0.4},
                              "doubleSided": True}]
    document["meshes"][0]["primitives"][0]["material"] = 0
    document["bufferViews"] += [{"buffer": 0, "byteOffset": 60, "byteLength": 8}, {"buffer": 0, "byteOffset": 68, "byteLength": 24}]
    document["accessors"] += [{"bufferView": 2, "componentType": 5126, "count": 2, "type": "SCALAR", "min": [0], "max": [1]},
                              {"bufferView": 3, "componentType": 5126, "count": 2, "type": "VEC3"}]
    document["buffers"][0]["byteLength"] = 92
    document["animations"] = [{"channels": [{"sampler": 0, "target": {"node": 0, "path": "translation"}}],
                               "samplers": [{"input": 2, "output": 3}]}]
    data = square_buffer() + struct.pack("<2f", 0, 1) + struct.pack("<6f", 0, 0, 0, 4, 2, 1)
    frames, _ = evaluated(bounce, tmp_path, write_glb(tmp_path / "moving.glb", document, data), "1,20")
    assert len(frames) == 2 and same(frames)


def add_floats(document, data, rows):
    """An accessor of rows of floats behind the buffer's bytes; returns its index and the longer buffer."""
    count = len(rows[0])
    packed = b"".join(struct.pack(f"<{count}f", *row) for row in rows)
    document["bufferViews"].append({"buffer": 0, "byteOffset": len(data), "byteLength": len(packed)})
    accessor = {"bufferView": len(document["bufferViews"]) - 1, "componentType": 5126, "count": len(rows),
                "type": {1: "SCALAR", 3: "VEC3", 4: "VEC4"}[count]}
    if count == 1:
        accessor.update(min=[min(row[0] for row in rows)], max=[max(row[0] for row in rows)])
    document["accessors"].append(accessor)
    document["buffers"][0]["byteLength"] = len(data) + len(packed)
    return len(document["accessors"]) - 1, data + packed


def test_what_the_importer_does_not_know(bounce, tmp_path):
    """A power along a spline, a hidden node with a visible one below it, instances, a surface without a material, and a
    buffer whose name is escaped; the extensions are required."""
    document, data = smooth(room()), room_buffer()
    times, data = add_floats(document, data, [(0,), (7 / 24,)])
    powers, data = add_floats(document, data, [(0,), (10,), (300,), (-900,), (90,), (0,)])
    animation = document["animations"][0]
    animation["samplers"].append({"input": times, "output": powers, "interpolation": "CUBICSPLINE"})
    animation["channels"].append({"sampler": 1, "target": {"path": "pointer", "extensions": {
        "KHR_animation_pointer": {"pointer": "/extensions/BOUNCE_scene/lights/0/power_w"}}}})
    places, data = add_floats(document, data, [(-2, 0, 0), (0, 0.5, 0.3), (2, 0, 0)])
    turns, data = add_floats(document, data, [(0, 0, 0, 1), (0.5, 0, 0, 0.8660254), (0, 0, 0.5, 0.8660254)])
    document["meshes"].append({"primitives": [{"attributes": {"POSITION": 0}, "indices": 1}]})
    document["nodes"] += [
        {"mesh": 1, "translation": [0, 0.4, -0.5], "scale": [0.22] * 3,
         "extensions": {"EXT_mesh_gpu_instancing": {"attributes": {"TRANSLATION": places, "ROTATION": turns}}}},
        {"extensions": {"KHR_node_visibility": {"visible": False}}, "children": [9]},
        {"mesh": 1, "translation": [0, 0, 0.5], "scale": [0.4] * 3, "extensions": {"KHR_node_visibility": {"visible": True}}},
        {"mesh": 3, "translation": [0.4, -0.5, 0.6], "rotation": [-0.5, 0, 0, 0.8660254], "scale": [0.3] * 3}]
    document["scenes"][0]["nodes"] += [7, 8, 10]
    document["extensionsUsed"] += ["KHR_animation_pointer", "KHR_node_visibility", "EXT_mesh_gpu_instancing"]
    document["extensionsRequired"] = ["KHR_node_visibility", "EXT_mesh_gpu_instancing"]
    document["buffers"][0]["uri"] = "my%20buffer.bin"
    (tmp_path / "my buffer.bin").write_bytes(data)
    (tmp_path / "room.gltf").write_text(json.dumps(document), encoding="utf-8")
    frames, _ = evaluated(bounce, tmp_path, "room.gltf", "1,5")
    assert len(frames) == 2 and same(frames)


def test_a_file_of_khronos_own_words(bounce, tmp_path):
    """No BOUNCE_scene: a point light without a stated intensity, and one through an orthographic camera of height 2.4 m."""
    document = smooth(room())
    del document["extensions"]
    document["extensionsUsed"] = ["KHR_lights_punctual"]
    document["extensions"] = {"KHR_lights_punctual": {"lights": [{"type": "point", "intensity": 3000}, {"type": "point"}]}}
    document["nodes"][6] = {"translation": [0.1, 0.8, 0.1], "extensions": {"KHR_lights_punctual": {"light": 0}}}
    document["nodes"].append({"translation": [0.5, -0.8, 0.4], "extensions": {"KHR_lights_punctual": {"light": 1}}})
    document["scenes"][0]["nodes"].append(7)
    document["cameras"] = [{"type": "orthographic", "orthographic": {"xmag": 1, "ymag": 1.2, "znear": 0.1, "zfar": 100}}]
    frames, _ = evaluated(bounce, tmp_path, write_glb(tmp_path / "plain.glb", document, room_buffer()))
    assert same(frames)


def test_a_camera_that_is_hidden_in_renders_is_the_camera(bounce, tmp_path):
    subprocess.run([BLENDER, "-b", "--factory-startup", "--python-exit-code", "1", "--python-expr",
                    f"import bpy; bpy.context.scene.camera.hide_render = True; "
                    f"bpy.ops.wm.save_as_mainfile(filepath={str(tmp_path / 'hidden.blend')!r})"], check=True, capture_output=True)
    frames, _ = evaluated(bounce, tmp_path, "hidden.blend")
    assert same(frames)


def test_capitals_are_no_other_kind_of_file(bounce, tmp_path):
    frames, _ = evaluated(bounce, tmp_path, write_glb(tmp_path / "ROOM.GLB", smooth(room()), room_buffer()))
    assert same(frames)


def test_a_blend_without_an_active_camera_is_refused_at_once(bounce, tmp_path):
    subprocess.run([BLENDER, "-b", "--factory-startup", "--python-exit-code", "1", "--python-expr",
                    f"import bpy; bpy.context.scene.camera = None; bpy.ops.wm.save_as_mainfile(filepath={str(tmp_path / 'none.BLEND')!r})"],
                   check=True, capture_output=True)
    done = bounce("evaluate", "none.BLEND", "-o", "report", "--size", "16x9", "--peers", "none",
                  environment={"XDG_CACHE_HOME": str(tmp_path / "cache")})
    assert done.returncode == 3, done.stderr
    assert "none.BLEND has no active camera that" in done.stderr
    assert "evaluate 1/" not in done.stderr, "nothing is drawn before"
