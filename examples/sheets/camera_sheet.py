# SPDX-License-Identifier: Apache-2.0
"""One small scene for every kind of camera: exported with the add-on and rendered with Cycles, for scripts/camera_sheet.

    blender -b --factory-startup --python-exit-code 1 -P examples/sheets/camera_sheet.py -- FOLDER [CASE ...]

Bright squares stand over black near the frame's corners and in its middle, each turned by a few degrees so that an edge
crosses pixels at every fraction; where clip planes are the matter, a slope runs through both. FOLDER gets CASE.glb,
CASE.FRAME.exr for each frame and cases.json: [{name, frames, size}], the size being that of Blender's own picture.
Settings of Cycles are those of `bounce evaluate` (previewer/evaluate/cycles_render.py), but for the resolution, which is
left as the scene says: percentage, pixel aspect and what they make of the frame are what is to be compared.
"""
import argparse
import json
import math
import sys
from pathlib import Path

import addon_utils
import bpy
from mathutils import Matrix, Vector

ROOT = Path(__file__).resolve().parents[2]
sys.path[:0] = [str(ROOT / folder) for folder in ("examples", "previewer/evaluate", "blender_addon")]
import common  # noqa: E402
from blender_job import match_picture  # noqa: E402
from cycles_render import match_light_paths, match_sampling  # noqa: E402

SAMPLES = 16
TURN_DEG = 8.0
# Of the frame: where squares stand from its middle, and their side as a part of the shorter side.
CORNER, SIDE = 0.36, 0.2
DISTANCE = 6.0
CLIP_START, CLIP_END = 4.0, 9.0

LANDSCAPE, PORTRAIT, SQUARE = (160, 90), (90, 160), (120, 120)


def case(name, size=LANDSCAPE, aspect=(1.0, 1.0), percentage=100, parent=None, clip=False, keys=(), **camera):
    """camera: attributes of Blender's camera. keys: (attribute, value at frame 1, value at frame 5). parent: scale of an
    empty that carries the camera."""
    return {"name": name, "size": size, "aspect": aspect, "percentage": percentage, "parent": parent, "clip": clip,
            "keys": keys, "camera": camera}


def cases():
    ortho = {"type": "ORTHO", "ortho_scale": 7.0}
    for kind, lens in (("perspective", {"lens": 35.0}), ("orthographic", ortho)):
        for fit in ("AUTO", "HORIZONTAL", "VERTICAL"):
            for shape, size in (("landscape", LANDSCAPE), ("portrait", PORTRAIT)):
                yield case(f"{kind}-{fit.lower()}-{shape}", size, sensor_fit=fit, sensor_width=32.0, sensor_height=20.0, **lens)
        yield case(f"{kind}-auto-square", SQUARE, sensor_height=20.0, **lens)
        yield case(f"{kind}-shift-landscape", shift_x=0.31, shift_y=-0.17, **lens)
        yield case(f"{kind}-shift-portrait", PORTRAIT, shift_x=-0.31, shift_y=0.17, **lens)
        yield case(f"{kind}-shift-vertical-fit", sensor_fit="VERTICAL", shift_x=0.31, shift_y=-0.17, **lens)
        yield case(f"{kind}-wide-pixels", aspect=(2.0, 1.0), **lens)
        # Pixels so tall that the frame is upright although it has more columns than rows.
        yield case(f"{kind}-tall-pixels", aspect=(1.0, 2.0), shift_x=0.1, shift_y=0.2, **lens)
        yield case(f"{kind}-tall-pixels-horizontal-fit", aspect=(1.0, 1.5), sensor_fit="HORIZONTAL", shift_y=0.2, **lens)
        yield case(f"{kind}-clip", clip=True, clip_start=CLIP_START, clip_end=CLIP_END, **lens)
    # 300 * 0.41 is less than 123 in floats.
    yield case("percentage-41", (300, 500), percentage=41, lens=35.0)
    yield case("percentage-33", (401, 303), percentage=33, lens=35.0)
    yield case("percentage-150", (107, 61), percentage=150, lens=35.0)
    yield case("angle", lens_unit="FOV", angle=math.radians(63.0))
    yield case("telephoto", lens=400.0)
    yield case("fish-bowl-wide", lens=9.0)
    yield case("scaled-parent", parent=(2.0, 2.0, 2.0), lens=35.0)
    yield case("stretched-parent", parent=(1.0, 1.0, 3.0), lens=35.0)
    yield case("mirrored-parent", parent=(-1.0, 1.0, 1.0), lens=35.0)
    yield case("animated-focal-length", keys=(("lens", 50.0, 28.0),), lens=50.0)
    yield case("animated-shift", keys=(("shift_x", 0.0, 0.09), ("shift_y", 0.0, -0.05)), lens=35.0)
    yield case("animated-scale", keys=(("ortho_scale", 6.0, 9.0),), **ortho)


def bright_material():
    material = bpy.data.materials.new("Bright")
    material.use_nodes = True
    nodes, links = material.node_tree.nodes, material.node_tree.links
    nodes.remove(nodes["Principled BSDF"])
    links.new(nodes.new("ShaderNodeEmission").outputs["Emission"], nodes["Material Output"].inputs["Surface"])
    return material


def make_camera(scene, item):
    data = bpy.data.cameras.new("Camera")
    for attribute, value in item["camera"].items():
        setattr(data, attribute, value)
    camera = common.add_object("Camera", data)
    camera.matrix_world = Matrix.LocRotScale((1.3, -7.2, 2.1), None, None) @ (
        Matrix.Rotation(math.radians(20), 4, "Z") @ Matrix.Rotation(math.radians(81), 4, "X") @ Matrix.Rotation(math.radians(3), 4, "Z"))
    if item["parent"] is not None:
        parent = common.add_object("Parent", None, (0.5, 0.25, 0.0))
        parent.scale = item["parent"]
        camera.parent = parent
    scene.camera = camera
    scene.frame_end = 5 if item["keys"] else 1
    for attribute, first, last in item["keys"]:
        common.key(data, attribute, [(1, first), (5, last)])
    scene.frame_set(1)
    return camera


def frame_at(camera, scene, distance):
    """Middle, half width and half height of the frame at a distance, in the camera's own axes."""
    corners = camera.data.view_frame(scene=scene)
    grow = distance / -corners[0].z if camera.data.type == "PERSP" else 1.0
    xs, ys = [c.x * grow for c in corners], [c.y * grow for c in corners]
    return (Vector(((min(xs) + max(xs)) / 2, (min(ys) + max(ys)) / 2, -distance)),
            (max(xs) - min(xs)) / 2, (max(ys) - min(ys)) / 2)


def placed(name, points, camera, material):
    """A polygon given in the axes of what Cycles takes for the camera: its place and directions without scale. (A mirrored
    one shows its picture mirrored, which squares in the corners cannot tell apart; the turn of their edges can.)"""
    world = camera.matrix_world.copy()
    for column in range(3):
        world.col[column] = world.col[column].normalized()
    common.quad(name, [world @ Vector(point) for point in points], material)


def squares(camera, scene, material):
    for index, (x, y) in enumerate([(0, 0), (-1, -1), (1, -1), (-1, 1), (1, 1)]):
        middle, wide, high = frame_at(camera, scene, DISTANCE + 0.4 * index)
        half = SIDE * min(wide, high)
        middle = middle + Vector((2 * CORNER * wide * x, 2 * CORNER * high * y, 0.0))
        turn = Matrix.Rotation(math.radians(TURN_DEG), 3, "Z")
        placed(f"Square {index}", [middle + turn @ Vector((a * half, b * half, 0.0)) for a, b in ((-1, -1), (1, -1), (1, 1), (-1, 1))],
               camera, material)


def slope(camera, scene, material):
    """A strip that meets the near plane low in the frame and the far one high in it, and goes on behind both."""
    ends = []
    for distance, height in ((CLIP_START, -0.6), (CLIP_END, 0.6)):
        middle, wide, high = frame_at(camera, scene, distance)
        ends.append(middle + Vector((0.0, height * high, 0.0)))
        half = 0.4 * wide if distance == CLIP_START else half
    along = ends[1] - ends[0]
    roll = Matrix.Rotation(math.radians(TURN_DEG), 3, along)
    across = roll @ Vector((half, 0.0, 0.0))
    near, far = ends[0] - 0.15 * along, ends[1] + 0.3 * along
    placed("Slope", [near - across, near + across, far + across, far - across], camera, material)


def build(item):
    scene = common.new_scene(item["name"])
    # An empty scene begins with factory settings, in which no add-on is enabled.
    addon_utils.enable("bounce", default_set=True)
    common.set_world((0.0, 0.0, 0.0))
    scene.render.resolution_x, scene.render.resolution_y = item["size"]
    scene.render.resolution_percentage = item["percentage"]
    scene.render.pixel_aspect_x, scene.render.pixel_aspect_y = item["aspect"]
    camera = make_camera(scene, item)
    bpy.context.view_layer.update()
    (slope if item["clip"] else squares)(camera, scene, bright_material())
    return scene


def render(scene, item, folder):
    """Renders each frame; returns the size of Blender's picture."""
    match_picture(scene, *item["size"])
    scene.render.resolution_percentage = item["percentage"]
    match_sampling(scene)
    match_light_paths(scene.cycles, 0)
    scene.cycles.samples = SAMPLES
    for frame in frames_of(item):
        scene.frame_set(frame)
        scene.render.filepath = str(folder / f"{item['name']}.{frame}.exr")
        bpy.ops.render.render(write_still=True)
    return frame_size(folder / f"{item['name']}.1.exr")


def frame_size(path):
    image = bpy.data.images.load(str(path))
    return list(image.size)


def frames_of(item):
    return [1, 3, 5] if item["keys"] else [1]


def main():
    parser = argparse.ArgumentParser(prog="camera_sheet.py")
    parser.add_argument("folder", type=Path)
    parser.add_argument("cases", nargs="*", metavar="CASE")
    arguments = parser.parse_args(sys.argv[sys.argv.index("--") + 1:])
    known = {item["name"]: item for item in cases()}
    unknown = [name for name in arguments.cases if name not in known]
    if unknown:
        parser.error(f"no case is called {unknown[0]}; there are {', '.join(known)}")
    done = []
    for name in arguments.cases or known:
        scene = build(known[name])
        # Only now: what is imported before it is enabled, Blender takes for changed and loads again.
        from bounce.export import export
        from bounce.options import Options

        export(arguments.folder / f"{name}.glb", Options())
        size = render(scene, known[name], arguments.folder)
        done.append({"name": name, "frames": frames_of(known[name]), "size": size})
    (arguments.folder / "cases.json").write_text(json.dumps(done), encoding="utf-8")


main()
