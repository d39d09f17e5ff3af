# SPDX-License-Identifier: Apache-2.0
"""Compressed exports, through our library and Blender's own exporter and importer."""

import json
import shutil

import bounce_schema
import numpy as np
import pytest
from conftest import ADDON, SCRIPTS
from gltf_eval import Gltf

MESHES = ["Keyed", "Skinned", "Morphed", "Curve", "Still"]


@pytest.fixture(scope="module")
def compressed(built, export, draco_library, tmp_path_factory):
    path = tmp_path_factory.mktemp("draco") / "motion.glb"
    done = export(built("motion").blend, path, draco=draco_library)
    return path, done.stdout


@pytest.fixture(scope="module")
def imported(blender, built, compressed, draco_library, tmp_path_factory):
    folder = tmp_path_factory.mktemp("import")

    def read(path, name):
        blender("--python-exit-code", "3", "-P", SCRIPTS / "import_glb.py", "--", path, folder / name,
                draco=draco_library)
        return json.loads((folder / name).read_text())

    return read(built("motion").path, "plain.json"), read(compressed[0], "draco.json")


def test_compressed_export_is_valid_and_smaller(built, compressed):
    document = Gltf(compressed[0]).json
    bounce_schema.validate(document)
    assert "KHR_draco_mesh_compression" in document["extensionsRequired"]
    primitives = [p for mesh in document["meshes"] for p in mesh["primitives"]]
    assert all("KHR_draco_mesh_compression" in p["extensions"] for p in primitives)
    assert compressed[0].stat().st_size < built("motion").path.stat().st_size


def test_the_log_names_what_keeps_its_order(compressed):
    assert "vertex order kept, so compressed less, for shape keys of: Skinned, Morphed" in compressed[1]


def mesh_of(scene, name):
    """Blender's importer numbers a name that an armature's node took before."""
    return scene.get(name) or scene[f"{name}.001"]


def nearest(points, others):
    distances = [np.sqrt(((others - point) ** 2).sum(axis=1)) for point in points]
    return np.array([d.argmin() for d in distances]), np.array([d.min() for d in distances])


@pytest.mark.parametrize("name", MESHES)
def test_blender_reads_back_what_it_wrote(imported, name):
    plain, draco = (mesh_of(scene, name) for scene in imported)
    positions, compressed = np.array(plain["positions"]), np.array(draco["positions"])
    # 16 bits over the mesh's own extent, which a scale in the node may stretch.
    step = (positions.max(axis=0) - positions.min(axis=0)).max() / (2 ** 16 - 1)
    match, distance = nearest(compressed, positions)
    assert distance.max() <= step
    assert nearest(positions, compressed)[1].max() <= step
    assert len(draco["triangles"]) == len(plain["triangles"])
    assert draco["keys"] == plain["keys"] and draco["groups"] == plain["groups"]


def corner_normals(scene, names):
    """Corner normals by triangle; triangles are keyed by the names of their corners, begun at the smallest."""
    result = {}
    for i, triangle in enumerate(scene["triangles"]):
        corners = [int(names[v]) for v in triangle]
        turned = [(corners.index(min(corners)) + k) % 3 for k in range(3)]
        result[tuple(corners[k] for k in turned)] = np.array([scene["normals"][3 * i + k] for k in turned])
    return result


def test_triangles_keep_their_front_and_their_normals(imported):
    plain, draco = (scene["Still"] for scene in imported)
    positions = np.array(plain["positions"])
    wanted = corner_normals(plain, nearest(positions, positions)[0])
    found = corner_normals(draco, nearest(np.array(draco["positions"]), positions)[0])
    assert set(found) == set(wanted)
    for corners, normals in wanted.items():
        assert np.abs(found[corners] - normals).max() < 2e-3


def test_skin_weights_survive(imported):
    plain, draco = (mesh_of(scene, "Skinned") for scene in imported)
    match, _ = nearest(np.array(draco["positions"]), np.array(plain["positions"]))
    for i, weights in enumerate(draco["weights"]):
        wanted = dict(plain["weights"][match[i]])
        assert all(abs(weight - wanted.get(group, 0.0)) < 1e-3 for group, weight in weights)


def test_the_library_is_found_in_a_checkout(export, built, draco_library, tmp_path):
    """Nothing set, the add-on in a checkout with a build: the library is found there."""
    checkout = tmp_path / "checkout"
    shutil.copytree(ADDON, checkout / "blender_addon", ignore=shutil.ignore_patterns("*.so"))
    (checkout / "build/release").mkdir(parents=True)
    shutil.copy(draco_library, checkout / "build/release/libextern_draco.so")
    done = export(built("motion").blend, tmp_path / "out.glb", addon=checkout / "blender_addon")
    assert "not compressed" not in done.stdout
    assert "KHR_draco_mesh_compression" in Gltf(tmp_path / "out.glb").json["extensionsRequired"]


def test_without_the_library_the_export_goes_on_and_says_so(export, built, tmp_path):
    shutil.copytree(ADDON, tmp_path / "blender_addon", ignore=shutil.ignore_patterns("*.so"))
    done = export(built("motion").blend, tmp_path / "out.glb", addon=tmp_path / "blender_addon")
    assert "Draco library not found: the meshes are not compressed" in done.stdout
    assert "extensionsRequired" not in Gltf(tmp_path / "out.glb").json
