# SPDX-License-Identifier: MIT
"""The Python module, compared with the program `lsc` and tested alone.

Usage: python3 test_lsys.py LSC SAMPLES [unittest options], with the module on PYTHONPATH.
"""

import contextlib
import copy
import gc
import importlib.util
import io
import os
import pickle
import re
import signal
import subprocess
import sys
import tempfile
import threading
import time
import types
import unittest
import unittest.mock
import warnings

import numpy as np

import lsys

LSC, SAMPLES = map(os.path.abspath, sys.argv[1:3])
TREE = "#n = 3; #w : A; #p : A : * : F [ + A ] F A;"
RANDOM = "#n = 30; #w : A(1); #p : A(x) : x > 0 : A(x + 0.5) A(x*{0.9, 1.1});"


def samples():
    """The .lsys samples, except the benchmark systems with their large words."""
    for folder in sorted(os.listdir(SAMPLES)):
        path = os.path.join(SAMPLES, folder, folder + ".lsys")
        if os.path.exists(path) and not folder.startswith("bench-"):
            yield path


def ply_positions(path):
    """Positions of a binary PLY file of `lsc`."""
    with open(path, "rb") as file:
        data = file.read()
    end = data.index(b"end_header\n") + len(b"end_header\n")
    lines = data[:end].decode().split("\n")
    count = next(int(line.split()[2]) for line in lines if line.startswith("element vertex"))
    sizes = {"float": 4, "uchar": 1}
    properties = lines[next(i for i, line in enumerate(lines) if "element vertex" in line) + 1:]
    stride = 0
    for line in properties:
        words = line.split()
        if not words or words[0] != "property":
            break
        stride += sizes[words[1]]
    vertices = np.frombuffer(data, np.uint8, count * stride, end).reshape(count, stride)
    return np.ascontiguousarray(vertices[:, :12]).view("<f4")


class Equality(unittest.TestCase):
    """Words, skeletons and meshes equal those of `lsc`, bit for bit."""

    def test_words(self):
        for path in samples():
            with self.subTest(path), warnings.catch_warnings():
                warnings.simplefilter("ignore")
                expected = subprocess.run([LSC, "dump", "-q", path], capture_output=True, check=True)
                self.assertEqual(str(lsys.compile(path).derive()) + "\n", expected.stdout.decode())

    def test_seeds(self):
        path = os.path.join(SAMPLES, "abop-1-27-stochastic", "abop-1-27-stochastic.lsys")
        grammar = lsys.compile(path)
        for seed in (1, 2, 2**63):
            expected = subprocess.run([LSC, "dump", "-q", "--seed", str(seed), "-n", "4", path],
                                      capture_output=True, check=True)
            self.assertEqual(str(grammar.derive(4, seed)) + "\n", expected.stdout.decode())

    def test_meshes(self):
        with tempfile.TemporaryDirectory() as folder:
            for path in samples():
                out = os.path.join(folder, "plant.ply")
                made = subprocess.run([LSC, "export", "-q", path, "-o", out], capture_output=True,
                                      check=False)
                with self.subTest(path), warnings.catch_warnings():
                    warnings.simplefilter("ignore")
                    plant = lsys.compile(path).grow()
                    mesh = plant.mesh()
                    if made.returncode != 0:  # nothing to draw
                        self.assertEqual(len(mesh.positions), 0, made.stderr)
                        continue
                    expected = ply_positions(out)
                    self.assertEqual(mesh.positions.tobytes(), expected.tobytes())

    def test_files(self):
        path = os.path.join(SAMPLES, "carey-type-0", "carey-type-0.lsys")
        with tempfile.TemporaryDirectory() as folder:
            expected = os.path.join(folder, "a.stl")
            subprocess.run([LSC, "export", "-q", path, "-o", expected], check=True)
            mine = os.path.join(folder, "b.stl")
            lsys.compile(path).grow().save(mine)
            with open(expected, "rb") as one, open(mine, "rb") as other:
                # The header of an STL names the program.
                self.assertEqual(one.read()[80:], other.read()[80:])
            self.assertEqual(sorted(os.listdir(folder)), ["a.stl", "b.stl"])

    def test_no_file_replaces_an_input(self):
        with tempfile.TemporaryDirectory() as folder:
            mesh = os.path.join(folder, "m.obj")
            with open(mesh, "w") as file:
                file.write("v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n")
            path = os.path.join(folder, "a.lsys")
            with open(path, "w") as file:
                file.write('#include "b.lsys";\n#object L "m.obj";\n#n = 1;\n#w : F L;\n')
            with open(os.path.join(folder, "b.lsys"), "w") as file:
                file.write("#set angle 25;\n")
            plant = lsys.compile(path).grow()
            forest = lsys.Forest(path, count=3)
            before = {name: self.bytes_of(folder, name) for name in os.listdir(folder)}
            for name in ("m.obj", "a.lsys", "b.lsys"):
                output = os.path.join(folder, name)
                for save in (lambda to: plant.save(to, format="obj"),
                             lambda to: plant.save(to, format="obj", mesh=plant.mesh())):
                    with self.assertRaisesRegex(lsys.LsysError, "it is an input of this command"):
                        save(output)
            with self.assertRaisesRegex(lsys.LsysError, "it is an input of this command"):
                forest.save(mesh, bake=True)
            self.assertEqual(before, {name: self.bytes_of(folder, name) for name in os.listdir(folder)})
            other = os.path.join(folder, "other.obj")
            self.assertEqual(plant.save(other, mesh=plant.mesh()), [other])
            self.assertEqual(self.bytes_of(folder, "other.obj"),
                             plant.export(plant.mesh(), "obj", name="other"))

    @staticmethod
    def bytes_of(folder, name):
        with open(os.path.join(folder, name), "rb") as file:
            return file.read()


class Views(unittest.TestCase):
    """Arrays are views: no data is copied, and views keep their owner alive."""

    def test_word(self):
        word = lsys.compile(text=TREE).derive(10)
        codes = word.codes
        self.assertEqual(codes.dtype, np.uint8)
        self.assertFalse(codes.flags.owndata)
        self.assertFalse(codes.flags.writeable)
        self.assertEqual(codes.ctypes.data, word.codes.ctypes.data)
        self.assertEqual(len(codes), len(word))
        names = "".join(word.kinds[code].name for code in codes)
        self.assertEqual(names, "".join(name for name, _ in word))
        text = str(word)
        del word
        gc.collect()
        self.assertEqual(np.count_nonzero(codes == codes[0]), text.count("F"))

    def test_parameters(self):
        word = lsys.compile(text="#n = 1; #w : A(0.5); #p : A(x) : * : B(x, {1, 2}) +(90);").derive()
        modules = list(word)
        self.assertEqual([name for name, _ in modules], ["B", "+"])
        self.assertEqual(modules[0][1][0], 0.5)
        self.assertTrue(1 <= modules[0][1][1] < 2)
        self.assertEqual(modules[1][1], (90.0,))

    def test_plant(self):
        plant = lsys.compile(text="#n = 1; #w : F(2) [ +(90) F(1) ]; #p : Q : * : Q;").grow()
        segments = plant.segments
        self.assertEqual(segments.dtype, lsys.SEGMENT)
        self.assertEqual(segments.dtype.itemsize, 60)
        self.assertFalse(segments.flags.owndata)
        self.assertEqual(segments["length"].tolist(), [2.0, 1.0])
        self.assertEqual(segments["parent"].tolist(), [2**32 - 1, 0])
        self.assertEqual(segments["flags"].tolist(), [0, 1])
        self.assertEqual(segments["base"][1].tolist(), [0.0, 2.0, 0.0])
        self.assertEqual(plant.measure().length, 3.0)
        mesh = plant.mesh()
        self.assertEqual(mesh.positions.shape[1], 3)
        self.assertEqual(mesh.indices.shape[1], 3)
        self.assertLess(mesh.indices.max(), len(mesh.positions))
        positions = mesh.positions
        del mesh, plant
        gc.collect()
        self.assertTrue(np.isfinite(positions).all())

    def test_pictures(self):
        plant = lsys.compile(text=TREE).grow()
        self.assertIn("<svg", plant._repr_svg_())
        self.assertIn("segments", repr(plant))


class Errors(unittest.TestCase):
    def test_mistakes(self):
        with self.assertRaises(lsys.GrammarError) as caught:
            lsys.compile(text="#n = 1;\n#w : F(lengt);", name="leaf.lsys")
        diagnostic = caught.exception.diagnostics[0]
        self.assertEqual(diagnostic.code, "unknown-name")
        self.assertEqual(diagnostic.severity, "error")
        self.assertEqual((diagnostic.place.file, diagnostic.place.line, diagnostic.place.column),
                         ("leaf.lsys", 2, 8))
        self.assertIn("^^^^^", str(caught.exception))

    def test_warnings(self):
        with self.assertWarns(lsys.GrammarWarning):
            lsys.compile(text="#n = 1; #define size 2; #w : F; #p : F : * : F F;")

    def test_files(self):
        with self.assertRaises(lsys.LsysError) as caught:
            lsys.compile("/nowhere/tree.lsys")
        self.assertEqual(str(caught.exception),
                         "cannot read `/nowhere/tree.lsys`: no such file or directory")
        with self.assertRaises(TypeError):
            lsys.compile()
        with self.assertRaises(TypeError):
            lsys.compile(text=TREE, colour="red")

    def test_callbacks(self):
        grammar = lsys.compile(text=RANDOM)

        def fail(*_):
            raise ValueError("enough")

        with self.assertRaisesRegex(ValueError, "enough"):
            grammar.derive(progress=fail)
        with self.assertRaises(lsys.Cancelled):
            grammar.derive(progress=lambda generation, generations, modules: generation < 5)
        with self.assertRaisesRegex(ValueError, "enough"):
            lsys.compile("tree.lsys", read_file=fail)
        files = {"a/tree.lsys": '#include "rules.lsys"; #n = 1; #w : A;',
                 "a/rules.lsys": b"#p : A : * : F F;"}
        grammar = lsys.compile("a/tree.lsys", read_file=files.get)
        self.assertEqual(str(grammar.derive()), "F F")
        with self.assertRaisesRegex(lsys.LsysError, "no such file"):
            lsys.compile("b.lsys", read_file=files.get)

    def test_limits(self):
        with self.assertRaises(lsys.LimitError):
            lsys.compile(text=RANDOM).derive(max_modules=1000)

    def test_limits_are_named_by_arguments(self):
        grammar = lsys.compile(text=RANDOM)
        for options in ({"max_modules": 1000}, {"max_bytes": 1000}):
            with self.assertRaises(lsys.LimitError) as caught:
                grammar.derive(**options)
            texts = [str(caught.exception)] + [text for one in caught.exception.diagnostics for text in one.help]
            for text in texts:
                self.assertIn(f"`{next(iter(options))}=", text)
                self.assertNotIn("`--", text)

    def test_values_out_of_range(self):
        grammar = lsys.compile(text=TREE)
        for height in (-1, 0, 1e7, float("nan"), float("inf")):
            with self.assertRaisesRegex(lsys.LsysError, "`height` is"):
                grammar.grow(height=height)
        plant = grammar.grow(1)
        for options, name in (({"sides": 1}, "sides"), ({"sides": 65}, "sides"), ({"deviation": -1}, "deviation"),
                              ({"deviation": float("nan")}, "deviation"), ({"min_width": -1}, "min_width"),
                              ({"min_width": float("inf")}, "min_width")):
            with self.assertRaisesRegex(lsys.LsysError, f"`{name}` is"):
                plant.mesh(**options)
        for options in ({"threads": -1}, {"max_modules": -1}, {"max_bytes": 2**64}):
            with self.assertRaisesRegex(ValueError, f"{next(iter(options))} is a whole number"):
                grammar.derive(**options)
        with self.assertRaisesRegex(TypeError, "threads is a whole number"):
            grammar.derive(threads=None)
        for options in ({"max_seconds": None}, {"max_seconds": "1"}, {"untrusted": "yes"}):
            with self.assertRaisesRegex(TypeError, f"{next(iter(options))} is"):
                grammar.derive(**options)
        for seconds in (-1.0, float("nan")):
            with self.assertRaisesRegex(lsys.LsysError, "max_seconds is neither 0"):
                grammar.derive(max_seconds=seconds)

    def test_errors_are_pickled(self):
        with self.assertRaises(lsys.GrammarError) as caught:
            lsys.compile(text="#n=1\n#w : F;\n")
        error = caught.exception
        for copied in (pickle.loads(pickle.dumps(error)), copy.deepcopy(error)):
            self.assertIs(type(copied), lsys.GrammarError)
            self.assertEqual(str(copied), str(error))
            one, other = error.diagnostics[0], copied.diagnostics[0]
            for name in ("severity", "code", "message", "label", "notes", "help"):
                self.assertEqual(getattr(one, name), getattr(other, name))
            self.assertEqual(repr(one.place), repr(other.place))
            self.assertEqual(other.place.end_offset, one.place.end_offset)
            self.assertEqual(other.fixes[0].edits[0].replacement, ";")
            self.assertEqual(other.fixes[0].certain, one.fixes[0].certain)
        with self.assertRaisesRegex(ValueError, "another version"):
            function, members = error.diagnostics[0].place.__reduce__()
            function(*members[:-1])

    def test_no_objects_without_values(self):
        for name in ("Grammar", "Word", "Plant", "Mesh", "Instances"):
            with self.assertRaisesRegex(TypeError, "has no constructor"):
                getattr(lsys, name).__new__(getattr(lsys, name))
        with self.assertRaisesRegex(TypeError, r"Forest\(\) missing .* 'scene'"):
            lsys.Forest.__new__(lsys.Forest)

    def test_interrupt_of_compile(self):
        text = "#n = 1; #w : F" + "(1) F [ + F ]" * 3_000_000 + ";"
        interrupted = 0.0

        def interrupt():
            nonlocal interrupted
            interrupted = time.monotonic()
            os.kill(os.getpid(), signal.SIGINT)

        timer = threading.Timer(0.3, interrupt)
        timer.start()
        with self.assertRaises(KeyboardInterrupt):
            lsys.compile(text=text)
        self.assertLess(time.monotonic() - interrupted, 2)  # about 0.1 s on an idle machine
        timer.join()

    def test_interrupt(self):
        grammar = lsys.compile(text=RANDOM)
        timer = threading.Timer(0.2, lambda: os.kill(os.getpid(), signal.SIGINT))
        timer.start()
        with self.assertRaises(KeyboardInterrupt):
            grammar.derive()
        timer.join()

    def test_no_leak(self):
        """10,000 mistakes leak no memory."""
        def memory():
            with open("/proc/self/statm", encoding="ascii") as file:
                return int(file.read().split()[1])

        def fail(count):
            for _ in range(count):
                try:
                    lsys.compile(text="#n = 1; #w : F(lengt;")
                except lsys.GrammarError:
                    pass

        fail(2000)
        before = memory()
        fail(8000)
        self.assertLess((memory() - before) * 4096, 4 << 20)


class Threads(unittest.TestCase):
    def test_threads(self):
        grammar = lsys.compile(os.path.join(SAMPLES, "abop-1-25-bush", "abop-1-25-bush.lsys"))
        expected = grammar.grow().mesh().positions.tobytes()
        results = []

        def work():
            for _ in range(3):
                results.append(grammar.grow(threads=2).mesh(threads=2).positions.tobytes())

        threads = [threading.Thread(target=work) for _ in range(8)]
        for thread in threads:
            thread.start()
        for thread in threads:
            thread.join()
        self.assertEqual(len(results), 24)
        self.assertTrue(all(result == expected for result in results))

    def test_exit_while_working(self):
        """An interpreter that ends while a thread derives ends cleanly."""
        code = (f"import threading, lsys; g = lsys.compile(text={RANDOM!r});"
                "threading.Thread(target=g.derive, daemon=True).start();"
                "import time; time.sleep(0.2)")
        ended = subprocess.run([sys.executable, "-c", code], capture_output=True, timeout=60,
                               check=False)
        self.assertEqual((ended.returncode, ended.stderr), (0, b""))


class Recipes(unittest.TestCase):
    """The examples of docs/python.md run, with stand-ins for packages that are not installed."""

    def test_documentation(self):
        class Bar:
            def __init__(self, total):
                self.n = 0

            def __enter__(self):
                return self

            def __exit__(self, *_):
                pass

            def update(self, count):
                self.n += count

        packages = {}
        for name in ("pandas", "matplotlib", "matplotlib.pyplot", "trimesh"):
            if importlib.util.find_spec(name.partition(".")[0]) is None:
                packages[name] = unittest.mock.MagicMock()
        os.environ["MPLBACKEND"] = "agg"
        with open(os.path.join(SAMPLES, os.pardir, "docs/python.md"), encoding="utf-8") as file:
            examples = re.findall(r"```python\n(.*?)```", file.read(), re.DOTALL)
        self.assertGreater(len(examples), 10)
        names = {"tqdm": types.SimpleNamespace(tqdm=Bar)}
        here = os.getcwd()
        with tempfile.TemporaryDirectory() as folder, unittest.mock.patch.dict(
                sys.modules, packages), contextlib.redirect_stdout(io.StringIO()):
            os.chdir(folder)
            try:
                os.mkdir("plants")
                with open("tree.lsys", "w", encoding="ascii") as file:
                    file.write("#n = 4; #param ratio 0.6 {0, 1}; #set angle 20; #w : A(1);\n"
                               "#p : A(x) : x > 0.05 :"
                               " !(x/10) F(x) [ + A(x*ratio) ] [ - A(x*ratio) ] A(x*0.8);\n")
                for example in examples:
                    exec(example, names)  # pylint: disable=exec-used
                self.assertTrue(os.path.exists("tree.glb"))
                self.assertEqual(len(os.listdir("plants")), 100)
                self.assertTrue(os.path.exists("stand.glb"))
                if "matplotlib" not in packages:
                    self.assertTrue(os.path.exists("allometry.png"))
                if "pandas" not in packages:
                    self.assertTrue(names["table"]["height"].is_monotonic_increasing)
            finally:
                os.chdir(here)


if __name__ == "__main__":
    unittest.main(argv=[sys.argv[0], *sys.argv[3:]])
