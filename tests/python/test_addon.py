# SPDX-License-Identifier: MIT
"""The add-on for Blender grows the same plants by the module as by the program.

Usage: python3 test_addon.py LSC SAMPLES ADDON [unittest options], with the module on PYTHONPATH.
"""

import os
import sys
import tempfile
import unittest

LSC, SAMPLES, ADDON = map(os.path.abspath, sys.argv[1:4])
sys.path.insert(0, ADDON)
sys.dont_write_bytecode = True

from lsys_plants import compiler, gltf  # noqa: E402

TREE = os.path.join(SAMPLES, "carey-type-0", "carey-type-0.lsys")


def binary(path):
    """The arrays of a GLB, without its document, which names the program."""
    with open(path, "rb") as file:
        return bytes(gltf.split_glb(file.read())[1])


class Addon(unittest.TestCase):
    def setUp(self):
        self.module = compiler.find_compiler()
        self.program = compiler.find_compiler(LSC)
        self.assertIsInstance(self.module, compiler.Module)
        self.assertIsInstance(self.program, compiler.Program)

    def test_parameters(self):
        with tempfile.TemporaryDirectory() as folder:
            path = os.path.join(folder, "a.lsys")
            with open(path, "w", encoding="ascii") as file:
                file.write("#n = 3; #set seed 9; #param ratio 0.6 {0.1, 2}; #define turn 25; #w : F(ratio) +(turn) F;")
            one = self.module.read_parameters(path, 60)
            other = self.program.read_parameters(path, 60)
        self.assertEqual(one["generations"], other["generations"])
        self.assertEqual(one["seed"], other["seed"])
        self.assertEqual([p["name"] for p in one["parameters"]], [p["name"] for p in other["parameters"]])
        for mine, theirs in zip(one["parameters"], other["parameters"]):
            for key in ("value", "min", "max"):
                self.assertEqual(key in mine, key in theirs)
                if key in mine:
                    self.assertAlmostEqual(mine[key], theirs[key], places=5)
        self.assertEqual(len(one["parameters"]), 2)

    def test_files(self):
        more = [["export", TREE, "--seed", "3", "--generations", "5"],
                ["export", TREE, "--generations", "5", "--height", "2.5", *compiler.split_options("--sides 12 --smooth-joints")],
                ["export", TREE, "--wind", "-8,0,0", "--frames", "4", "--generations=4"],
                ["forest", TREE, "--key", "4", "--count", "20", "--size", "50.5", "--generations", "5"],
                ["forest", TREE, "--generations", "5", "--count", "9", "--expand", "--level", "1", "--heroes", "2"]]
        for arguments in more:
            with self.subTest(arguments), compiler.TemporaryGlb(self.module, arguments, 120) as (mine, _), \
                    compiler.TemporaryGlb(self.program, arguments, 120) as (theirs, _):
                self.assertEqual(binary(mine), binary(theirs))

    def test_definitions(self):
        with tempfile.TemporaryDirectory() as folder:
            path = os.path.join(folder, "a.lsys")
            with open(path, "w", encoding="ascii") as file:
                file.write("#n = 1; #param l 1 {0.1, 9}; #w : F(l);")
            arguments = ["export", path, "-D", "l=4", "--set", "width=0.3"]
            with compiler.TemporaryGlb(self.module, arguments, 60) as (mine, _), \
                    compiler.TemporaryGlb(self.program, arguments, 60) as (theirs, _):
                self.assertEqual(binary(mine), binary(theirs))
                self.assertGreater(max(gltf.read_gltf(mine).accessor(0)[0]), 3.9)

    def test_mistakes(self):
        with tempfile.TemporaryDirectory() as folder:
            path = os.path.join(folder, "a.lsys")
            with open(path, "w", encoding="ascii") as file:
                file.write("#n = 1; #w : F(lengt);")
            for work in (lambda: self.module.read_parameters(path, 60),
                         lambda: self.module.write(["export", path], path + ".glb", 60)):
                with self.assertRaisesRegex(compiler.CompilerError, "unknown name `lengt`"):
                    work()
            with open(path, "w", encoding="ascii") as file:
                file.write("#n = 30; #w : A(1); #p : A(x) : * : A(x*{1, 2}) F A(x);")
            with self.assertRaisesRegex(compiler.CompilerError, "stopped after 0.2 s"):
                self.module.write(["export", path], path + ".glb", 0.2)
        for arguments, text in ((["--sides"], "no value"), (["sides"], "is not an option"), (["--lots", "1"], "unknown option")):
            with self.assertRaisesRegex(compiler.CompilerError, text):
                self.module.write(["export", TREE, *arguments], "/nowhere/a.glb", 60)


if __name__ == "__main__":
    unittest.main(argv=[sys.argv[0], *sys.argv[4:]])
