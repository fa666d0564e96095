# SPDX-License-Identifier: MIT
"""Forests, their instances and files of the module, and files of plants.

Usage: python3 test_forest.py LSC SAMPLES [unittest options], with the module on PYTHONPATH.
"""

import gc
import json
import os
import struct
import subprocess
import sys
import tempfile
import unittest
import zlib

import numpy as np

import lsys

LSC, SAMPLES = map(os.path.abspath, sys.argv[1:3])
TREE = ("#n = 4; #set angle 25; #w : !(0.3) F(3) X;"
        "#p : X : * : !(0.08) F(0.6) [ + X ] /(120) [ & X ] /(120) [ ^ X ];")
CAREY = os.path.join(SAMPLES, "carey-type-0", "carey-type-0.lsys")


def chunks(glb):
    """The document of a GLB without the program's name, and its arrays."""
    length = struct.unpack_from("<I", glb, 12)[0]
    document = json.loads(glb[20:20 + length])
    del document["asset"]["generator"]
    return document, glb[20 + length:]


def read(tree=TREE):
    return {"tree.lsys": tree}.get


class Files(unittest.TestCase):
    """Files equal those of `lsc`, except for the name of the program."""

    def compare(self, command, options, make, name, **more):
        with tempfile.TemporaryDirectory() as folder:
            mine, theirs = (os.path.join(folder, part) for part in ("mine", "theirs"))
            os.mkdir(mine)
            os.mkdir(theirs)
            subprocess.run([LSC, command, CAREY, "-q", "-o", os.path.join(theirs, name), *options], check=True)
            paths = make().save(os.path.join(mine, name), **more)
            self.assertEqual(sorted(os.listdir(mine)), sorted(os.listdir(theirs)))
            self.assertEqual(sorted(map(os.path.basename, paths)), sorted(os.listdir(mine)))
            for file in os.listdir(mine):
                with open(os.path.join(mine, file), "rb") as one, open(os.path.join(theirs, file), "rb") as other:
                    one, other = one.read(), other.read()
                if file.endswith(".glb"):
                    one, other = chunks(one), chunks(other)
                elif file.endswith(".stl"):  # the header of 80 bytes names the program, truncated
                    one, other = one[80:], other[80:]
                else:
                    one, other = (data.replace(b"liblsys " + lsys.__version__.encode(), b"PROGRAM")
                                  .replace(b"lsc " + lsys.__version__.encode(), b"PROGRAM") for data in (one, other))
                self.assertEqual(one, other, file)

    def plant(self):
        return lsys.compile(CAREY, generations=4).grow()

    def test_plants(self):
        n = ["-n", "4"]
        for preset in lsys.PRESETS:
            name = "a.stl" if preset == "print" else "a.glb"
            with self.subTest(preset):
                self.compare("export", [*n, "--preset", preset], self.plant, name, preset=preset)
        for name, options, more in (
                ("a.obj", ["--lods", "3", "--up", "z"], {"lods": 3, "up": "z"}),
                ("a.gltf", ["--buffers", "separate"], {"buffers": "separate"}),
                ("a.usda", [], {}),
                ("a.glb", ["--wind", "8,0,0,0.5", "--frames", "5"], {"wind": (8, 0, 0, 0.5), "frames": 5}),
                ("a.ply", ["--gravity", "9.81", "--settle"], {"gravity": 9.81, "settle": True}),
                ("a.glb", ["--grow", "--frames", "4"], {"grow": True, "frames": 4}),
                ("a.glb", ["--preset", "unity", "--wind-data=false", "--lods", "2"],
                 {"preset": "unity", "wind_data": False, "lods": 2})):
            with self.subTest(name=name, options=options):
                self.compare("export", [*n, *options], self.plant, name, **more)

    def test_forests(self):
        n = ["-n", "4", "--count", "30", "--size", "40", "--heroes", "3"]

        def forest():
            return lsys.Forest(CAREY, generations=4, count=30, size=40, heroes=3)

        for preset in ("web", "unreal", "godot", None):
            options = ["--preset", preset] if preset else []
            with self.subTest(preset):
                self.compare("forest", [*n, *options], forest, "a.glb", preset=preset)
        self.compare("forest", [*n, "--bake"], forest, "a.obj", bake=True)
        self.compare("forest", n, forest, "a.json")

    def test_receiver(self):
        plant = lsys.compile(text=TREE).grow()
        with tempfile.TemporaryDirectory() as folder:
            saved = plant.save(os.path.join(folder, "a.obj"))
            files = plant.files_of("a.obj")
            self.assertEqual(sorted(files), sorted(map(os.path.basename, saved)))
            for name, data in files.items():
                with open(os.path.join(folder, name), "rb") as file:
                    self.assertEqual(file.read(), data)
        ends = []
        plant.write("a.obj", lambda name, piece, is_last: ends.append(name) if is_last else None)
        self.assertEqual(sorted(ends), sorted(files))

    def test_mistakes(self):
        plant = lsys.compile(text=TREE).grow()
        for options, text in (({"lod": 3}, "did you mean `--lods`"), ({"preset": "moon"}, "moon"),
                              ({"grow": True}, "--frames")):
            with self.assertRaisesRegex(lsys.LsysError, text):
                plant.files_of("a.glb", **options)
        with self.assertRaises(TypeError):
            plant.save("a.glb", mesh=plant.mesh(), preset="web")
        with self.assertRaises(lsys.LsysError):
            lsys.Forest("tree.lsys", colour="red", read_file=read())

    def test_options(self):
        for part, name in (("plant", "lods"), ("forest", "instances"), ("scene", "heroes")):
            options = lsys.options(part)
            self.assertIn(name, options)
            self.assertTrue(all(len(text) > 5 for _, text in options.values()))
        self.assertEqual(lsys.options("plant")["wind-data"][0], "")
        self.assertNotEqual(lsys.options("plant")["lods"][0], "")
        with self.assertRaises(ValueError):
            lsys.options("scenery")


class Forests(unittest.TestCase):
    def test_scene(self):
        forest = lsys.Forest("tree.lsys", count=50, heroes=2, key=7, read_file=read())
        self.assertEqual((forest.key, len(forest.trees), forest.species[0].name), (7, 50, "tree"))
        self.assertEqual(forest.trees.dtype, lsys.TREE)
        self.assertFalse(forest.trees.flags.owndata)
        self.assertFalse(forest.trees.flags.writeable)
        self.assertEqual(forest.count().trees, 50)
        self.assertIn("50 trees", repr(forest))
        self.assertIn("<svg", forest._repr_html_())
        self.assertGreater(len(forest.ground().positions), 0)

    def test_scene_file(self):
        folder = os.path.join(SAMPLES, "scenes", "meadow")
        path = next(os.path.join(folder, name) for name in os.listdir(folder) if name.endswith(".toml"))
        forest = lsys.Forest(path)
        expected = subprocess.run([LSC, "forest", path, "-q", "--stats", "--message-format", "json"],
                                  capture_output=True, check=True)
        self.assertEqual(len(forest.trees), json.loads(expected.stdout)["trees"])

    def test_places(self):
        positions = np.array([[0, 0, 0], [10, 1, 0], [0, 2, 10]])
        forest = lsys.Forest.from_places("tree.lsys", positions, rotation=[0, 1, 2], scale=2.0, key=[5, 6, 7],
                                         heroes=2, read_file=read())
        trees = forest.trees
        self.assertTrue((trees["position"] == positions).all())
        self.assertEqual(trees["yaw"].tolist(), [0, 1, 2])
        self.assertEqual(trees["scale"].tolist(), [2, 2, 2])
        self.assertEqual(trees["number"].tolist(), [5, 6, 7])
        with self.assertRaisesRegex(lsys.LsysError, "species 3"):
            lsys.Forest.from_places(["tree.lsys"], positions, species=[0, 3, 0], read_file=read())
        with self.assertRaises(ValueError):
            lsys.Forest.from_places("tree.lsys", [1, 2, 3], read_file=read())
        with self.assertRaises(ValueError):
            lsys.Forest.from_places("tree.lsys", positions, scale=[1, 2], read_file=read())
        for name, value in (("species", 65536), ("species", -1), ("species", 0.9), ("age", 70000), ("age", 1.5),
                            ("key", -1), ("key", 2**32), ("key", float("nan"))):
            with self.assertRaisesRegex(ValueError, f"{name} is a whole number"):
                lsys.Forest.from_places("tree.lsys", positions, read_file=read(), **{name: value})

    def test_surroundings(self):
        """Arms of a tree stop in the shade of its neighbour only if its species senses it."""
        star = ("#n = 6; #sense light shadow cell 1 levels 20 strength 0.1 ratio 1;"
                "#w : F(3) [ +(90) ?light(1, 0, 0, 0, 0) ] [ -(90) ?light(1, 0, 0, 0, 0) ] ?light(1, 0, 0, 0);"
                "#arm : ?light(q, x, y, z, k) : k < 2 || q > 0.85 : F(1) ?light(0, 0, 0, 0, k + 1);"
                "#mast : ?light(q, x, y, z) : * : F(1) ?light(0, 0, 0, 0);")
        positions = [[0, 0, 0], [6, 0, 0], [100, 0, 0]]
        segments = {}
        for surroundings in ("ignored", "sensed"):
            forest = lsys.Forest.from_places("star.lsys", positions, surroundings=surroundings, rho=0, heroes=1,
                                             read_file={"star.lsys": star}.get)
            stages = len(forest.species[0].generations)
            self.assertEqual(stages, 6 if surroundings == "sensed" else 1)
            segments[surroundings] = forest.count().segments
        self.assertGreater(segments["ignored"], segments["sensed"])
        with self.assertRaises(lsys.LsysError):
            lsys.Forest("star.lsys", surroundings="seen", read_file={"star.lsys": star}.get)

    def test_instances(self):
        forest = lsys.Forest("tree.lsys", count=200, heroes=2, read_file=read())
        instances = forest.instances
        self.assertIs(instances, forest.instances)
        array = instances.array
        self.assertEqual(array.dtype, lsys.INSTANCE)
        self.assertEqual(array.dtype.itemsize, 40)
        self.assertFalse(array.flags.owndata)
        self.assertEqual(array.ctypes.data, instances.array.ctypes.data)
        self.assertEqual(len(array), forest.count().branches)
        groups = instances.groups
        self.assertEqual(groups.dtype, lsys.INSTANCE_GROUP)
        self.assertFalse(groups.flags.owndata)
        self.assertEqual(groups["instance_count"].sum(), len(array))
        self.assertTrue((np.repeat(np.arange(len(groups)), groups["instance_count"].astype(int)) == array["group"]).all())
        self.assertEqual(set(array["tree"].tolist()), set(range(200)))
        matrices = instances.matrices()
        self.assertEqual(matrices.shape, (len(array), 4, 4))
        self.assertTrue(np.array_equal(matrices[:, :3, 3], array["position"]))
        lengths = np.linalg.norm(matrices[:, :3, 0], axis=1)
        self.assertTrue(np.allclose(lengths, array["scale"], rtol=1e-5))
        buffer = np.zeros(32, np.float32)
        instances.read_matrices(buffer, 5)
        self.assertTrue(np.array_equal(buffer.reshape(2, 4, 4).transpose(0, 2, 1), matrices[5:7]))
        for wrong in (np.zeros(15, np.float32), np.zeros((len(array) + 1, 16), np.float32)):
            with self.assertRaises(ValueError):
                instances.read_matrices(wrong)
        mesh = instances.meshes[0]
        del instances, forest
        gc.collect()
        self.assertTrue(np.isfinite(mesh.positions).all())
        self.assertTrue(np.isfinite(array["position"]).all())

    def test_whole_trees(self):
        """The instances of whole trees lie where the baked file has them."""
        forest = lsys.Forest.from_places("tree.lsys", [[0, 0, 0], [20, 3, 5]], rotation=[0, 2], scale=[1, 3],
                                         rho=0, heroes=1, read_file=read())
        instances = forest.instances
        self.assertEqual(len(instances), 2)
        points = instances.meshes[0].positions
        whole = np.concatenate([points @ matrix[:3, :3].T + matrix[:3, 3] for matrix in instances.matrices()])
        ply = forest.files_of("a.ply", bake=True)["a.ply"]
        end = ply.index(b"end_header\n") + len(b"end_header\n")
        count = int(ply[:end].split(b"element vertex ")[1].split()[0])
        header = ply[:end].decode().split("element vertex")[1].split("element")[0].split("\n")
        stride = sum({"float": 4, "uchar": 1}[line.split()[1]] for line in header if line.startswith("property"))
        baked = np.frombuffer(ply, np.uint8, count * stride, end).reshape(count, stride)[:, :12].copy().view("<f4")
        self.assertEqual(len(baked), len(whole))
        order = [np.lexsort(np.round(each, 2).T) for each in (whole, baked)]
        self.assertTrue(np.allclose(np.sort(whole, axis=0), np.sort(baked, axis=0), atol=1e-3), order[0][:3])


class Pictures(unittest.TestCase):
    def test_png(self):
        plant = lsys.compile(text=TREE).grow()
        data = plant._repr_png_()
        self.assertTrue(data.startswith(b"\x89PNG\r\n\x1a\n"))
        width, height = struct.unpack(">II", data[16:24])
        self.assertEqual((width, height), (320, 400))
        at = data.index(b"IDAT")
        size = struct.unpack(">I", data[at - 4:at])[0]
        rows = np.frombuffer(zlib.decompress(data[at + 4:at + 4 + size]), np.uint8).reshape(height, 1 + 3 * width)
        drawn = (rows[:, 1:].reshape(height, width, 3) < 250).any(axis=2)
        self.assertGreater(drawn.mean(), 0.005)
        self.assertLess(drawn.mean(), 0.5)
        self.assertTrue(drawn[height - 40:, width // 3:2 * width // 3].any())  # the trunk
        self.assertIn("<svg", plant._repr_html_())
        empty = lsys.compile(text="#n = 1; #w : A; #p : A : * : A;").grow()
        self.assertTrue(empty.png().startswith(b"\x89PNG"))


class Memory(unittest.TestCase):
    def test_ten_million_modules(self):
        """The arrays of 10^7 modules need no additional memory."""
        def memory():
            with open("/proc/self/statm", encoding="ascii") as file:
                return 4096 * int(file.read().split()[1])

        word = lsys.compile(text="#n = 24; #w : A(1); #p : A(x) : * : A(x*{0.9, 1.1}) F;"
                                 "#q : F : * : F F;").derive()
        self.assertGreater(len(word), 10_000_000)
        before = memory()
        codes, parameters = word.codes, word.parameters
        after = memory()
        self.assertEqual(len(codes), len(word))
        self.assertGreater(len(parameters), 0)
        print(f"{len(codes):,} modules, {codes.nbytes + parameters.nbytes:,} bytes of arrays, "
              f"{after - before:,} bytes more memory")
        self.assertLess(after - before, 1 << 20)


if __name__ == "__main__":
    unittest.main(argv=[sys.argv[0], *sys.argv[3:]])
