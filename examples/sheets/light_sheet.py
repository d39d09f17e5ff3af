# SPDX-License-Identifier: Apache-2.0
"""One small scene for every kind of light and setting: exported with the add-on and rendered with Cycles, for
scripts/light_sheet.

    blender -b --factory-startup --python-exit-code 1 -P examples/sheets/light_sheet.py -- FOLDER [--samples 1024] [CASE ...]

Each case is examples/sheets/light_stage.py under its lights, direct light alone. FOLDER gets CASE.glb, CASE.exr and
cases.json: [{name, soft}]. A reference whose case, samples, size and scripts are those of CASE.key is kept.
Settings of Cycles are those of `bounce evaluate` (previewer/evaluate/cycles_render.py).
"""
import argparse
import hashlib
import json
import math
import sys
from pathlib import Path

import addon_utils
import bpy

ROOT = Path(__file__).resolve().parents[2]
sys.path[:0] = [str(ROOT / folder) for folder in ("examples", "examples/sheets", "previewer/evaluate", "blender_addon")]
import common  # noqa: E402
import light_stage  # noqa: E402
from blender_job import match_picture  # noqa: E402
from cycles_render import match_light_paths, match_sampling  # noqa: E402
from light_stage import ABOVE, ASIDE, TARGET  # noqa: E402

WIDTH, HEIGHT = 320, 180
SOURCES = ("examples/sheets/light_stage.py", "examples/common.py",
           "previewer/evaluate/cycles_render.py", "previewer/evaluate/blender_job.py")
FACING = {"POINT": 250.0, "SPOT": 500.0, "SUN": 3.0, "AREA": 250.0}


def light(kind, place=None, energy=None, color=(1.0, 1.0, 1.0), scale=(1.0, 1.0, 1.0), parent=None, image=False, **settings):
    """parent: scale of an empty, turned about Z, that carries the light; image: an area light shines with light_image()."""
    place = place or (ABOVE if kind in ("POINT", "AREA") else ASIDE)
    return {"kind": kind, "place": place, "energy": FACING[kind] if energy is None else energy, "color": color, "scale": scale,
            "parent": parent, "settings": settings, **({"image": True} if image else {})}


def light_image():
    """Red to the left, green to the right, bluer upwards, and a dark bar across."""
    side = 64
    image = bpy.data.images.new("Light", side, side, float_buffer=True)
    pixels = []
    for y in range(side):
        for x in range(side):
            u, v = (x + 0.5) / side, (y + 0.5) / side
            lit = 0.0 if 0.4 < v < 0.6 else 1.0
            pixels += [lit * 2.0 * (1.0 - u) ** 2, lit * u, lit * v * v, 1.0]
    image.pixels = pixels
    image.pack()
    return image


def shine_with_image(data):
    data.use_nodes = True
    tree = data.node_tree
    texture, geometry = (tree.nodes.new(kind) for kind in ("ShaderNodeTexImage", "ShaderNodeNewGeometry"))
    texture.image = light_image()
    tree.links.new(geometry.outputs["Parametric"], texture.inputs["Vector"])
    tree.links.new(texture.outputs["Color"], tree.nodes["Emission"].inputs["Color"])


def point(radius=0.0, **more):
    return light("POINT", shadow_soft_size=radius, **more)


def spot(size_deg=60.0, radius=0.0, blend=0.15, **more):
    return light("SPOT", shadow_soft_size=radius, spot_size=math.radians(size_deg), spot_blend=blend, **more)


def sun(angle_deg=0.0, **more):
    return light("SUN", angle=math.radians(angle_deg), **more)


def area(shape, size, size_y=None, **more):
    return light("AREA", shape=shape, size=size, **({} if size_y is None else {"size_y": size_y}), **more)


def case(name, *lights, gloss=None):
    return {"name": name, "lights": lights, "gloss": gloss}


def cases():
    yield case("point-hard", point())
    yield case("point-small", point(0.05))
    yield case("point-large", point(0.4))
    yield case("point-among", point(0.12, place=(-0.2, 0.5, 0.9), energy=60.0))
    yield case("point-coloured", point(0.1, color=(1.0, 0.25, 0.05)))
    yield case("point-scaled", point(0.2, scale=(3.0, 3.0, 3.0)))
    yield case("point-no-shadow", point(0.2, use_shadow=False))
    yield case("spot-hard", spot(blend=0.0))
    yield case("spot-blend", spot(blend=0.5))
    yield case("spot-blend-one", spot(blend=1.0))
    yield case("spot-narrow", spot(15.0, blend=0.3))
    yield case("spot-wide", spot(140.0, blend=0.2))
    yield case("spot-180", spot(180.0, blend=0.15))
    yield case("spot-small", spot(radius=0.05))
    yield case("spot-large", spot(radius=0.35))
    yield case("spot-large-narrow", spot(15.0, radius=0.35, blend=0.3))
    yield case("spot-scaled", spot(40.0, radius=0.1, scale=(2.0, 1.0, 1.0)))
    yield case("sun-hard", sun())
    yield case("sun-half", sun(0.5))
    yield case("sun-ten", sun(10.0))
    yield case("sun-low", sun(2.0, place=(-5.0, 1.0, 1.0)))
    yield case("area-square", area("SQUARE", 0.8))
    yield case("area-rectangle", area("RECTANGLE", 2.0, 0.2))
    yield case("area-disk", area("DISK", 1.0))
    yield case("area-ellipse", area("ELLIPSE", 1.6, 0.4))
    yield case("area-square-stretched", area("SQUARE", 0.5, scale=(3.0, 0.5, 1.0)))
    yield case("area-disk-stretched", area("DISK", 0.5, scale=(3.0, 0.5, 1.0)))
    yield case("area-spread-120", area("SQUARE", 0.8, spread=math.radians(120), energy=100.0))
    yield case("area-spread-70", area("SQUARE", 0.8, spread=math.radians(70), energy=60.0))
    yield case("area-disk-spread", area("DISK", 0.8, spread=math.radians(70), energy=60.0))
    yield case("area-low", area("SQUARE", 1.0, place=(-0.9, 0.0, 0.7), energy=40.0))
    yield case("area-coloured", area("SQUARE", 0.4, color=(0.1, 0.4, 1.0)))
    yield case("area-parented", area("RECTANGLE", 0.6, 0.3, parent=(2.0, 2.0, 2.0)))
    yield case("area-sheared", area("RECTANGLE", 0.6, 0.3, parent=(2.0, 1.0, 1.0)))
    yield case("area-mirrored", area("RECTANGLE", 0.6, 0.3, parent=(-1.0, 1.0, 1.0)))
    yield case("area-image", area("RECTANGLE", 2.0, 1.2, image=True))
    yield case("area-image-low", area("SQUARE", 1.0, place=(-0.9, 0.0, 0.7), energy=40.0, image=True))
    yield case("area-image-disk", area("DISK", 1.0, image=True))
    yield case("several", point(0.1, energy=80.0, color=(1.0, 0.6, 0.3)), spot(50.0, energy=200.0, color=(0.3, 0.5, 1.0)),
               area("DISK", 0.5, place=(1.5, 1.2, 2.5), energy=60.0), sun(1.0, energy=0.4, place=(2.0, -3.0, 4.0)))
    # What a user may set but hardly means. Cycles' picture says what it does.
    lit = point(place=(1.5, 1.2, 2.5), energy=80.0)
    yield case("zero-power", point(energy=0.0), lit)
    yield case("negative-power-point", point(energy=-60.0), lit)
    yield case("negative-power-area", area("SQUARE", 0.8, energy=-60.0), lit)
    yield case("negative-power-sun", sun(energy=-0.3), lit)
    yield case("zero-size-area", area("SQUARE", 0.0), lit)
    yield case("zero-scale-area", area("SQUARE", 0.8, scale=(0.0, 0.0, 0.0)), lit)
    yield case("flat-scale-area", area("SQUARE", 0.8, scale=(1.0, 0.0, 1.0)), lit)
    yield case("zero-scale-spot", spot(scale=(0.0, 0.0, 0.0)), lit)
    yield case("zero-spread-area", area("SQUARE", 0.8, spread=0.0, energy=20.0), lit)
    yield case("sun-180", sun(180.0))
    yield case("black-light", point(color=(0.0, 0.0, 0.0)), lit)
    yield case("gloss-point", point(0.4), gloss=(0.3, 0.0))
    yield case("gloss-area", area("RECTANGLE", 2.0, 0.2), gloss=(0.25, 0.0))
    yield case("gloss-disk", area("DISK", 1.0), gloss=(0.4, 1.0))
    yield case("gloss-sun", sun(10.0, place=(-3.0, 4.0, 3.6)), gloss=(0.2, 0.0))


def has_size(item):
    """Whether it throws penumbrae; a hard light's limit is the stricter one."""
    sizes = {"POINT": "shadow_soft_size", "SPOT": "shadow_soft_size", "SUN": "angle", "AREA": "size"}
    return any(one["settings"][sizes[one["kind"]]] > 0.0 and one["settings"].get("use_shadow", True) for one in item["lights"])


def add(index, item):
    made = common.add_light(f"{item['kind'].title()} {index}", item["kind"], item["place"], item["energy"], item["color"],
                            **item["settings"])
    common.look_at(made, TARGET)
    made.scale = item["scale"]
    if item.get("image"):
        shine_with_image(made.data)
    if item["parent"] is not None:
        parent = common.add_object("Parent", None, (0.5, 0.25, 0.0))
        parent.scale = item["parent"]
        parent.rotation_euler = (0.0, 0.0, 0.4)
        made.parent = parent


def build(item):
    scene = light_stage.build(item["name"], item["gloss"])
    # An empty scene begins with factory settings, in which no add-on is enabled.
    addon_utils.enable("bounce", default_set=True)
    for index, one in enumerate(item["lights"]):
        add(index, one)
    return scene


def render(scene, samples, output):
    match_picture(scene, WIDTH, HEIGHT)
    match_sampling(scene)
    match_light_paths(scene.cycles, 0)
    scene.cycles.samples = samples
    scene.render.filepath = str(output)
    bpy.ops.render.render(write_still=True)


def key_of(item, samples):
    digest = hashlib.sha256(json.dumps([item, samples, WIDTH, HEIGHT, bpy.app.version_string]).encode())
    for source in SOURCES:
        digest.update((ROOT / source).read_bytes())
    return digest.hexdigest()


def main():
    parser = argparse.ArgumentParser(prog="light_sheet.py")
    parser.add_argument("folder", type=Path)
    parser.add_argument("--samples", type=int, default=1024)
    parser.add_argument("cases", nargs="*", metavar="CASE")
    arguments = parser.parse_intermixed_args(sys.argv[sys.argv.index("--") + 1:])
    known = {item["name"]: item for item in cases()}
    unknown = [name for name in arguments.cases if name not in known]
    if unknown:
        parser.error(f"no case is called {unknown[0]}; there are {', '.join(known)}")
    done = []
    for name in arguments.cases or known:
        item = known[name]
        scene = build(item)
        # Only now: what is imported before it is enabled, Blender takes for changed and loads again.
        from bounce.export import export
        from bounce.options import Options

        export(arguments.folder / f"{name}.glb", Options())
        key, stamp = key_of(item, arguments.samples), arguments.folder / f"{name}.key"
        if not stamp.exists() or stamp.read_text(encoding="utf-8") != key:
            render(scene, arguments.samples, arguments.folder / f"{name}.exr")
            stamp.write_text(key, encoding="utf-8")
        done.append({"name": name, "soft": has_size(item)})
    (arguments.folder / "cases.json").write_text(json.dumps(done), encoding="utf-8")


main()
