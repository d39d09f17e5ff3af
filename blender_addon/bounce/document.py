# SPDX-License-Identifier: GPL-3.0-or-later
"""The last touches to the glTF document: static placements, light and root extensions, and the pointers' numbers."""

import bpy

from io_scene_gltf2.io.exp.gltf2_io_binary_data import BinaryData

from . import environment_file, lights, read_lights, read_scene, read_world
from .errors import ExportError
from .pointers import Pointer

SCHEMA_VERSION = 1
ADDON_VERSION = "0.1.0"
_VIEWERS_MAY_SKIP = {"KHR_lights_punctual"}


def set_static(node, placement):
    """The pose of the first frame, which a viewer without animation shows."""
    for attribute, values, default in (
        ("translation", placement.translations, [0.0, 0.0, 0.0]),
        ("rotation", placement.rotations, [0.0, 0.0, 0.0, 1.0]),
        ("scale", placement.scales, [1.0, 1.0, 1.0]),
    ):
        value = values[0].tolist()
        setattr(node, attribute, None if value == default else value)


def check_compression(scenes):
    """Blender's exporter goes on after a primitive that could not be encoded and writes it empty."""
    for scene in scenes:
        for node in _all_nodes(scene.nodes):
            for primitive in node.mesh.primitives if node.mesh is not None else []:
                encoded = (primitive.extensions or {}).get("KHR_draco_mesh_compression")
                if encoded is not None and encoded["bufferView"].byte_length == 0:
                    raise ExportError(f"Draco could not compress mesh '{node.mesh.name}'; export without it")


def _all_nodes(nodes):
    for node in nodes:
        yield node
        yield from _all_nodes(node.children or [])


def finish(gltf, export):
    _attach_lights(gltf, export)
    gltf.extensions["BOUNCE_scene"] = _root(gltf, export)
    _resolve_pointers(gltf, export)
    gltf.extensions_required = [name for name in gltf.extensions_required if name not in _VIEWERS_MAY_SKIP]
    for name in ("BOUNCE_scene", *(["KHR_node_visibility"] if _has_visibility(gltf) else [])):
        if name not in gltf.extensions_used:
            gltf.extensions_used.append(name)
    gltf.asset.generator = f"Bounce {ADDON_VERSION} on {gltf.asset.generator}"


def _attach_lights(gltf, export):
    punctual = gltf.extensions.get("KHR_lights_punctual", {}).get("lights", [])
    for index, (key, nodes) in enumerate(export.light_nodes.items()):
        for light, node in nodes:
            node.extensions = {**(node.extensions or {}), "BOUNCE_scene": {"light": index}}
            if "KHR_lights_punctual" in node.extensions:
                # The exporter reads node lights and ranges otherwise than Cycles.
                punctual[node.extensions["KHR_lights_punctual"]["light"]] = lights.punctual_light(
                    _light(light, key, export)
                )


def _light(light, key, export):
    return {**read_lights.fixed(light), **export.samples.at_start("light", key)}


def _root(gltf, export):
    scene = export.scene
    root = {
        "version": SCHEMA_VERSION,
        "generator": {"blender": list(bpy.app.version), "addon": ADDON_VERSION},
        "frames": read_scene.frames(scene),
        "render": read_scene.render(scene),
        "view": {**read_scene.view(scene), **export.samples.at_start("view", None)},
        # Tuples: the exporter drops empty lists, and an empty list says that nothing was left out.
        "lights": tuple(_light(nodes[0][0], key, export) for key, nodes in export.light_nodes.items()),
        "unsupported": tuple({"object": name, "what": what} for name, what in export.unsupported),
    }
    if ("world", None) in export.samples.values:
        root["world"] = {**export.samples.at_start("world", None), **_world_image(gltf, export)}
    camera = _active_camera_node(gltf, export)
    if camera is not None:
        root["camera"] = camera
    return root


_CARRIER = "BOUNCE_scene image"  # leaves the document again


def carry_world_image(gltf_scene, export):
    """The exporter has written its buffer before the root extensions are asked for; what hangs on a scene goes into the
    buffer, and the number of its view comes into this dictionary."""
    image = read_world.image_of(export.scene.world) if export.scene.world is not None else None
    if image is not None:
        data, mime_type = environment_file.encoded(image)
        export.world_image = {"name": image.name, "mimeType": mime_type, "bufferView": BinaryData(data)}
        gltf_scene.extensions = {**(gltf_scene.extensions or {}), _CARRIER: export.world_image}


def _world_image(gltf, export):
    if export.world_image is None:
        return {}
    for gltf_scene in gltf.scenes:
        if (gltf_scene.extensions or {}).pop(_CARRIER, None) is not None and not gltf_scene.extensions:
            gltf_scene.extensions = None
    return {"image": export.world_image}


def _active_camera_node(gltf, export):
    if scene_camera_missing(export.scene):
        return None
    known = export.cameras.get(export.scene.camera.data.as_pointer())
    if known is None:
        return None
    index = _position(gltf.cameras, known[1])
    nodes = [i for i, node in enumerate(gltf.nodes) if node.camera == index]
    # Cameras may share their data; the node then has the object's name.
    named = [i for i in nodes if gltf.nodes[i].name == export.scene.camera.name]
    return (named or nodes)[0]


def scene_camera_missing(scene):
    return scene.camera is None or scene.camera.type != "CAMERA"


def _position(items, wanted):
    return next(i for i, item in enumerate(items) if item is wanted)


def _resolve_pointers(gltf, export):
    def index_of(kind, owner):
        if kind == "light":
            return export.light_index(owner)
        if kind == "punctual":
            return export.light_nodes[owner][0][1].extensions["KHR_lights_punctual"]["light"]
        return _position({"camera": gltf.cameras, "node": gltf.nodes, "material": gltf.materials}[kind], owner)

    for animation in gltf.animations:
        for channel in animation.channels:
            extension = (channel.target.extensions or {}).get("KHR_animation_pointer")
            if extension is not None and isinstance(extension["pointer"], Pointer):
                extension["pointer"] = extension["pointer"].resolve(index_of)


def _has_visibility(gltf):
    return any("KHR_node_visibility" in (node.extensions or {}) for node in gltf.nodes)
