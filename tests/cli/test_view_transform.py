# SPDX-License-Identifier: Apache-2.0
"""How light becomes a picture for a screen: options, names that are not there, configurations that cannot be read."""
import os
import pathlib
import shutil

import gltf_scenes
import pytest

# Where nothing of Blender's is to be found.
NOTHING = {"OCIO": "", "BLENDER": "/nowhere/blender"}


def has_configuration():
    """As color_config.cpp looks for it, of an installed Blender."""
    blender = shutil.which(os.environ.get("BLENDER", "blender"))
    if blender is None:
        return False
    here = pathlib.Path(blender).resolve().parent
    return any(list(folder.glob("**/datafiles/colormanagement/config.ocio")) for folder in (here.parent / "share" / "blender", here))


needs_blender = pytest.mark.skipif(not has_configuration(), reason="Blender's colour configuration is not here")


@pytest.fixture
def viewed(tmp_path):
    """A scene whose view differs from the plain one."""

    def write(**view):
        document = gltf_scenes.lit_square()
        document["extensions"]["BOUNCE_scene"]["view"].update(view)
        return gltf_scenes.write_glb(tmp_path / "viewed.glb", document)

    return write


def same(bounce, a, b):
    return bounce("compare", a, b, "--fail-above", "max_abs=0").returncode == 0


def refused(result, *words):
    assert result.returncode == 2, (result.returncode, result.stderr)
    assert len(result.stderr.splitlines()) == 1, result.stderr
    for word in words:
        assert word in result.stderr, result.stderr


def warned(result, *words):
    assert result.returncode == 0, result.stderr
    lines = [line for line in result.stderr.splitlines() if "warning" in line]
    assert any(all(word in line for word in words) for line in lines), result.stderr


def test_options_stand_for_what_the_file_says(render, bounce, scene, viewed):
    assert render(viewed(exposure=1.5, gamma=1.4), "-o", "file.png", "--frames", "12").returncode == 0
    assert render(scene, "-o", "option.png", "--frames", "12", "--exposure", "1.5", "--gamma", "1.4").returncode == 0
    assert render(scene, "-o", "plain.png", "--frames", "12").returncode == 0
    assert same(bounce, "file.png", "option.png")
    assert not same(bounce, "file.png", "plain.png")


def test_convert_does_what_render_does(render, bounce, scene):
    view = ["--exposure", "1", "--gamma", "1.2"]
    assert render(scene, "-o", "light.exr", "-o", "render.png", "--frames", "12", *view).returncode == 0
    assert bounce("convert", "light.exr", "-o", "convert.png", *view).returncode == 0
    # Half floats of the file, then 8 bits: one step at most.
    assert bounce("compare", "convert.png", "render.png", "--fail-above", "max_abs=0.02").returncode == 0
    assert not same(bounce, "convert.png", "light.exr")


def test_bad_options(bounce, render, scene):
    refused(render(scene, "-o", "a.exr", "--gamma", "2"), "scene-linear")
    refused(render(scene, "-o", "a.png", "--gamma", "2", "--show", "rsm-normal"), "rsm-normal")
    refused(render(scene, "-o", "a.png", "--gamma", "-1"), "--gamma")
    refused(render(scene, "-o", "a.png", "--exposure", "1e9"), "--exposure")
    refused(bounce("convert", "nowhere.exr", "-o", "a.exr"), "scene-linear")


@needs_blender
@pytest.mark.parametrize("option, name, listed", [("--view-transform", "Kodachrome", ["Filmic", "Standard", "Raw"]),
                                                  ("--look", "Bleach", ["High Contrast", "None"]),
                                                  ("--display-device", "Cathode", ["sRGB"])])
def test_names_that_are_not_there_are_refused(bounce, render, scene, option, name, listed):
    refused(render(scene, "-o", "a.png", option, name), name, *listed)
    assert render(scene, "-o", "light.exr").returncode == 0
    refused(bounce("convert", "light.exr", "-o", "a.png", option, name), name, *listed)


@needs_blender
@pytest.mark.parametrize("named, instead", [({"view_transform": "Kodachrome"}, {"view_transform": "Standard"}),
                                            ({"view_transform": "Filmic", "look": "Bleach"}, {"view_transform": "Filmic"}),
                                            ({"display_device": "Cathode"}, {})])
def test_names_of_a_file_that_are_not_there_are_told(bounce, render, viewed, named, instead):
    missing = list(named.values())[-1]
    warned(render(viewed(**named), "-o", "named.png", "--frames", "12"), missing, "is used instead")
    done = render(viewed(**instead), "-o", "instead.png", "--frames", "12")
    assert done.returncode == 0 and "warning" not in done.stderr
    assert same(bounce, "named.png", "instead.png")


@needs_blender
def test_a_configuration_that_cannot_be_read(bounce, render, viewed, tmp_path):
    filmic = viewed(view_transform="Filmic")
    assert render(filmic, "-o", "blender.png", "--frames", "12").returncode == 0
    (tmp_path / "broken.ocio").write_text("this is no configuration")
    for name in ("broken.ocio", "missing.ocio"):
        result = render(filmic, "-o", "other.png", "--frames", "12", environment={"OCIO": str(tmp_path / name)})
        warned(result, name, "is used instead")
        assert same(bounce, "other.png", "blender.png")


def test_without_any_configuration(bounce, render, scene, viewed, tmp_path):
    filmic = viewed(view_transform="Filmic", exposure=0.5)
    warned(render(filmic, "-o", "filmic.png", "--frames", "12", environment=NOTHING), "Filmic", "OCIO", "Standard")
    standard = render(scene, "-o", "standard.png", "--frames", "12", "--exposure", "0.5", environment=NOTHING)
    assert standard.returncode == 0 and "warning" not in standard.stderr, "Standard needs none"
    assert same(bounce, "filmic.png", "standard.png")
    refused(render(scene, "-o", "a.png", "--view-transform", "Filmic", environment=NOTHING), "Filmic", "Standard")
    broken = {"OCIO": str(tmp_path / "missing.ocio"), "BLENDER": NOTHING["BLENDER"]}
    warned(render(filmic, "-o", "filmic.png", "--frames", "12", environment=broken), "missing.ocio", "Standard")
    warned(render(scene, "-o", "standard.png", "--frames", "12", environment=broken), "missing.ocio", "needs none")


@needs_blender
def test_a_configuration_without_its_tables(render, viewed, tmp_path):
    """Read, but Filmic cannot be made of it."""
    (tmp_path / "config.ocio").write_text(
        "ocio_profile_version: 1\nsearch_path: nowhere\nroles:\n  scene_linear: Linear\ndisplays:\n  sRGB:\n"
        "    - !<View> {name: Filmic, colorspace: Film}\ncolorspaces:\n  - !<ColorSpace>\n    name: Linear\n"
        "  - !<ColorSpace>\n    name: Film\n    from_reference: !<FileTransform> {src: film.spi1d, interpolation: linear}\n")
    result = render(viewed(view_transform="Filmic"), "-o", "a.png", "--frames", "12", environment={"OCIO": str(tmp_path / "config.ocio")})
    warned(result, "config.ocio", "Filmic", "is used instead")
