# SPDX-License-Identifier: Apache-2.0
"""A scene full of what need not travel, with what must beside each: twice the same, unread, unseen, still."""

import sys
from pathlib import Path

import bpy

sys.path.insert(0, str(Path(__file__).resolve().parent))
import truth  # noqa: E402

START, END = 1, 4
ROCKS = 8


def material(name, color=(0.8, 0.8, 0.8, 1.0), image=None):
    made = bpy.data.materials.new(name)
    made.use_nodes = True
    shader = made.node_tree.nodes["Principled BSDF"]
    shader.inputs["Base Color"].default_value = color
    if image is not None:
        node = made.node_tree.nodes.new("ShaderNodeTexImage")
        node.image = image
        made.node_tree.links.new(node.outputs["Color"], shader.inputs["Base Color"])
    return made


def picture(name, level=0.2):
    image = bpy.data.images.new(name, 64, 64)
    image.pixels = [v for i in range(64 * 64) for v in ((i * 37 % 101) / 101, (i // 64) / 64, level, 1.0)]
    image.pack()
    return image


def mesh_object(name, operator, slot, location, scale=1.0, **settings):
    operator(location=location, **settings)
    obj = bpy.context.object
    obj.name = name
    obj.scale = (scale,) * 3
    if slot is not None:
        obj.data.materials.append(slot)
    return obj


def layered(obj):
    for name in ("Second UV", "Third UV"):
        obj.data.uv_layers.new(name=name)
    layer = obj.data.color_attributes.new("Paint", "FLOAT_COLOR", "CORNER")
    for i, entry in enumerate(layer.data):
        entry.color = ((i % 7) / 7, (i % 5) / 5, (i % 3) / 3, 1.0)
    return obj


def twice():
    """Rocks of one content and their own mesh each; one of another material, one of another shape."""
    rocks, sphere = bpy.ops.mesh.primitive_ico_sphere_add, {"subdivisions": 4, "radius": 0.3}
    grey, red = material("Grey"), material("Red", (0.7, 0.1, 0.1, 1.0))
    for i in range(ROCKS):
        layered(mesh_object(f"Rock {i}", rocks, grey, (i % 4 - 1.5, i // 4 - 0.5, 0.3), **sphere))
    mesh_object("Red rock", rocks, red, (0.0, 1.5, 0.3), **sphere)
    other = mesh_object("Other rock", rocks, grey, (1.0, 1.5, 0.3), **sphere)
    other.data.vertices[0].co.z -= 0.05


def textured():
    """The same pixels in two images, others in a third."""
    for i, image in enumerate((picture("Wood"), picture("Wood again"), picture("Stone", 0.7))):
        mesh_object(f"Board {i}", bpy.ops.mesh.primitive_plane_add, material(f"Boards {i}", image=image),
                    (i - 1.0, -1.5, 0.2), 0.4)


def half_textured():
    """Of two faces one shows an image."""
    mesh = bpy.data.meshes.new("Half")
    mesh.from_pydata([(0, 0, 0), (0.4, 0, 0), (0.4, 0.4, 0), (0, 0.4, 0), (0.8, 0, 0), (0.8, 0.4, 0)], [],
                     [(0, 1, 2, 3), (1, 4, 5, 2)])
    mesh.uv_layers.new(name="UVMap")
    mesh.materials.append(bpy.data.materials["Boards 2"])
    mesh.materials.append(bpy.data.materials["Grey"])
    mesh.polygons[1].material_index = 1
    truth.link("Half", mesh, location=(1.6, 1.2, 0.2))


def unread():
    for name in ("Nobody's", "Hidden one's"):
        made = material(name, image=picture(f"Image of {name}"))
        made.use_fake_user = True
    picture("Stray").use_fake_user = True
    hidden = mesh_object("Hidden", bpy.ops.mesh.primitive_cube_add, bpy.data.materials["Hidden one's"], (0, 0, 1))
    hidden.hide_render = True
    never = mesh_object("Never", bpy.ops.mesh.primitive_cube_add, None, (0, 0, 1))
    truth.key(never, "hide_render", [(START, True), (END, True)], "CONSTANT")
    blinking = mesh_object("Blinking", bpy.ops.mesh.primitive_cube_add, None, (0.0, 0.0, 1.0), 0.2)
    truth.key(blinking, "hide_render", [(START, True), (3, False)], "CONSTANT")
    truth.link("Empty", None)
    carrier = truth.link("Carrier", None)
    mesh_object("Carried", bpy.ops.mesh.primitive_cube_add, None, (1.8, 0.0, 0.2), 0.2).parent = carrier
    truth.link("No faces", bpy.data.meshes.new("No faces"))


def still():
    obj = mesh_object("Keyed but still", bpy.ops.mesh.primitive_cube_add, None, (-1.8, 1.0, 0.2), 0.2)
    truth.key(obj, "location", [(START, (-1.8, 1.0, 0.2)), (END, (-1.8, 1.0, 0.2))])
    moves = mesh_object("Moves", bpy.ops.mesh.primitive_cube_add, None, (-1.8, 0.0, 0.2), 0.2)
    truth.key(moves, "location", [(START, (-1.8, 0.0, 0.2)), (END, (-1.8, 0.5, 0.2))])


def lights():
    for name, power in (("Lamp", 150.0), ("Dark", 0.0), ("Later", 0.0), ("Negative", -5.0)):
        data = bpy.data.lights.new(name, "POINT")
        data.energy, data.shadow_soft_size = power, 0.0
        truth.link(name, data, location=(0.5, -0.5, 3.0))
    truth.key(bpy.data.lights["Later"], "energy", [(START, 0.0), (END, 100.0)])


def cameras():
    for name, height in (("Camera", 6.0), ("Unused camera", 4.0)):
        truth.link(name, bpy.data.cameras.new(name), location=(0.0, 0.0, height))
    bpy.context.scene.camera = bpy.data.objects["Camera"]


truth.new_scene(END, START)
mesh_object("Floor", bpy.ops.mesh.primitive_plane_add, material("Floor"), (0.0, 0.0, 0.0), 4.0)
twice()
textured()
half_textured()
unread()
still()
lights()
cameras()
bpy.ops.wm.save_as_mainfile(filepath=str(truth.folder() / "scene.blend"))
