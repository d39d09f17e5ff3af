# SPDX-License-Identifier: Apache-2.0
"""Writes the scene of the window tests: a white corner with a red wall, a cube that moves, a spot light.

Small, so that it draws fast without a GPU; animated over a second; with two cameras that see it from
different sides. No Blender is needed.
"""
import json
import struct

# Corners of a face in the order that makes its normal point along `normal`.
CUBE_FACES = [
    ((0, 0, 1), (1, 0, 0), (0, 1, 0)),
    ((0, 0, -1), (-1, 0, 0), (0, 1, 0)),
    ((1, 0, 0), (0, 0, -1), (0, 1, 0)),
    ((-1, 0, 0), (0, 0, 1), (0, 1, 0)),
    ((0, 1, 0), (1, 0, 0), (0, 0, -1)),
    ((0, -1, 0), (1, 0, 0), (0, 0, 1)),
]


def quad(normal, across, up):
    """Four corners around `normal`, two units wide, and its two triangles."""
    corners = []
    for a, b in ((-1, -1), (1, -1), (1, 1), (-1, 1)):
        corners.append([n + a * x + b * y for n, x, y in zip(normal, across, up)])
    return corners, [0, 1, 2, 0, 2, 3]


class Document:
    """Collects a binary buffer and the JSON that describes it."""

    def __init__(self):
        self.binary = b""
        self.json = {"asset": {"version": "2.0"}, "bufferViews": [], "accessors": [], "meshes": [], "nodes": []}

    def accessor(self, component, kind, rows):
        width = {"SCALAR": 1, "VEC3": 3}[kind]
        code = {5126: "f", 5125: "I"}[component]
        flat = [value for row in rows for value in (row if width > 1 else [row])]
        self.json["bufferViews"].append({"buffer": 0, "byteOffset": len(self.binary), "byteLength": 4 * len(flat)})
        self.binary += struct.pack(f"<{len(flat)}{code}", *flat)
        entry = {"bufferView": len(self.json["bufferViews"]) - 1, "componentType": component, "type": kind,
                 "count": len(rows)}
        if component == 5126:
            columns = list(zip(*rows)) if width > 1 else [rows]
            entry["min"] = [min(column) for column in columns]
            entry["max"] = [max(column) for column in columns]
        self.json["accessors"].append(entry)
        return len(self.json["accessors"]) - 1

    def mesh(self, faces, material):
        positions, normals, indices = [], [], []
        for normal, across, up in faces:
            corners, triangles = quad(normal, across, up)
            indices += [len(positions) + i for i in triangles]
            positions += corners
            normals += [list(normal)] * 4
        # Through struct, so that min and max are the floats that the file holds.
        positions = [[struct.unpack("<f", struct.pack("<f", v))[0] for v in row] for row in positions]
        self.json["meshes"].append({"primitives": [{
            "attributes": {"POSITION": self.accessor(5126, "VEC3", positions),
                           "NORMAL": self.accessor(5126, "VEC3", normals)},
            "indices": self.accessor(5125, "SCALAR", indices), "material": material}]})
        return len(self.json["meshes"]) - 1

    def node(self, **fields):
        self.json["nodes"].append(fields)
        return len(self.json["nodes"]) - 1

    def write(self, path):
        self.json["buffers"] = [{"byteLength": len(self.binary)}]
        self.json["scenes"] = [{"nodes": list(range(len(self.json["nodes"])))}]
        self.json["scene"] = 0
        text = json.dumps(self.json).encode()
        text += b" " * (-len(text) % 4)
        with open(path, "wb") as out:
            out.write(struct.pack("<4sII", b"glTF", 2, 20 + len(text) + 8 + len(self.binary)))
            out.write(struct.pack("<I4s", len(text), b"JSON") + text)
            out.write(struct.pack("<I4s", len(self.binary), b"BIN\0") + self.binary)


def write_scene(path, cube_color=(0.8, 0.8, 0.8)):
    document = Document()

    def diffuse(*color):
        return {"pbrMetallicRoughness": {"baseColorFactor": [*color, 1.0], "metallicFactor": 0.0}}

    document.json["materials"] = [diffuse(0.8, 0.8, 0.8), diffuse(0.8, 0.1, 0.1), diffuse(*cube_color)]
    # The corner: a floor and a back wall, and a red wall on the left; each quad is two units wide.
    floor = document.mesh([((0, 1, 0), (1, 0, 0), (0, 0, -1))], 0)
    back = document.mesh([((0, 0, 1), (1, 0, 0), (0, 1, 0))], 0)
    left = document.mesh([((1, 0, 0), (0, 0, -1), (0, 1, 0))], 1)
    cube = document.mesh(CUBE_FACES, 2)
    # Quads stand one unit along their normal from the origin, so a wall moves back by one size and one more.
    document.node(name="floor", mesh=floor, scale=[2, 2, 2], translation=[0, -2, 0])
    document.node(name="back", mesh=back, scale=[2, 2, 2], translation=[0, 2, -4])
    document.node(name="left", mesh=left, scale=[2, 2, 2], translation=[-4, 2, 0])
    moving = document.node(name="cube", mesh=cube, scale=[0.4, 0.4, 0.4], translation=[-1, 0.5, 0])
    document.node(name="front camera", camera=0, translation=[0.5, 1.5, 6])
    # Turned by 60 degrees about the upright axis: from the right.
    document.node(name="side camera", camera=0, translation=[5.5, 1.5, 3], rotation=[0, 0.5, 0, 0.8660254])
    # Down the slope by half a right angle, from above and in front.
    document.node(name="spot", translation=[0.5, 4, 4], rotation=[-0.3826834, 0, 0, 0.9238795],
                  extensions={"KHR_lights_punctual": {"light": 0}})
    document.json["cameras"] = [{"type": "perspective", "perspective": {"yfov": 0.8, "znear": 0.1, "zfar": 100}}]
    document.json["extensionsUsed"] = ["KHR_lights_punctual"]
    document.json["extensions"] = {"KHR_lights_punctual": {"lights": [
        {"type": "spot", "intensity": 30000, "spot": {"innerConeAngle": 0.5, "outerConeAngle": 0.8}}]}}
    document.json["animations"] = [{
        "name": "slide",
        "channels": [{"sampler": 0, "target": {"node": moving, "path": "translation"}}],
        "samplers": [{"input": document.accessor(5126, "SCALAR", [0.0, 1.0, 2.0]),
                      "output": document.accessor(5126, "VEC3", [[-1, 0.5, 0], [1.5, 0.5, 0], [-1, 0.5, 0]])}]}]
    document.write(path)


if __name__ == "__main__":
    import sys
    write_scene(sys.argv[1])
