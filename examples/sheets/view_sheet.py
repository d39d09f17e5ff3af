# SPDX-License-Identifier: Apache-2.0
"""A chart of colours under every view transform, as Blender writes it, for scripts/view_sheet.

    blender -b --factory-startup --python-exit-code 1 -P examples/sheets/view_sheet.py -- FOLDER

Patches that shine by themselves, from 2^-9 to 2^6 and more: grey, the hues and skin. FOLDER gets CASE.png as Blender renders
it, without dithering, CASE.exr, the same picture scene-linear in 32-bit floats, for some cases CASE.glb from the add-on, and
cases.json: [{name, view_transform, look, exposure, gamma, display_device, film_exposure, exported}], PATCH pixels a side.
"""
import argparse
import json
import sys
from pathlib import Path

import addon_utils
import bpy

ROOT = Path(__file__).resolve().parents[2]
sys.path[:0] = [str(ROOT / folder) for folder in ("examples", "previewer/evaluate", "blender_addon")]

import common  # noqa: E402
from blender_job import match_picture  # noqa: E402
from cycles_render import match_light_paths, match_sampling  # noqa: E402

COLUMNS, PATCH = 16, 10
LEAST_STOP = -9
TINTS = [(1, 1, 1), (1, 0.02, 0.02), (0.02, 1, 0.02), (0.02, 0.02, 1), (1, 0.9, 0.1), (0.1, 0.9, 1), (0.9, 0.1, 1),
         (0.9, 0.5, 0.35), (0.3, 0.35, 0.4)]


def case(name, view_transform, look="None", exposure=0.0, gamma=1.0, display_device="sRGB", film_exposure=1.0, exported=False):
    return dict(locals())


def cases(scene):
    """Every view of the screen, every look of Filmic, and numbers beside both."""
    views = enum_items(scene.view_settings, "view_transform")
    looks = [look for look in enum_items(scene.view_settings, "look") if look != "None"]
    for view in views:
        yield case(view, view, exported=view in ("Standard", "Filmic", "Raw"))
    for look in looks:
        yield case(f"Filmic, {look}", "Filmic", look)
    yield case("Standard, High Contrast", "Standard", "High Contrast")
    for view in ("Standard", "Filmic"):
        yield case(f"{view}, exposure 1.5", view, exposure=1.5)
        yield case(f"{view}, exposure -3", view, exposure=-3.0)
        yield case(f"{view}, gamma 1.8", view, gamma=1.8)
        yield case(f"{view}, gamma 0.6", view, gamma=0.6)
        yield case(f"{view}, film exposure 2.7", view, film_exposure=2.7, exported=True)
    yield case("Filmic, all at once", "Filmic", "Medium High Contrast", -0.7, 1.3, film_exposure=0.4, exported=True)


def enum_items(settings, name):
    """What Blender lets an enumeration be. Its items are made at run time, so only the refusal of a wrong one lists them."""
    try:
        setattr(settings, name, "?")
    except TypeError as error:
        text = str(error)
        return [item.strip().strip("'") for item in text[text.rindex("(") + 1:text.rindex(")")].split(",")]
    raise RuntimeError(f"{name} takes anything")


def glow(name, color, strength):
    material = bpy.data.materials.new(name)
    material.use_nodes = True
    nodes, links = material.node_tree.nodes, material.node_tree.links
    nodes.remove(nodes["Principled BSDF"])
    emission = nodes.new("ShaderNodeEmission")
    emission.inputs["Color"].default_value = (*color, 1.0)
    emission.inputs["Strength"].default_value = strength
    links.new(emission.outputs["Emission"], nodes["Material Output"].inputs["Surface"])
    return material


def build():
    scene = common.new_scene("Chart")
    # An empty scene begins with factory settings, in which no add-on is enabled.
    addon_utils.enable("bounce", default_set=True)
    common.set_world((0.0, 0.0, 0.0))
    scene.frame_end = 1
    scene.render.resolution_x, scene.render.resolution_y = COLUMNS * PATCH, len(TINTS) * PATCH
    for row, tint in enumerate(TINTS):
        for column in range(COLUMNS):
            x, y = column - COLUMNS / 2, len(TINTS) / 2 - row - 1
            common.quad(f"{row} {column}", [(x, y, 0), (x + 1, y, 0), (x + 1, y + 1, 0), (x, y + 1, 0)],
                        glow(f"{row} {column}", tint, 2.0 ** (LEAST_STOP + column)))
    camera = bpy.data.cameras.new("Camera")
    camera.type, camera.ortho_scale = "ORTHO", COLUMNS
    scene.camera = common.add_object("Camera", camera, (0.0, 0.0, 5.0))
    match_picture(scene, scene.render.resolution_x, scene.render.resolution_y)
    match_sampling(scene)
    match_light_paths(scene.cycles, 0)
    scene.cycles.samples = 16
    scene.render.dither_intensity = 0.0
    return scene


def render(scene, item, folder):
    scene.display_settings.display_device = item["display_device"]
    for name in ("view_transform", "look", "exposure", "gamma"):
        setattr(scene.view_settings, name, item[name])
    scene.cycles.film_exposure = item["film_exposure"]
    settings = scene.render.image_settings
    settings.file_format, settings.color_depth, settings.color_mode = "PNG", "8", "RGB"
    scene.render.filepath = str(folder / f"{item['name']}.png")
    bpy.ops.render.render(write_still=True)
    settings.file_format, settings.color_depth = "OPEN_EXR", "32"
    bpy.data.images["Render Result"].save_render(str(folder / f"{item['name']}.exr"), scene=scene)
    if item["exported"]:
        # Only now: what is imported before it is enabled, Blender takes for changed and loads again.
        from bounce.export import export
        from bounce.options import Options

        export(folder / f"{item['name']}.glb", Options())


def main():
    parser = argparse.ArgumentParser(prog="view_sheet.py")
    parser.add_argument("folder", type=Path)
    arguments = parser.parse_args(sys.argv[sys.argv.index("--") + 1:])
    scene = build()
    done = list(cases(scene))
    for item in done:
        render(scene, item, arguments.folder)
    (arguments.folder / "cases.json").write_text(json.dumps({"patch": PATCH, "cases": done}), encoding="utf-8")


main()
