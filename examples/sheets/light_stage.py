# SPDX-License-Identifier: Apache-2.0
"""A post, a sphere and a slab over a floor, for sheets of lights: penumbrae at contact, in the middle and far."""
import math

import common

ABOVE, ASIDE = (-1.2, 0.9, 3.2), (-3.0, 1.5, 3.6)
TARGET = (0.0, 0.0, 0.3)


def build(title, gloss=None):
    """gloss: (roughness, metallic) of a Principled floor and sphere instead of diffuse ones."""
    scene = common.new_scene(title)
    common.set_world((0.0, 0.0, 0.0))
    grey = common.diffuse("Grey", (0.7, 0.7, 0.7)) if gloss is None else common.principled("Grey", (0.7, 0.7, 0.7), *gloss)
    if gloss is not None:
        # The law of docs/lights.md; the node's other distribution has several scatterings.
        grey.node_tree.nodes["Principled BSDF"].distribution = "GGX"
    red = common.diffuse("Red", (0.7, 0.3, 0.2))
    common.quad("Floor", [(-6, -6, 0), (6, -6, 0), (6, 6, 0), (-6, 6, 0)], grey)
    common.box("Post", (0.12, 0.12, 1.6), (-0.1, 0.35, 0.8), red)
    common.lathe("Sphere", [(0.3 * math.sin(math.pi * i / 24), 0.3 - 0.3 * math.cos(math.pi * i / 24))
                            for i in range(25)], 48, grey, (0.7, -0.3, 0.0))
    common.box("Slab", (0.7, 0.5, 0.04), (-0.7, -0.5, 0.55), grey)
    common.box("Leg", (0.05, 0.05, 0.53), (-0.95, -0.5, 0.265), red)
    common.add_camera((0.6, -3.6, 2.2), (0.1, 0.1, 0.3), 35.0)
    return scene
