# SPDX-License-Identifier: Apache-2.0
"""Lights of every type, cameras, world and view, with animated values, at 30 / 1.001 frames a second."""

import math
import sys
from pathlib import Path

import bpy

sys.path.insert(0, str(Path(__file__).resolve().parent))
import truth  # noqa: E402

START, END = 3, 15


def light(name, kind, **settings):
    data = bpy.data.lights.new(name, kind)
    for key, value in settings.items():
        setattr(data, key, value)
    return truth.link(name, data, location=(1, 2, 3), rotation_euler=(0.3, 0.5, 0.7)), data


def animate_lights():
    _, point = light("Point", "POINT", energy=100.0, shadow_soft_size=0.0)
    truth.key(point, "energy", [(START, 100.0), (END, 40.0)])
    truth.key(point, "color", [(START, (1, 1, 1)), (END, (1, 0.2, 0))])
    spot_object, spot = light("Spot", "SPOT", spot_blend=0.3, shadow_soft_size=0.05)
    truth.key(spot_object, "rotation_euler", [(START, (0, 0, 0)), (END, (1, 0.4, 0.2))])
    truth.key(spot, "spot_size", [(START, 0.5), (END, 1.5)])
    truth.key(spot, "energy", [(START, 10.0), (9, 50.0), (END, 20.0)], "CONSTANT")
    driver = spot.driver_add("spot_blend").driver
    driver.expression = "0.5 + 0.01 * frame"
    _, sun = light("Sun", "SUN", energy=3.0)
    truth.key(sun, "angle", [(START, 0.0), (END, 0.2)])
    area_object, area = light("Area", "AREA", shape="RECTANGLE", size=0.5, energy=20.0)
    area_object.scale = (2, 1, 1)
    truth.key(area, "size_y", [(START, 0.25), (END, 1.0)])
    truth.key(area, "spread", [(START, math.pi), (END, 1.0)])
    light("Disk", "AREA", shape="DISK", size=0.7, energy=5.0)
    _, still = light("Still", "POINT", energy=7.0, shadow_soft_size=0.25)
    still.cycles.cast_shadow = False
    still.cycles.max_bounces = 3
    shared = truth.link("Still again", still, location=(0, 0, 4))
    shared.parent = area_object
    _, portal = light("Portal", "AREA")
    portal.cycles.is_portal = True
    _, nodes = light("Nodes", "POINT", energy=10.0, color=(0.5, 1.0, 1.0))
    nodes.use_nodes = True
    nodes.node_tree.nodes["Emission"].inputs["Strength"].default_value = 3.0
    nodes.node_tree.nodes["Emission"].inputs["Color"].default_value = (0.5, 0.25, 1.0, 1.0)
    _, ies = light("IES", "SPOT", energy=10.0)
    ies.use_nodes = True
    texture = ies.node_tree.nodes.new("ShaderNodeTexIES")
    ies.node_tree.links.new(texture.outputs[0], ies.node_tree.nodes["Emission"].inputs["Strength"])
    light("Dark", "POINT", energy=-5.0)
    sheared, _ = light("Sheared", "AREA", shape="SQUARE", size=1.0, energy=8.0)
    sheared.parent = truth.link("Stretched", None, scale=(3, 1, 1))
    pattern("Pattern", "Parametric", "SQUARE")
    pattern("Round pattern", "Parametric", "DISK")
    pattern("Lost pattern", "Position", "SQUARE")


def pattern(name, coordinate, shape):
    """An area light with an image of 2 x 2 pixels: from the lower left red, green, blue and twice white."""
    _, area = light(name, "AREA", shape=shape, size=1.0, energy=8.0, color=(1.0, 0.5, 1.0))
    area.use_nodes = True
    tree = area.node_tree
    texture, geometry = (tree.nodes.new(kind) for kind in ("ShaderNodeTexImage", "ShaderNodeNewGeometry"))
    texture.image = bpy.data.images.new(name, 2, 2, float_buffer=True)
    texture.image.pixels = [1, 0, 0, 1, 0, 1, 0, 1, 0, 0, 1, 1, 2, 2, 2, 1]
    texture.image.pack()
    texture.interpolation = "Linear" if shape == "DISK" else "Closest"
    tree.links.new(geometry.outputs[coordinate], texture.inputs["Vector"])
    tree.links.new(texture.outputs["Color"], tree.nodes["Emission"].inputs["Color"])


def animate_cameras(scene):
    camera = bpy.data.cameras.new("Main camera")
    camera.sensor_width, camera.shift_x = 32.0, 0.1
    obj = truth.link("Main camera", camera, rotation_euler=(1.2, 0, 0.4))
    truth.key(camera, "lens", [(START, 35.0), (END, 80.0)])
    truth.key(camera, "shift_y", [(START, 0.0), (END, 0.2)])
    truth.key(obj, "location", [(START, (0, -8, 2)), (END, (1, -6, 2))])
    camera.dof.use_dof = True
    ortho = bpy.data.cameras.new("Ortho")
    ortho.type, ortho.sensor_fit = "ORTHO", "VERTICAL"
    truth.key(ortho, "ortho_scale", [(START, 4.0), (END, 9.0)])
    truth.link("Ortho", ortho)
    scene.camera = obj


def animate_world(scene):
    world = bpy.data.worlds.new("World")
    world.use_nodes = True
    background = world.node_tree.nodes["Background"]
    background.inputs["Color"].default_value = (0.1, 0.2, 0.4, 1.0)
    truth.key(background.inputs["Strength"], "default_value", [(START, 0.5), (END, 2.0)])
    scene.world = world
    scene.view_settings.exposure = 0.0
    scene.view_settings.keyframe_insert("exposure", frame=START)
    scene.view_settings.exposure = 1.5
    scene.view_settings.keyframe_insert("exposure", frame=END)


def record(depsgraph):
    scene = bpy.context.scene
    cameras = {}
    for obj in bpy.data.objects:
        if obj.type == "CAMERA":
            frame = [list(v) for v in obj.data.view_frame(scene=scene)]
            cameras[obj.name] = {"matrix": truth.matrix_in_gltf(obj.evaluated_get(depsgraph).matrix_world),
                                 "frame": frame, "lens": obj.data.lens, "ortho_scale": obj.data.ortho_scale,
                                 "shift_y": obj.data.shift_y}
    lights = {}
    for obj in bpy.data.objects:
        if obj.type == "LIGHT":
            data = obj.data
            lights[obj.name] = {
                "matrix": truth.matrix_in_gltf(obj.evaluated_get(depsgraph).matrix_world), "data": data.name,
                **{name: getattr(data, name) for name in
                   ("energy", "shadow_soft_size", "spot_size", "spot_blend", "angle", "size", "size_y", "spread")
                   if hasattr(data, name)}, "color": list(data.color)}
    background = scene.world.node_tree.nodes["Background"]
    return {"lights": lights, "cameras": cameras, "world_strength": background.inputs["Strength"].default_value,
            "exposure": scene.view_settings.exposure}


def main():
    scene = truth.new_scene(END, START)
    scene.render.fps, scene.render.fps_base = 30, 1.001
    scene.render.resolution_x, scene.render.resolution_y, scene.render.resolution_percentage = 800, 300, 50
    scene.render.pixel_aspect_x = 1.5
    scene.render.use_motion_blur = True
    scene.cycles.film_exposure = 1.25
    scene.view_settings.look = "High Contrast"
    animate_lights()
    animate_cameras(scene)
    animate_world(scene)
    truth.save((3, 6, 9, 12, 15), record)


main()
