# SPDX-License-Identifier: GPL-3.0-or-later
"""Matrices of many frames at once, [frame, 4, 4]: axes and translation, rotation, scale. numpy alone."""

import numpy as np

# Blender is Z up, glTF is Y up: (x, y, z) -> (x, z, -y).
GLTF_FROM_BLENDER = np.array(
    [[1.0, 0.0, 0.0, 0.0], [0.0, 0.0, 1.0, 0.0], [0.0, -1.0, 0.0, 0.0], [0.0, 0.0, 0.0, 1.0]]
)
BLENDER_FROM_GLTF = np.linalg.inv(GLTF_FROM_BLENDER)


def object_in_gltf(world_matrices):
    """World matrices of what has its own axes turned along with the world: meshes, empties, armatures."""
    return GLTF_FROM_BLENDER @ world_matrices @ BLENDER_FROM_GLTF


def oriented_in_gltf(world_matrices):
    """World matrices of what keeps its axes: cameras and lights look along their own -Z in both, bones along +Y."""
    return GLTF_FROM_BLENDER @ world_matrices


def decompose(matrices):
    """(translations [f,3], quaternions xyzw [f,4], scales [f,3]). A mirrored matrix gets all scales negative,
    as Blender's own decomposition does. Shear has no place in it and is lost."""
    matrices = np.asarray(matrices, dtype=np.float64)
    linear = matrices[:, :3, :3]
    scale = np.linalg.norm(linear, axis=1)
    scale *= np.where(np.linalg.det(linear) < 0.0, -1.0, 1.0)[:, None]
    safe = np.where(np.abs(scale) > 1e-12, scale, 1.0)
    rotation = linear / safe[:, None, :]
    # A collapsed axis says nothing of the rotation; leave the rest orthonormal by Gram-Schmidt order.
    collapsed = np.any(np.abs(scale) <= 1e-12, axis=1)
    rotation[collapsed] = np.eye(3)
    rotation = _orthonormal(rotation)
    return matrices[:, :3, 3].copy(), _quaternions(rotation), scale


def compose(translations, quaternions, scales):
    count = len(translations)
    matrices = np.zeros((count, 4, 4))
    matrices[:, :3, :3] = _rotations(np.asarray(quaternions, dtype=np.float64)) * np.asarray(scales)[:, None, :]
    matrices[:, :3, 3] = translations
    matrices[:, 3, 3] = 1.0
    return matrices


def inverse(matrices):
    """Inverses; of a collapsed matrix the pseudo-inverse, so that what hangs under it stays finite."""
    matrices = np.asarray(matrices, dtype=np.float64)
    singular = np.abs(np.linalg.det(matrices)) < 1e-30
    result = np.empty_like(matrices)
    result[~singular] = np.linalg.inv(matrices[~singular])
    result[singular] = np.linalg.pinv(matrices[singular])
    return result


def relative_error(matrices, wanted):
    """Largest difference of the linear part to what was wanted, against its size: how much shear was lost."""
    size = np.maximum(np.abs(wanted[:, :3, :3]).max(axis=(1, 2)), 1e-12)
    return float((np.abs(matrices - wanted)[:, :3, :3].max(axis=(1, 2)) / size).max())


def _orthonormal(rotations):
    x = rotations[:, :, 0]
    y = rotations[:, :, 1] - np.sum(rotations[:, :, 1] * x, axis=1, keepdims=True) * x
    y /= np.maximum(np.linalg.norm(y, axis=1, keepdims=True), 1e-12)
    return np.stack([x, y, np.cross(x, y)], axis=2)


def _quaternions(r):
    """Of rotation matrices [f,3,3], xyzw, by the largest of the four components so that none divides by zero."""
    m00, m11, m22 = r[:, 0, 0], r[:, 1, 1], r[:, 2, 2]
    four = np.stack([1 + m00 - m11 - m22, 1 - m00 + m11 - m22, 1 - m00 - m11 + m22, 1 + m00 + m11 + m22], axis=1)
    largest = np.argmax(four, axis=1)
    sum_xy, sum_xz, sum_yz = r[:, 1, 0] + r[:, 0, 1], r[:, 0, 2] + r[:, 2, 0], r[:, 2, 1] + r[:, 1, 2]
    dif_yz, dif_xz, dif_xy = r[:, 2, 1] - r[:, 1, 2], r[:, 0, 2] - r[:, 2, 0], r[:, 1, 0] - r[:, 0, 1]
    rows = np.stack(
        [
            np.stack([four[:, 0], sum_xy, sum_xz, dif_yz], axis=1),
            np.stack([sum_xy, four[:, 1], sum_yz, dif_xz], axis=1),
            np.stack([sum_xz, sum_yz, four[:, 2], dif_xy], axis=1),
            np.stack([dif_yz, dif_xz, dif_xy, four[:, 3]], axis=1),
        ],
        axis=1,
    )
    q = rows[np.arange(len(r)), largest]
    return q / np.linalg.norm(q, axis=1, keepdims=True)


def _rotations(q):
    x, y, z, w = q[:, 0], q[:, 1], q[:, 2], q[:, 3]
    return np.stack(
        [
            np.stack([1 - 2 * (y * y + z * z), 2 * (x * y - z * w), 2 * (x * z + y * w)], axis=1),
            np.stack([2 * (x * y + z * w), 1 - 2 * (x * x + z * z), 2 * (y * z - x * w)], axis=1),
            np.stack([2 * (x * z - y * w), 2 * (y * z + x * w), 1 - 2 * (x * x + y * y)], axis=1),
        ],
        axis=1,
    )
