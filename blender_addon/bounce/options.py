# SPDX-License-Identifier: GPL-3.0-or-later
"""What one export is asked to do. No Blender needed."""

from dataclasses import dataclass

# Finer than the defaults of Blender's exporter: at 10 bits a normal is off by up to 0.1 degrees, which a
# comparison with a path tracer sees; skin weights at 12 bits bend a limb visibly at its far end.
POSITION_BITS = 16
NORMAL_BITS = 14
TEXCOORD_BITS = 14
COLOR_BITS = 12
GENERIC_BITS = 16


@dataclass(frozen=True)
class Options:
    draco: bool = True
    draco_level: int = 7
    position_bits: int = POSITION_BITS
    normal_bits: int = NORMAL_BITS
    texcoord_bits: int = TEXCOORD_BITS
    color_bits: int = COLOR_BITS
    generic_bits: int = GENERIC_BITS
    animation: bool = True
    keep_all: bool = False  # what changes no picture travels as well, for comparison
