#!/usr/bin/env python3
"""Imports an instanced forest of lsc into Blender, whose own importer refuses EXT_mesh_gpu_instancing.

    blender --python scripts/blender/import_forest.py -- forest.glb [--save forest.blend]

Every branch becomes an object; those of one kind share one mesh, as linked duplicates. Objects lie in
collections by cells of the ground. Blender has +Z up, so what is (x, y, z) in the file is (x, -z, y).
read_forest() needs no Blender.
"""
import array
import json
import struct
import sys

EXTENSION = "EXT_mesh_gpu_instancing"
WIDTHS = {"SCALAR": 1, "VEC2": 2, "VEC3": 3, "VEC4": 4}
CODES = {5121: "B", 5123: "H", 5125: "I", 5126: "f"}


class ForestError(Exception):
    """The file is no forest that can be read here."""


def split_glb(data):
    """The document and the buffer of a GLB."""
    if len(data) < 20:
        raise ForestError("too short for a GLB")
    magic, version, length = struct.unpack_from("<4sII", data, 0)
    if magic != b"glTF" or version != 2:
        raise ForestError("no GLB of version 2")
    if length != len(data):
        raise ForestError(f"{len(data)} bytes long, and {length} by its header")
    chunks = {}
    at = 12
    while at + 8 <= length:
        size, kind = struct.unpack_from("<I4s", data, at)
        if at + 8 + size > length:
            raise ForestError("a chunk goes on beyond the end")
        chunks[kind] = memoryview(data)[at + 8 : at + 8 + size]
        at += 8 + size
    if b"JSON" not in chunks:
        raise ForestError("no document")
    return json.loads(bytes(chunks[b"JSON"])), chunks.get(b"BIN\0", memoryview(b""))


class Forest:
    """A GLB's meshes, ground and instances, as plain arrays."""

    def __init__(self, document, buffer):
        required = set(document.get("extensionsRequired", []))
        if required - {EXTENSION}:
            raise ForestError(f"asks for {', '.join(sorted(required - {EXTENSION}))}")
        self.document = document
        self.buffer = buffer
        self.extras = document["nodes"][document["scenes"][0]["nodes"][0]].get("extras", {})

    def accessor(self, number):
        """Numbers of an accessor, flat, and how many make an item."""
        accessor = self.document["accessors"][number]
        view = self.document["bufferViews"][accessor["bufferView"]]
        width = WIDTHS[accessor["type"]]
        values = array.array(CODES[accessor["componentType"]])
        begin = view.get("byteOffset", 0) + accessor.get("byteOffset", 0)
        size = accessor["count"] * width * values.itemsize
        if begin + size > len(self.buffer):
            raise ForestError(f"accessor {number} goes on beyond the buffer")
        values.frombytes(self.buffer[begin : begin + size])
        if sys.byteorder != "little":
            values.byteswap()
        return values, width

    def cells(self):
        """(name, nodes) of the ground and of each cell."""
        nodes = self.document["nodes"]
        root = nodes[self.document["scenes"][0]["nodes"][0]]
        for child in root["children"]:
            node = nodes[child]
            yield node.get("name", "cell"), [nodes[c] for c in node.get("children", [])] or [node]

    def transforms(self, node):
        """(translation, rotation as w x y z, scale) of each instance of a node."""
        extension = node.get("extensions", {}).get(EXTENSION)
        if extension is None:
            x, y, z, w = node.get("rotation", (0.0, 0.0, 0.0, 1.0))
            yield (tuple(node.get("translation", (0.0, 0.0, 0.0))), (w, x, y, z),
                   tuple(node.get("scale", (1.0, 1.0, 1.0))))
            return
        attributes = extension["attributes"]
        translations, _ = self.accessor(attributes["TRANSLATION"])
        rotations, _ = self.accessor(attributes["ROTATION"])
        scales, _ = self.accessor(attributes["SCALE"])
        for i in range(len(translations) // 3):
            x, y, z, w = rotations[4 * i : 4 * i + 4]
            yield (tuple(translations[3 * i : 3 * i + 3]), (w, x, y, z),
                   tuple(scales[3 * i : 3 * i + 3]))

    def mesh(self, number):
        """Name, positions, texture coordinates or None, faces, and the material of each face.

        Vertices are those that the mesh uses; its parts have arrays of their own.
        """
        mesh = self.document["meshes"][number]
        places = []
        coordinates = []
        faces = []
        materials = []
        for primitive in mesh["primitives"]:
            numbers = {}
            indices, _ = self.accessor(primitive["indices"])
            attributes = primitive["attributes"]
            own = [len(places) + numbers.setdefault(i, len(numbers)) for i in indices]
            faces += [tuple(own[i : i + 3]) for i in range(0, len(own), 3)]
            materials += [primitive["material"]] * (len(own) // 3)
            positions, _ = self.shared(attributes["POSITION"])
            places += [tuple(positions[3 * i : 3 * i + 3]) for i in numbers]
            if "TEXCOORD_0" in attributes:
                values, _ = self.shared(attributes["TEXCOORD_0"])
                coordinates += [(values[2 * i], values[2 * i + 1]) for i in numbers]
        if len(coordinates) != len(places):
            coordinates = None
        return mesh.get("name", f"mesh {number}"), places, coordinates, faces, materials

    def shared(self, number):
        """An accessor that many meshes have, read once."""
        known = self.__dict__.setdefault("known", {})
        if number not in known:
            known[number] = self.accessor(number)
        return known[number]


def read_forest(path):
    with open(path, "rb") as file:
        return Forest(*split_glb(file.read()))


def to_blender(v):
    """+Y up to +Z up."""
    return (v[0], -v[2], v[1])


def make_materials(bpy, forest):
    made = []
    for material in forest.document.get("materials", []):
        own = bpy.data.materials.new(material.get("name", "material"))
        shading = material.get("pbrMetallicRoughness", {})
        colour = shading.get("baseColorFactor", [1.0, 1.0, 1.0, 1.0])
        own.diffuse_color = colour
        own.use_nodes = True
        surface = own.node_tree.nodes.get("Principled BSDF")
        if surface is not None:
            surface.inputs["Base Color"].default_value = colour
            surface.inputs["Roughness"].default_value = shading.get("roughnessFactor", 1.0)
        own.use_backface_culling = not material.get("doubleSided", False)
        made.append(own)
    return made


def make_mesh(bpy, forest, number, materials):
    name, places, coordinates, faces, of_faces = forest.mesh(number)
    mesh = bpy.data.meshes.new(name)
    mesh.from_pydata([to_blender(p) for p in places], [], faces)
    slots = sorted(set(of_faces))
    for material in slots:
        mesh.materials.append(materials[material])
    mesh.polygons.foreach_set("material_index", [slots.index(m) for m in of_faces])
    mesh.polygons.foreach_set("use_smooth", [True] * len(faces))
    if coordinates is not None:
        layer = mesh.uv_layers.new(name="UVMap")
        flat = [c for face in faces for i in face
                for c in (coordinates[i][0], 1.0 - coordinates[i][1])]
        layer.data.foreach_set("uv", flat)
    mesh.update()
    return mesh


def import_forest(path):
    """Makes the objects and returns them."""
    import bpy
    from mathutils import Quaternion

    forest = read_forest(path)
    materials = make_materials(bpy, forest)
    meshes = {}
    top = bpy.data.collections.new(str(forest.extras.get("scene", "forest")))
    bpy.context.scene.collection.children.link(top)
    made = []
    for cell, nodes in forest.cells():
        collection = bpy.data.collections.new(cell)
        top.children.link(collection)
        for node in nodes:
            number = node["mesh"]
            if number not in meshes:
                meshes[number] = make_mesh(bpy, forest, number, materials)
            mesh = meshes[number]
            for translation, rotation, scale in forest.transforms(node):
                twin = bpy.data.objects.new(mesh.name, mesh)
                twin.location = to_blender(translation)
                twin.rotation_mode = "QUATERNION"
                w, x, y, z = rotation
                twin.rotation_quaternion = Quaternion((w, *to_blender((x, y, z))))
                twin.scale = (scale[0], scale[2], scale[1])
                collection.objects.link(twin)
                made.append(twin)
    return made


def main(arguments):
    if not arguments or len(arguments) not in (1, 3) or (len(arguments) == 3 and arguments[1] != "--save"):
        print("usage: blender --python import_forest.py -- forest.glb [--save forest.blend]", file=sys.stderr)
        return 2
    try:
        objects = import_forest(arguments[0])
    except (ForestError, OSError) as error:
        print(f"{arguments[0]}: {error}", file=sys.stderr)
        return 1
    print(f"{len(objects)} objects of {len({o.data.name for o in objects})} meshes")
    if len(arguments) == 3:
        import bpy

        bpy.ops.wm.save_as_mainfile(filepath=arguments[2])
    return 0


if __name__ == "__main__":
    given = sys.argv[sys.argv.index("--") + 1 :] if "--" in sys.argv else []
    code = main(given)
    if code != 0:
        sys.exit(code)
