# SPDX-License-Identifier: Apache-2.0
"""Materials of an export: values, textures, animation, and the list of what has no words."""

import pytest


@pytest.fixture(scope="module")
def scene(built):
    return built("materials")


def index(scene, name):
    found = [i for i, m in enumerate(scene.gltf.json["materials"]) if m["name"] == name]
    assert len(found) == 1, f"{len(found)} materials named {name}"
    return found[0]


def material(scene, name):
    return scene.gltf.json["materials"][index(scene, name)]


def primitive(scene, node_name):
    node = scene.gltf.json["nodes"][scene.gltf.node(node_name)]
    primitives = scene.gltf.json["meshes"][node["mesh"]]["primitives"]
    assert len(primitives) == 1
    return primitives[0]


def emission(description):
    strength = description.get("extensions", {}).get("KHR_materials_emissive_strength", {}).get("emissiveStrength", 1.0)
    return [c * strength for c in description.get("emissiveFactor", [0, 0, 0])]


def test_principled(scene):
    plain = material(scene, "Plain")
    assert plain["pbrMetallicRoughness"]["baseColorFactor"] == pytest.approx([0.8, 0.1, 0.2, 1])
    assert plain["pbrMetallicRoughness"]["roughnessFactor"] == pytest.approx(0.35)
    assert plain["pbrMetallicRoughness"]["metallicFactor"] == pytest.approx(0.25)
    assert plain["extensions"]["BOUNCE_scene"] == {"diffuse": "disney", "specular": pytest.approx(0.7)}
    assert plain["doubleSided"] is True and "emissiveFactor" not in plain


def test_diffuse(scene):
    diffuse = material(scene, "Diffuse")
    assert diffuse["pbrMetallicRoughness"]["baseColorFactor"] == pytest.approx([0.1, 0.6, 0.3, 1])
    assert diffuse["pbrMetallicRoughness"]["metallicFactor"] == 0
    assert diffuse["extensions"]["BOUNCE_scene"] == {"diffuse": "lambert", "specular": 0}


def test_materials_without_nodes_and_surfaces_without_materials(scene):
    assert material(scene, "No nodes")["pbrMetallicRoughness"]["baseColorFactor"] == pytest.approx([0.3, 0.5, 0.7, 1])
    bare = scene.gltf.json["materials"][primitive(scene, "Bare")["material"]]
    assert bare["pbrMetallicRoughness"]["baseColorFactor"] == pytest.approx([0.8, 0.8, 0.8, 1])
    assert bare["extensions"]["BOUNCE_scene"] == {"diffuse": "lambert", "specular": 0}


@pytest.mark.parametrize("name, wanted, base", [
    ("Lamp", [8.0, 4.0, 2.0], [0, 0, 0, 1]), ("Glowing", [2.0, 2.0, 4.0], None), ("Dim", [0.5, 0.25, 0.125], None),
    ("Added", [0.3, 0.2, 0.1], [0.2, 0.4, 0.6, 1]),
])
def test_emission(scene, name, wanted, base):
    found = material(scene, name)
    assert emission(found) == pytest.approx(wanted, rel=1e-6)
    assert max(found["emissiveFactor"]) <= 1.0
    if base is not None:
        assert found["pbrMetallicRoughness"]["baseColorFactor"] == pytest.approx(base)


def test_alpha(scene):
    assert material(scene, "Transparent")["alphaMode"] == "BLEND"
    assert material(scene, "Transparent")["pbrMetallicRoughness"]["baseColorFactor"][3] == pytest.approx(0.4)
    assert "alphaMode" not in material(scene, "Plain")


@pytest.mark.parametrize("name, mode, alpha, textured", [
    ("Cut by image", "MASK", 1.0, True), ("Clear by image", "BLEND", 1.0, True), ("Half clear", "BLEND", 0.3, True),
    ("Mixed clear", "BLEND", 0.3, False), ("Mixed clear, other way", "BLEND", 0.7, False),
    ("Mixed by image", "BLEND", 1.0, True), ("Textured", None, 1.0, True),
])
def test_alpha_is_what_cycles_sees_through(scene, name, mode, alpha, textured):
    found = material(scene, name)
    pbr = found["pbrMetallicRoughness"]
    assert found.get("alphaMode") == mode
    assert pbr["baseColorFactor"][3] == pytest.approx(alpha)
    assert ("baseColorTexture" in pbr) == textured
    if mode == "MASK":
        assert found["alphaCutoff"] == pytest.approx(0.3, abs=1e-6) and found["alphaCutoff"] > 0.3


def test_mixed_surface_keeps_its_colour(scene):
    for name in ("Mixed clear", "Mixed clear, other way", "Mixed by image"):
        assert material(scene, name)["pbrMetallicRoughness"]["baseColorFactor"][:3] == pytest.approx([0.2, 0.4, 0.6])


def test_constant_beside_an_image_is_its_factor(scene):
    pbr = material(scene, "Times constant")["pbrMetallicRoughness"]
    assert "baseColorTexture" in pbr and pbr["baseColorFactor"] == pytest.approx([0.5, 0.25, 1, 1])


@pytest.mark.parametrize("name, texture, encoding", [
    ("Data as colour", "baseColorTexture", "linear"), ("Textured", "baseColorTexture", None),
    ("Colour as data", "metallicRoughnessTexture", "srgb"), ("Data as data", "metallicRoughnessTexture", None),
])
def test_colour_spaces_that_gltf_does_not_expect(scene, name, texture, encoding):
    extensions = material(scene, name)["pbrMetallicRoughness"][texture].get("extensions", {})
    assert extensions.get("BOUNCE_scene") == (None if encoding is None else {"encoding": encoding})


def test_normal_map_in_srgb(scene):
    assert material(scene, "Normal mapped")["normalTexture"]["extensions"]["BOUNCE_scene"] == {"encoding": "srgb"}


@pytest.mark.parametrize("name", ["Textured", "Textured diffuse"])
def test_textures(scene, name):
    texture = material(scene, name)["pbrMetallicRoughness"]["baseColorTexture"]
    assert texture["extensions"]["KHR_texture_transform"]["scale"] == pytest.approx([2, 3])
    textures = scene.gltf.json["textures"]
    other = material(scene, "Textured")["pbrMetallicRoughness"]["baseColorTexture"]
    assert textures[texture["index"]]["source"] == textures[other["index"]]["source"], "one image serves both"
    attributes = primitive(scene, name)["attributes"]
    assert "TEXCOORD_0" in attributes and "TEXCOORD_1" not in attributes


def test_unreadable_inputs_have_their_unconnected_colour(scene):
    noise = material(scene, "Noise")["pbrMetallicRoughness"]
    assert noise["baseColorFactor"] == pytest.approx([0.4, 0.3, 0.2, 1]) and "baseColorTexture" not in noise
    ramped = material(scene, "Ramped")["pbrMetallicRoughness"]
    assert "baseColorTexture" in ramped and ramped["baseColorFactor"] == [1, 1, 1, 1]


def test_textured_emission_keeps_its_animated_strength(scene):
    i = index(scene, "Glowing picture")
    assert "emissiveTexture" in material(scene, "Glowing picture")
    strength = f"/materials/{i}/extensions/KHR_materials_emissive_strength/emissiveStrength"
    for frame, wanted in ((1, 1.0), (5, 3.0), (9, 5.0)):
        moment = scene.gltf.at(frame)
        assert moment.pointer(f"/materials/{i}/emissiveFactor") * moment.pointer(strength) == pytest.approx(
            [wanted] * 3, rel=1e-5)


def test_attributes_that_no_material_reads_are_left_out(scene):
    assert set(primitive(scene, "Plain")["attributes"]) == {"POSITION", "NORMAL"}
    assert "COLOR_0" in primitive(scene, "Colour read")["attributes"]
    assert "COLOR_0" not in primitive(scene, "Colour unread")["attributes"]
    assert "TANGENT" in primitive(scene, "Normal mapped")["attributes"]
    assert "TANGENT" not in primitive(scene, "Textured")["attributes"]


@pytest.mark.parametrize("frame", [1, 3, 5, 9])
def test_animated_materials(scene, frame):
    moment, truth = scene.gltf.at(frame), scene.truth[str(frame)]
    i = index(scene, "Animated")
    pbr = f"/materials/{i}/pbrMetallicRoughness"
    assert moment.pointer(f"{pbr}/baseColorFactor") == pytest.approx(truth["base"], abs=1e-6)
    assert moment.pointer(f"{pbr}/roughnessFactor") == pytest.approx(truth["roughness"], abs=1e-6)
    strength = moment.pointer(f"/materials/{i}/extensions/KHR_materials_emissive_strength/emissiveStrength")
    assert moment.pointer(f"/materials/{i}/emissiveFactor") * strength == pytest.approx(truth["emission"], abs=1e-5)
    i = index(scene, "Animated diffuse")
    assert moment.pointer(f"/materials/{i}/pbrMetallicRoughness/baseColorFactor") == pytest.approx(
        truth["diffuse"], abs=1e-6)
    assert f"/materials/{i}/pbrMetallicRoughness/roughnessFactor" not in scene.gltf.channels()


def test_mix_takes_the_first_surface_it_names(scene):
    assert material(scene, "Mixed")["pbrMetallicRoughness"]["baseColorFactor"] == pytest.approx([0.9, 0.2, 0.1, 1])


def test_unsupported(scene):
    def of(name, what):
        return name, f"material '{name}': {what}"

    assert scene.unsupported() == {
        ("Scene", "world 'Sky': Color comes from Sky Texture; exported as black"),
        of("Noise", "Principled BSDF: Base Color comes from Noise Texture"),
        of("Ramped", "Principled BSDF: Base Color comes from ColorRamp; its image is exported as it is"),
        of("Subsurface", "Principled BSDF: Subsurface"),
        of("Clearcoat", "Principled BSDF: Clearcoat"),
        of("Transmission", "Principled BSDF: Transmission"),
        of("Bumpy", "Normal comes from Bump"),
        of("Mixed", "Mix Shader"),
        of("Glass", "Glass BSDF, exported as a Diffuse BSDF of its colour"),
        of("Smoke", "volume"),
        of("Clipped", "Principled BSDF: Base Color: Image Texture with extension Clip, exported as Extend"),
        of("Clipped", "Principled BSDF: Base Color: Image Texture with cubic interpolation, exported as linear"),
        of("Tinted", "Principled BSDF: Specular Tint"),
        of("Tinted", "Principled BSDF: Multiscatter GGX, exported as GGX"),
        of("Box mapped", "Principled BSDF: Base Color comes from Image Texture with box projection; "
           "its image is exported as it is"),
        of("Animated sheen", 'animation of nodes["Principled BSDF"].inputs[13].default_value'),
        ("Hairy", "particle system 'Hair'"),
        ("Hold-out", "holdout"),
        ("Shy", "not visible to diffuse rays"),
        ("Fog", "volume"),
    }
