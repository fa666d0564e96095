#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Installs the add-on in Blender from its zip and uses it. Usage: addon_in_blender.py ROOT LSC FOLDER

ROOT: the source tree. Runs itself in Blender with user folders below FOLDER; exit status 77 without Blender.
"""
import json
import os
import shutil
import struct
import subprocess
import sys


class CheckState:
    """State shared by the checks."""

    def __init__(self, root, lsc, folder):
        import bpy

        self.bpy, self.root, self.lsc, self.folder = bpy, root, lsc, folder

    def sample(self, name):
        return os.path.join(self.root, "samples", name, f"{name}.lsys")

    def counts(self):
        """Numbers of all data that an import could leave behind."""
        return {kind: len(getattr(self.bpy.data, kind)) for kind in
                ("collections", "objects", "meshes", "materials", "images", "node_groups", "actions", "armatures")}

    def written(self, *arguments):
        """The file that lsc writes without the add-on, parsed by the add-on's glTF reader."""
        from lsys_plants.gltf import read_gltf

        path = os.path.join(self.folder, "direct.glb")
        subprocess.run([self.lsc, *arguments, "-q", "-o", path], check=True)
        return read_gltf(path)

    def fails(self, action, *texts):
        """Checks that the action is refused with these texts and leaves no data."""
        before = self.counts()
        try:
            action()
        except RuntimeError as error:
            for text in texts:
                assert text in str(error), (text, str(error))
        else:
            raise AssertionError(f"no error with {texts}")
        assert self.counts() == before, (before, self.counts())


def box(points):
    return [(min(p[i] for p in points), max(p[i] for p in points)) for i in range(3)]


def box_of_file(gltf):
    """The box of a single plant in a file, with +Z up, and its number of triangles."""
    (placement,) = gltf.placements()
    _, parts = gltf.primitives(placement.mesh)
    points = []
    for attributes, indices, _ in parts:
        values, _ = gltf.accessor(attributes["POSITION"])
        points += [(values[3 * i], -values[3 * i + 2], values[3 * i + 1]) for i in set(gltf.accessor(indices)[0])]
    return box(points), sum(len(gltf.accessor(indices)[0]) // 3 for _, indices, _ in parts)


def check_plant(state, collection, *arguments):
    """Checks that the plant in the scene is the one that lsc writes with these arguments."""
    expected, triangles = box_of_file(state.written("export", *arguments))
    meshes = [o for o in collection.all_objects if o.type == "MESH"]
    assert sum(len(o.data.polygons) for o in meshes) == triangles, arguments
    state.bpy.context.view_layer.update()
    anchor = next(o for o in collection.objects if o.get("lsys_anchor"))
    points = [anchor.matrix_world.inverted() @ o.matrix_world @ v.co for o in meshes for v in o.data.vertices]
    for (low, high), (low_expected, high_expected) in zip(box(points), expected):
        assert abs(low - low_expected) < 1e-3 and abs(high - high_expected) < 1e-3, (box(points), expected)


def plant(state):
    """Creates a plant and changes parameters (kept within bounds), generations and options, in one collection."""
    bpy = state.bpy
    file = state.sample("teach-param")
    assert bpy.ops.lsys.new_plant(filepath=file) == {"FINISHED"}
    collection = bpy.data.collections["teach-param"]
    settings = collection.lsys
    assert [p.name for p in settings.parameters] == ["spread", "shrink", "trunk", "slim"]
    assert (settings.generations, settings.seed) == (7, 0)
    check_plant(state, collection, file)
    anchor = bpy.context.view_layer.objects.active
    assert anchor.get("lsys_anchor"), anchor
    anchor.location = (5, 6, 7)
    before = state.counts()
    spread = settings.parameters["spread"]
    spread.value = 50
    check_plant(state, collection, file, "-D", "spread=50")
    spread.value = 500
    assert spread.value == 80, spread.value
    check_plant(state, collection, file, "-D", "spread=80")
    settings.parameters["shrink"].value = 0.6
    settings.generations = 5
    check_plant(state, collection, file, "-D", "spread=80", "-D", "shrink=0.6", "-n", "5")
    settings.height = 3
    check_plant(state, collection, file, "-D", "spread=80", "-D", "shrink=0.6", "-n", "5", "--height", "3")
    assert state.counts() == before, (before, state.counts())
    assert tuple(anchor.location) == (5, 6, 7) and anchor.name in collection.objects

    meshes = {o.data.name for o in collection.all_objects if o.type == "MESH"}
    settings.options = "--sides 2"
    assert "--sides" in settings.message, settings.message
    assert {o.data.name for o in collection.all_objects if o.type == "MESH"} == meshes
    state.fails(bpy.ops.lsys.update, "--sides")
    settings.options = "--sides '"
    assert "quotation" in settings.message, settings.message
    settings.options = "--wind 8,0,0,0.5 --frames 4"
    assert (len(bpy.data.armatures), len(bpy.data.actions)) == (1, 1)
    settings.options = ""
    assert settings.message == "", settings.message
    assert state.counts() == before, (before, state.counts())
    bpy.ops.lsys.reload()
    assert spread.value == 80, "changed values stay"
    bpy.ops.lsys.reset()
    assert spread.value == 25


def seed(state):
    """Another seed gives another plant; leaves are cut out, bark has a normal map."""
    bpy = state.bpy
    file = state.sample("carey-type-2")
    bpy.ops.lsys.new_plant(filepath=file)
    collection = bpy.data.collections["carey-type-2"]
    collection.lsys.generations = 9
    for number in (0, 1, 2):
        collection.lsys.seed = number
        check_plant(state, collection, file, "-n", "9", "-s", str(number))
    check_materials(bpy, {s.material for o in collection.all_objects for s in o.material_slots})


def check_materials(bpy, materials):
    by_name = {m.name.split(".")[0]: m for m in materials}
    leaf, bark = by_name["leaf"], by_name["bark"]
    for material, has_relief, has_holes in ((leaf, False, True), (bark, True, False)):
        nodes = material.node_tree.nodes
        surface = next(n for n in nodes if n.type == "BSDF_PRINCIPLED")
        assert surface.inputs["Base Color"].is_linked, material.name
        assert surface.inputs["Normal"].is_linked == has_relief, material.name
        assert surface.inputs["Alpha"].is_linked == has_holes, material.name
        if bpy.app.version < (4, 2, 0):
            assert material.blend_method == ("CLIP" if has_holes else "OPAQUE"), material.blend_method
        for node in nodes:
            if node.type == "TEX_IMAGE":
                assert node.image.packed_file is not None and node.image.size[0] > 8, node.image.name
    assert bark.use_backface_culling and not leaf.use_backface_culling


def statistics(state, *arguments):
    path = os.path.join(state.folder, "direct.json")
    subprocess.run([state.lsc, "forest", *arguments, "-q", "-o", path], check=True)
    with open(path) as file:
        return json.load(file)


def processor_time():
    """Processor time of this process and of lsc, s; other processes do not affect it."""
    times = os.times()
    return times.user + times.system + times.children_user + times.children_system


def count_instances(bpy):
    instances = triangles = 0
    for instance in bpy.context.evaluated_depsgraph_get().object_instances:
        if instance.is_instance:
            instances += 1
            triangles += len(instance.object.data.polygons)
    return instances, triangles


def forest(state):
    """Checks the objects of 1,000 trees, the branches and triangles of 20 trees with two keys, and a scene."""
    bpy = state.bpy
    file = state.sample("carey-type-2")
    start = processor_time()
    bpy.ops.lsys.new_forest(filepath=file)
    print(f"1000 trees: {processor_time() - start:.2f} s of processor time, {len(bpy.data.objects)} objects")
    collection = bpy.data.collections["carey-type-2"]
    assert len(collection.all_objects) <= 1000, len(collection.all_objects)
    collection.lsys.count = 20
    for key in (0, 3):
        collection.lsys.seed = key
        expected = statistics(state, file, "--count", "20", "--key", str(key))
        found = count_instances(bpy)
        assert found == (expected["branches"], expected["triangles"]), (found, expected["triangles"])
    check_materials(bpy, {s.material for o in collection.all_objects for s in o.material_slots
                          if s.material.name.split(".")[0] != "ground"})
    meshes = [o.data for o in collection.children[0].objects]
    assert all(mesh.has_custom_normals for mesh in meshes)
    assert all(mesh.uv_layers for mesh in meshes)

    scene_file = os.path.join(state.root, "samples", "scenes", "mixed-forest", "mixed-forest.toml")
    start = processor_time()
    bpy.ops.lsys.new_forest(filepath=scene_file)
    print(f"mixed-forest: {processor_time() - start:.2f} s of processor time")
    mixed = bpy.data.collections["mixed-forest"]
    assert len(mixed.all_objects) <= 1000, len(mixed.all_objects)
    assert mixed.lsys.has_key and mixed.lsys.seed == 2019, mixed.lsys.seed


def errors(state):
    """Messages of lsc are shown, and no data is left after an error."""
    bpy = state.bpy
    broken = os.path.join(state.folder, "broken.lsys")
    with open(broken, "w") as file:
        file.write("#n = 2;\n#w : F(;\n#p : F : * : F F;\n")
    state.fails(lambda: bpy.ops.lsys.new_plant(filepath=broken), "broken.lsys:2:", "error")
    state.fails(lambda: bpy.ops.lsys.new_forest(filepath=broken), "broken.lsys:2:", "error")
    state.fails(lambda: bpy.ops.lsys.new_plant(filepath=os.path.join(state.folder, "none.lsys")), "no such file")
    state.fails(bpy.ops.lsys.update, "no plant")
    cut = os.path.join(state.folder, "cut.glb")
    state.written("forest", state.sample("carey-type-2"), "--count", "2")
    with open(os.path.join(state.folder, "direct.glb"), "rb") as whole, open(cut, "wb") as file:
        file.write(whole.read()[:-1000])
    state.fails(lambda: bpy.ops.lsys.import_forest(filepath=cut), "by its header")
    # A file whose last mesh is wrong: the import fails after other meshes were made.
    late = os.path.join(state.folder, "late.glb")
    with open(os.path.join(state.folder, "direct.glb"), "rb") as file:
        data = file.read()
    size = struct.unpack_from("<I", data, 12)[0]
    document = json.loads(data[20 : 20 + size])
    document["meshes"][-1]["primitives"][0]["attributes"]["POSITION"] = 1_000_000
    write_glb(late, document, data[28 + size :])
    state.fails(lambda: bpy.ops.lsys.import_forest(filepath=late), "no accessors 1000000")
    preferences = bpy.context.preferences.addons["lsys_plants"].preferences
    preferences.lsc = os.path.join(state.folder, "no-lsc")
    state.fails(lambda: bpy.ops.lsys.new_plant(filepath=state.sample("teach-param")), "no-lsc", "preferences")
    preferences.lsc = state.lsc


def write_glb(path, document, binary):
    text = json.dumps(document).encode()
    text += b" " * (-len(text) % 4)
    with open(path, "wb") as file:
        file.write(struct.pack("<4sII", b"glTF", 2, 28 + len(text) + len(binary)))
        file.write(struct.pack("<I4s", len(text), b"JSON") + text)
        file.write(struct.pack("<I4s", len(binary), b"BIN\0") + binary)


def layouts(state):
    """Imports a mesh whose parts have separate arrays, 8- and 16-bit indices, vertex colours and no picture."""
    bpy = state.bpy
    path = os.path.join(state.folder, "layouts.glb")
    corners = [(0, 0, 0), (1, 0, 0), (0, 2, 0), (0, 0, 3), (1, 0, 3), (0, 2, 3)]
    binary = b"".join(struct.pack("<3f", *corner) for corner in corners)
    binary += bytes([255, 0, 0, 255, 0, 255, 0, 255, 51, 0, 255, 255])  # at byte 72
    binary += struct.pack("<4B4H", 0, 1, 2, 0, 0, 1, 2, 0)  # at bytes 84 and 88
    views = [{"buffer": 0, "byteOffset": at, "byteLength": size} for at, size in ((0, 72), (72, 12), (84, 3), (88, 6))]
    accessors = [{"bufferView": 0, "byteOffset": 36 * i, "componentType": 5126, "count": 3, "type": "VEC3"}
                 for i in range(2)]
    accessors += [{"bufferView": 1, "componentType": 5121, "count": 3, "type": "VEC4", "normalized": True},
                  {"bufferView": 2, "componentType": 5121, "count": 3, "type": "SCALAR"},
                  {"bufferView": 3, "componentType": 5123, "count": 3, "type": "SCALAR"}]
    write_glb(path, {
        "asset": {"version": "2.0"}, "scene": 0, "scenes": [{"nodes": [0]}], "nodes": [{"name": "one", "mesh": 0}],
        "materials": [{"name": "plain", "pbrMetallicRoughness": {"metallicFactor": 0}}],
        "meshes": [{"name": "two", "primitives": [
            {"attributes": {"POSITION": 0, "COLOR_0": 2}, "indices": 3, "material": 0},
            {"attributes": {"POSITION": 1, "COLOR_0": 2}, "indices": 4, "material": 0}]}],
        "accessors": accessors, "bufferViews": views, "buffers": [{"byteLength": len(binary)}]}, binary)
    assert bpy.ops.lsys.import_forest(filepath=path) == {"FINISHED"}
    (mesh,) = bpy.data.meshes
    assert [tuple(v.co) for v in mesh.vertices] == [(x, -z, y) for x, y, z in corners]
    assert [tuple(p.vertices) for p in mesh.polygons] == [(0, 1, 2), (3, 4, 5)]
    colours = [tuple(round(c, 4) for c in item.color) for item in mesh.color_attributes["Color"].data]
    assert colours == [(1, 0, 0, 1), (0, 1, 0, 1), (0.2, 0, 1, 1)] * 2, colours
    (material,) = mesh.materials
    surface = next(n for n in material.node_tree.nodes if n.type == "BSDF_PRINCIPLED")
    assert surface.inputs["Base Color"].links[0].from_node.type == "VERTEX_COLOR"


def face_the_leaf(bpy, is_forest):
    """Adds a camera that faces the first triangle drawn and shows the whole leaf."""
    points = []
    for drawn in bpy.context.evaluated_depsgraph_get().object_instances:
        if drawn.object.type == "MESH" and drawn.is_instance == is_forest:
            points += [drawn.matrix_world @ v.co for v in drawn.object.data.vertices]
    sides = box(points)
    size = sum((high - low) ** 2 for low, high in sides) ** 0.5
    normal = (points[1] - points[0]).cross(points[2] - points[0]).normalized()
    camera = bpy.data.objects.new("camera", bpy.data.cameras.new("camera"))
    bpy.context.scene.collection.objects.link(camera)
    bpy.context.scene.camera = camera
    camera.location = [(low + high) / 2 + 3 * size * n for (low, high), n in zip(sides, normal)]
    camera.rotation_euler = normal.to_track_quat("Z", "Y").to_euler()
    camera.data.type = "ORTHO"
    camera.data.ortho_scale = 1.02 * size
    camera.data.clip_end = 10 * size


def render_pixels(bpy, path):
    """Pixels (r, g, b, a) of a small picture by Cycles in grey light."""
    scene = bpy.context.scene
    scene.world = bpy.data.worlds.new("sky")
    scene.world.use_nodes = True
    scene.world.node_tree.nodes["Background"].inputs["Color"].default_value = (0.5, 0.5, 0.5, 1)
    scene.render.engine = "CYCLES"
    scene.cycles.samples = 8
    scene.cycles.use_denoising = False
    scene.render.film_transparent = True
    scene.render.resolution_x = scene.render.resolution_y = 96
    scene.view_settings.view_transform = "Standard"
    scene.render.filepath = path
    bpy.ops.render.render(write_still=True)
    values = list(bpy.data.images.load(path).pixels)
    return [values[i : i + 4] for i in range(0, len(values), 4)]


def render(state):
    """A leaf of a plant and of a forest: green, cut out by its picture, nowhere white."""
    bpy = state.bpy
    file = os.path.join(state.folder, "leaf.lsys")
    with open(file, "w") as text:
        text.write("#n = 0;\n#set turtle houdini;\n#set names letters;\n#w : J;\n")
    for kind, make in (("plant", bpy.ops.lsys.new_plant), ("forest", bpy.ops.lsys.new_forest)):
        bpy.ops.wm.read_homefile(use_factory_startup=False, use_empty=True)
        make(filepath=file)
        bpy.data.collections["leaf"].lsys.count = 1
        if kind == "forest":
            bpy.data.objects["ground"].hide_render = True
        face_the_leaf(bpy, kind == "forest")
        pixels = render_pixels(bpy, os.path.join(state.folder, f"leaf-{kind}.png"))
        opaque = [p for p in pixels if p[3] > 0.9]
        print(f"{kind}: {len(opaque)} of {len(pixels)} pixels are opaque")
        assert 0.1 * len(pixels) < len(opaque) < 0.3 * len(pixels), len(opaque)
        assert sum(p[1] > p[0] and p[1] > p[2] for p in opaque) > 0.9 * len(opaque), "a leaf that is not green"
        assert not any(min(p[:3]) > 0.7 for p in opaque), "white"


def within_blender(root, lsc, folder):
    import bpy

    bpy.ops.preferences.addon_install(filepath=os.path.join(folder, "lsys_plants.zip"))
    bpy.ops.preferences.addon_enable(module="lsys_plants")
    bpy.context.preferences.addons["lsys_plants"].preferences.lsc = lsc
    state = CheckState(root, lsc, folder)
    for check in (errors, layouts, plant, seed, forest, render):
        bpy.ops.wm.read_homefile(use_factory_startup=False, use_empty=True)
        check(state)
        print(f"{check.__name__}: passed")
    bpy.ops.preferences.addon_disable(module="lsys_plants")
    assert not hasattr(bpy.types.Collection, "lsys")
    print("add-on: as it should be")


def main():
    if "--" in sys.argv:
        within_blender(*sys.argv[sys.argv.index("--") + 1 :])
        return 0
    root, lsc, folder = (os.path.abspath(path) for path in sys.argv[1:])
    shutil.rmtree(folder, ignore_errors=True)
    os.makedirs(folder)
    archives = [os.path.join(folder, name) for name in ("lsys_plants.zip", "again.zip")]
    for archive in archives:
        subprocess.run([sys.executable, os.path.join(root, "scripts", "blender", "pack"), archive], check=True)
    contents = []
    for archive in archives:
        with open(archive, "rb") as file:
            contents.append(file.read())
    assert contents[0] == contents[1], "the zip differs from run to run"
    blender = shutil.which("blender")
    if blender is None:
        print("Blender is not here")
        return 77
    user = os.path.join(folder, "user")
    # A Blender without its own Python uses the modules of the first python3 in PATH.
    environment = dict(os.environ, PATH=f"/usr/bin:{os.environ['PATH']}",
                       BLENDER_USER_SCRIPTS=os.path.join(user, "scripts"),
                       BLENDER_USER_CONFIG=os.path.join(user, "config"), PYTHONDONTWRITEBYTECODE="1")
    run = subprocess.run(
        [blender, "--background", "--factory-startup", "--python-exit-code", "1",
         "--python", os.path.abspath(__file__), "--", root, lsc, folder],
        env=environment, capture_output=True, text=True, check=False)
    print(run.stdout, run.stderr)
    return 0 if run.returncode == 0 and "add-on: as it should be" in run.stdout else 1


sys.exit(main())
