# SPDX-License-Identifier: Apache-2.0
"""relMSE and bias of a picture over the pixels whose reference is no brighter than LIMIT, nor within three of one that is.

    /usr/bin/python3 -I tests/cycles/compare_without_emitter.py LIT.exr REFERENCE.exr LIMIT

What an emitter's own pixels and outlines weigh is left out so (docs/lights.md).
"""
import sys

import numpy
import OpenImageIO


def read(path):
    return OpenImageIO.ImageBuf(path).get_pixels(OpenImageIO.FLOAT)[..., :3]


picture, reference = read(sys.argv[1]), read(sys.argv[2])
bright = reference.max(axis=2) > float(sys.argv[3])
left_out = numpy.zeros_like(bright)
for dy in range(-3, 4):
    for dx in range(-3, 4):
        left_out |= numpy.roll(bright, (dy, dx), (0, 1))
a, b = picture[~left_out], reference[~left_out]
print(f"relMSE {((a - b) ** 2 / (b * b + 0.01)).mean():.5f}, bias {100 * (a.mean() / b.mean() - 1):+.2f} %")
