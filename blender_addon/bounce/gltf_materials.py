# SPDX-License-Identifier: GPL-3.0-or-later
"""Puts into exported materials what Blender's exporter leaves out, and their animation."""

import copy

import numpy as np
from io_scene_gltf2.io.com import gltf2_io
from io_scene_gltf2.io.com.gltf2_io_extensions import Extension

from . import materials, textures
from .animation import Channel
from .duplicates import texture_infos
from .pointers import Pointer
from .tracks import is_constant

_STRENGTH = "KHR_materials_emissive_strength"


def complete(material, blender_material, export):
    """May be called more than once for one material, which changes nothing."""
    key = blender_material.as_pointer()
    model = export.models[key][1]
    values = export.samples.at_start("material", key)
    known = export.materials.setdefault(key, [])
    if not any(material is other for other in known):
        known.append(material)
    material.extensions = dict(material.extensions or {})
    if "KHR_materials_unlit" in material.extensions:
        _glow_instead_of_unlit(material)
    # Cycles shades both sides whatever the viewport's backface culling.
    material.double_sided = True
    pbr = material.pbr_metallic_roughness
    for name, attribute in (("baseColorFactor", "base_color_factor"), ("metallicFactor", "metallic_factor"),
                            ("roughnessFactor", "roughness_factor")):
        if name in values:
            setattr(pbr, attribute, values[name])
    _set_emission(material, export.samples.values["material", key])
    _set_alpha(material, model, export.samples.values["material", key])
    material.extensions["BOUNCE_scene"] = {"diffuse": model.diffuse, "specular": values["specular"]}


def _glow_instead_of_unlit(material):
    """A colour linked straight to the output is emission to Cycles; the exporter writes it as unlit."""
    del material.extensions["KHR_materials_unlit"]
    pbr = material.pbr_metallic_roughness
    color = pbr.base_color_factor or [1.0, 1.0, 1.0, 1.0]
    material.emissive_factor, material.emissive_texture = color[:3], pbr.base_color_texture
    pbr.base_color_texture = None
    pbr.base_color_factor = [0.0, 0.0, 0.0, 1.0]


def _emission_scale(track):
    """glTF's emissive factor ends at 1; the brightest moment sets a strength that stays fixed."""
    return max(1.0, float(track.max()))


def _set_emission(material, tracks):
    if "emissive" not in tracks:
        return
    scale = _emission_scale(tracks["emissive"])
    factor = (tracks["emissive"][0] / scale).tolist()
    moves = not is_constant(tracks["emissive"])
    material.emissive_factor = factor if any(factor) or moves else None
    material.extensions.pop(_STRENGTH, None)
    if scale > 1.0:
        material.extensions[_STRENGTH] = Extension(_STRENGTH, {"emissiveStrength": scale}, required=False)


def _set_alpha(material, model, tracks):
    """Cycles lets light through wherever alpha is below 1; Eevee's blend mode, which the exporter reads, says nothing."""
    least = 1.0 if "baseColorFactor" not in tracks else float(np.asarray(tracks["baseColorFactor"])[:, 3].min())
    material.alpha_mode = material.alpha_cutoff = None
    if model.alpha_cutoff is not None and least == 1.0:
        # glTF keeps what equals the cutoff, a Math node does not.
        material.alpha_mode, material.alpha_cutoff = "MASK", float(np.nextafter(np.float32(model.alpha_cutoff), 2))
    elif model.alpha_image or least < 1.0:
        material.alpha_mode = "BLEND"


def set_encoding(texture_info, shader_sockets):
    """Says where an image's colour space is not what glTF takes for granted at this place."""
    encoding = textures.encoding(shader_sockets[0])
    if encoding is not None:
        texture_info.extensions = {**(texture_info.extensions or {}), "BOUNCE_scene": {"encoding": encoding}}


def finish_primitives(mesh, blender_materials, export):
    for primitive in mesh.primitives:
        if primitive.material is None:
            export.default_material = export.default_material or _default_material()
            primitive.material = export.default_material
        _drop_unused_attributes(mesh.name, primitive, export)


def _default_material():
    return gltf2_io.Material(
        alpha_cutoff=None, alpha_mode=None, double_sided=True, emissive_factor=None, emissive_texture=None,
        extensions={"BOUNCE_scene": {"diffuse": "lambert", "specular": 0.0}}, extras=None, name="Default",
        normal_texture=None, occlusion_texture=None,
        pbr_metallic_roughness=gltf2_io.MaterialPBRMetallicRoughness(
            base_color_factor=materials.DEFAULT_BASE_COLOR, base_color_texture=None, extensions=None, extras=None,
            metallic_factor=0.0, metallic_roughness_texture=None, roughness_factor=1.0,
        ),
    )


def _drop_unused_attributes(name_of_mesh, primitive, export):
    model = _model_of(primitive.material, export)
    unused = set()
    if model is None or model.color_attribute is None:
        unused.add("COLOR_0")
    # Unlike a colour, which glTF multiplies into the material whether that says so or not, it changes nothing.
    if (model is None or not model.normal_map) and not export.options.keep_all:
        unused.add("TANGENT")
    if not export.options.keep_all:
        unused.update(_texcoords_behind_the_last_used(primitive))
    unused &= set(primitive.attributes)
    if not unused:
        return
    words = {"TANGENT": ("tangents", "its material has no normal map"),
             "COLOR_0": ("vertex colours", "its material does not read them, and glTF would tint by them")}
    for name in sorted(unused):
        what, reason = words.get(name, ("texture coordinates", "its material has no image at them"))
        export.left_out.append((name_of_mesh, what, reason))
    # Accessors are shared with primitives of other materials, whose compressed vertices may be others.
    primitive.attributes = {
        name: copy.copy(accessor) for name, accessor in primitive.attributes.items() if name not in unused
    }
    primitive.indices = copy.copy(primitive.indices)


def _texcoords_behind_the_last_used(primitive):
    """Of a mesh of several materials, those that another one reads. glTF numbers them without gaps."""
    used = max((info.tex_coord or 0 for info in texture_infos([primitive.material])), default=-1)
    return {name for name in primitive.attributes if name.startswith("TEXCOORD_") and int(name[9:]) > used}


def _model_of(gltf_material, export):
    for key, versions in export.materials.items():
        if any(gltf_material is version for version in versions):
            return export.models[key][1]
    return None


def channels(material, blender_material, tracks):
    for name in ("baseColorFactor", "metallicFactor", "roughnessFactor"):
        if name in tracks and not is_constant(tracks[name]):
            yield Channel(None, Pointer("material", material, f"pbrMetallicRoughness/{name}"), tracks[name])
    emissive = tracks.get("emissive")
    if emissive is not None and not is_constant(emissive):
        factor = np.asarray(emissive) / _emission_scale(emissive)
        yield Channel(None, Pointer("material", material, "emissiveFactor"), factor)
