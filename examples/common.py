# SPDX-License-Identifier: Apache-2.0
"""What the example scenes share: an empty scene, meshes, materials, keys and saving."""

import argparse
import math
import os
import sys
import traceback

import bpy
from mathutils import Vector

FRAME_START, FRAME_END, FPS = 1, 48, 24


def new_scene(name):
    """An empty scene with the render settings that all examples have."""
    bpy.ops.wm.read_factory_settings(use_empty=True)
    scene = bpy.context.scene
    scene.name = name
    scene.frame_start, scene.frame_end = FRAME_START, FRAME_END
    scene.render.fps = FPS
    scene.render.engine = "CYCLES"
    scene.render.resolution_x, scene.render.resolution_y = 640, 360
    scene.view_settings.view_transform = "Standard"
    return scene


def set_world(color, strength=1.0):
    world = bpy.data.worlds.new("World")
    world.use_nodes = True
    background = world.node_tree.nodes["Background"]
    background.inputs["Color"].default_value = (*color, 1.0)
    background.inputs["Strength"].default_value = strength
    bpy.context.scene.world = world


def principled(name, color, roughness=0.9, metallic=0.0):
    material = bpy.data.materials.new(name)
    material.use_nodes = True
    shader = material.node_tree.nodes["Principled BSDF"]
    shader.inputs["Base Color"].default_value = (*color, 1.0)
    shader.inputs["Roughness"].default_value = roughness
    shader.inputs["Metallic"].default_value = metallic
    return material


def diffuse(name, color):
    material = bpy.data.materials.new(name)
    material.use_nodes = True
    nodes, links = material.node_tree.nodes, material.node_tree.links
    nodes.remove(nodes["Principled BSDF"])
    shader = nodes.new("ShaderNodeBsdfDiffuse")
    shader.inputs["Color"].default_value = (*color, 1.0)
    links.new(shader.outputs["BSDF"], nodes["Material Output"].inputs["Surface"])
    return material


def add_mesh(name, vertices, faces, material, smooth=False, location=(0.0, 0.0, 0.0)):
    mesh = bpy.data.meshes.new(name)
    mesh.from_pydata(vertices, [], faces)
    mesh.validate()
    mesh.materials.append(material)
    mesh.polygons.foreach_set("use_smooth", [smooth] * len(mesh.polygons))
    return add_object(name, mesh, location)


def add_object(name, data, location=(0.0, 0.0, 0.0)):
    obj = bpy.data.objects.new(name, data)
    obj.location = location
    bpy.context.scene.collection.objects.link(obj)
    return obj


def quad(name, corners, material):
    return add_mesh(name, corners, [(0, 1, 2, 3)], material)


def box(name, size, location, material, bevel=0.0):
    """A box by its full size, standing around `location`; a bevel softens its edges."""
    x, y, z = (s / 2.0 for s in size)
    vertices = [(sx * x, sy * y, sz * z) for sx in (-1, 1) for sy in (-1, 1) for sz in (-1, 1)]
    faces = [(0, 1, 3, 2), (4, 6, 7, 5), (0, 4, 5, 1), (2, 3, 7, 6), (0, 2, 6, 4), (1, 5, 7, 3)]
    obj = add_mesh(name, vertices, faces, material, location=location)
    if bevel > 0.0:
        modifier = obj.modifiers.new("Bevel", "BEVEL")
        modifier.width, modifier.segments = bevel, 3
    return obj


def lathe_geometry(profile, segments):
    """Vertices and faces of a profile of (radius, height) turned about Z."""
    vertices = [
        (r * math.cos(2 * math.pi * s / segments), r * math.sin(2 * math.pi * s / segments), z)
        for r, z in profile for s in range(segments)
    ]
    faces = [
        (ring * segments + s, ring * segments + (s + 1) % segments,
         (ring + 1) * segments + (s + 1) % segments, (ring + 1) * segments + s)
        for ring in range(len(profile) - 1) for s in range(segments)
    ]
    return vertices, faces


def lathe(name, profile, segments, material, location=(0.0, 0.0, 0.0)):
    obj = add_mesh(name, *lathe_geometry(profile, segments), material, smooth=True, location=location)
    soften(obj)
    return obj


def soften(obj, angle_deg=35.0):
    """Smooth shading that stops at edges sharper than this."""
    obj.data.use_auto_smooth = True
    obj.data.auto_smooth_angle = math.radians(angle_deg)


def subdivide(obj, levels):
    modifier = obj.modifiers.new("Subdivision", "SUBSURF")
    modifier.levels = modifier.render_levels = levels


def look_at(obj, target):
    """Turns a camera or a light so that its -Z points at `target`."""
    direction = Vector(target) - Vector(obj.location)
    obj.rotation_euler = direction.to_track_quat("-Z", "Y").to_euler()


def add_light(name, kind, location, energy, color=(1.0, 1.0, 1.0), **settings):
    light = bpy.data.lights.new(name, kind)
    light.energy, light.color = energy, color
    for setting, value in settings.items():
        setattr(light, setting, value)
    return add_object(name, light, location)


def add_camera(location, target, lens):
    camera = bpy.data.cameras.new("Camera")
    camera.lens = lens
    obj = add_object("Camera", camera, location)
    look_at(obj, target)
    bpy.context.scene.camera = obj
    return obj


def key(owner, path, frames_and_values, interpolation="BEZIER"):
    """Keys of one property: [(frame, value), …]."""
    for frame, value in frames_and_values:
        setattr(owner, path, value)
        owner.keyframe_insert(path, frame=frame)
    # Bones and shape keys keep their curves with the data-block that they are part of.
    full_path = path if owner == owner.id_data else owner.path_from_id(path)
    for curve in owner.id_data.animation_data.action.fcurves:
        if curve.data_path == full_path:
            for point in curve.keyframe_points:
                point.interpolation = interpolation


def name_action(owner, name):
    owner.animation_data.action.name = name


def run(build):
    """Builds the scene and writes it to the file named after `--` on the command line."""
    parser = argparse.ArgumentParser(prog=sys.argv[sys.argv.index("-P") + 1])
    parser.add_argument("output", metavar="OUT.blend")
    arguments = parser.parse_args(sys.argv[sys.argv.index("--") + 1:] if "--" in sys.argv else [])
    try:
        build()
        bpy.context.scene.frame_set(FRAME_START)
        bpy.ops.wm.save_as_mainfile(filepath=os.path.abspath(arguments.output), compress=True)
    except Exception:
        # Blender itself exits with 0 after a Python exception.
        traceback.print_exc()
        sys.exit(1)
