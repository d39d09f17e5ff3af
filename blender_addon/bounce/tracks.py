# SPDX-License-Identifier: GPL-3.0-or-later
"""Values over frames: what moves, and quaternions that do not flip. numpy alone, no Blender."""

from dataclasses import dataclass

import numpy as np

# Single precision keeps about seven digits; what differs by less than this is evaluation noise, not motion.
_NOISE = 1e-6


@dataclass
class Track:
    """`values` is frames x components. `step` holds each value until the next frame."""

    values: np.ndarray
    step: bool = False


def is_constant(values):
    values = np.asarray(values, dtype=np.float64).reshape(len(values), -1)
    spread = values.max(axis=0) - values.min(axis=0)
    return bool(np.all(spread <= _NOISE * np.maximum(1.0, np.abs(values).max(axis=0))))


def continuous_quaternions(quaternions):
    """q and -q are one rotation, but blending between them takes the long way round: pick the nearer sign."""
    result = np.array(quaternions, dtype=np.float64)
    for frame in range(1, len(result)):
        if np.dot(result[frame - 1], result[frame]) < 0.0:
            result[frame] = -result[frame]
    return result


def key_times(frames, fps):
    """Seconds since the first frame, one a frame, in the precision that the file stores."""
    return ((np.asarray(frames, dtype=np.float64) - frames[0]) / fps).astype(np.float32)
