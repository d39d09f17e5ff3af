# SPDX-License-Identifier: Apache-2.0
"""Opens a glTF file in Blender as the scene that Bounce shows.

Blender's importer brings meshes, nodes, skins and their animation; what only BOUNCE_scene says (docs/bounce_scene.md)
is set from the file: lights, cameras, world, diffuse lobes, film and view. Values that move by KHR_animation_pointer
are written into a copy of the file's document at each frame, and set from there like the ones that do not move. Where
the file has no camera or no light, Bounce's own ones are used: its renders and Blender's show the same.
"""

import base64
import copy
import json
import math
import struct
import sys
import tempfile
import urllib.parse
from pathlib import Path

import bpy
import mathutils
import numpy

FLOAT = 5126
COMPONENTS = {"SCALAR": 1, "VEC2": 2, "VEC3": 3, "VEC4": 4}
LIGHT_TYPES = {"point": "POINT", "spot": "SPOT", "sun": "SUN", "area": "AREA"}
NAME = "BOUNCE_scene"
# Extensions that are taken care of here and not by Blender's importer, which refuses files that require one it lacks.
OURS = [NAME, "KHR_animation_pointer", "KHR_node_visibility", "EXT_mesh_gpu_instancing"]
LUMENS_A_WATT = 683


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
            buffers.append(base64.b64decode(uri.split(",", 1)[1]))
        else:
            buffers.append((Path(path).parent / urllib.parse.unquote(uri)).read_bytes())
    return document, buffers


class Channel:
    """One animated value: a JSON pointer and its keys."""

    def __init__(self, document, buffers, sampler, pointer):
        self.path = [int(part) if part.isdigit() else part for part in pointer.strip("/").split("/")]
        self.interpolation = sampler.get("interpolation", "LINEAR")
        self.times = [row[0] for row in read_floats(document, buffers, sampler["input"])]
        rows = read_floats(document, buffers, sampler["output"])
        spline = self.interpolation == "CUBICSPLINE"
        # A key of a spline is three rows: the tangent into it, its value, the tangent out of it.
        self.values = rows[1::3] if spline else rows
        self.tangents_in, self.tangents_out = (rows[0::3], rows[2::3]) if spline else ([], [])

    def value(self, time):
        if time <= self.times[0]:
            return self.values[0]
        if time >= self.times[-1]:
            return self.values[-1]
        after = next(i for i, key in enumerate(self.times) if key > time)
        before = after - 1
        if self.interpolation == "STEP":
            return self.values[before]
        span = self.times[after] - self.times[before]
        t = (time - self.times[before]) / span
        if self.interpolation == "LINEAR":
            return [a + (b - a) * t for a, b in zip(self.values[before], self.values[after])]
        # Hermite's, by glTF 2.0, appendix C.
        weights = (2 * t**3 - 3 * t**2 + 1, span * (t**3 - 2 * t**2 + t), 3 * t**2 - 2 * t**3, span * (t**3 - t**2))
        return [sum(weight * part for weight, part in zip(weights, parts))
                for parts in zip(self.values[before], self.tangents_out[before], self.values[after], self.tangents_in[after])]

    def write(self, document, time):
        target = document
        for part in self.path[:-1]:
            target = target[part] if isinstance(part, int) else target.setdefault(part, {})
        value = self.value(time)
        target[self.path[-1]] = value[0] if len(value) == 1 else value


def read_floats(document, buffers, index):
    accessor = document["accessors"][index]
    if accessor["componentType"] != FLOAT or "sparse" in accessor or "bufferView" not in accessor:
        raise ValueError("its values are not stored as plain floats")
    view = document["bufferViews"][accessor["bufferView"]]
    data = buffers[view["buffer"]]
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
            if pointer.startswith("/nodes/") and pointer.rsplit("/", 1)[1] in ("translation", "rotation", "scale", "weights"):
                note(f"{pointer} does not move in the reference: Blender's importer does not know motion by pointers")
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
        self.instances = {}
        self.make_instances(buffers)
        set_world(self.scene, extension(document).get("world") or self.world)
        link_world_image(self.scene, document, buffers, note)
        self.blinks = any("KHR_node_visibility" in node.get("extensions", {}) for node in document.get("nodes", []))

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

    def make_instances(self, buffers):
        """Copies below the node, which itself is not drawn then; the importer makes one object of all."""
        for index, node in enumerate(self.document.get("nodes", [])):
            wanted = node.get("extensions", {}).get("EXT_mesh_gpu_instancing")
            found = self.made.nodes.get(index)
            if wanted is None or found is None:
                continue
            try:
                read = {name: read_floats(self.document, buffers, accessor) for name, accessor in wanted["attributes"].items()
                        if name in ("TRANSLATION", "ROTATION", "SCALE")}
            except ValueError as error:
                self.note(f"{node.get('name', index)} is drawn once in the reference: {error}")
                continue
            self.instances[index] = []
            for i in range(max((len(rows) for rows in read.values()), default=0)):
                instance = found.copy()
                self.scene.collection.objects.link(instance)
                instance.parent = found
                instance.matrix_parent_inverse.identity()
                instance.matrix_local = instance_matrix(*(read[name][i] if name in read else plain for name, plain in (
                    ("TRANSLATION", (0, 0, 0)), ("ROTATION", (0, 0, 0, 1)), ("SCALE", (1, 1, 1)))))
                self.instances[index].append(instance)
            found.hide_render = True

    def shown_nodes(self, document):
        """Whether each node that the scene has is shown: one that is hidden hides those below it."""
        nodes = document.get("nodes", [])
        shown = {}
        waiting = [(root, True) for root in document["scenes"][document.get("scene", 0)].get("nodes", [])]
        while waiting:
            index, above = waiting.pop()
            visible = nodes[index].get("extensions", {}).get("KHR_node_visibility", {}).get("visible", True)
            shown[index] = above and visible
            waiting += [(child, shown[index]) for child in nodes[index].get("children", [])]
        return shown

    def show_nodes(self, document):
        for index, shown in self.shown_nodes(document).items():
            drawn = self.instances.get(index, [self.made.nodes.get(index)])
            for item in [*drawn, self.lights.get(index), self.made.lights.get(index)]:
                if item is not None:
                    item.hide_render = not shown

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
            if index in self.made.cameras:
                set_camera(self.made.cameras[index].data, document["cameras"][node["camera"]])
        if self.blinks:
            self.show_nodes(document)
        set_world(self.scene, extension(document).get("world") or self.world)
        set_materials(document, self.made.materials)
        if self.framing:
            place_camera(self.scene.camera, self.framing[frame])
        # The importer puts time 0 at frame 0.
        return time * self.scene.render.fps


def instance_matrix(translation, rotation, scale):
    """Of an instance below its node, from glTF's axes to Blender's."""
    to_z_up = mathutils.Matrix(((1, 0, 0, 0), (0, 0, -1, 0), (0, 1, 0, 0), (0, 0, 0, 1)))
    x, y, z, w = rotation
    matrix = mathutils.Matrix.LocRotScale(mathutils.Vector(translation), mathutils.Quaternion((w, x, y, z)),
                                          mathutils.Vector(scale))
    return to_z_up @ matrix @ to_z_up.inverted()


def set_plain_lights(document, made, note):
    """Lights of KHR_lights_punctual alone: points without a size, as Bounce draws them; Blender's new lights have one."""
    lights = document.get("extensions", {}).get("KHR_lights_punctual", {}).get("lights", [])
    for index, holder in made.lights.items():
        node = document["nodes"][index]
        if "light" in extension(node):
            continue
        light = lights[node["extensions"]["KHR_lights_punctual"]["light"]]
        watts = light.get("intensity", 1) / LUMENS_A_WATT
        if light["type"] == "directional":
            holder.data.energy, holder.data.angle = watts, 0
        else:
            holder.data.energy, holder.data.shadow_soft_size = 4 * math.pi * watts, 0
        if light["type"] == "spot":
            note(f"the edge of the spot {light.get('name', index)} follows Blender's law in the reference, not glTF's")


def give_plain_materials(made):
    """A surface without a material is white metal by glTF, and grey in Blender."""
    plain = None
    for found in made.nodes.values():
        mesh = found.data if found.type == "MESH" else None
        if mesh is None or (mesh.materials and all(mesh.materials)):
            continue
        if plain is None:
            plain = bpy.data.materials.new("glTF default")
            plain.use_nodes = True
            shader = plain.node_tree.nodes["Principled BSDF"]
            for name, value in (("Base Color", (1, 1, 1, 1)), ("Metallic", 1), ("Roughness", 1)):
                shader.inputs[name].default_value = value
        if not mesh.materials:
            mesh.materials.append(plain)
        for slot, material in enumerate(mesh.materials):
            if material is None:
                mesh.materials[slot] = plain


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


def set_camera(data, described):
    camera = extension(described)
    if not camera:
        # The file's own numbers are of the picture's height.
        data.sensor_fit = "VERTICAL"
        if data.type == "ORTHO":
            data.ortho_scale = 2 * abs(described["orthographic"]["ymag"])
        else:
            data.angle = described["perspective"]["yfov"]
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
    mapping = scene.world.node_tree.nodes.get(WORLD_TURN)
    if mapping is not None:
        x, y, z, w = (world or {}).get("rotation", (0, 0, 0, 1))
        mapping.inputs["Rotation"].default_value = mathutils.Quaternion((w, x, -z, y)).to_euler("XYZ")


WORLD_TURN = "Bounce world"


def link_world_image(scene, document, buffers, note):
    """Puts the image of the file's world before its colour."""
    described = extension(document).get("world", {}).get("image", {})
    if "bufferView" not in described:
        if described:
            note("the world's image is beside the file: the reference has its mean colour")
        return
    view = document["bufferViews"][described["bufferView"]]
    start = view.get("byteOffset", 0)
    with tempfile.TemporaryDirectory() as folder:
        path = Path(folder) / ("world.hdr" if described.get("mimeType") == "image/vnd.radiance" else "world.exr")
        path.write_bytes(bytes(buffers[view["buffer"]][start:start + view["byteLength"]]))
        image = bpy.data.images.load(str(path))
        image.pack()
    tree = scene.world.node_tree
    texture, mapping = tree.nodes.new("ShaderNodeTexEnvironment"), tree.nodes.new("ShaderNodeMapping")
    texture.image, mapping.name, mapping.vector_type = image, WORLD_TURN, "TEXTURE"
    tree.links.new(tree.nodes.new("ShaderNodeTexCoord").outputs["Generated"], mapping.inputs["Vector"])
    tree.links.new(mapping.outputs["Vector"], texture.inputs["Vector"])
    tree.links.new(texture.outputs["Color"], tree.nodes["Background"].inputs["Color"])


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
    from io_scene_gltf2.io.imp.gltf2_io_gltf import glTFImporter

    plain_init = glTFImporter.__init__

    def init(self, *arguments, **options):
        plain_init(self, *arguments, **options)
        self.extensions_managed = [*self.extensions_managed, *OURS]

    glTFImporter.__init__ = init
    try:
        bpy.ops.import_scene.gltf(filepath=str(path))
    finally:
        glTFImporter.__init__ = plain_init
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
    set_plain_lights(document, made, note)
    give_plain_materials(made)
    imported = Imported(document, buffers, scene, made, defaults, note)
    set_scene(scene, root, imported)
    choose_camera(scene, root, defaults, imported)
    return scene, imported
