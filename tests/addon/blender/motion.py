# SPDX-License-Identifier: Apache-2.0
"""Everything that moves or deforms an object. Frame 5 is the first, so that times show whether they are shifted."""

import math
import sys
from pathlib import Path

import bpy
from mathutils import Matrix

sys.path.insert(0, str(Path(__file__).resolve().parent))
import truth  # noqa: E402

START, END = 5, 28


def keyed():
    obj = truth.grid("Keyed")
    obj.rotation_mode = "ZXY"
    truth.key(obj, "location", [(START, (0, 0, 0)), (15, (1, 2, 3)), (END, (-2, 0, 1))])
    truth.key(obj, "rotation_euler", [(START, (0, 0, 0)), (END, (3.0, -2.0, 7.0))], "LINEAR")
    truth.key(obj, "scale", [(START, (1, 1, 1)), (END, (2.0, -0.5, 1.5))])
    # Crosses zero scale on its way to a mirrored one, off any frame that is compared.
    axis = truth.grid("Axis angle", rotation_mode="AXIS_ANGLE")
    truth.key(axis, "rotation_axis_angle", [(START, (0, 0, 1, 0)), (END, (5.0, 0.3, 1, 0.5))])
    return obj


def parented(parent):
    child = truth.grid("Child", location=(0, 1, 0))
    child.parent = parent
    child.matrix_parent_inverse = Matrix.Translation((0.3, -0.2, 0.1)) @ Matrix.Rotation(0.4, 4, "X")
    truth.key(child, "location", [(START, (0, 1, 0)), (END, (1, 1, 1))])
    grandchild = truth.grid("Grandchild", location=(0.5, 0, 0))
    grandchild.parent = child


def constrained(target):
    copier = truth.grid("Constrained", location=(5, 0, 0))
    constraint = copier.constraints.new("COPY_LOCATION")
    constraint.target, constraint.influence = target, 0.6
    tracker = truth.grid("Tracker", location=(3, 3, 0))
    constraint = tracker.constraints.new("TRACK_TO")
    constraint.target, constraint.track_axis, constraint.up_axis = target, "TRACK_X", "UP_Z"


def driven(target):
    obj = truth.grid("Driven")
    driver = obj.driver_add("location", 0).driver
    variable = driver.variables.new()
    variable.type = "TRANSFORMS"
    variable.targets[0].id, variable.targets[0].transform_type = target, "LOC_Z"
    driver.expression = f"{variable.name} * 2 + 1"


def in_strips():
    obj = truth.grid("Strips")
    truth.key(obj, "location", [(1, (0, 0, 0)), (10, (4, 0, 0))], "LINEAR")
    action = obj.animation_data.action
    obj.animation_data.action = None
    for i, start in enumerate((START, 16)):
        strip = obj.animation_data.nla_tracks.new().strips.new(f"Strip {i}", start, action)
        strip.blend_type, strip.scale = "ADD", 0.8


def mesh_of_column(name, rings=12):
    vertices, faces = [], []
    for ring in range(rings + 1):
        for s in range(6):
            angle = s * math.pi / 3
            vertices.append((0.3 * math.cos(angle), (0.2 + 0.01 * ring) * math.sin(angle), 2.0 * ring / rings))
    for ring in range(rings):
        for s in range(6):
            a, b = ring * 6 + s, ring * 6 + (s + 1) % 6
            faces.append((a, b, b + 6, a + 6))
    mesh = bpy.data.meshes.new(name)
    mesh.from_pydata(vertices, [], faces)
    return mesh


def skinned():
    armature = bpy.data.armatures.new("Bones")
    rig = truth.link("Rig", armature, location=(1, 0, 0), rotation_euler=(0.2, 0.1, 0.5), scale=(1.2, 1.2, 1.2))
    bpy.context.view_layer.objects.active = rig
    bpy.ops.object.mode_set(mode="EDIT")
    parent = None
    for i, name in enumerate(("Lower", "Middle", "Upper")):
        bone = armature.edit_bones.new(name)
        bone.head, bone.tail = (0, 0.05 * i, 0.66 * i), (0, 0.05 * (i + 1), 0.66 * (i + 1))
        bone.roll = 0.3 * i
        bone.parent = parent
        parent = bone
    bpy.ops.object.mode_set(mode="OBJECT")
    mesh = truth.link("Skinned", mesh_of_column("Skinned"), location=(0.05, 0, 0.02), rotation_euler=(0, 0, 0.2))
    mesh.parent = rig
    mesh.modifiers.new("Armature", "ARMATURE").object = rig
    groups = {bone.name: mesh.vertex_groups.new(name=bone.name) for bone in armature.bones}
    for vertex in mesh.data.vertices:
        t = min(vertex.co.z, 1.999)
        weights = {"Lower": max(0.0, 1.0 - t), "Middle": 1.0 - abs(1.0 - t), "Upper": max(0.0, t - 1.0)}
        for name, weight in weights.items():
            if weight > 0.0:
                groups[name].add([vertex.index], weight, "REPLACE")
    mesh.shape_key_add(name="Basis")
    fat = mesh.shape_key_add(name="Fat")
    for point in fat.data:
        point.co.x *= 1.6
    truth.key(fat, "value", [(START, 0.0), (END, 1.0)])
    for bone, turn in (("Middle", (0.7, 0.2, 0.0)), ("Upper", (-0.4, 0.0, 0.9))):
        pose = rig.pose.bones[bone]
        pose.rotation_mode = "XYZ"
        truth.key(pose, "rotation_euler", [(START, (0.1, 0, 0)), (END, turn)])
    truth.key(rig.pose.bones["Upper"], "location", [(START, (0, 0, 0)), (END, (0.1, 0.2, 0))])
    truth.key(rig, "location", [(START, (1, 0, 0)), (END, (2, 1, 0))])
    hat = truth.grid("On bone", scale=(0.3, 0.3, 0.3), location=(0, 0.1, 0))
    hat.parent, hat.parent_type, hat.parent_bone = rig, "BONE", "Upper"


def morphed():
    obj = truth.grid("Morphed", location=(-3, 0, 0))
    obj.shape_key_add(name="Basis")
    for name, axis in (("Up", 2), ("Out", 0)):
        shape = obj.shape_key_add(name=name)
        for i, point in enumerate(shape.data):
            point.co[axis] += 0.1 * (i % 5)
    blocks = obj.data.shape_keys.key_blocks
    truth.key(blocks["Up"], "value", [(START, 0.0), (16, 1.0), (END, 0.2)])
    blocks["Out"].value = 0.35
    # In the viewport coarser than in the render: the export must take the render's.
    modifier = obj.modifiers.new("Subdivision", "SUBSURF")
    modifier.levels, modifier.render_levels = 0, 1


def converted():
    curve = bpy.data.curves.new("Curve", "CURVE")
    curve.dimensions, curve.bevel_depth = "3D", 0.1
    spline = curve.splines.new("BEZIER")
    spline.bezier_points.add(2)
    for point, co in zip(spline.bezier_points, ((0, 0, 0), (1, 1, 0), (2, 0, 1))):
        point.co, point.handle_left_type, point.handle_right_type = co, "AUTO", "AUTO"
    obj = truth.link("Curve", curve, location=(0, -4, 0))
    truth.key(obj, "location", [(START, (0, -4, 0)), (END, (1, -4, 2))])
    below = truth.grid("Under curve", location=(0, 0, 1))
    below.parent = obj
    text = bpy.data.curves.new("Text", "FONT")
    text.body, text.extrude = "ab", 0.1
    truth.link("Text", text, location=(4, -4, 0), rotation_euler=(1.2, 0, 0))
    meta = bpy.data.metaballs.new("Meta")
    meta.elements.new().radius = 1.0
    truth.link("Meta", meta, location=(-4, -4, 0))


def instanced():
    collection = bpy.data.collections.new("Crowd")
    collection.instance_offset = (0.5, 0.2, 0.1)
    member = bpy.data.objects.new("Member", truth.grid_mesh("Member"))
    member.location = (0.5, 0.5, 0.5)
    truth.key(member, "rotation_euler", [(START, (0, 0, 0)), (END, (0, 0, 2))])
    follower = bpy.data.objects.new("Follower", truth.grid_mesh("Follower"))
    follower.parent, follower.location = member, (0, 0, 1)
    for obj in (member, follower):
        collection.objects.link(obj)
    for i in range(2):
        empty = truth.link(f"Instance {i}", None, location=(6 + 3 * i, 0, 0), rotation_euler=(0, 0.3 * i, 0.5))
        empty.instance_type, empty.instance_collection = "COLLECTION", collection
        truth.key(empty, "location", [(START, (6 + 3 * i, 0, 0)), (END, (6 + 3 * i, 2, i))])


def on_vertices():
    """Instances on the vertices of a moving mesh that is itself not drawn."""
    parent = truth.grid("Instancer", location=(12, 0, 0))
    parent.instance_type, parent.show_instancer_for_render = "VERTS", False
    parent.show_instancer_for_viewport = False
    truth.key(parent, "rotation_euler", [(START, (0, 0, 0)), (END, (0.3, 0, 1))])
    truth.grid("On vertices", scale=(0.1, 0.1, 0.1)).parent = parent


def unparented_skin():
    """Deformed by an armature that is hidden in renders and that the mesh is not a child of."""
    armature = bpy.data.armatures.new("Loose bones")
    rig = truth.link("Loose rig", armature, location=(12, 6, 0), rotation_euler=(0, 0.3, 0))
    bpy.context.view_layer.objects.active = rig
    bpy.ops.object.mode_set(mode="EDIT")
    bone = armature.edit_bones.new("Bone")
    bone.head, bone.tail = (0, 0, 0), (0, 0, 1)
    bpy.ops.object.mode_set(mode="OBJECT")
    rig.hide_render = True
    truth.key(rig.pose.bones["Bone"], "rotation_quaternion", [(START, (1, 0, 0, 0)), (END, (0.8, 0.6, 0, 0))])
    mesh = truth.grid("Loose skin", location=(12, 6, 0.2))
    mesh.vertex_groups.new(name="Bone").add(range(20), 1.0, "REPLACE")
    # The last five vertices have no weight and stay where they are.
    mesh.modifiers.new("Armature", "ARMATURE").object = rig


def linked():
    """Objects out of a library file: their data cannot be edited, and must export all the same."""
    library = truth.folder() / "library.blend"
    for name, kind in (("Linked", "MESH"), ("Linked curve", "CURVE")):
        collection = bpy.data.collections.new(name)
        if kind == "MESH":
            obj = bpy.data.objects.new(name, truth.grid_mesh(name))
            obj.modifiers.new("Subdivision", "SUBSURF").levels = 2
        else:
            curve = bpy.data.curves.new(name, "CURVE")
            curve.dimensions, curve.extrude = "2D", 0.2
            curve.splines.new("POLY").points.add(2)
            for point, co in zip(curve.splines[0].points, ((0, 0, 0, 1), (1, 0, 0, 1), (0, 2, 0, 1))):
                point.co = co
            curve.splines[0].use_cyclic_u = True
            obj = bpy.data.objects.new(name, curve)
        material = bpy.data.materials.new(f"{name} diffuse")
        material.use_nodes = True
        diffuse = material.node_tree.nodes.new("ShaderNodeBsdfDiffuse")
        diffuse.inputs["Color"].default_value = (0.1, 0.2, 0.3, 1)
        material.node_tree.links.new(diffuse.outputs[0], material.node_tree.nodes["Material Output"].inputs[0])
        obj.data.materials.append(material)
        collection.objects.link(obj)
        bpy.data.libraries.write(str(library.with_stem(name)), {collection})
        bpy.data.collections.remove(collection)
        bpy.data.objects.remove(obj)
        bpy.data.materials.remove(material)
        with bpy.data.libraries.load(str(library.with_stem(name)), link=True) as (_, target):
            target.collections = [name]
        instance = truth.link(f"Instance of {name}", None, location=(16, 0, 0))
        instance.instance_type, instance.instance_collection = "COLLECTION", target.collections[0]


def blinking():
    obj = truth.grid("Blinking", location=(0, 6, 0))
    truth.key(obj, "hide_render", [(START, True), (12, False), (20, True)])
    child = truth.grid("Child of blinking", location=(1, 0, 0))
    child.parent = obj


def hidden():
    parent = truth.grid("Hidden in render", hide_render=True, location=(0, 0, 3))
    truth.key(parent, "location", [(START, (0, 0, 3)), (END, (0, 1, 3))])
    child = truth.grid("Child of hidden", location=(5, 8, 0))
    child.parent = parent
    truth.grid("Hidden in viewport", location=(0, 8, 0)).hide_viewport = True
    truth.grid("Eye closed", location=(2, 8, 0)).hide_set(True)
    collection = bpy.data.collections.new("Excluded")
    bpy.context.scene.collection.children.link(collection)
    collection.objects.link(bpy.data.objects.new("In excluded collection", truth.grid_mesh("x")))
    bpy.context.view_layer.layer_collection.children["Excluded"].exclude = True


def deforming():
    wave = truth.grid("Waving", location=(0, 10, 0))
    wave.modifiers.new("Wave", "WAVE")
    parent = truth.link("Stretched", None, scale=(3, 1, 1), location=(3, 10, 0))
    sheared = truth.grid("Sheared")
    sheared.parent = parent
    truth.key(sheared, "rotation_euler", [(START, (0, 0, 0)), (END, (0, 0, 0.8))])
    # Under its parent a sheared object can still be said; one that has the shear to itself cannot.
    truth.grid("Shear copied").constraints.new("COPY_TRANSFORMS").target = sheared


def still():
    truth.grid("Still", location=(0, -8, 0))


def main():
    truth.new_scene(END, START)
    moving = keyed()
    parented(moving)
    constrained(moving)
    driven(moving)
    in_strips()
    skinned()
    morphed()
    converted()
    instanced()
    on_vertices()
    unparented_skin()
    linked()
    blinking()
    hidden()
    deforming()
    still()

    def render_levels(depsgraph):
        # What the render would see: its levels, and all that only the viewport hides.
        bpy.data.objects["Morphed"].modifiers["Subdivision"].levels = 1
        bpy.data.metaballs["Meta"].resolution = bpy.data.metaballs["Meta"].render_resolution
        bpy.data.objects["Hidden in viewport"].hide_viewport = False
        bpy.data.objects["Eye closed"].hide_set(False)
        bpy.context.view_layer.update()
        return truth.clouds(bpy.context.evaluated_depsgraph_get())

    truth.save((5, 9, 15, 22, 28), render_levels)


main()
