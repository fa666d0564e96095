# SPDX-License-Identifier: MIT
"""Makes the objects of plants and forests. A failure leaves Blender's data unchanged.

Written for Blender 3.4. The code for differences of 4.0 to 4.5 follows Blender's release notes and has not been run.
"""
import re

import bpy
import numpy

from .gltf import GltfError, read_gltf
from .materials import Materials

#: Kinds of data that an import makes, in the order in which they are removed.
KINDS = ("collections", "objects", "meshes", "armatures", "node_groups", "materials", "images", "actions")
#: Max number of point clouds of a forest, one for each cell; a forest with more cells gets a single one.
MAX_CLOUDS = 200


class Changes:
    """Data made within a `with` block; an exception removes all of it."""

    def __enter__(self):
        self.before = {kind: set(getattr(bpy.data, kind)) for kind in KINDS}
        return self

    def made(self, kind):
        """The data of a kind that were made in the block."""
        return [item for item in getattr(bpy.data, kind) if item not in self.before[kind]]

    def __exit__(self, kind, *_):
        if kind is not None:
            for kind_of_data in KINDS:
                bpy.data.batch_remove(self.made(kind_of_data))

    def tidy_names(self):
        """Removes the number suffixes that Blender added to names because the replaced data still existed."""
        for kind in KINDS:
            data = getattr(bpy.data, kind)
            for item in self.made(kind):
                base = re.sub(r"\.\d{3,}$", "", item.name)
                if base != item.name and base not in data:
                    item.name = base


def upright(values):
    """Converts rows (x, y, z) with +Y up to rows (x, -z, y) with +Z up."""
    rows = numpy.array(values, dtype=numpy.float32).reshape(-1, 3)
    return numpy.column_stack((rows[:, 0], -rows[:, 2], rows[:, 1]))


def euler_angles(rotations):
    """Converts quaternions (x, y, z, w) with +Y up to rows of XYZ angles in radians with +Z up."""
    rows = numpy.array(rotations, dtype=numpy.float64).reshape(-1, 4)
    rows /= numpy.maximum(numpy.linalg.norm(rows, axis=1), 1e-30)[:, None]
    x, y, z, w = rows[:, 0], -rows[:, 2], rows[:, 1], rows[:, 3]
    m00, m10, m20 = 1 - 2 * (y * y + z * z), 2 * (x * y + z * w), 2 * (x * z - y * w)
    m11, m12 = 1 - 2 * (x * x + z * z), 2 * (y * z - x * w)
    m21, m22 = 2 * (y * z + x * w), 1 - 2 * (x * x + y * y)
    level = numpy.hypot(m00, m10)
    locked = level < 1e-7  # gimbal lock: X and Z turn about the same axis, so Z is set to 0
    angles = numpy.empty((len(rows), 3))
    angles[:, 0] = numpy.where(locked, numpy.arctan2(-m12, m11), numpy.arctan2(m21, m22))
    angles[:, 1] = numpy.arctan2(-m20, level)
    angles[:, 2] = numpy.where(locked, 0.0, numpy.arctan2(m10, m00))
    return angles


class MeshMaker:
    """Meshes of a file, each made once."""

    def __init__(self, gltf):
        self.gltf = gltf
        self.materials = Materials(bpy, gltf)
        self.made = {}
        self.rows = {}

    def attribute(self, number):
        """The numbers of an accessor, a row for each item. Cached."""
        if number not in self.rows:
            values, width = self.gltf.accessor(number)
            self.rows[number] = numpy.array(values).reshape(-1, width)
        return self.rows[number]

    def get(self, number):
        """The mesh `number` of the file."""
        if number not in self.made:
            self.made[number] = self.make(number)
        return self.made[number]

    def make(self, number):
        """Makes a mesh with only the vertices that its triangles use, because meshes of the file may share arrays."""
        name, primitives = self.gltf.primitives(number)
        sets = {}
        for attributes, indices, material in primitives:
            key = tuple(sorted(attributes.items()))
            sets.setdefault(key, []).append((self.gltf.accessor(indices)[0], material))
        parts = {"POSITION": [], "NORMAL": [], "TEXCOORD_0": [], "COLOR_0": []}
        corners, slots, face_slots = [], [], []
        count = 0
        for key, users in sets.items():
            attributes = dict(key)
            joined = numpy.concatenate([numpy.array(indices, dtype=numpy.int64) for indices, _ in users])
            if len(joined) % 3 != 0:
                raise GltfError(f"mesh {number} has a triangle of less than three corners")
            used, own = numpy.unique(joined, return_inverse=True)
            positions = self.attribute(attributes["POSITION"])
            if len(used) and used[-1] >= len(positions):
                raise GltfError(f"mesh {number} has an index beyond its {len(positions)} vertices")
            for name_of_part, rows in parts.items():
                if name_of_part in attributes:
                    rows.append(self.attribute(attributes[name_of_part])[used])
            corners.append(own.reshape(-1) + count)
            count += len(used)
            for indices, material in users:
                slot = (material, "COLOR_0" in attributes)
                if slot not in slots:
                    slots.append(slot)
                face_slots.append(numpy.full(len(indices) // 3, slots.index(slot), dtype=numpy.int32))
        columns = {part: numpy.concatenate(rows) for part, rows in parts.items()
                   if rows and sum(len(r) for r in rows) == count}
        mesh = self.assemble(name, columns, numpy.concatenate(corners).astype(numpy.int32))
        mesh.polygons.foreach_set("material_index", numpy.concatenate(face_slots))
        for material, has_colours in slots:
            mesh.materials.append(self.materials.get(material, has_colours))
        return mesh

    def assemble(self, name, columns, corners):
        """Makes a mesh of Blender. `columns`: attributes of the vertices; `corners`: three per triangle."""
        mesh = bpy.data.meshes.new(name)
        faces = len(corners) // 3
        positions = upright(columns["POSITION"])
        mesh.vertices.add(len(positions))
        mesh.vertices.foreach_set("co", positions.reshape(-1))
        mesh.loops.add(len(corners))
        mesh.loops.foreach_set("vertex_index", corners)
        mesh.polygons.add(faces)
        mesh.polygons.foreach_set("loop_start", numpy.arange(0, 3 * faces, 3, dtype=numpy.int32))
        if bpy.app.version < (3, 6, 0):  # read-only in later versions, which compute it from loop_start
            mesh.polygons.foreach_set("loop_total", numpy.full(faces, 3, dtype=numpy.int32))
        mesh.polygons.foreach_set("use_smooth", numpy.ones(faces, dtype=bool))
        if "TEXCOORD_0" in columns:
            coordinates = numpy.array(columns["TEXCOORD_0"], dtype=numpy.float32)
            coordinates[:, 1] = 1.0 - coordinates[:, 1]
            mesh.uv_layers.new(name="UVMap").data.foreach_set("uv", coordinates[corners].reshape(-1))
        if "COLOR_0" in columns:
            colours = numpy.ones((len(positions), 4), dtype=numpy.float32)
            colours[:, : columns["COLOR_0"].shape[1]] = columns["COLOR_0"]
            layer = mesh.color_attributes.new("Color", "FLOAT_COLOR", "POINT")
            layer.data.foreach_set("color", colours.reshape(-1))
        mesh.update(calc_edges=True)
        if "NORMAL" in columns:
            mesh.normals_split_custom_set_from_vertices(upright(columns["NORMAL"]))
            if bpy.app.version < (4, 1, 0):  # later versions use custom normals without this switch
                mesh.use_auto_smooth = True
        return mesh


def make_instancer(sources):
    """A geometry-nodes group that places a branch of `sources` at each point, by the attributes of the point."""
    group = bpy.data.node_groups.new("lsys instances", "GeometryNodeTree")
    if bpy.app.version < (4, 0, 0):
        group.inputs.new("NodeSocketGeometry", "Geometry")
        group.outputs.new("NodeSocketGeometry", "Geometry")
    else:
        group.interface.new_socket("Geometry", in_out="INPUT", socket_type="NodeSocketGeometry")
        group.interface.new_socket("Geometry", in_out="OUTPUT", socket_type="NodeSocketGeometry")
        group.is_modifier = True
    first, last = group.nodes.new("NodeGroupInput"), group.nodes.new("NodeGroupOutput")
    first.location, last.location = (-400, 200), (300, 0)
    branches = group.nodes.new("GeometryNodeCollectionInfo")
    branches.location = (-400, 0)
    branches.inputs["Collection"].default_value = sources
    branches.inputs["Separate Children"].default_value = True
    branches.inputs["Reset Children"].default_value = True
    place = group.nodes.new("GeometryNodeInstanceOnPoints")
    place.inputs["Pick Instance"].default_value = True
    group.links.new(first.outputs[0], place.inputs["Points"])
    group.links.new(branches.outputs[0], place.inputs["Instance"])
    for row, (name, kind, target) in enumerate((("branch", "INT", "Instance Index"),
                                                ("rotation", "FLOAT_VECTOR", "Rotation"),
                                                ("scale", "FLOAT_VECTOR", "Scale"))):
        node = group.nodes.new("GeometryNodeInputNamedAttribute")
        node.location = (-400, -200 - 150 * row)
        node.data_type = kind
        node.inputs["Name"].default_value = name
        output = next(o for o in node.outputs if o.enabled and o.name == "Attribute")
        group.links.new(output, place.inputs[target])
    group.links.new(place.outputs[0], last.inputs[0])
    return group


def make_cloud(name, placements, numbers, group):
    """An object with one point per instance. `numbers`: for each mesh, its index in the collection of branches."""
    mesh = bpy.data.meshes.new(name)
    count = sum(len(p) for p in placements)
    joined = [numpy.concatenate([numpy.array(getattr(p, part), dtype=numpy.float32) for p in placements])
              for part in ("translations", "rotations", "scales")]
    mesh.vertices.add(count)
    mesh.vertices.foreach_set("co", upright(joined[0]).reshape(-1))
    angles = euler_angles(joined[1]).astype(numpy.float32)
    sizes = joined[2].reshape(-1, 3)[:, [0, 2, 1]]
    branches = numpy.concatenate([numpy.full(len(p), numbers[p.mesh], dtype=numpy.int32) for p in placements])
    mesh.attributes.new("branch", "INT", "POINT").data.foreach_set("value", branches)
    mesh.attributes.new("rotation", "FLOAT_VECTOR", "POINT").data.foreach_set("vector", angles.reshape(-1))
    mesh.attributes.new("scale", "FLOAT_VECTOR", "POINT").data.foreach_set(
        "vector", numpy.ascontiguousarray(sizes).reshape(-1))
    mesh.update()
    cloud = bpy.data.objects.new(name, mesh)
    cloud.modifiers.new("Branches", "NODES").node_group = group
    return cloud


def make_forest(gltf, name):
    """Makes the objects of a forest and the collection of its branches, all unlinked. Call within Changes."""
    placements = list(gltf.placements())
    maker = MeshMaker(gltf)
    objects = []
    for placement in placements:
        if placement.is_single:
            mesh = maker.get(placement.mesh)
            single = bpy.data.objects.new(mesh.name, mesh)
            single.location = upright(placement.translations)[0]
            single.rotation_euler = euler_angles(placement.rotations)[0]
            single.scale = [placement.scales[i] for i in (0, 2, 1)]
            objects.append(single)
    placements = [p for p in placements if not p.is_single and len(p) > 0]
    if not placements:
        return objects, None
    sources = bpy.data.collections.new(f"{name} branches")
    numbers = {}
    for number in sorted({p.mesh for p in placements}):
        # The node Collection Info sorts by name, so a number at the start of the name keeps the order.
        mesh = maker.get(number)
        sources.objects.link(bpy.data.objects.new(f"{len(numbers):06d} {mesh.name}", mesh))
        numbers[number] = len(numbers)
    cells = {}
    for placement in placements:
        cells.setdefault(placement.cell or name, []).append(placement)
    if len(cells) > MAX_CLOUDS:
        cells = {"trees": placements}
    group = make_instancer(sources)
    for cell, members in cells.items():
        objects.append(make_cloud(cell, members, numbers, group))
    return objects, sources


class OldNumpyNames:
    """Defines numpy.bool during a `with`: the importer of Blender 3.4 uses it, but NumPy 1.24, with which Debian 12
    runs Blender, has removed it."""

    def __enter__(self):
        self.is_missing = "bool" not in vars(numpy)
        if self.is_missing:
            numpy.bool = bool

    def __exit__(self, *_):
        if self.is_missing:
            del numpy.bool


def import_plant(path):
    """Imports a plant with Blender's own importer and unlinks its objects. Call within Changes."""
    if not hasattr(bpy.types, "IMPORT_SCENE_OT_gltf"):
        raise GltfError("Blender's glTF importer is off: switch on the add-on `glTF 2.0 format`")
    if bpy.context.object is not None and bpy.context.object.mode != "OBJECT":
        bpy.ops.object.mode_set(mode="OBJECT")
    before = set(bpy.data.objects)
    try:
        with OldNumpyNames():
            bpy.ops.import_scene.gltf(filepath=path, import_pack_images=True)
    except RuntimeError as error:
        raise GltfError(f"Blender's glTF importer: {error}") from error
    objects = [item for item in bpy.data.objects if item not in before]
    if not objects:
        raise GltfError("Blender's glTF importer made nothing")
    for item in objects:
        for collection in list(item.users_collection):
            collection.objects.unlink(item)
    return objects


def anchor_of(collection):
    """The empty object that keeps the transform of a plant through all changes; None if it was deleted."""
    return next((o for o in collection.objects if o.get("lsys_anchor")), None)


def clear(collection, keep):
    """Removes all objects of a plant except `keep`, and data without other users."""
    objects = [o for o in collection.all_objects if o not in keep]
    children = [c for c in collection.children_recursive]
    data, images = set(), set()
    for item in objects:
        data.add(item.data)
        data.update(modifier.node_group for modifier in item.modifiers if modifier.type == "NODES")
        if item.animation_data is not None:
            data.add(item.animation_data.action)
        for slot in item.material_slots:
            data.add(slot.material)
            if slot.material is not None and slot.material.use_nodes:
                images.update(node.image for node in slot.material.node_tree.nodes if node.type == "TEX_IMAGE")
    bpy.data.batch_remove([*objects, *children])
    # Meshes use materials, and materials use images, so users are removed first.
    rounds = ([d for d in data if d is not None and not isinstance(d, bpy.types.Material)],
              [d for d in data if isinstance(d, bpy.types.Material)], [i for i in images if i is not None])
    for unused in rounds:
        bpy.data.batch_remove([d for d in unused if d.users - d.use_fake_user <= 0])


def fill(collection, path, is_forest):
    """Replaces the contents of a collection by those of a file. Returns the extras of a forest's root node.

    Raises OSError or GltfError; the contents then stay.
    """
    active = bpy.context.view_layer.objects.active
    with Changes() as changes:
        try:
            if is_forest:
                gltf = read_gltf(path)
                objects, sources = make_forest(gltf, collection.name)
                extras = gltf.extras
            else:
                objects, sources, extras = import_plant(path), None, {}
        except (KeyError, TypeError, IndexError, ValueError) as error:
            raise GltfError(f"the file is broken: {error!r}") from error
        anchor = anchor_of(collection)
        if anchor is None:
            anchor = bpy.data.objects.new(collection.name, None)
            anchor["lsys_anchor"] = True
            anchor.empty_display_size = 0.5
            collection.objects.link(anchor)
        was_inside = active is not None and active != anchor and active.name in collection.all_objects
        clear(collection, {anchor, *objects})
        for item in objects:
            collection.objects.link(item)
            if item.parent is None:
                item.parent = anchor
        if sources is not None:
            collection.children.link(sources)
        for child in changes.made("collections"):
            if child != sources and child.users == 0 and not child.objects:
                bpy.data.collections.remove(child)
    changes.tidy_names()
    if sources is not None:
        hide(sources)
    if was_inside or not is_forest:  # the importer of plants changes the selection
        activate(anchor if was_inside or active is None else active)
    return extras


def hide(collection):
    """Excludes the collection of branches from all view layers, so that only instances are visible."""
    stack = [layer.layer_collection for scene in bpy.data.scenes for layer in scene.view_layers]
    while stack:
        layer = stack.pop()
        if layer.collection == collection:
            layer.exclude = True
        stack += layer.children


def activate(item):
    """Makes an object the active object and the only selected one."""
    layer = bpy.context.view_layer
    layer.update()  # without this, objects that were just linked are missing in the layer
    if item is None or item.name not in layer.objects:
        return
    for other in list(layer.objects.selected):
        other.select_set(False)
    item.select_set(True)
    layer.objects.active = item
