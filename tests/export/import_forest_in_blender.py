#!/usr/bin/env python3
"""Has Blender import a file of write_forest. Usage: import_forest_in_blender.py SCRIPT FOLDER

Starts Blender on itself; exit status 77 where there is none.
"""
import importlib.util
import json
import os
import shutil
import subprocess
import sys


def within_blender(script, folder):
    import bpy

    spec = importlib.util.spec_from_file_location("import_forest", script)
    module = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(module)
    objects = module.import_forest(os.path.join(folder, "forest.glb"))
    bpy.context.view_layer.update()
    with open(os.path.join(folder, "facts.json")) as file:
        facts = json.load(file)
    assert len(objects) == facts["branches"] + 1, len(objects)  # the ground
    assert sum(len(o.data.polygons) for o in objects) == facts["triangles"]
    assert len({o.data.name for o in objects}) < len(objects) / 2
    low, high = [1e9] * 3, [-1e9] * 3
    for o in objects:
        for vertex in o.data.vertices:
            x, z, y = o.matrix_world @ vertex.co
            for axis, value in enumerate((x, y, -z)):
                low[axis] = min(low[axis], value)
                high[axis] = max(high[axis], value)
    for axis in range(3):
        assert abs(low[axis] - facts["low"][axis]) < 1e-3, (low, facts)
        assert abs(high[axis] - facts["high"][axis]) < 1e-3, (high, facts)
    print("import_forest: as it should be")


def main():
    if "--" in sys.argv:
        within_blender(*sys.argv[sys.argv.index("--") + 1 :])
        return 0
    blender = shutil.which("blender")
    if blender is None:
        print("Blender is not here")
        return 77
    run = subprocess.run(
        [blender, "--background", "--factory-startup", "--python-exit-code", "1",
         "--python", os.path.abspath(__file__), "--", *sys.argv[1:]],
        capture_output=True, text=True, check=False)
    print(run.stdout, run.stderr)
    return 0 if run.returncode == 0 and "as it should be" in run.stdout else 1


sys.exit(main())
