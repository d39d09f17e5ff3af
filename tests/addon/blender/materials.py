# SPDX-License-Identifier: Apache-2.0
"""Materials that glTF can say and materials that it cannot."""

import sys
from pathlib import Path

import bpy

sys.path.insert(0, str(Path(__file__).resolve().parent))
import truth  # noqa: E402

START, END = 1, 9
COLUMN = []


def material(name, shader=None):
    """A material on a grid of its own name; returns its nodes, links and the shader linked to the output."""
    data = bpy.data.materials.new(name)
    data.use_nodes = True
    nodes, links = data.node_tree.nodes, data.node_tree.links
    node = nodes["Principled BSDF"]
    if shader is not None:
        nodes.remove(node)
        node = nodes.new(shader)
        links.new(node.outputs[0], nodes["Material Output"].inputs["Surface"])
    obj = truth.grid(name, location=(0, 2 * len(COLUMN), 0))
    obj.data.materials.append(data)
    obj.data.uv_layers.new(name="UVMap")
    COLUMN.append(name)
    return nodes, links, node


def image():
    picture = bpy.data.images.new("Picture", 4, 4)
    picture.pixels = [0.25 * (i % 4) for i in range(4 * 4 * 4)]
    picture.pack()
    return picture


def plain():
    _, _, node = material("Plain")
    node.inputs["Base Color"].default_value = (0.8, 0.1, 0.2, 1)
    node.inputs["Roughness"].default_value = 0.35
    node.inputs["Metallic"].default_value = 0.25
    node.inputs["Specular"].default_value = 0.7
    _, _, node = material("Diffuse", "ShaderNodeBsdfDiffuse")
    node.inputs["Color"].default_value = (0.1, 0.6, 0.3, 1)
    _, _, node = material("Lamp", "ShaderNodeEmission")
    node.inputs["Color"].default_value = (1.0, 0.5, 0.25, 1)
    node.inputs["Strength"].default_value = 8.0
    _, _, node = material("Glowing")
    node.inputs["Emission"].default_value = (0.5, 0.5, 1.0, 1)
    node.inputs["Emission Strength"].default_value = 4.0
    _, _, node = material("Dim")
    node.inputs["Emission"].default_value = (0.5, 0.25, 0.125, 1)
    nodes, links, add = material("Added", "ShaderNodeAddShader")
    surface, light = nodes.new("ShaderNodeBsdfDiffuse"), nodes.new("ShaderNodeEmission")
    surface.inputs["Color"].default_value = (0.2, 0.4, 0.6, 1)
    light.inputs["Color"].default_value = (0.3, 0.2, 0.1, 1)
    links.new(surface.outputs[0], add.inputs[0])
    links.new(light.outputs[0], add.inputs[1])
    truth.grid("Bare", location=(0, -2, 0))
    data = bpy.data.materials.new("No nodes")
    data.diffuse_color = (0.3, 0.5, 0.7, 1)
    truth.grid("No nodes", location=(0, -4, 0)).data.materials.append(data)
    _, _, node = material("Transparent")
    node.inputs["Alpha"].default_value = 0.4


def seen_through(picture):
    for name, between in (("Cut by image", "GREATER_THAN"), ("Clear by image", None), ("Half clear", "MULTIPLY")):
        nodes, links, node = material(name)
        texture = nodes.new("ShaderNodeTexImage")
        texture.image = picture
        links.new(texture.outputs["Color"], node.inputs["Base Color"])
        alpha = texture.outputs["Alpha"]
        if between is not None:
            math = nodes.new("ShaderNodeMath")
            math.operation, math.inputs[1].default_value = between, 0.3
            links.new(alpha, math.inputs[0])
            alpha = math.outputs[0]
        links.new(alpha, node.inputs["Alpha"])
    for name, clear, source in (("Mixed clear", 1, 0.3), ("Mixed clear, other way", 2, 0.3), ("Mixed by image", 1, picture)):
        nodes, links, node = material(name)
        mix, transparent = nodes.new("ShaderNodeMixShader"), nodes.new("ShaderNodeBsdfTransparent")
        links.new(transparent.outputs[0], mix.inputs[clear])
        links.new(node.outputs[0], mix.inputs[3 - clear])
        links.new(mix.outputs[0], nodes["Material Output"].inputs["Surface"])
        if source is picture:
            texture = nodes.new("ShaderNodeTexImage")
            texture.image = picture
            links.new(texture.outputs["Alpha"], mix.inputs[0])
        else:
            mix.inputs[0].default_value = source
        node.inputs["Base Color"].default_value = (0.2, 0.4, 0.6, 1)
    nodes, links, node = material("Times constant")
    texture, mix = nodes.new("ShaderNodeTexImage"), nodes.new("ShaderNodeMixRGB")
    texture.image, mix.blend_type = picture, "MULTIPLY"
    mix.inputs[0].default_value, mix.inputs[2].default_value = 1.0, (0.5, 0.25, 1, 1)
    links.new(texture.outputs[0], mix.inputs[1])
    links.new(mix.outputs[0], node.inputs["Base Color"])
    data = bpy.data.images.new("Data", 4, 4)
    data.colorspace_settings.name = "Non-Color"
    data.pack()
    for name, image, socket in (("Data as colour", data, "Base Color"), ("Colour as data", picture, "Roughness"),
                                ("Data as data", data, "Roughness")):
        nodes, links, node = material(name)
        texture = nodes.new("ShaderNodeTexImage")
        texture.image = image
        links.new(texture.outputs[0], node.inputs[socket])
    nodes, links, node = material("Clipped")
    texture = nodes.new("ShaderNodeTexImage")
    texture.image, texture.extension, texture.interpolation = picture, "CLIP", "Cubic"
    links.new(texture.outputs[0], node.inputs["Base Color"])
    _, _, node = material("Tinted")
    node.inputs["Specular Tint"].default_value = 0.5
    node.distribution = "MULTI_GGX"


def textured(picture):
    for name, shader, socket in (("Textured", None, "Base Color"), ("Textured diffuse", "ShaderNodeBsdfDiffuse", "Color")):
        nodes, links, node = material(name, shader)
        texture, mapping, coordinates = (nodes.new(kind) for kind in (
            "ShaderNodeTexImage", "ShaderNodeMapping", "ShaderNodeTexCoord"))
        texture.image = picture
        mapping.inputs["Scale"].default_value = (2.0, 3.0, 1.0)
        links.new(coordinates.outputs["UV"], mapping.inputs["Vector"])
        links.new(mapping.outputs[0], texture.inputs["Vector"])
        links.new(texture.outputs[0], node.inputs[socket])
        # A second UV map that nothing reads.
        bpy.data.objects[name].data.uv_layers.new(name="Unused")
    nodes, links, node = material("Glowing picture", "ShaderNodeEmission")
    texture = nodes.new("ShaderNodeTexImage")
    texture.image = picture
    links.new(texture.outputs[0], node.inputs["Color"])
    truth.key(node.inputs["Strength"], "default_value", [(START, 1.0), (END, 5.0)], "LINEAR")
    nodes, links, node = material("Normal mapped")
    texture, normal = nodes.new("ShaderNodeTexImage"), nodes.new("ShaderNodeNormalMap")
    texture.image = picture
    links.new(texture.outputs[0], normal.inputs["Color"])
    links.new(normal.outputs[0], node.inputs["Normal"])


def vertex_colored():
    for name, reads in (("Colour read", True), ("Colour unread", False)):
        nodes, links, node = material(name)
        mesh = bpy.data.objects[name].data
        colors = mesh.color_attributes.new("Col", "FLOAT_COLOR", "POINT")
        for i, item in enumerate(colors.data):
            item.color = (i / len(colors.data), 0.5, 0.25, 1.0)
        if reads:
            attribute = nodes.new("ShaderNodeVertexColor")
            attribute.layer_name = "Col"
            links.new(attribute.outputs["Color"], node.inputs["Base Color"])


def animated():
    _, _, node = material("Animated")
    truth.key(node.inputs["Base Color"], "default_value", [(START, (1, 0, 0, 1)), (END, (0, 0, 1, 1))], "LINEAR")
    truth.key(node.inputs["Roughness"], "default_value", [(START, 0.2), (END, 0.9)])
    node.inputs["Emission"].default_value = (1.0, 0.5, 0.0, 1)
    truth.key(node.inputs["Emission Strength"], "default_value", [(START, 0.0), (END, 6.0)])
    _, _, node = material("Animated diffuse", "ShaderNodeBsdfDiffuse")
    truth.key(node.inputs["Color"], "default_value", [(START, (0, 1, 0, 1)), (END, (1, 1, 0, 1))])
    _, _, node = material("Animated sheen")
    truth.key(node.inputs["Sheen Tint"], "default_value", [(START, 0.0), (END, 0.5)])


def unsayable(picture):
    nodes, links, node = material("Noise")
    noise = nodes.new("ShaderNodeTexNoise")
    links.new(noise.outputs["Color"], node.inputs["Base Color"])
    node.inputs["Base Color"].default_value = (0.4, 0.3, 0.2, 1)
    nodes, links, node = material("Ramped")
    ramp, texture = nodes.new("ShaderNodeValToRGB"), nodes.new("ShaderNodeTexImage")
    texture.image = picture
    links.new(texture.outputs[0], ramp.inputs[0])
    links.new(ramp.outputs[0], node.inputs["Base Color"])
    for name, socket in (("Subsurface", "Subsurface"), ("Clearcoat", "Clearcoat"), ("Transmission", "Transmission")):
        _, _, node = material(name)
        node.inputs[socket].default_value = 0.5
    nodes, links, node = material("Bumpy")
    links.new(nodes.new("ShaderNodeBump").outputs[0], node.inputs["Normal"])
    nodes, links, mix = material("Mixed", "ShaderNodeMixShader")
    links.new(nodes.new("ShaderNodeBsdfDiffuse").outputs[0], mix.inputs[1])
    links.new(nodes.new("ShaderNodeBsdfGlossy").outputs[0], mix.inputs[2])
    nodes["Diffuse BSDF"].inputs["Color"].default_value = (0.9, 0.2, 0.1, 1)
    _, _, node = material("Glass", "ShaderNodeBsdfGlass")
    nodes, links, node = material("Smoke")
    links.new(nodes.new("ShaderNodeVolumeScatter").outputs[0], nodes["Material Output"].inputs["Volume"])
    nodes, links, node = material("Box mapped")
    texture = nodes.new("ShaderNodeTexImage")
    texture.image, texture.projection = picture, "BOX"
    links.new(texture.outputs[0], node.inputs["Base Color"])


def objects_unsayable():
    hairy = truth.grid("Hairy", location=(5, 0, 0))
    hairy.modifiers.new("Hair", "PARTICLE_SYSTEM")
    hairy.particle_systems[0].settings.type = "HAIR"
    truth.grid("Hold-out", location=(5, 3, 0)).is_holdout = True
    truth.grid("Shy", location=(5, 6, 0)).visible_diffuse = False
    truth.link("Fog", bpy.data.volumes.new("Fog"), location=(5, 9, 0))


def record(depsgraph):
    nodes = {name: bpy.data.materials[name].node_tree.nodes for name in ("Animated", "Animated diffuse")}
    shader = nodes["Animated"]["Principled BSDF"].inputs
    return {
        "base": list(shader["Base Color"].default_value), "roughness": shader["Roughness"].default_value,
        "emission": [c * shader["Emission Strength"].default_value for c in shader["Emission"].default_value][:3],
        "diffuse": list(nodes["Animated diffuse"]["Diffuse BSDF"].inputs["Color"].default_value),
    }


def main():
    scene = truth.new_scene(END, START)
    scene.world = bpy.data.worlds.new("Sky")
    scene.world.use_nodes = True
    tree = scene.world.node_tree
    tree.links.new(tree.nodes.new("ShaderNodeTexSky").outputs[0], tree.nodes["Background"].inputs["Color"])
    picture = image()
    plain()
    seen_through(picture)
    textured(picture)
    vertex_colored()
    animated()
    unsayable(picture)
    objects_unsayable()
    truth.save((1, 3, 5, 9), record)


main()
