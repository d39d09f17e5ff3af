# SPDX-License-Identifier: GPL-3.0-or-later
"""What is in the document twice is stored once: meshes of the same content and materials, vertex data, images.

Works on the exporter's objects before it numbers them: whatever is one object becomes one entry.
"""

import enum
import hashlib

import numpy

_MATERIAL_TEXTURES = ("normal_texture", "occlusion_texture", "emissive_texture")
_PBR_TEXTURES = ("base_color_texture", "metallic_roughness_texture")


def share(scenes, materials):
    """`materials` are lists of versions of one material. Yields (name, what, reason) of what is stored no more."""
    return [*_share_images([m for versions in materials for m in versions]), *_share_meshes(scenes)]


def content(value, by_identity=()):
    """A hashable description by content, objects in `by_identity` types and materials by who they are."""
    if value is None or isinstance(value, (bool, int, float, str)):
        return value
    if isinstance(value, (bytes, bytearray, memoryview)):
        return hashlib.sha256(value).digest()
    if isinstance(value, dict):
        return tuple((key, content(value[key], by_identity)) for key in sorted(value))
    if isinstance(value, (list, tuple)):
        return tuple(content(item, by_identity) for item in value)
    if type(value).__name__ in by_identity:
        return id(value)
    if hasattr(value, "__dict__") and not isinstance(value, enum.Enum):
        return (type(value).__name__, *((name, content(item, by_identity)) for name, item in sorted(vars(value).items())
                                        if name != "name"))
    if isinstance(value, (numpy.ndarray, numpy.generic)):
        return str(value.dtype), value.shape, hashlib.sha256(numpy.ascontiguousarray(value).tobytes()).digest()
    if isinstance(value, enum.Enum):
        return value.name
    raise TypeError(f"duplicates cannot be told of a {type(value).__name__}")


def _share_meshes(scenes):
    meshes, accessors, kept = {}, {}, {}
    for node in _nodes(scenes):
        mesh = node.mesh
        if mesh is None or id(mesh) in kept:
            node.mesh = kept.get(id(mesh), (mesh, None))[0]
            continue
        first = meshes.setdefault(content(mesh, {"Material"}), mesh)
        # The merged mesh is held as well: its id must not be given to another.
        kept[id(mesh)] = (first, mesh)
        node.mesh = first
        if first is mesh:
            _share_accessors(mesh, accessors)
        else:
            yield mesh.name, "mesh", f"the same as '{first.name}', which stands for both"


def _share_accessors(mesh, known):
    """The same vertices under another material, or indices of the same topology."""
    for primitive in mesh.primitives:
        if "KHR_draco_mesh_compression" in (primitive.extensions or {}):
            continue  # what they describe is within one compressed block
        primitive.attributes = {
            name: known.setdefault(content(accessor), accessor) for name, accessor in primitive.attributes.items()
        }
        if primitive.indices is not None:
            primitive.indices = known.setdefault(content(primitive.indices), primitive.indices)


def _share_images(materials):
    images, textures, told = {}, {}, set()
    for info in texture_infos(materials):
        texture = info.index
        if texture is None or texture.source is None:
            continue
        image = texture.source
        first = images.setdefault(content(image), image)
        if first is not image and id(image) not in told:
            told.add(id(image))
            yield image.name, "image", f"the same as '{first.name}', which stands for both"
        texture.source = first
        info.index = textures.setdefault(content(texture, {"Image"}), texture)


def texture_infos(materials):
    """Of glTF materials every place that names a texture."""
    for material in materials:
        owners = [(material, _MATERIAL_TEXTURES), (material.pbr_metallic_roughness, _PBR_TEXTURES)]
        for owner, names in owners:
            for name in names:
                info = getattr(owner, name, None)
                if info is not None:
                    yield info


def _nodes(scenes):
    waiting = [node for scene in scenes for node in scene.nodes]
    while waiting:
        node = waiting.pop(0)
        yield node
        waiting.extend(node.children or [])
