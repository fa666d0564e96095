# SPDX-License-Identifier: MIT
"""Has Blender's own importer of glTF read a forest, and prints seconds, memory and the box of its trees as JSON.

Usage: blender --background --factory-startup --python box_in_blender.py -- FILE
"""
import json
import resource
import sys
import time

import bpy
import numpy

numpy.bool = bool  # Blender 3.4 uses numpy.bool, which newer numpy versions lack


def main(path):
    bpy.ops.wm.read_homefile(use_factory_startup=True, use_empty=True)
    start = time.perf_counter()
    processor = time.process_time()
    bpy.ops.import_scene.gltf(filepath=path)
    found = {
        "reader": f"Blender {bpy.app.version_string}",
        "seconds": time.perf_counter() - start,
        "processor": time.process_time() - processor,
        "megabytes": resource.getrusage(resource.RUSAGE_SELF).ru_maxrss / 1024,
        "instances": 0,
    }
    points = {}
    low, high = numpy.full(3, numpy.inf), numpy.full(3, -numpy.inf)
    bpy.context.view_layer.update()
    for drawn in bpy.data.objects:
        mesh = drawn.data
        if drawn.type != "MESH" or drawn.name.startswith("ground"):
            continue
        found["instances"] += 1
        if mesh.name not in points:
            flat = numpy.empty(3 * len(mesh.vertices), dtype=numpy.float32)
            mesh.vertices.foreach_get("co", flat)
            points[mesh.name] = flat.reshape(-1, 3).astype(float)
        matrix = numpy.array(drawn.matrix_world)
        placed = points[mesh.name] @ matrix[:3, :3].T + matrix[:3, 3]
        placed = placed[:, [0, 2, 1]] * (1, 1, -1)  # Blender turns +Y up into +Z up
        low, high = numpy.minimum(low, placed.min(axis=0)), numpy.maximum(high, placed.max(axis=0))
    found.update(low=low.tolist(), high=high.tolist())
    print(json.dumps(found))


main(sys.argv[sys.argv.index("--") + 1])
