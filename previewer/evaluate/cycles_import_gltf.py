# SPDX-License-Identifier: Apache-2.0
"""Opens a glTF file in Blender as the scene that Bounce shows.

Blender's importer brings meshes, nodes, skins and their animation; what only BOUNCE_scene says (docs/bounce_scene.md)
is set from the file: lights, cameras, world, diffuse lobes, film and view. Values that move by KHR_animation_pointer
are written into a copy of the file's document at each frame, and set from there like the ones that do not move. Where
the file has no camera or no light, Bounce's own ones are used: its renders and Blender's show the same.
"""

import copy
import json
import math
import struct
import sys
from pathlib import Path

import bpy
import mathutils
import numpy

FLOAT = 5126
COMPONENTS = {"SCALAR": 1, "VEC2": 2, "VEC3": 3, "VEC4": 4}
LIGHT_TYPES = {"point": "POINT", "spot": "SPOT", "sun": "SUN", "area": "AREA"}
NAME = "BOUNCE_scene"


def read_document(path):
    """The JSON and the list of buffers of a .glb or .gltf file."""
    data = Path(path).read_bytes()
    binary = None
    if data[:4] == b"glTF":
        length = struct.unpack_from("<I", data, 12)[0]
        document = json.loads(data[20:20 + length])
        if len(data) > 20 + length:
            binary = data[28 + length:]
    else:
        document = json.loads(data)
    buffers = []
    for buffer in document.get("buffers", []):
        uri = buffer.get("uri")
        if uri is None:
            buffers.append(binary)
        elif uri.startswith("data:"):
            buffers.append(None)  # embedded text; our exporter writes no animation that way
        else:
            buffers.append((Path(path).parent / uri).read_bytes())
    return document, buffers


class Channel:
    """One animated value: a JSON pointer and its keys."""

    def __init__(self, document, buffers, sampler, pointer):
        self.path = [int(part) if part.isdigit() else part for part in pointer.strip("/").split("/")]
        self.step = sampler.get("interpolation", "LINEAR") == "STEP"
        self.times = [row[0] for row in read_floats(document, buffers, sampler["input"])]
        self.values = read_floats(document, buffers, sampler["output"])

    def value(self, time):
        if time <= self.times[0]:
            return self.values[0]
        if time >= self.times[-1]:
            return self.values[-1]
        after = next(i for i, key in enumerate(self.times) if key > time)
        before = after - 1
        if self.step:
            return self.values[before]
        t = (time - self.times[before]) / (self.times[after] - self.times[before])
        return [a + (b - a) * t for a, b in zip(self.values[before], self.values[after])]

    def write(self, document, time):
        target = document
        for part in self.path[:-1]:
            target = target[part] if isinstance(part, int) else target.setdefault(part, {})
        value = self.value(time)
        target[self.path[-1]] = value[0] if len(value) == 1 else value


def read_floats(document, buffers, index):
    accessor = document["accessors"][index]
    if accessor["componentType"] != FLOAT or "sparse" in accessor or "bufferView" not in accessor:
        raise ValueError("an animated value is not stored as plain floats")
    view = document["bufferViews"][accessor["bufferView"]]
    data = buffers[view["buffer"]]
    if data is None:
        raise ValueError("an animated value is stored as text in the file")
    count = COMPONENTS[accessor["type"]]
    start = view.get("byteOffset", 0) + accessor.get("byteOffset", 0)
    stride = view.get("byteStride", 4 * count)
    return [list(struct.unpack_from(f"<{count}f", data, start + i * stride)) for i in range(accessor["count"])]


def pointer_channels(document, buffers, note):
    channels = []
    for animation in document.get("animations", []):
        for channel in animation["channels"]:
            target = channel["target"]
            pointer = target.get("extensions", {}).get("KHR_animation_pointer", {}).get("pointer")
            # The twins for other viewers say nothing new.
            if pointer is None or pointer.startswith("/extensions/KHR_lights_punctual"):
                continue
            try:
                channels.append(Channel(document, buffers, animation["samplers"][channel["sampler"]], pointer))
            except ValueError as error:
                note(f"{pointer} does not move in the reference: {error}")
    return channels


def extension(item):
    return item.get("extensions", {}).get(NAME, {})


def position_in(items, wanted):
    return next((i for i, item in enumerate(items or []) if item is wanted), None)


class MadeObjects:
    """What the importer made of each node and material, told by its hooks: names need not be unique, nor be the file's."""

    def __init__(self):
        self.nodes = {}
        # A node with a mesh as well has its camera or light below it.
        self.cameras = {}
        self.lights = {}
        self.materials = {}  # several: one for each vertex colour

    def glTF2ImportUserExtension(self):  # noqa: N802, the importer asks for this name
        return self

    def gather_import_node_after_hook(self, vnode, gltf_node, made, gltf):
        index = position_in(gltf.data.nodes, gltf_node)
        if index is not None:
            self.nodes[index] = made
        if vnode.camera_node_idx is not None:
            self.cameras[vnode.camera_node_idx] = made
        if vnode.light_node_idx is not None:
            self.lights[vnode.light_node_idx] = made

    def gather_import_material_after_hook(self, gltf_material, _vertex_color, made, gltf):
        self.materials.setdefault(position_in(gltf.data.materials, gltf_material), []).append(made)


class Imported:
    def __init__(self, document, buffers, scene, made, defaults, note):
        self.document = document
        self.scene = scene
        self.world = defaults.get("world")
        self.framing = {item["frame"]: item for item in defaults.get("cameras", [])}
        self.note = note
        self.channels = pointer_channels(document, buffers, note)
        self.frames = extension(document).get("frames", {"start": 1, "fps": 24})
        self.made = made
        self.lights = {}
        self.make_lights()

    def camera_of(self, index):
        if index not in self.made.cameras:
            raise ValueError(f"the importer made no camera that is node {index}'s")
        return self.made.cameras[index]

    def make_lights(self):
        for index, node in enumerate(self.document.get("nodes", [])):
            if "light" not in extension(node):
                continue
            found = self.made.lights.get(index, self.made.nodes.get(index))
            if found is None:
                raise ValueError(f"the light node {node.get('name', index)} was not imported")
            light = extension(self.document)["lights"][extension(node)["light"]]
            kind = LIGHT_TYPES[light["type"]]
            if found.type == "LIGHT":
                found.data = found.data.copy()
                found.data.type = kind
                holder = found
            else:  # an area light is an empty node to the importer
                name = light.get("name", "Light")
                holder = bpy.data.objects.new(name, bpy.data.lights.new(name, kind))
                self.scene.collection.objects.link(holder)
                holder.parent = found
                holder.rotation_euler.x = math.pi / 2  # the importer's axes: glTF's -Z is Blender's +Y
            self.lights[index] = holder

    def apply(self, frame):
        """Sets what the importer did not, at Bounce's frame; returns Blender's frame number."""
        time = (frame - self.frames["start"]) / self.frames["fps"]
        document = copy.deepcopy(self.document)
        for channel in self.channels:
            channel.write(document, time)
        for index, holder in self.lights.items():
            node = document["nodes"][index]
            set_light(holder.data, extension(document)["lights"][extension(node)["light"]])
        for index, node in enumerate(document.get("nodes", [])):
            found = self.made.nodes.get(index)
            if found is None:
                continue
            visibility = node.get("extensions", {}).get("KHR_node_visibility")
            if visibility is not None:
                hide(found, not visibility.get("visible", True))
            if index in self.made.cameras:
                set_camera(self.made.cameras[index].data, extension(document["cameras"][node["camera"]]))
        set_world(self.scene, extension(document).get("world") or self.world)
        set_materials(document, self.made.materials)
        if self.framing:
            place_camera(self.scene.camera, self.framing[frame])
        # The importer puts time 0 at frame 0.
        return time * self.scene.render.fps


def hide(found, hidden):
    found.hide_render = hidden
    for child in found.children:
        hide(child, hidden)


def set_light(data, light):
    data.color = light.get("color", (1, 1, 1))
    data.energy = light.get("irradiance_w_m2", 0) if light["type"] == "sun" else light.get("power_w", 0)
    data.use_shadow = light.get("cast_shadow", True)
    data.cycles.cast_shadow = light.get("cast_shadow", True)
    if "max_bounces" in light:
        data.cycles.max_bounces = light["max_bounces"]
    if light["type"] in ("point", "spot"):
        data.shadow_soft_size = light.get("radius_m", 0)
    if light["type"] == "spot":
        data.spot_size = light["cone_angle_rad"]
        data.spot_blend = light.get("blend", 0)
    elif light["type"] == "sun":
        data.angle = light.get("angle_rad", 0)
    elif light["type"] == "area":
        data.shape = light.get("shape", "square").upper()
        data.size = light["size_x_m"]
        data.size_y = light["size_y_m"]
        data.spread = light.get("spread_rad", math.pi)


def set_camera(data, camera):
    if not camera:
        return
    data.sensor_fit = {"auto": "AUTO", "horizontal": "HORIZONTAL", "vertical": "VERTICAL"}[camera["sensor_fit"]]
    data.sensor_width = camera["sensor_width_mm"]
    data.sensor_height = camera["sensor_height_mm"]
    if "focal_length_mm" in camera and data.type == "PERSP":
        data.lens = camera["focal_length_mm"]
    if "ortho_scale" in camera and data.type == "ORTHO":
        data.ortho_scale = camera["ortho_scale"]
    data.shift_x = camera.get("shift_x", 0)
    data.shift_y = camera.get("shift_y", 0)


def place_camera(holder, framed):
    """Bounce's camera of a frame of a file without one; an unrotated Blender camera looks along -Z as glTF's does."""
    to_z_up = mathutils.Matrix(((1, 0, 0, 0), (0, 0, -1, 0), (0, 1, 0, 0), (0, 0, 0, 1)))
    holder.matrix_world = to_z_up @ mathutils.Matrix(framed["world_from_camera"]).transposed()
    holder.data.sensor_fit = "VERTICAL"
    holder.data.angle = framed["yfov_rad"]
    holder.data.clip_start = framed["near_m"]
    holder.data.clip_end = framed["far_m"]


def set_world(scene, world):
    if scene.world is None:
        scene.world = bpy.data.worlds.new("World")
    scene.world.use_nodes = True
    background = scene.world.node_tree.nodes["Background"]
    background.inputs["Color"].default_value = (*(world or {}).get("color", (0, 0, 0)), 1)
    background.inputs["Strength"].default_value = (world or {}).get("strength", 0)


def set_materials(document, made):
    for index, item in enumerate(document.get("materials", [])):
        for material in made.get(index, []):
            if material.use_nodes:
                set_material(item, material)


def set_material(item, material):
    shader = next((n for n in material.node_tree.nodes if n.type in ("BSDF_PRINCIPLED", "BSDF_DIFFUSE")), None)
    if shader is None:
        return
    said = extension(item)
    if shader.type == "BSDF_PRINCIPLED" and said.get("diffuse") == "lambert" and said.get("specular") == 0:
        shader = replace_by_diffuse(material, shader)
    elif shader.type == "BSDF_PRINCIPLED" and "specular" in said and "Specular" in shader.inputs:
        shader.inputs["Specular"].default_value = said["specular"]
    factors = item.get("pbrMetallicRoughness", {})
    color = shader.inputs["Color" if shader.type == "BSDF_DIFFUSE" else "Base Color"]
    if "baseColorFactor" in factors and not color.is_linked:
        color.default_value = factors["baseColorFactor"]
    if shader.type == "BSDF_PRINCIPLED":
        for name, key in (("Metallic", "metallicFactor"), ("Roughness", "roughnessFactor")):
            if key in factors and not shader.inputs[name].is_linked:
                shader.inputs[name].default_value = factors[key]
        emission = shader.inputs["Emission"]
        if "emissiveFactor" in item and not emission.is_linked:
            emission.default_value = (*item["emissiveFactor"], 1)
            shader.inputs["Emission Strength"].default_value = emissive_strength(item)


def emissive_strength(item):
    strength = item.get("extensions", {}).get("KHR_materials_emissive_strength", {})
    return strength.get("emissiveStrength", 1)


def replace_by_diffuse(material, principled):
    """A Diffuse BSDF where the file says Lambert without a highlight; Principled has Disney's lobe."""
    nodes, links = material.node_tree.nodes, material.node_tree.links
    diffuse = nodes.new("ShaderNodeBsdfDiffuse")
    diffuse.inputs["Roughness"].default_value = 0
    for name, source in (("Color", "Base Color"), ("Normal", "Normal")):
        links_in = principled.inputs[source].links
        if links_in:
            links.new(links_in[0].from_socket, diffuse.inputs[name])
        elif name == "Color":
            diffuse.inputs[name].default_value = principled.inputs[source].default_value
    result = diffuse.outputs["BSDF"]
    emission = principled.inputs["Emission"]
    if emission.is_linked or any(emission.default_value[:3]):
        glow = nodes.new("ShaderNodeEmission")
        glow.inputs["Strength"].default_value = principled.inputs["Emission Strength"].default_value
        if emission.is_linked:
            links.new(emission.links[0].from_socket, glow.inputs["Color"])
        else:
            glow.inputs["Color"].default_value = emission.default_value
        both = nodes.new("ShaderNodeAddShader")
        links.new(result, both.inputs[0])
        links.new(glow.outputs[0], both.inputs[1])
        result = both.outputs[0]
    for link in list(principled.outputs["BSDF"].links):
        links.new(result, link.to_socket)
    nodes.remove(principled)
    return diffuse


def choose_camera(scene, root, defaults, imported):
    if imported.framing:
        scene.camera = bpy.data.objects.new("Framing", bpy.data.cameras.new("Framing"))
        scene.collection.objects.link(scene.camera)
        scene.render.pixel_aspect_x = scene.render.pixel_aspect_y = 1  # framed for square pixels
        return
    scene.camera = imported.camera_of(defaults.get("camera_node", root.get("camera")))


def set_scene(scene, root, imported):
    render = root.get("render", {})
    scene.cycles.film_exposure = render.get("film_exposure", 1)
    scene.render.pixel_aspect_x = render.get("pixel_aspect_x", 1)
    scene.render.pixel_aspect_y = render.get("pixel_aspect_y", 1)
    view = root.get("view", {})
    try:
        scene.display_settings.display_device = view.get("display_device", "sRGB")
        scene.view_settings.view_transform = view.get("view_transform", "Standard")
        scene.view_settings.look = view.get("look", "None")
    except TypeError:
        imported.note("this Blender lacks the file's view transform; pictures are shown as Standard")
        scene.view_settings.view_transform = "Standard"
    scene.view_settings.exposure = view.get("exposure", 0)
    scene.view_settings.gamma = view.get("gamma", 1)


def import_nodes(path):
    """Runs Blender's importer. It asks the modules of all enabled add-ons for extensions, its own among them."""
    made = MadeObjects()
    importer = sys.modules["io_scene_gltf2"]
    importer.glTF2ImportUserExtension = made.glTF2ImportUserExtension
    try:
        bpy.ops.import_scene.gltf(filepath=str(path))
    finally:
        del importer.glTF2ImportUserExtension
    if not made.nodes:
        raise ValueError("this Blender's glTF importer does not tell what it makes of each node: is it older than 3.4?")
    return made


def load(path, addon, defaults, note):
    """Imports the file into an empty scene; defaults: what the file lacks, or None. Returns (scene, Imported)."""
    defaults = defaults or {}
    document, buffers = read_document(path)
    if addon:
        sys.path.insert(0, addon)
        from bounce.draco_library import locate

        locate(None, Path(addon) / "bounce")
    bpy.ops.wm.read_factory_settings(use_empty=True)
    scene = bpy.context.scene
    root = extension(document)
    if not root:
        note("the file has no BOUNCE_scene: lights and materials are what Blender's importer makes of it")
    # Blender 3.4's importer uses names that numpy dropped in 1.24, which Debian 12 has.
    for name, kind in (("bool", bool), ("int", int), ("float", float)):
        if name not in numpy.__dict__:
            setattr(numpy, name, kind)
    scene.render.fps = max(1, round(root.get("frames", {}).get("fps", 24)))
    made = import_nodes(path)
    imported = Imported(document, buffers, scene, made, defaults, note)
    set_scene(scene, root, imported)
    choose_camera(scene, root, defaults, imported)
    return scene, imported
