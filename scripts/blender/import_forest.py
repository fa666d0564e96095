#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Imports a forest of lsc into Blender from the command line, without installing the add-on.

    blender --python scripts/blender/import_forest.py -- forest.glb [--save forest.blend]

Makes the same objects as the add-on beside this file: each branch once, and a point cloud for each square of the
ground.
"""
import os
import sys

sys.dont_write_bytecode = True
sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))


def import_forest(path):
    """Makes and returns the collection of the forest. Raises OSError or lsys_plants.gltf.GltfError."""
    import bpy
    from lsys_plants import scene

    name = os.path.splitext(os.path.basename(path))[0]
    collection = bpy.data.collections.new(name)
    bpy.context.scene.collection.children.link(collection)
    try:
        scene.fill(collection, path, True)
    except BaseException:
        bpy.data.collections.remove(collection)
        raise
    return collection


def main(arguments):
    from lsys_plants.gltf import GltfError

    if len(arguments) not in (1, 3) or (len(arguments) == 3 and arguments[1] != "--save"):
        print("usage: blender --python import_forest.py -- forest.glb [--save forest.blend]", file=sys.stderr)
        return 2
    try:
        collection = import_forest(arguments[0])
    except (GltfError, OSError) as error:
        print(f"{arguments[0]}: {error}", file=sys.stderr)
        return 1
    objects = collection.all_objects
    print(f"{len(objects)} objects of {len({o.data for o in objects if o.data is not None})} meshes")
    if len(arguments) == 3:
        import bpy

        bpy.ops.wm.save_as_mainfile(filepath=os.path.abspath(arguments[2]))
    return 0


if __name__ == "__main__":
    given = sys.argv[sys.argv.index("--") + 1 :] if "--" in sys.argv else []
    code = main(given)
    if code != 0:
        sys.exit(code)
