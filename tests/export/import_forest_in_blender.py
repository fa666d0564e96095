#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Imports the files that write_forest wrote into Blender, with the add-on. Usage: import_forest_in_blender.py SCRIPT FOLDER

Runs itself in Blender; exit status 77 without Blender.
"""
import importlib.util
import json
import os
import shutil
import subprocess
import sys


def check(bpy, module, path, facts):
    """Instances, triangles and box of the forest as Blender draws it."""
    collection = module.import_forest(path)
    instances = triangles = 0
    low, high = [1e9] * 3, [-1e9] * 3
    for drawn in bpy.context.evaluated_depsgraph_get().object_instances:
        if drawn.object.type != "MESH":
            continue
        mesh = drawn.object.data
        instances += drawn.is_instance
        triangles += len(mesh.polygons)
        for vertex in mesh.vertices if mesh.polygons else ():
            x, z, y = drawn.matrix_world @ vertex.co
            for axis, value in enumerate((x, y, -z)):
                low[axis] = min(low[axis], value)
                high[axis] = max(high[axis], value)
    assert instances == facts["branches"], (instances, facts)
    assert triangles == facts["triangles"], (triangles, facts)
    for axis in range(3):
        assert abs(low[axis] - facts["low"][axis]) < 1e-3, (low, facts)
        assert abs(high[axis] - facts["high"][axis]) < 1e-3, (high, facts)
    (sources,) = collection.children
    for branch in sources.objects:
        assert branch.data.has_custom_normals and branch.data.uv_layers, branch.name
    pictures = [image for image in bpy.data.images if image.packed_file is not None]
    assert pictures and all(image.size[0] > 8 for image in pictures)
    print(f"{len(collection.all_objects)} objects, {instances} instances")


def within_blender(script, folder):
    import bpy

    spec = importlib.util.spec_from_file_location("import_forest", script)
    module = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(module)
    with open(os.path.join(folder, "facts.json")) as file:
        facts = json.load(file)
    for name in ("forest.glb", "expanded.glb"):
        bpy.ops.wm.read_homefile(use_factory_startup=True, use_empty=True)
        check(bpy, module, os.path.join(folder, name), facts)
    print("import_forest: as it should be")


def main():
    if "--" in sys.argv:
        within_blender(*sys.argv[sys.argv.index("--") + 1 :])
        return 0
    blender = shutil.which("blender")
    if blender is None:
        print("Blender is not here")
        return 77
    # A Blender without its own Python uses the modules of the first python3 in PATH.
    environment = dict(os.environ, PATH=f"/usr/bin:{os.environ['PATH']}")
    run = subprocess.run(
        [blender, "--background", "--factory-startup", "--python-exit-code", "1",
         "--python", os.path.abspath(__file__), "--", *sys.argv[1:]],
        env=environment, capture_output=True, text=True, check=False)
    print(run.stdout, run.stderr)
    return 0 if run.returncode == 0 and "as it should be" in run.stdout else 1


sys.exit(main())
