# SPDX-License-Identifier: GPL-3.0-or-later
"""What in the open scene has no words in the file, by the object's name."""

from . import read_lights, read_world
from .visibility import animated_paths

_UNSUPPORTED_TYPES = {"CURVES": "hair curves", "POINTCLOUD": "point cloud", "VOLUME": "volume", "GPENCIL": "grease pencil",
                      "LIGHT_PROBE": None}
_RAY_FLAGS = {"visible_camera": "camera", "visible_diffuse": "diffuse", "visible_glossy": "glossy",
              "visible_shadow": "shadow"}
# Cosine between the axes of an area light from which a shear shows.
_LEAST_SHEAR = 1e-3
_SIMULATIONS = {"CLOTH": "cloth", "SOFT_BODY": "soft body", "FLUID": "fluid", "EXPLODE": "explode"}


def scene_issues(scene, view_layer):
    if scene.render.use_motion_blur:
        yield scene.name, "motion blur"
    if scene.view_settings.use_curve_mapping:
        yield scene.name, "view curves"
    if any(marker.camera is not None and marker.camera != scene.camera for marker in scene.timeline_markers):
        yield scene.name, "the active camera changes at timeline markers"
    if scene.world is not None:
        for what in read_world.issues(scene.world):
            yield scene.name, what
        tree = scene.world.node_tree if scene.world.use_nodes else None
        if tree is not None:
            for path in sorted(animated_paths(tree)):
                if not _is_background_input(path, tree):
                    yield scene.name, f"world '{scene.world.name}': animation of {path}"
    for path in sorted(animated_paths(scene)):
        if path != "view_settings.exposure" and _matters(path):
            yield scene.name, f"animation of {path}"
    yield from _layer_issues(view_layer.layer_collection)


def _matters(scene_path):
    """Of the scene's properties, those that change a picture."""
    return scene_path.startswith(("cycles.film", "render.resolution", "view_settings", "render.pixel_aspect"))


def _is_background_input(path, tree):
    return any(path.startswith(f'nodes["{node.name}"]') for node in tree.nodes
               if node.type in {"BACKGROUND", "RGB", "VALUE"}) or any(
        # The third of a Mapping's inputs is its rotation.
        path.startswith(f'nodes["{node.name}"].inputs[2]') for node in tree.nodes if node.type == "MAPPING")


def _layer_issues(layer_collection):
    for attribute, words in (("holdout", "holdout"), ("indirect_only", "indirect only")):
        if getattr(layer_collection, attribute):
            for obj in layer_collection.collection.all_objects:
                yield obj.name, f"{words} (collection '{layer_collection.collection.name}')"
    for child in layer_collection.children:
        yield from _layer_issues(child)


def object_issues(obj):
    if _UNSUPPORTED_TYPES.get(obj.type):
        yield _UNSUPPORTED_TYPES[obj.type]
    if obj.type in {"MESH", "CURVE", "SURFACE", "FONT", "META"}:
        for attribute, words in (("is_holdout", "holdout"), ("is_shadow_catcher", "shadow catcher")):
            if getattr(obj, attribute):
                yield words
        hidden = [words for attribute, words in _RAY_FLAGS.items() if not getattr(obj, attribute)]
        if hidden:
            yield "not visible to " + ", ".join(hidden) + " rays"
    linking = getattr(obj, "light_linking", None)
    if linking is not None and (linking.receiver_collection or linking.blocker_collection):
        yield "light linking"
    for system in obj.particle_systems:
        yield f"particle system '{system.name}'"
    for modifier in obj.modifiers:
        if modifier.show_render:
            yield from _modifier_issues(obj, modifier)
    if obj.type == "MESH" and obj.data.shape_keys is not None:
        yield from _shape_key_issues(obj.data.shape_keys)
    if obj.type == "ARMATURE" and any(bone.bbone_segments > 1 for bone in obj.data.bones):
        yield "bendy bones"
    if obj.type == "CAMERA":
        yield from _camera_issues(obj.data)
    if obj.type == "LIGHT":
        if read_lights.is_portal(obj.data):
            return
        yield from read_lights.issues(obj.data)
        axes = [obj.matrix_world.col[axis].xyz.normalized() for axis in (0, 1)]
        if obj.data.type == "AREA" and abs(axes[0].dot(axes[1])) > _LEAST_SHEAR:
            yield f"light '{obj.data.name}': sheared by its parent, and then elsewhere for each receiver in Cycles"
        if obj.data.use_nodes and obj.data.node_tree is not None:
            for path in sorted(animated_paths(obj.data.node_tree)):
                if "Emission" not in path and "inputs" not in path:
                    yield f"light '{obj.data.name}': animation of {path}"


def _modifier_issues(obj, modifier):
    if modifier.type == "ARMATURE" and modifier.object is not None:
        if modifier.use_deform_preserve_volume:
            yield f"modifier '{modifier.name}': Preserve Volume (exported as linear skinning)"
        if modifier.use_bone_envelopes:
            yield f"modifier '{modifier.name}': bone envelopes"
        crowded = _vertices_of_many_bones(obj, modifier.object)
        if crowded:
            yield f"{crowded} vertices moved by more than four bones, of which the four strongest are exported"
        if modifier.vertex_group:
            yield f"modifier '{modifier.name}': vertex group mask"
    elif modifier.type in _SIMULATIONS:
        yield f"{_SIMULATIONS[modifier.type]} simulation, exported as it is at the first frame"


def _vertices_of_many_bones(obj, armature):
    if obj.type != "MESH":
        return 0
    bones = {group.index for group in obj.vertex_groups if group.name in armature.data.bones}
    return sum(
        sum(1 for entry in vertex.groups if entry.group in bones and entry.weight > 0.0) > 4
        for vertex in obj.data.vertices
    )


def _shape_key_issues(keys):
    if not keys.use_relative:
        yield "absolute shape keys"
    basis = keys.reference_key
    for key in keys.key_blocks:
        if key != basis and key.relative_key != basis and key.relative_key != key:
            yield f"shape key '{key.name}' is relative to '{key.relative_key.name}', not to the basis"


def _camera_issues(camera):
    if camera.type == "PANO":
        yield "panoramic camera"
    if camera.dof.use_dof:
        yield "depth of field"


def instancing_issues(depsgraph, visibility):
    """Instances that no exported node makes: those of geometry nodes."""
    named = set()
    for instance in depsgraph.object_instances:
        if not instance.is_instance or instance.parent is None:
            continue
        parent = instance.parent.original
        if instance.object.original == parent:
            # The mesh of a curve, text or metaball comes as an instance of itself.
            continue
        if parent.as_pointer() in visibility.objects and not parent.is_instancer and parent.name not in named:
            named.add(parent.name)
            yield parent.name, "instances made by geometry nodes"
