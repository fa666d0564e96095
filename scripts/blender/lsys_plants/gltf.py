# SPDX-License-Identifier: MIT
"""Reads GLB and glTF files of lsc into plain arrays; needs no Blender.

A forest is read as placements. A placement names a mesh and holds one transform, or one per instance of
EXT_mesh_gpu_instancing. Coordinates are those of the file: metres, +Y up.
"""
import array
import base64
import binascii
import json
import os
import struct
import sys
import urllib.parse

INSTANCING = "EXT_mesh_gpu_instancing"
COMPONENT_COUNTS = {"SCALAR": 1, "VEC2": 2, "VEC3": 3, "VEC4": 4}
#: Type codes of Python's module `array`, by component type of glTF.
TYPE_CODES = {5120: "b", 5121: "B", 5122: "h", 5123: "H", 5125: "I", 5126: "f"}
#: The integer that stands for 1 in normalised components, by component type.
MAX_INTEGERS = {5120: 127, 5121: 255, 5122: 32767, 5123: 65535}
IDENTITY = ((0.0, 0.0, 0.0), (0.0, 0.0, 0.0, 1.0), (1.0, 1.0, 1.0))


class GltfError(Exception):
    """The file cannot be read by this module."""


def split_glb(data):
    """Returns the document and the binary chunk of a GLB. GltfError: not a complete GLB of version 2."""
    if len(data) < 20:
        raise GltfError("too short for a GLB")
    magic, version, length = struct.unpack_from("<4sII", data, 0)
    if magic != b"glTF" or version != 2:
        raise GltfError("no GLB of version 2")
    if length != len(data):
        raise GltfError(f"{len(data)} bytes long, and {length} by its header")
    chunks = {}
    at = 12
    while at + 8 <= length:
        size, kind = struct.unpack_from("<I4s", data, at)
        if at + 8 + size > length:
            raise GltfError("a chunk goes on beyond the end")
        chunks[kind] = memoryview(data)[at + 8 : at + 8 + size]
        at += 8 + size
    if b"JSON" not in chunks:
        raise GltfError("no document")
    return parse_document(bytes(chunks[b"JSON"])), chunks.get(b"BIN\0", memoryview(b""))


def parse_document(text):
    try:
        document = json.loads(text)
    except ValueError as error:
        raise GltfError(f"no JSON: {error}") from error
    if not isinstance(document, dict):
        raise GltfError("no glTF document")
    return document


def multiply(a, b):
    """Product of two quaternions (x, y, z, w): b is applied first."""
    ax, ay, az, aw = a
    bx, by, bz, bw = b
    return (aw * bx + ax * bw + ay * bz - az * by, aw * by - ax * bz + ay * bw + az * bx,
            aw * bz + ax * by - ay * bx + az * bw, aw * bw - ax * bx - ay * by - az * bz)


def rotate(q, v):
    """The vector v turned by the quaternion q (x, y, z, w)."""
    x, y, z, w = q
    tx, ty, tz = 2 * (y * v[2] - z * v[1]), 2 * (z * v[0] - x * v[2]), 2 * (x * v[1] - y * v[0])
    return (v[0] + w * tx + y * tz - z * ty, v[1] + w * ty + z * tx - x * tz,
            v[2] + w * tz + x * ty - y * tx)


class Placement:
    """A mesh of the file and the transforms of its instances, as flat arrays of 3, 4 (x, y, z, w) and 3 numbers."""

    def __init__(self, cell, mesh, is_single, translations, rotations, scales):
        self.cell = cell  # name of the node below the root: the ground, or a square of the ground
        self.is_single = is_single  # drawn once, like the ground, without EXT_mesh_gpu_instancing
        self.mesh = mesh
        self.translations = translations
        self.rotations = rotations
        self.scales = scales

    def __len__(self):
        return len(self.translations) // 3


class Gltf:
    """A document with its buffers."""

    def __init__(self, document, binary, folder="."):
        unknown = set(document.get("extensionsRequired", [])) - {INSTANCING}
        if unknown:
            raise GltfError(f"asks for {', '.join(sorted(unknown))}, which is not read here")
        self.document = document
        self.folder = folder
        self.binary = binary
        self.buffers = {}
        self.accessor_cache = {}
        roots = self.roots()
        self.extras = self.item("nodes", roots[0]).get("extras", {}) if roots else {}

    def item(self, kind, number):
        """Item `number` of the list `kind` of the document, such as "nodes"."""
        items = self.document.get(kind, [])
        if not isinstance(number, int) or not 0 <= number < len(items):
            raise GltfError(f"no {kind} {number}")
        return items[number]

    def roots(self):
        """Numbers of the nodes at the top of the scene."""
        if not self.document.get("scenes"):
            raise GltfError("no scene")
        return self.item("scenes", self.document.get("scene", 0)).get("nodes", [])

    def buffer(self, number):
        """Bytes of a buffer. Cached."""
        if number not in self.buffers:
            uri = self.item("buffers", number).get("uri")
            self.buffers[number] = self.binary if uri is None else memoryview(self.fetch(uri))
        return self.buffers[number]

    def fetch(self, uri):
        """Bytes of a data URI, or of a file beside the document."""
        if uri.startswith("data:"):
            try:
                return base64.b64decode(uri.partition(",")[2], validate=True)
            except binascii.Error as error:
                raise GltfError(f"a data URI is broken: {error}") from error
        with open(os.path.join(self.folder, urllib.parse.unquote(uri)), "rb") as file:
            return file.read()

    def view(self, number):
        """Bytes of a buffer view and its stride or None."""
        view = self.item("bufferViews", number)
        begin = view.get("byteOffset", 0)
        data = self.buffer(view["buffer"])[begin : begin + view["byteLength"]]
        if len(data) != view["byteLength"]:
            raise GltfError(f"buffer view {number} goes on beyond the buffer")
        return data, view.get("byteStride")

    def accessor(self, number):
        """The numbers of an accessor as a flat array, and the count of numbers per item. Cached."""
        if number not in self.accessor_cache:
            self.accessor_cache[number] = self.read_accessor(number)
        return self.accessor_cache[number]

    def read_accessor(self, number):
        """accessor() without the cache."""
        accessor = self.item("accessors", number)
        kind = accessor.get("componentType")
        if kind not in TYPE_CODES or accessor.get("type") not in COMPONENT_COUNTS:
            raise GltfError(f"accessor {number} has a type that is not read here")
        if "sparse" in accessor or "bufferView" not in accessor:
            raise GltfError(f"accessor {number} is sparse")
        width = COMPONENT_COUNTS[accessor["type"]]
        values = array.array(TYPE_CODES[kind])
        data, stride = self.view(accessor["bufferView"])
        size = width * values.itemsize
        begin, count = accessor.get("byteOffset", 0), accessor["count"]
        stride = stride or size
        if count and begin + stride * (count - 1) + size > len(data):
            raise GltfError(f"accessor {number} goes on beyond its buffer view")
        if stride == size:
            values.frombytes(data[begin : begin + count * size])
        else:
            packed = bytearray(count * size)
            for i in range(size):
                packed[i::size] = data[begin + i : begin + i + stride * (count - 1) + 1 : stride]
            values.frombytes(packed)
        if sys.byteorder != "little":
            values.byteswap()
        if accessor.get("normalized") and kind in MAX_INTEGERS:
            unit = MAX_INTEGERS[kind]
            values = array.array("f", (max(-1.0, value / unit) for value in values))
        return values, width

    def picture(self, number):
        """Name and bytes of an image."""
        image = self.item("images", number)
        if "bufferView" in image:
            data = bytes(self.view(image["bufferView"])[0])
        else:
            data = bytes(self.fetch(image["uri"]))
        return image.get("name", f"image {number}"), data

    def placements(self):
        """Every use of a mesh, in the order of the file. Uses a stack, since trees may be too deep for recursion."""
        stack = [(root, IDENTITY, None, 0) for root in reversed(self.roots())]
        while stack:
            number, parent, cell, depth = stack.pop()
            node = self.item("nodes", number)
            if depth == 1 or (depth == 0 and cell is None and "children" not in node):
                cell = node.get("name", f"node {number}")
            here = self.compose(parent, self.transform(node, number), number)
            if "mesh" in node:
                yield self.placement(node, number, here, cell, depth < 2)
            if depth > 1000:
                raise GltfError("nodes are nested more than 1,000 deep")
            stack += [(c, here, cell, depth + 1) for c in reversed(node.get("children", []))]

    def transform(self, node, number):
        """Translation, rotation and scale of a node relative to its parent."""
        if "matrix" in node:
            raise GltfError(f"node {number} has a matrix, which is not read here")
        return (tuple(node.get("translation", IDENTITY[0])), tuple(node.get("rotation", IDENTITY[1])),
                tuple(node.get("scale", IDENTITY[2])))

    def compose(self, parent, own, number):
        """The transform `own`, relative to `parent`, as one relative to the scene. `number`: for messages."""
        if parent == IDENTITY:
            return own
        if own == IDENTITY:
            return parent
        (place, turn, size), (own_place, own_turn, own_size) = parent, own
        if not size[0] == size[1] == size[2]:
            raise GltfError(f"node {number} lies in a node that is scaled unevenly")
        moved = rotate(turn, [size[0] * v for v in own_place])
        return (tuple(a + b for a, b in zip(place, moved)), multiply(turn, own_turn),
                tuple(size[0] * v for v in own_size))

    def placement(self, node, number, here, cell, is_single):
        """The Placement of the mesh of a node. `here`: transform of the node relative to the scene."""
        instancing = node.get("extensions", {}).get(INSTANCING)
        if instancing is None:
            return Placement(cell, node["mesh"], is_single, *(array.array("f", part) for part in here))
        attributes = instancing["attributes"]
        arrays = [self.accessor(attributes[name])[0] if name in attributes else None
                  for name in ("TRANSLATION", "ROTATION", "SCALE")]
        count = max(len(values) // width for values, width in zip(arrays, (3, 4, 3)) if values is not None)
        for i, width in enumerate((3, 4, 3)):
            if arrays[i] is None:
                arrays[i] = array.array("f", IDENTITY[i] * count)
            if len(arrays[i]) != width * count:
                raise GltfError(f"node {number} has instances with unequal attributes")
        if here != IDENTITY:
            arrays = self.moved(arrays, here, count, number)
        return Placement(cell, node["mesh"], False, *arrays)

    def moved(self, arrays, here, count, number):
        """The translations, rotations and scales of instances in a node, relative to the scene."""
        moved = [array.array("f") for _ in arrays]
        for i in range(count):
            own = tuple(tuple(values[width * i : width * i + width])
                        for values, width in zip(arrays, (3, 4, 3)))
            for values, part in zip(moved, self.compose(here, own, number)):
                values.extend(part)
        return moved

    def primitives(self, number):
        """Name of a mesh and, per primitive, the accessors of its attributes and of its indices, and its material."""
        mesh = self.item("meshes", number)
        parts = []
        for primitive in mesh["primitives"]:
            if primitive.get("mode", 4) != 4:
                raise GltfError(f"mesh {number} has other faces than triangles")
            if "indices" not in primitive:
                raise GltfError(f"mesh {number} has no indices")
            parts.append((primitive["attributes"], primitive["indices"], primitive.get("material")))
        return mesh.get("name", f"mesh {number}"), parts


def read_gltf(path):
    """Reads a .glb or .gltf. Raises OSError or GltfError."""
    with open(path, "rb") as file:
        data = file.read()
    folder = os.path.dirname(os.path.abspath(path))
    try:
        if path.lower().endswith(".gltf"):
            return Gltf(parse_document(data), memoryview(b""), folder)
        return Gltf(*split_glb(data), folder)
    except (KeyError, TypeError, AttributeError) as error:
        raise GltfError(f"no glTF document: {error!r}") from error
