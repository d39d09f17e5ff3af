# SPDX-License-Identifier: Apache-2.0
"""Writes down what Blender itself evaluates, for the tests to compare an export with. Runs inside Blender."""

import json
import sys
from pathlib import Path

import bpy


def folder():
    return Path(sys.argv[sys.argv.index("--") + 1])


def new_scene(end=24, start=1):
    bpy.ops.wm.read_factory_settings(use_empty=True)
    scene = bpy.context.scene
    scene.frame_start, scene.frame_end = start, end
    scene.render.engine = "CYCLES"
    return scene


def link(name, data, **settings):
    obj = bpy.data.objects.new(name, data)
    bpy.context.scene.collection.objects.link(obj)
    for key, value in settings.items():
        setattr(obj, key, value)
    return obj


def grid_mesh(name, size=1.0, n=4):
    """A bumpy patch without any symmetry, so that no wrong turn or mirror goes unseen."""
    vertices = [(size * i / n, size * 1.7 * j / n, 0.23 * size * (i * i - 0.5 * i * j) / n)
                for j in range(n + 1) for i in range(n + 1)]
    faces = [(j * (n + 1) + i, j * (n + 1) + i + 1, (j + 1) * (n + 1) + i + 1, (j + 1) * (n + 1) + i)
             for j in range(n) for i in range(n)]
    mesh = bpy.data.meshes.new(name)
    mesh.from_pydata(vertices, [], faces)
    return mesh


def grid(name, **settings):
    return link(name, grid_mesh(name), **settings)


def key(owner, path, frames_and_values, interpolation="BEZIER"):
    for frame, value in frames_and_values:
        setattr(owner, path, value)
        owner.keyframe_insert(path, frame=frame)
    # Bones and shape keys keep their curves with the data-block that they are part of.
    full_path = path if owner == owner.id_data else owner.path_from_id(path)
    for curve in owner.id_data.animation_data.action.fcurves:
        if curve.data_path == full_path:
            for point in curve.keyframe_points:
                point.interpolation = interpolation


def matrix_in_gltf(matrix):
    """Row by row, of something that keeps its own axes, in a world whose Y is up."""
    rows = [list(row) for row in matrix]
    return [rows[0], rows[2], [-v for v in rows[1]], rows[3]]


def clouds(depsgraph):
    """World vertices by object name, instances united, in glTF's axes."""
    result = {}
    for instance in depsgraph.object_instances:
        obj = instance.object
        if obj.type not in {"MESH", "CURVE", "FONT", "SURFACE", "META"}:
            continue
        mesh = obj.to_mesh()
        if mesh is not None and len(mesh.polygons) > 0:
            world = instance.matrix_world.copy()
            points = [world @ v.co for v in mesh.vertices]
            result.setdefault(obj.name, []).extend([p.x, p.z, -p.y] for p in points)
        obj.to_mesh_clear()
    return result


def save(frames, record):
    """Saves the scene, then `record(depsgraph)` at each frame."""
    scene = bpy.context.scene
    scene.frame_set(scene.frame_start)
    bpy.ops.wm.save_as_mainfile(filepath=str(folder() / "scene.blend"))
    at_frame = {}
    for frame in frames:
        scene.frame_set(frame)
        at_frame[str(frame)] = record(bpy.context.evaluated_depsgraph_get())
    (folder() / "truth.json").write_text(json.dumps(at_frame))
