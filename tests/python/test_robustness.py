# SPDX-License-Identifier: MIT
"""No leak and no crash of the module: exceptions in callbacks, an interpreter that ends during a call, many
threads, many mistakes. With libasan (scripts/nightly python) the tests count the bytes of its heap, else the
resident memory of the process.

Usage: python3 test_robustness.py [unittest options], with the module on PYTHONPATH.
"""

import ctypes
import gc
import os
import subprocess
import sys
import tempfile
import threading
import unittest
import warnings

import numpy as np

import lsys

TREE = ("#n = 4; #param ratio 0.6 {0, 1}; #set angle 25; #w : !(0.3) F(3) X;"
        "#p : X : * : !(0.08) F(0.6) [ + X ] /(120) [ & X ] /(120) [ ^ X ];")
ENDLESS = "#n = 30; #w : A(1); #p : A(x) : x > 0 : A(x + 0.5) A(x*{0.9, 1.1});"
FILES = {"tree.lsys": TREE, "part.lsys": '#include "tree.lsys";'}


def heap():
    """Bytes in use (libasan's heap, else resident memory), and the growth in bytes that counts as a leak."""
    gc.collect()
    try:
        count = ctypes.CDLL(None).__sanitizer_get_current_allocated_bytes
    except AttributeError:
        with open("/proc/self/statm", encoding="ascii") as file:
            return 4096 * int(file.read().split()[1]), 6 << 20
    count.restype = ctypes.c_size_t
    return count(), 64 << 10


def fail(*_):
    raise ValueError("enough")


class Leaks(unittest.TestCase):
    def check(self, work, times):
        for _ in range(max(times // 4, 3)):
            work()
        before, most = heap()
        for _ in range(times):
            work()
        after, _ = heap()
        self.assertLess(after - before, most)

    def test_ten_thousand_mistakes(self):
        def work():
            with self.assertRaises(lsys.GrammarError):
                lsys.compile(text="#n = 1; #w : F(lengt;")

        self.check(work, 10_000)

    def test_exceptions_in_callbacks(self):
        grammar = lsys.compile(text=TREE)
        endless = lsys.compile(text=ENDLESS)
        plant = grammar.grow()
        forest = lsys.Forest("tree.lsys", count=5, heroes=1, read_file=FILES.get)

        def work():
            for action in (lambda: endless.derive(progress=fail), lambda: endless.grow(progress=fail),
                           lambda: lsys.compile("tree.lsys", read_file=fail),
                           lambda: lsys.Forest("tree.lsys", read_file=fail),
                           lambda: lsys.Forest.from_places("tree.lsys", np.zeros((2, 3)), read_file=fail),
                           lambda: plant.write("a.glb", fail), lambda: plant.write("a.obj", fail, lods=2),
                           lambda: forest.write("a.glb", fail),
                           lambda: forest.write("a.glb", print, instances="lods", read_file=fail)):
                with self.assertRaisesRegex(ValueError, "enough"):
                    action()
            with self.assertRaises(lsys.Cancelled):
                plant.write("a.glb", lambda *_: False)
            with self.assertRaises(TypeError):
                lsys.compile("tree.lsys", read_file=lambda path: 7)

        self.check(work, 100)

    def test_warnings_as_errors(self):
        def work():
            with warnings.catch_warnings():
                warnings.simplefilter("error")
                with self.assertRaises(lsys.GrammarWarning):
                    lsys.compile(text="#n = 1; #define size 2; #w : F; #p : F : * : F F;")

        self.check(work, 300)

    def test_all_values(self):
        def work():
            grammar = lsys.compile("part.lsys", read_file=FILES.get, defines={"ratio": 0.5})
            word = grammar.derive()
            codes = word.codes
            self.assertEqual(len(codes), sum(1 for _ in word))
            plant = grammar.grow()
            mesh = plant.mesh()
            segments, positions = plant.segments, mesh.positions
            del plant, mesh, word, grammar
            self.assertGreater(segments["length"].sum(), 0)
            self.assertTrue(np.isfinite(positions).all())
            forest = lsys.Forest.from_places("tree.lsys", [[0, 0, 0], [5, 0, 5]], heroes=1, read_file=FILES.get)
            instances = forest.instances
            array, matrices = instances.array, instances.matrices()
            del forest, instances
            self.assertEqual(array["tree"].max(), 1)
            self.assertEqual(matrices[0, 3, 3], 1)

        self.check(work, 60)

    def test_files(self):
        plant = lsys.compile(text=TREE).grow()
        with tempfile.TemporaryDirectory() as folder:
            def work():
                plant.save(os.path.join(folder, "a.glb"), preset="unity", lods=2)
                plant.files_of("a.obj")
                self.assertGreater(len(plant.png()), 100)

            self.check(work, 20)


class Crashes(unittest.TestCase):
    def test_eight_threads(self):
        grammar = lsys.compile(text=TREE)
        expected = grammar.grow().mesh().positions.tobytes()
        failures = []

        def work(number):
            try:
                for i in range(12):
                    plant = grammar.grow(threads=1 + number % 3)
                    if plant.mesh().positions.tobytes() != expected:
                        failures.append("another mesh")
                    plant.files_of("a.glb", compress="meshopt")
                    try:
                        lsys.compile(text=f"#n = 1; #w : F(lengt{i};")
                    except lsys.GrammarError as error:
                        str(error)
                    lsys.Forest("tree.lsys", count=20, heroes=1, read_file=FILES.get).instances.matrices()
            except BaseException as error:  # pylint: disable=broad-except
                failures.append(repr(error))

        threads = [threading.Thread(target=work, args=(number,)) for number in range(8)]
        for thread in threads:
            thread.start()
        for thread in threads:
            thread.join()
        self.assertEqual(failures, [])

    def run_and_end(self, code):
        environment = {**os.environ, "ASAN_OPTIONS": "detect_leaks=0"}
        done = subprocess.run([sys.executable, "-c", code], capture_output=True, timeout=300, check=False,
                              env=environment)
        self.assertEqual((done.returncode, done.stderr), (0, b""))

    def test_exit_in_the_middle(self):
        setup = f"import lsys, threading, time; g = lsys.compile(text={ENDLESS!r});"
        for work in ("g.derive", "g.grow", "lambda: g.derive(progress=lambda *_: True)"):
            with self.subTest(work):
                self.run_and_end(f"{setup} threading.Thread(target={work}, daemon=True).start(); time.sleep(0.3)")

    def test_call_in_a_signal_handler(self):
        self.run_and_end(
            "import lsys, os, signal\n"
            f"g = lsys.compile(text={ENDLESS!r}); lengths = []\n"
            "signal.signal(signal.SIGALRM, lambda *_: lengths.append(len(g.derive(6))))\n"
            "signal.setitimer(signal.ITIMER_REAL, 0.2)\n"
            "g.derive(18)\n"
            "while not lengths: pass\n"
            "assert lengths[0] == len(g.derive(6))\n")

    def test_fork(self):
        self.run_and_end(
            "import lsys, os\n"
            f"g = lsys.compile(text={ENDLESS!r}); length = len(g.derive(9)); child = os.fork()\n"
            "same = len(g.derive(9)) == length\n"
            "if child == 0: os._exit(0 if same else 1)\n"
            "assert same and os.waitpid(child, 0)[1] == 0\n")

    def test_exit_with_values(self):
        self.run_and_end(f"import lsys; w = lsys.compile(text={ENDLESS!r}).derive(9); c = w.codes; i = iter(w); next(i)")


if __name__ == "__main__":
    unittest.main()
