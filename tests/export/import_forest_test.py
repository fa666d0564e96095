#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Tests the part of the add-on for Blender that needs no Blender, with files of write_forest.

Usage: import_forest_test.py ADDON FOLDER
"""
import base64
import importlib.util
import json
import os
import struct
import sys


def load(folder, name):
    spec = importlib.util.spec_from_file_location(name, os.path.join(folder, f"{name}.py"))
    module = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(module)
    return module


def check_forest(gltf, path, facts):
    """Counts and box of a forest, by its placements."""
    forest = gltf.read_gltf(path)
    assert forest.extras["trees"] == facts["trees"], forest.extras
    assert forest.extras["key"] == str(2**64 - 1), forest.extras

    branches = triangles = 0
    low, high = [1e9] * 3, [-1e9] * 3
    meshes = {}
    for placement in forest.placements():
        if placement.mesh not in meshes:
            name, parts = forest.primitives(placement.mesh)
            points, faces = [], 0
            for attributes, indices, _ in parts:
                values, width = forest.accessor(attributes["POSITION"])
                assert width == 3 and "NORMAL" in attributes and "TEXCOORD_0" in attributes, name
                corners = forest.accessor(indices)[0]
                faces += len(corners) // 3
                points += [tuple(values[3 * i : 3 * i + 3]) for i in sorted(set(corners))]
            meshes[placement.mesh] = (points[:: max(1, len(points) // 50)], faces)
        points, faces = meshes[placement.mesh]
        assert placement.is_single == (placement.cell == "ground"), placement.cell
        branches += 0 if placement.is_single else len(placement)
        triangles += faces * len(placement)
        # Some vertices of a mesh suffice to compare the bounds of the rotated mesh.
        for i in range(len(placement)):
            turn = placement.rotations[4 * i : 4 * i + 4]
            for point in points:
                scaled = [placement.scales[3 * i + axis] * point[axis] for axis in range(3)]
                moved = gltf.rotate(turn, scaled)
                for axis in range(3):
                    value = placement.translations[3 * i + axis] + moved[axis]
                    low[axis] = min(low[axis], value)
                    high[axis] = max(high[axis], value)
    assert branches == facts["branches"], (branches, facts)
    assert triangles == facts["triangles"], (triangles, facts)
    for axis in range(3):
        size = facts["high"][axis] - facts["low"][axis]
        assert facts["low"][axis] - 1e-3 <= low[axis] <= facts["low"][axis] + 0.05 * size, (low, facts)
        assert facts["high"][axis] - 0.05 * size <= high[axis] <= facts["high"][axis] + 1e-3, (high, facts)
    print(f"{path}: {branches} branches of {len(meshes)} meshes, {triangles} triangles")


def check_layouts(gltf):
    """Indices of each width, interleaved attributes, nodes within nodes, a missing attribute of instances."""
    positions = [(0.0, 0.0, 0.0), (1.0, 0.0, 0.0), (0.0, 2.0, 0.0)]
    normals = [(0.0, 0.0, 1.0)] * 3
    data = b"".join(struct.pack("<6f", *p, *n) for p, n in zip(positions, normals))  # 0: interleaved
    offsets = [len(data)]
    for code in "BHI":
        data += struct.pack(f"<3{code}", 2, 1, 0) + bytes(-len(struct.pack(f"<3{code}", 0, 0, 0)) % 4)
        offsets.append(len(data))
    data += struct.pack("<6f", 1, 2, 3, 4, 5, 6)
    views = [{"buffer": 0, "byteLength": 72, "byteStride": 24}]
    views += [{"buffer": 0, "byteOffset": at, "byteLength": 3 * size} for at, size in zip(offsets, (1, 2, 4))]
    views.append({"buffer": 0, "byteOffset": offsets[3], "byteLength": 24})
    accessors = [{"bufferView": 0, "componentType": 5126, "count": 3, "type": "VEC3"},
                 {"bufferView": 0, "byteOffset": 12, "componentType": 5126, "count": 3, "type": "VEC3"}]
    accessors += [{"bufferView": 1 + i, "componentType": kind, "count": 3, "type": "SCALAR"}
                  for i, kind in enumerate((5121, 5123, 5125))]
    accessors.append({"bufferView": 4, "componentType": 5126, "count": 2, "type": "VEC3"})
    half = 0.5**0.5
    document = {
        "scene": 0, "scenes": [{"nodes": [0]}],
        "nodes": [{"name": "root", "rotation": [0, 0, half, half], "scale": [2, 2, 2], "children": [1]},
                  {"name": "cell", "translation": [1, 0, 0], "children": [2]},
                  {"mesh": 0, "extensions": {gltf.INSTANCING: {"attributes": {"TRANSLATION": 5}}}}],
        "meshes": [{"primitives": [{"attributes": {"POSITION": 0, "NORMAL": 1}, "indices": i} for i in (2, 3, 4)]}],
        "accessors": accessors, "bufferViews": views,
        "buffers": [{"byteLength": len(data),
                     "uri": "data:application/octet-stream;base64," + base64.b64encode(data).decode()}],
        "extensionsUsed": [gltf.INSTANCING], "extensionsRequired": [gltf.INSTANCING]}
    read = gltf.Gltf(json.loads(json.dumps(document)), memoryview(b""))
    assert list(read.accessor(0)[0]) == [v for p in positions for v in p]
    assert list(read.accessor(1)[0]) == [v for n in normals for v in n]
    for number in (2, 3, 4):
        assert list(read.accessor(number)[0]) == [2, 1, 0], number
    (placement,) = read.placements()
    assert placement.cell == "cell" and not placement.is_single and len(placement) == 2
    # A quarter turn about Z and twice the size: (x, y, z) to (-2 y, 2 (x + 1), 2 z).
    expected = [-4, 4, 6, -10, 10, 12]
    assert all(abs(a - b) < 1e-5 for a, b in zip(placement.translations, expected)), placement.translations
    assert all(abs(v - 2) < 1e-6 for v in placement.scales)
    assert all(abs(a - b) < 1e-6 for a, b in zip(placement.rotations, [0, 0, half, half] * 2))

    refused(gltf, lambda: gltf.Gltf({**document, "extensionsRequired": ["EXT_unknown"]}, b""), "EXT_unknown")
    accessors[0]["count"] = 4
    refused(gltf, lambda: gltf.Gltf(document, b"").accessor(0), "beyond its buffer view")
    views[4]["byteLength"] = 99
    refused(gltf, lambda: gltf.Gltf(document, b"").accessor(5), "beyond the buffer")
    refused(gltf, lambda: gltf.Gltf(document, b"").accessor(77), "no accessors 77")
    document["nodes"][0]["scale"] = [1, 2, 1]
    document["nodes"][1].pop("children")
    document["nodes"][1]["mesh"] = 0
    refused(gltf, lambda: list(gltf.Gltf(document, b"").placements()), "unevenly")


def refused(gltf, action, text):
    try:
        action()
    except gltf.GltfError as error:
        assert text in str(error), (text, str(error))
        return
    raise AssertionError(f"no error with {text}")


def check_compiler(compiler, folder):
    """Programs that fail, print nothing or do not end."""
    def fails(action, *texts):
        try:
            action()
        except compiler.CompilerError as error:
            assert all(text in str(error) for text in texts), (texts, str(error))
            return
        raise AssertionError(f"no error with {texts}")

    fails(lambda: compiler.find_compiler(os.path.join(folder, "none")), "none", "preferences")
    program = os.path.join(folder, "fails")
    with open(program, "w") as file:
        file.write("#!/bin/sh\ncase $1 in\n  loud) echo 'a:1:1: error: no' >&2; exit 1;;\n"
                   "  silent) exit 3;;\n  slow) exec sleep 20;;\nesac\n")
    os.chmod(program, 0o755)
    fails(lambda: compiler.Program(program).run(["loud"], 10.0), "a:1:1: error: no")
    fails(lambda: compiler.Program(program).run(["silent"], 10.0), "status 3")
    fails(lambda: compiler.Program(program).run(["slow"], 0.2), "0.2 s", "limit")
    fails(lambda: compiler.TemporaryGlb(compiler.Program(program), ["other"], 10.0).__enter__(), "series")
    fails(lambda: compiler.split_options("--sides '"), "options")
    assert compiler.split_options("--set tropism='0 -1 0 0.2'") == ["--set", "tropism=0 -1 0 0.2"]


def main():
    addon, folder = sys.argv[1:]
    gltf = load(addon, "gltf")
    with open(os.path.join(folder, "facts.json")) as file:
        facts = json.load(file)
    for name in ("forest.glb", "forest.gltf", "expanded.glb"):
        check_forest(gltf, os.path.join(folder, name), facts)

    with open(os.path.join(folder, "forest.glb"), "rb") as file:
        data = file.read()
    for broken in (b"", data[:100], b"glTX" + data[4:], data + b"...."):
        try:
            gltf.split_glb(broken)
        except gltf.GltfError:
            continue
        raise AssertionError("a broken file was read")
    check_layouts(gltf)
    check_compiler(load(addon, "compiler"), folder)


main()
