# SPDX-License-Identifier: GPL-3.0-or-later
"""One export, from the open scene to a file in its place."""

import os
import shutil
import tempfile
import time
from dataclasses import dataclass, field
from pathlib import Path

import bpy

from . import (
    blender_gltf, context, deformation, draco_library, geometry, materials, omissions, sampling, surrogates, survey,
)
from .edits import Edits
from .errors import ExportError
from .visibility import Visibility, animated_paths, evaluate_as_render

ADDON_FOLDER = Path(__file__).resolve().parent


@dataclass
class Report:
    path: Path
    bytes_written: int
    seconds: float
    draco: str = None  # the library used, None where the file is not compressed
    notes: list = field(default_factory=list)
    unsupported: list = field(default_factory=list)
    left_out: list = field(default_factory=list)  # (name, what, reason)

    def lines(self, verbose=False):
        yield f"{self.path.name}: {self.bytes_written} bytes in {self.seconds:.1f} s"
        yield from self.notes
        for name, what in self.unsupported:
            yield f"not represented: {name}: {what}"
        if verbose:
            for name, what, reason in self.left_out:
                yield f"left out: {name}: {what}: {reason}"

    def as_json(self):
        return {
            "file": self.path.name, "bytes": self.bytes_written,
            "left_out": [dict(zip(("name", "what", "reason"), entry)) for entry in self.left_out],
            "unsupported": [{"object": name, "what": what} for name, what in self.unsupported],
        }


def export(path, options):
    """Writes the open scene's active view layer to `path` (.glb or .gltf) and returns a Report."""
    began = time.monotonic()
    path = Path(os.path.abspath(path))
    if path.suffix.lower() not in {".glb", ".gltf"}:
        raise ExportError(f"cannot export to '{path.name}': the name must end in .glb or .gltf")
    if not path.parent.is_dir():
        raise ExportError(f"cannot export to '{path}': the folder does not exist")
    blender_gltf.require()
    library = None
    notes = []
    if options.draco:
        library = draco_library.locate(blender_gltf.own_draco_library(), ADDON_FOLDER)
        if library is None:
            notes.append("Draco library not found: the meshes are not compressed (build extern_draco, or see "
                         f"{draco_library.VARIABLE})")
    scene, view_layer = bpy.context.scene, bpy.context.view_layer
    _leave_edit_mode()
    frame_before = scene.frame_current, scene.frame_subframe
    try:
        with Edits() as edits:
            current = _prepare(scene, view_layer, options, edits)
            _write(path, options, library, current)
    finally:
        scene.frame_set(frame_before[0], subframe=frame_before[1])
    if library is not None and current.kept_in_order:
        notes.append("vertex order kept, so compressed less, for shape keys of: "
                     + ", ".join(dict.fromkeys(current.kept_in_order)))
    return Report(path, path.stat().st_size, time.monotonic() - began, str(library) if library else None, notes,
                  list(dict.fromkeys(current.unsupported)), list(dict.fromkeys(current.left_out)))


def _leave_edit_mode():
    if bpy.context.active_object is not None and bpy.context.active_object.mode != "OBJECT":
        bpy.ops.object.mode_set(mode="OBJECT")


def _prepare(scene, view_layer, options, edits):
    """Reads everything over time, then leaves the scene at its first frame with meshes and materials that Blender's
    exporter understands."""
    if scene.frame_end < scene.frame_start:
        raise ExportError(f"the frame range of scene '{scene.name}' is empty")
    visibility = Visibility(scene, view_layer)
    evaluate_as_render(scene, view_layer, visibility, edits)
    objects = _with_ancestors(visibility.objects, scene)
    models = {
        m.as_pointer(): (m, materials.analyse(m, bpy.app.version)) for m in bpy.data.materials if not m.is_grease_pencil
    }
    frames = [scene.frame_start]
    if options.animation and sampling.is_animated(scene):
        frames = list(range(scene.frame_start, scene.frame_end + 1))
    samples = sampling.sample(scene, objects, models, frames)
    shown = list(visibility.objects.values())
    unsupported = [*survey.scene_issues(scene, view_layer)]
    for obj in shown:
        unsupported.extend((obj.name, what) for what in survey.object_issues(obj))
    for name in deformation.deforming(scene, shown, frames):
        unsupported.append((name, "deforms over time by something else than bones or shape keys; exported as it is at "
                                  "the first frame"))
    for name in deformation.skins_adrift(shown, samples):
        unsupported.append((name, "moves against the armature that deforms it"))

    scene.frame_set(scene.frame_start)
    unsupported.extend(survey.instancing_issues(bpy.context.evaluated_depsgraph_get(), visibility))

    def models_of(obj):
        return [models[slot.material.as_pointer()][1] for slot in obj.material_slots
                if slot.material is not None and slot.material.as_pointer() in models]

    prepared = geometry.prepare(scene, visibility, models_of, edits, options.keep_all)
    unsupported.extend(prepared.issues)
    used = {slot.material.as_pointer() for obj in shown for slot in obj.material_slots if slot.material is not None}
    for key, (material, model) in models.items():
        if key in used:
            surrogates.stand_in(material, model, edits)
            owner = next(obj for obj in shown if any(s.material == material for s in obj.material_slots))
            unsupported.extend((owner.name, f"material '{material.name}': {what}") for what in
                               [*model.issues, *_unexported_motion(material, model)])
    prepared.left_out.extend(omissions.unused_data(used, models, scene))
    return context.ExportContext(scene, options, visibility, models, samples, prepared, unsupported)


def _with_ancestors(objects, scene):
    """Hidden parents and armatures still move what they carry."""
    result = dict(objects)
    for obj in list(objects.values()):
        carriers = [obj.parent, *(getattr(m, "object", None) for m in obj.modifiers if m.type == "ARMATURE")]
        while carriers:
            carrier = carriers.pop()
            if carrier is not None and carrier.as_pointer() not in result:
                result[carrier.as_pointer()] = carrier
                carriers.append(carrier.parent)
    for obj in scene.objects:
        result.setdefault(obj.as_pointer(), obj)
    return result


def _unexported_motion(material, model):
    if material.node_tree is None or not material.use_nodes:
        return
    for path in sorted(animated_paths(material.node_tree)):
        if path not in model.animatable:
            yield f"animation of {path}"


def _as_export_error(failure):
    if isinstance(failure, ExportError):
        return failure
    return ExportError(f"{type(failure).__name__} in a hook: {failure}")


def _write(path, options, library, current):
    """The exporter writes into a folder of its own beside the target; what it wrote then moves over in one step a
    file, the one that names the others last."""
    used_images = options.keep_all or any(model.uv_maps for _, model in current.models.values())
    normal_maps = options.keep_all or any(model.normal_map for _, model in current.models.values())
    # The exporter caches by the identity of these wrappers; they must not be freed and reused meanwhile.
    kept_alive = [*bpy.data.meshes, *bpy.data.materials, *bpy.data.cameras, *bpy.data.lights, *bpy.data.objects]
    folder = Path(tempfile.mkdtemp(prefix=f".{path.stem}.", dir=path.parent))
    try:
        target = folder / path.name
        with context.active(current):
            try:
                blender_gltf.run(target, options, library is not None, used_images, normal_maps)
            finally:
                # Whatever else goes wrong after a failed hook goes wrong because of it.
                if current.failure is not None:
                    raise _as_export_error(current.failure) from current.failure
        if not target.is_file():
            raise ExportError("Blender's glTF exporter wrote no file")
        for written in sorted(folder.rglob("*"), key=lambda p: p == target):
            if written.is_file():
                destination = path.parent / written.relative_to(folder)
                destination.parent.mkdir(parents=True, exist_ok=True)
                os.replace(written, destination)
    finally:
        shutil.rmtree(folder)
        del kept_alive
