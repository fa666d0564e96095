# SPDX-License-Identifier: MIT
"""Words, skeletons and meshes of the module equal those of `lsc`, bit for bit, for every grammar of the
samples and of tests/ui that derives.

Usage: python3 test_equality.py LSC ROOT [unittest options], with the module on PYTHONPATH.
"""

import os
import re
import subprocess
import sys
import tempfile
import unittest
import warnings

import numpy as np

import lsys

LSC, ROOT = map(os.path.abspath, sys.argv[1:3])
MAX_MODULES = 300_000
LEAST_GRAMMARS = 300
NO_PARENT = 2**32 - 1

SEGMENT = re.compile(
    r"segment \d+ parent (\S+) order (\d+) base \((\S+), (\S+), (\S+)\) frame \((\S+), (\S+), (\S+), (\S+)\) "
    r"length (\S+) radius (\S+) (\S+) spring (\S+) mass (\S+) colour (\S+)")


def grammars():
    """The .lsys files of samples and tests/ui, except the benchmark systems."""
    for folder in ("samples", os.path.join("tests", "ui")):
        for place, folders, files in os.walk(os.path.join(ROOT, folder)):
            folders[:] = sorted(name for name in folders if not name.startswith("bench-"))
            for name in sorted(files):
                if name.endswith(".lsys"):
                    yield os.path.join(place, name)


def run_lsc(*arguments):
    """Status and output of a run."""
    done = subprocess.run([LSC, *arguments, "-q", "--max-modules", str(MAX_MODULES)], capture_output=True,
                          stdin=subprocess.DEVNULL, check=False)
    return done.returncode, done.stdout


def skeleton_of(text):
    """The segments of `lsc dump --stage skeleton`: floats are texts that read back as the same bits."""
    parents, numbers, colours = [], [], []
    for match in SEGMENT.finditer(text):
        parent, order, *values, colour = match.groups()
        parents.append((NO_PARENT if parent == "-" else int(parent), int(order)))
        numbers.append(values)
        colours.append(colour)
    return np.array(parents, np.int64).reshape(-1, 2), np.array(numbers, np.float32).reshape(-1, 12), colours


def ply_arrays(path):
    """Positions and normals of a binary PLY of `lsc`, and its triangles."""
    with open(path, "rb") as file:
        data = file.read()
    end = data.index(b"end_header\n") + len(b"end_header\n")
    lines = data[:end].decode().split("\n")
    counts = {words[1]: int(words[2]) for words in map(str.split, lines) if words[:1] == ["element"]}
    size = {"float": 4, "uchar": 1}
    at = next(i for i, line in enumerate(lines) if line.startswith("element vertex"))
    stride = 0
    names = []
    for words in map(str.split, lines[at + 1:]):
        if words[:1] != ["property"]:
            break
        names.append(words[2])
        stride += size[words[1]]
    assert names[:6] == ["x", "y", "z", "nx", "ny", "nz"], names
    vertices = np.frombuffer(data, np.uint8, counts["vertex"] * stride, end).reshape(-1, stride)
    faces = np.frombuffer(data, np.uint8, counts["face"] * 13, end + counts["vertex"] * stride).reshape(-1, 13)
    return vertices[:, :24].copy().view("<f4"), faces[:, 1:].copy().view("<u4")


class Equality(unittest.TestCase):
    def test_all(self):
        words = skeletons = meshes = 0
        with tempfile.TemporaryDirectory() as folder, warnings.catch_warnings():
            warnings.simplefilter("ignore")
            ply = os.path.join(folder, "plant.ply")
            for path in grammars():
                status, expected = run_lsc("dump", path)
                if status != 0:  # mistakes, no number of generations, too large
                    continue
                with self.subTest(os.path.relpath(path, ROOT)):
                    grammar = lsys.compile(path)
                    word = grammar.derive(max_modules=MAX_MODULES)
                    self.assertEqual(str(word) + "\n", expected.decode())
                    words += 1
                    status, expected = run_lsc("dump", "--stage", "skeleton", path)
                    if status != 0:
                        continue
                    plant = grammar.grow(max_modules=MAX_MODULES)
                    self.compare_skeleton(plant.segments, expected.decode())
                    skeletons += 1
                    if run_lsc("export", path, "-o", ply)[0] == 0:
                        mesh = plant.mesh()
                        vertices, triangles = ply_arrays(ply)
                        self.assertEqual(mesh.positions.tobytes(), vertices[:, :3].tobytes())
                        self.assertEqual(mesh.normals.tobytes(), vertices[:, 3:].tobytes())
                        self.assertEqual(mesh.indices.tobytes(), triangles.tobytes())
                        meshes += 1
        print(f"{words} words, {skeletons} skeletons, {meshes} meshes are equal")
        self.assertGreaterEqual(words, LEAST_GRAMMARS)
        self.assertGreaterEqual(skeletons, LEAST_GRAMMARS)
        self.assertGreaterEqual(meshes, LEAST_GRAMMARS * 2 // 3)

    def compare_skeleton(self, segments, text):
        parents, numbers, _ = skeleton_of(text)
        self.assertEqual(len(segments), len(parents))
        self.assertEqual(segments["parent"].tolist(), parents[:, 0].tolist())
        self.assertEqual(segments["order"].tolist(), parents[:, 1].tolist())
        # In the text, the quaternion of a frame begins with w.
        mine = np.column_stack([segments["base"], np.roll(segments["frame"], 1, axis=1), segments["length"],
                                segments["base_radius"], segments["tip_radius"], segments["spring"],
                                segments["mass"]]).astype(np.float32)
        # A text has no sign of zero: add 0 to both.
        self.assertEqual((mine + np.float32(0)).tobytes(), (numbers + np.float32(0)).tobytes())


if __name__ == "__main__":
    unittest.main(argv=[sys.argv[0], *sys.argv[3:]])
