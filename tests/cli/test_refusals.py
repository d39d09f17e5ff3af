# SPDX-License-Identifier: Apache-2.0
"""Scenes that cannot be shown: exit code 3, one line that names the file, and nothing left behind."""
import gltf_scenes
import pytest


def missing(path):
    return path


def empty(path):
    path.write_bytes(b"")
    return path


def a_folder(path):
    path.mkdir()
    return path


def truncated(path):
    data = gltf_scenes.glb(gltf_scenes.lit_square())
    path.write_bytes(data[: len(data) - 40])
    return path


def truncated_header(path):
    path.write_bytes(gltf_scenes.glb(gltf_scenes.square())[:9])
    return path


def not_gltf(path):
    path.write_text("This is a shopping list: bread, butter, lamps.\n")
    return path


def another_format(path):
    path.write_bytes(b"\x89PNG\r\n\x1a\n" + bytes(64))
    return path


def other_json(path):
    path = path.with_suffix(".gltf")
    path.write_text('{"name": "not a scene", "version": 1}')
    return path


def broken_json(path):
    path = path.with_suffix(".gltf")
    path.write_text('{"asset": {"version": "2.0"')
    return path


def short_buffer(path):
    document = gltf_scenes.square()
    document["buffers"][0]["byteLength"] = 50
    return gltf_scenes.write_glb(path, document, gltf_scenes.square_buffer()[:50])


def accessor_past_its_view(path):
    document = gltf_scenes.square()
    document["accessors"][0]["count"] = 4000
    return gltf_scenes.write_glb(path, document)


def vertex_index_out_of_range(path):
    data = bytearray(gltf_scenes.square_buffer())
    data[48:50] = b"\xfe\xff"
    return gltf_scenes.write_glb(path, gltf_scenes.square(), bytes(data))


def mesh_out_of_range(path):
    document = gltf_scenes.square()
    document["nodes"][0]["mesh"] = 7
    return gltf_scenes.write_glb(path, document)


def cyclic_nodes(path):
    document = gltf_scenes.square()
    document["nodes"] = [{"mesh": 0, "children": [1]}, {"children": [2]}, {"children": [0]}]
    return gltf_scenes.write_glb(path, document)


def unknown_extension(path):
    document = gltf_scenes.square()
    document["extensionsUsed"] = document["extensionsRequired"] = ["EXT_from_the_future"]
    return gltf_scenes.write_glb(path, document)


def missing_buffer_file(path):
    document = gltf_scenes.square()
    document["buffers"][0]["uri"] = "nowhere.bin"
    return gltf_scenes.write_glb(path, document)


def textured(document, uri):
    document["images"] = [{"uri": uri}]
    document["textures"] = [{"source": 0}]
    document["materials"] = [{"pbrMetallicRoughness": {"baseColorTexture": {"index": 0}}}]
    document["meshes"][0]["primitives"][0]["material"] = 0
    return document


def unreadable_texture(path):
    (path.parent / "picture.png").write_bytes(b"\x89PNG\r\n\x1a\nnot a picture at all")
    return gltf_scenes.write_glb(path, textured(gltf_scenes.square(), "picture.png"))


def missing_texture(path):
    return gltf_scenes.write_glb(path, textured(gltf_scenes.square(), "nowhere.png"))


CASES = [
    missing,
    empty,
    a_folder,
    truncated,
    truncated_header,
    not_gltf,
    another_format,
    other_json,
    broken_json,
    short_buffer,
    accessor_past_its_view,
    vertex_index_out_of_range,
    mesh_out_of_range,
    cyclic_nodes,
    unknown_extension,
    missing_buffer_file,
    unreadable_texture,
    missing_texture,
]


@pytest.mark.parametrize("make", CASES, ids=lambda make: make.__name__)
@pytest.mark.parametrize("command", ["render", "info"])
def test_refused_with_one_line_and_nothing_left(bounce, tmp_path, command, make):
    scene = make(tmp_path / "faulty scene.glb")
    before = sorted(tmp_path.iterdir())
    arguments = ["-o", "out/picture.png"] if command == "render" else []
    result = bounce(command, scene, *arguments)
    assert result.returncode == 3, result.stderr
    lines = result.stderr.splitlines()
    assert len(lines) == 1, result.stderr
    assert lines[0].startswith("error: ")
    assert scene.name in lines[0]
    assert result.stdout == ""
    assert sorted(tmp_path.iterdir()) == before


def test_the_same_scene_without_a_fault_is_shown(bounce, render, tmp_path):
    """The makers above differ from this one by their fault alone."""
    scene = gltf_scenes.write_glb(tmp_path / "faulty scene.glb", gltf_scenes.square())
    assert bounce("info", scene).returncode == 0
    result = render(scene, "-o", "picture.png")
    assert result.returncode == 0, result.stderr
    assert (tmp_path / "picture.png").stat().st_size > 0


def test_info_as_json_prints_none_of_it_for_a_faulty_scene(bounce, tmp_path):
    result = bounce("info", empty(tmp_path / "scene.glb"), "--json")
    assert result.returncode == 3
    assert result.stdout == ""
