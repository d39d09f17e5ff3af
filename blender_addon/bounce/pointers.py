# SPDX-License-Identifier: GPL-3.0-or-later
"""JSON pointers of KHR_animation_pointer. No Blender needed.

Indices are known only when the file is laid out, so a pointer is kept as what it points into and a tail.
"""

from dataclasses import dataclass

_ROOTS = {
    "light": "/extensions/BOUNCE_scene/lights/{index}/{tail}",
    "punctual": "/extensions/KHR_lights_punctual/lights/{index}/{tail}",
    "camera": "/cameras/{index}/{tail}",
    "node": "/nodes/{index}/{tail}",
    "material": "/materials/{index}/{tail}",
    "world": "/extensions/BOUNCE_scene/world/{tail}",
    "view": "/extensions/BOUNCE_scene/view/{tail}",
}


@dataclass(frozen=True)
class Pointer:
    """`owner` is whatever `index_of` in `resolve` knows how to find; None for the world and the view."""

    kind: str
    owner: object
    tail: str

    def resolve(self, index_of):
        root = _ROOTS[self.kind]
        index = index_of(self.kind, self.owner) if "{index}" in root else None
        return root.format(index=index, tail=self.tail)
