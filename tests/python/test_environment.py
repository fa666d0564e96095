# SPDX-License-Identifier: MIT
"""Functions of Python that answer environments, compared with programs of `lsc --environment`.

Usage: python3 test_environment.py LSC [unittest options], with the module on PYTHONPATH.
"""

import gc
import os
import subprocess
import sys
import tempfile
import threading
import unittest

import numpy as np

import lsys

LSC = os.path.abspath(sys.argv[1])
LIGHT = ("#n = 4; #set angle 25; #sense light program; #w : F ?light(0, 0, 3) A(1);\n"
         "#p : ?light(q, x, y) < A(l) : q > 0.2 : F(l) [ + f ?light(0) A(l*q) ] & f ?light(0, 0, 5) A(l*0.9);")
ONE = "#n = 2; #sense light program; #w : F ?light(0) A; #p : A : * : F ?light(0) A;"

# A program that answers each query with two numbers, as light() does.
PROGRAM = """
import json, struct, sys
def answer(position, heading, parameters):
    parameter = struct.unpack("f", struct.pack("f", parameters[0]))[0]  # binary32
    return [1 / (1 + abs(position[0])) + 0.1 * heading[1], parameter + position[1]]
for line in sys.stdin:
    queries = json.loads(line)["queries"]
    rows = [answer(each["position"], each["heading"], each["parameters"]) for each in queries]
    print(json.dumps({"answers": rows}), flush=True)
"""


def light(generation, positions, headings, ups, parameters):
    return np.stack([1 / (1 + np.abs(positions[:, 0])) + 0.1 * headings[:, 1],
                     parameters[:, 0].astype(np.float64) + positions[:, 1]], axis=1)


def heights(generation, positions, *_):
    return positions[:, 1:2]


class Answers(unittest.TestCase):
    def test_equals_the_program(self):
        with tempfile.TemporaryDirectory() as folder:
            path = os.path.join(folder, "light.lsys")
            program = os.path.join(folder, "light.py")
            for name, text in ((path, LIGHT), (program, PROGRAM)):
                with open(name, "w", encoding="ascii") as file:
                    file.write(text)
            expected = subprocess.run(
                [LSC, "dump", "-q", "--environment", f"light={sys.executable} {program}", path],
                capture_output=True, check=True)
            for threads in (1, 2):
                word = lsys.compile(path).derive(environment={"light": light}, threads=threads)
                self.assertEqual(str(word) + "\n", expected.stdout.decode())

    def test_arguments(self):
        calls = []

        def keep(*arguments):
            calls.append(arguments)
            return np.zeros((len(arguments[1]), 0))

        lsys.compile(text=LIGHT).derive(1, environment={"light": keep})
        gc.collect()
        self.assertEqual([call[0] for call in calls], [0, 1])
        _, positions, headings, ups, parameters = calls[0]
        for array, row in ((positions, (0, 1, 0)), (headings, (0, 1, 0)), (ups, (0, 0, 1))):
            self.assertEqual((array.shape, array.dtype), ((1, 3), np.float64))
            np.testing.assert_array_equal(array, [row])
        self.assertEqual(parameters.dtype, np.float32)
        np.testing.assert_array_equal(parameters, [[0, 0, 3]])

    def test_missing_parameters_are_nan(self):
        shown = []

        def keep(generation, positions, headings, ups, parameters):
            shown.append(parameters.tolist())
            return np.zeros((len(positions), 1))

        text = "#n = 0; #sense light program; #w : ?light(1, 2) ?light ?light(3);"
        lsys.compile(text=text).derive(environment={"light": keep})
        self.assertEqual(str(shown), "[[[1.0, 2.0], [nan, nan], [3.0, nan]]]")

    def test_plants_and_forests(self):
        plant = lsys.compile(text=ONE).grow(environment={"light": heights})
        self.assertEqual(len(plant.segments), 3)
        forest = lsys.Forest("tree.lsys", count=3, heroes=2, environment={"light": heights},
                             read_file={"tree.lsys": ONE}.get)
        self.assertEqual(len(forest.trees), 3)

    def test_kinds_of_arrays(self):
        for rows in ([[1], [2]], np.array([[1], [2]], np.int8), ((1,), (2,)),
                     np.array([[1, 9], [2, 9]], np.float32)[:, :1]):
            word = lsys.compile(text="#n = 0; #sense a program; #w : ?a(0) ?a(0);").derive(
                environment={"a": lambda *_, rows=rows: rows})
            self.assertEqual(str(word), "?a(1)?a(2)")


class Mistakes(unittest.TestCase):
    def derive(self, function, text=ONE):
        return lsys.compile(text=text).derive(environment={"light": function})

    def test_exceptions(self):
        class Dark(Exception):
            pass

        def fail(*_):
            raise Dark("night")

        with self.assertRaisesRegex(Dark, "night"):
            self.derive(fail)

    def test_shapes(self):
        for rows, shape in (([1.0], r"\(1,\)"), ([[1.0], [2.0]], r"\(2, 1\)"), (np.zeros((0, 1)), r"\(0, 1\)"),
                            (1.0, r"\(\)"), (np.zeros((1, 1, 1)), r"\(1, 1, 1\)")):
            with self.assertRaisesRegex(ValueError, f"\"light\": the answer has the shape {shape}, not .1, numbers"):
                self.derive(lambda *_, rows=rows: rows)
        for answer in (None, "bright", [[1], [2, 3]]):
            with self.assertRaisesRegex(TypeError, "environment \"light\": the answer is .*, not an array"):
                self.derive(lambda *_, answer=answer: answer)

    def test_not_finite(self):
        for number in (np.nan, np.inf, 1e300):
            with self.assertRaisesRegex(lsys.GrammarError, r"`\?light` is (?s:.*)module 1 of generation 0") as caught:
                self.derive(lambda *_, number=number: [[number]])
            self.assertEqual(caught.exception.diagnostics[0].code, "sense-not-finite")

    def test_names(self):
        with self.assertRaisesRegex(lsys.GrammarError, "environment={\"light\": function}"):
            lsys.compile(text=ONE).derive()
        with self.assertRaisesRegex(lsys.LsysError, "no `#sense ligth program;`"):
            lsys.compile(text=ONE).derive(environment={"light": heights, "ligth": heights})
        for wrong in ([heights], {"light": 3}, {3: heights}):
            with self.assertRaisesRegex(TypeError, "environment is a dictionary"):
                lsys.compile(text=ONE).derive(environment=wrong)

    def test_no_leak(self):
        grammar = lsys.compile(text=ONE)
        counts = []
        for _ in range(3):
            for _ in range(50):
                grammar.derive(environment={"light": heights})
            gc.collect()
            counts.append(sys.getrefcount(heights))
        self.assertEqual(counts[1], counts[2])


class Threads(unittest.TestCase):
    def test_threads(self):
        grammar = lsys.compile(text=LIGHT)
        expected = str(grammar.derive(environment={"light": light}))
        words = []
        threads = [threading.Thread(target=lambda: words.append(
            str(grammar.derive(environment={"light": light})))) for _ in range(8)]
        for thread in threads:
            thread.start()
        for thread in threads:
            thread.join()
        self.assertEqual(words, [expected] * 8)


if __name__ == "__main__":
    unittest.main(argv=[sys.argv[0], *sys.argv[2:]])
