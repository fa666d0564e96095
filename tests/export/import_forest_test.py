#!/usr/bin/env python3
"""The part of the Blender script that needs no Blender, on a file of write_forest.

Usage: import_forest_test.py SCRIPT FOLDER
"""
import importlib.util
import json
import os
import sys


def rotate(q, v):
    w, x, y, z = q
    tx, ty, tz = 2 * (y * v[2] - z * v[1]), 2 * (z * v[0] - x * v[2]), 2 * (x * v[1] - y * v[0])
    return (v[0] + w * tx + y * tz - z * ty, v[1] + w * ty + z * tx - x * tz,
            v[2] + w * tz + x * ty - y * tx)


def main():
    script, folder = sys.argv[1:]
    spec = importlib.util.spec_from_file_location("import_forest", script)
    module = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(module)
    with open(os.path.join(folder, "facts.json")) as file:
        facts = json.load(file)
    path = os.path.join(folder, "forest.glb")
    forest = module.read_forest(path)
    assert forest.extras["trees"] == facts["trees"], forest.extras
    assert forest.extras["key"] == str(2**64 - 1), forest.extras

    branches = triangles = 0
    low, high = [1e9] * 3, [-1e9] * 3
    meshes = {}
    for cell, nodes in forest.cells():
        for node in nodes:
            number = node["mesh"]
            if number not in meshes:
                meshes[number] = forest.mesh(number)
            name, places, coordinates, faces, materials = meshes[number]
            assert len(materials) == len(faces) and len(coordinates) == len(places), name
            assert max(max(face) for face in faces) == len(places) - 1, name
            # Ends of the mesh along some directions are enough to bound what is turned.
            for translation, rotation, scale in forest.transforms(node):
                branches += cell != "ground"
                triangles += len(faces)
                for place in places[:: max(1, len(places) // 50)]:
                    at = rotate(rotation, place)
                    for axis in range(3):
                        value = translation[axis] + scale[axis] * at[axis]
                        low[axis] = min(low[axis], value)
                        high[axis] = max(high[axis], value)
    assert branches == facts["branches"], (branches, facts)
    assert triangles == facts["triangles"], (triangles, facts)
    for axis in range(3):
        size = facts["high"][axis] - facts["low"][axis]
        assert facts["low"][axis] - 1e-3 <= low[axis] <= facts["low"][axis] + 0.05 * size, (low, facts)
        assert facts["high"][axis] - 0.05 * size <= high[axis] <= facts["high"][axis] + 1e-3, (high, facts)

    with open(path, "rb") as file:
        data = file.read()
    for broken in (b"", data[:100], b"glTX" + data[4:], data + b"...."):
        try:
            module.split_glb(broken)
        except module.ForestError:
            continue
        raise AssertionError("a broken file was read")
    print(f"{branches} branches of {len(meshes)} meshes, {triangles} triangles")


main()
