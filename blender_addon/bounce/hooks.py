# SPDX-License-Identifier: GPL-3.0-or-later
"""The hooks that Blender's glTF exporter calls. It only prints what a hook raises; here the first failure is kept, and
export.py turns it into a failed export."""

import functools

from . import (
    animation, context, document, duplicates, gltf_materials, lights, omissions, read_scene, transforms, tree_filter,
)
from .animation import Channel
from .pointers import Pointer
from .stepping import is_stepped, object_is_stepped
from .tracks import is_constant


def _hook(function):
    @functools.wraps(function)
    def guarded(self, *arguments):
        export = context.current()
        if export is None or export.failure is not None:
            return
        try:
            function(self, export, *arguments)
        except Exception as error:
            export.failure = error
            raise

    return guarded


class glTF2ExportUserExtension:
    @_hook
    def gather_tree_filter_tag_hook(self, export, vtree, export_settings):
        tree_filter.tag(vtree, export)

    @_hook
    def gather_node_hook(self, export, node, blender_object, export_settings):
        replaced = export.prepared.source.get(blender_object.as_pointer())
        if replaced is not None:
            node.name = export.visibility.objects[replaced].name
        if blender_object.type == "LIGHT":
            light = blender_object.data
            export.light_nodes.setdefault(light.as_pointer(), []).append((light, node))
        visible = export.samples.visible.get(export.source_of(blender_object))
        if visible is not None and not is_constant(visible) and tree_filter.is_rendered(blender_object):
            node.extensions = {**(node.extensions or {}), "KHR_node_visibility": {"visible": bool(visible[0])}}

    @_hook
    def gather_camera_hook(self, export, camera, blender_camera, export_settings):
        key = blender_camera.as_pointer()
        export.cameras[key] = (blender_camera, camera)
        values = export.samples.at_start("camera", key)
        camera.extensions = {
            **(camera.extensions or {}), "BOUNCE_scene": {**read_scene.camera_fixed(blender_camera), **values}
        }
        if camera.perspective is not None:
            camera.perspective.yfov = read_scene.camera_yfov(blender_camera, values, export.scene)
        else:
            magnification = read_scene.camera_magnification(blender_camera, values, export.scene)
            camera.orthographic.xmag, camera.orthographic.ymag = magnification

    @_hook
    def gather_mesh_hook(self, export, mesh, blender_mesh, blender_object, vertex_groups, modifiers, skip_filter,
                         materials, export_settings):
        mesh.name = export.prepared.names.get(blender_mesh.as_pointer(), mesh.name)
        gltf_materials.finish_primitives(mesh, materials, export)
        if export_settings["gltf_draco_mesh_compression"] and any(p.targets for p in mesh.primitives):
            export.kept_in_order.append(mesh.name)

    @_hook
    def gather_texture_info_hook(self, export, texture_info, blender_shader_sockets, export_settings):
        gltf_materials.set_encoding(texture_info, blender_shader_sockets)

    @_hook
    def gather_material_hook(self, export, material, blender_material, export_settings):
        gltf_materials.complete(material, blender_material, export)

    @_hook
    def gather_gltf_hook(self, export, active_scene, scenes, animations, export_settings):
        document.check_compression(scenes)
        document.carry_world_image(scenes[active_scene], export)
        vtree = export_settings["vtree"]
        placements, sheared = transforms.place(vtree, export.samples, export.source_of)
        for name in sheared:
            export.unsupported.append((name, "sheared transform (rotation under a non-uniform scale)"))
        channels = []
        for uuid, placement in placements.items():
            vnode = vtree.nodes[uuid]
            if vnode.node is not None:
                document.set_static(vnode.node, placement)
                step = vnode.blender_bone is None and object_is_stepped(vnode.blender_object)
                channels.extend(animation.node_channels(vnode.node, placement, step))
                if export.source_of(vnode.blender_object) in export.visibility.objects and vnode.blender_bone is None:
                    omissions.note_still(export, vnode, channels)
        channels.extend(self._weights(export, vtree))
        if not export.options.keep_all:
            export.left_out.extend(duplicates.share(scenes, export.materials.values()))
        channels.extend(self._visibility(export, vtree))
        channels.extend(_pointer_channels(export))
        if len(export.samples.frames) > 1:
            built = animation.build(export.scene.name, channels, export.samples.frames,
                                    read_scene.frames(export.scene)["fps"])
            if built is not None:
                animations.append(built)

    @_hook
    def gather_gltf_extensions_hook(self, export, gltf, export_settings):
        document.finish(gltf, export)

    @staticmethod
    def _weights(export, vtree):
        for vnode in vtree.nodes.values():
            weights = export.samples.weights.get(export.source_of(vnode.blender_object))
            has_targets = vnode.node is not None and vnode.node.mesh is not None and vnode.node.mesh.weights
            if vnode.blender_bone is None and weights is not None and has_targets:
                vnode.node.mesh.weights = weights[0].tolist()
                if not is_constant(weights):
                    yield Channel(vnode.node, "weights", weights)

    @staticmethod
    def _visibility(export, vtree):
        for vnode in vtree.nodes.values():
            node = vnode.node
            if vnode.blender_bone is None and node is not None and "KHR_node_visibility" in (node.extensions or {}):
                visible = export.samples.visible[export.source_of(vnode.blender_object)]
                pointer = Pointer("node", node, "extensions/KHR_node_visibility/visible")
                yield Channel(None, pointer, visible[:, None], is_bool=True)


def _pointer_channels(export):
    values = export.samples.values
    for key, nodes in export.light_nodes.items():
        yield from _light_channels(key, nodes[0][0], values["light", key])
    for key, (camera, gltf_camera) in export.cameras.items():
        yield from _camera_channels(camera, gltf_camera, values["camera", key], export)
    for kind in ("world", "view"):
        for name, track in values.get((kind, None), {}).items():
            yield from _moving(Pointer(kind, None, name), track)
    for key, gltf_versions in export.materials.items():
        for gltf_material in gltf_versions:
            yield from gltf_materials.channels(gltf_material, export.models[key][0], values["material", key])


def _moving(pointer, track, step=False):
    if not is_constant(track):
        yield Channel(None, pointer, track, step)


# Blender's property behind each value, to see whether its keys hold.
_LIGHT_PATHS = {
    "power_w": "energy", "irradiance_w_m2": "energy", "color": "color", "cone_angle_rad": "spot_size",
    "blend": "spot_blend", "radius_m": "shadow_soft_size", "angle_rad": "angle", "size_x_m": "size",
    "size_y_m": "size_y", "spread_rad": "spread",
}
_CAMERA_PATHS = {"focal_length_mm": "lens"}


def _light_channels(key, light, values):
    for name, track in values.items():
        yield from _moving(Pointer("light", key, name), track, is_stepped(light, {_LIGHT_PATHS[name]}))
    kind = lights.TYPE_OF_BLENDER[light.type]
    if kind == "area":
        return
    frames = range(len(values["color"]))
    punctual = [
        lights.punctual_light({"name": light.name, "type": kind,
                               **{name: track[f] if name == "color" else track[f, 0] for name, track in values.items()}})
        for f in frames
    ]
    stepped = is_stepped(light, {"energy"})
    yield from _moving(Pointer("punctual", key, "color"), values["color"], is_stepped(light, {"color"}))
    yield from _moving(Pointer("punctual", key, "intensity"), _column(p["intensity"] for p in punctual), stepped)
    if kind == "spot":
        for name in ("innerConeAngle", "outerConeAngle"):
            yield from _moving(Pointer("punctual", key, f"spot/{name}"), _column(p["spot"][name] for p in punctual))


def _camera_channels(camera, gltf_camera, values, export):
    for name, track in values.items():
        stepped = is_stepped(camera, {_CAMERA_PATHS.get(name, name)})
        yield from _moving(Pointer("camera", gltf_camera, f"extensions/BOUNCE_scene/{name}"), track, stepped)
    if gltf_camera.perspective is not None:
        yfov = [
            read_scene.camera_yfov(camera, {"focal_length_mm": length}, export.scene)
            for length in values["focal_length_mm"][:, 0]
        ]
        yield from _moving(Pointer("camera", gltf_camera, "perspective/yfov"), _column(yfov),
                           is_stepped(camera, {"lens"}))


def _column(values):
    import numpy as np

    return np.array(list(values), dtype=np.float64)[:, None]
