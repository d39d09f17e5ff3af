# SPDX-License-Identifier: Apache-2.0
"""export_cli.py and the add-on as a user meets them: exit codes, messages, files left behind, the package."""

import hashlib
import json
import subprocess
import sys
import zipfile

import pytest
from conftest import ADDON, SCRIPTS
from gltf_eval import Gltf


def test_a_missing_scene_fails(export, tmp_path):
    done = export(tmp_path / "none.blend", tmp_path / "out.glb", check=False)
    assert done.returncode == 1 and "none.blend" in done.stdout + done.stderr
    assert not (tmp_path / "out.glb").exists()


def test_no_scene_is_one_sentence(blender, tmp_path):
    done = blender("-P", ADDON / "export_cli.py", "--", tmp_path / "out.glb", check=False)
    assert done.returncode == 1
    ours = [line for line in done.stderr.splitlines() if line.startswith("bounce:")]
    assert ours == ["bounce: export failed: no .blend file is open; was it found and could this Blender read it?"]
    assert not (tmp_path / "out.glb").exists()


@pytest.mark.parametrize("output, words", [
    ("out.obj", "the name must end in .glb or .gltf"), ("nowhere/out.glb", "the folder does not exist"),
])
def test_a_bad_target_is_one_sentence(export, built, tmp_path, output, words):
    done = export(built("lights").blend, tmp_path / output, check=False)
    assert done.returncode == 1
    assert words in done.stderr and "Traceback" not in done.stderr


@pytest.mark.parametrize("options", [[], ["out.glb", "--draco-level", "11"], ["out.glb", "--surprise"]])
def test_bad_usage_exits_with_2(blender, built, options):
    done = blender(built("lights").blend, "-P", ADDON / "export_cli.py", "--", *options, check=False)
    assert done.returncode == 2 and "usage: export_cli.py" in done.stderr


@pytest.mark.parametrize("hook", ["mesh", "placement", "document"])
def test_a_failing_hook_fails_the_export(blender, built, tmp_path, hook):
    target = tmp_path / "kept.glb"
    target.write_bytes(b"what was there before")
    blender(built("motion").blend, "--python-exit-code", "3", "-P", SCRIPTS / "failing_hook.py", "--", ADDON, target,
            hook)
    assert target.read_bytes() == b"what was there before"


@pytest.mark.parametrize("scene", ["motion", "materials"])
def test_an_export_leaves_the_scene_as_it_was(blender, built, tmp_path, scene):
    blender(built(scene).blend, "--python-exit-code", "3", "-P", SCRIPTS / "restores.py", "--", ADDON,
            tmp_path / "out.glb")


def test_separate_files(export, built, tmp_path):
    export(built("materials").blend, tmp_path / "out.gltf", "--no-draco")
    names = {path.name for path in tmp_path.iterdir()}
    # An image whose red channel is told to be roughness is written once more, its channels in glTF's places.
    images = {image["uri"] for image in json.loads((tmp_path / "out.gltf").read_text(encoding="utf-8"))["images"]}
    assert "Picture.png" in images
    assert names == {"out.gltf", "out.bin"} | images
    document = json.loads((tmp_path / "out.gltf").read_text())
    assert document["buffers"][0]["uri"] == "out.bin" and document["images"][0]["uri"] == "Picture.png"


def test_without_animation_the_first_frame_stands(export, built, tmp_path):
    export(built("motion").blend, tmp_path / "still.glb", "--no-draco", "--no-animation")
    still, moving = Gltf(tmp_path / "still.glb"), built("motion").gltf
    assert "animations" not in still.json
    for name in ("Keyed", "Strips", "Member"):
        nodes = [n for n in still.json["nodes"] if n["name"] == name]
        wanted = [n for n in moving.json["nodes"] if n["name"] == name]
        assert nodes[0].get("translation") == wanted[0].get("translation")


def test_exports_repeat_bit_for_bit(export, built, tmp_path):
    digests = set()
    for i in range(2):
        export(built("lights").blend, tmp_path / f"{i}.glb", "--no-draco")
        digests.add(hashlib.sha256((tmp_path / f"{i}.glb").read_bytes()).hexdigest())
    assert len(digests) == 1


def test_other_gltf_exports_stay_as_they_are(blender, built, tmp_path):
    """With the add-on enabled, Blender's own export writes what it writes without."""
    for name, enable in (("with.glb", True), ("without.glb", False)):
        script = tmp_path / "plain.py"
        script.write_text(
            "import sys, addon_utils, bpy\n"
            f"sys.path.insert(0, {str(ADDON)!r})\n"
            + ("addon_utils.enable('bounce', default_set=True)\nassert hasattr(bpy.types, 'EXPORT_SCENE_OT_bounce')\n"
               if enable else "")
            + f"bpy.ops.export_scene.gltf(filepath={str(tmp_path / name)!r}, export_lights=True)\n")
        blender(built("lights").blend, "--python-exit-code", "3", "-P", script)
    assert (tmp_path / "with.glb").read_bytes() == (tmp_path / "without.glb").read_bytes()


def test_the_package_installs(blender, built, draco_library, tmp_path):
    """Packs the add-on, installs it into a fresh Blender home and exports by its operator."""
    package = tmp_path / "bounce.zip"
    subprocess.run([sys.executable, ADDON / "package.py", package, "--draco", draco_library], check=True)
    with zipfile.ZipFile(package) as archive:
        names = archive.namelist()
    assert {"bounce/__init__.py", "bounce/blender_manifest.toml", "bounce/LICENSE", "bounce/libextern_draco.so",
            "bounce/schema/BOUNCE_scene.schema.json"} <= set(names)
    assert not [name for name in names if "__pycache__" in name]
    scripts = tmp_path / "scripts"
    script = tmp_path / "install.py"
    script.write_text(
        "import bpy\n"
        f"bpy.ops.preferences.addon_install(filepath={str(package)!r}, target='DEFAULT')\n"
        "bpy.ops.preferences.addon_enable(module='bounce')\n"
        f"assert bpy.ops.export_scene.bounce(filepath={str(tmp_path / 'out.glb')!r}) == {{'FINISHED'}}\n")
    scripts.mkdir()
    done = blender(built("materials").blend, "--python-exit-code", "3", "-P", script,
                   environment={"BLENDER_USER_SCRIPTS": str(scripts)})
    assert (scripts / "addons/bounce/__init__.py").is_file(), done.stdout
    document = Gltf(tmp_path / "out.glb").json
    assert "KHR_draco_mesh_compression" in document["extensionsRequired"], "the packed library was not found"
    assert "BOUNCE_scene" in document["extensions"]
