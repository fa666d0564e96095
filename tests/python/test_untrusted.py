# SPDX-License-Identifier: MIT
"""Grammars that are not trusted: `untrusted=True` and the limits of calls.

Usage: python3 test_untrusted.py [unittest options], with the module on PYTHONPATH.
"""

import os
import tempfile
import time
import unittest

import lsys

LEAF = "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n"
ENDLESS = "#n = 4294967294; #w : A; #p : A : * : A;"


class UntrustedTest(unittest.TestCase):
    def setUp(self):
        self.folder = tempfile.TemporaryDirectory()
        self.addCleanup(self.folder.cleanup)
        os.mkdir(self.path("home"))
        self.write("secret.lsys", "#w : F;")
        self.write("secret.obj", LEAF)
        self.write("home/part.lsys", "#w : F;")
        self.write("home/leaf.obj", LEAF)
        os.symlink("../secret.lsys", self.path("home/out.lsys"))

    def path(self, name):
        return os.path.join(self.folder.name, name)

    def write(self, name, text):
        with open(self.path(name), "w", encoding="utf-8") as file:
            file.write(text)
        return self.path(name)

    def test_includes(self):
        good = self.write("home/good.lsys", '#n = 1; #include "part.lsys";')
        self.assertEqual(str(lsys.compile(good, untrusted=True).derive()), "F")
        for name in ("../secret.lsys", "out.lsys", self.path("secret.lsys")):
            with self.subTest(name):
                bad = self.write("home/bad.lsys", f'#n = 1; #include "{name}";')
                self.assertEqual(str(lsys.compile(bad).derive()), "F")
                with self.assertRaisesRegex(lsys.GrammarError, "only files in"):
                    lsys.compile(bad, untrusted=True)
        bad = self.write("home/bad.lsys", '#n = 1; #include "../secret.lsys";')
        self.assertEqual(str(lsys.compile(bad, untrusted=True, root=self.folder.name).derive()), "F")

    def test_later_calls_are_untrusted_too(self):
        plant = lsys.compile(self.write("home/a.lsys", '#n = 1; #w : Q; #object Q "leaf.obj";'), untrusted=True).grow()
        self.assertEqual(len(plant.mesh().indices), 1)
        grammar = lsys.compile(self.write("home/a.lsys", '#n = 1; #w : Q; #object Q "../secret.obj";'), untrusted=True)
        with self.assertRaisesRegex(lsys.LsysError, "only files in"):
            grammar.grow().mesh()

    def test_texts_read_no_file(self):
        text = '#n = 1; #include "part.lsys";'
        with self.assertRaises(lsys.GrammarError):
            lsys.compile(text=text, name=self.path("home/x.lsys"), untrusted=True)
        grammar = lsys.compile(text=text, name=self.path("home/x.lsys"), untrusted=True, root=self.path("home"))
        self.assertEqual(str(grammar.derive()), "F")

    def test_time(self):
        begin = time.monotonic()
        with self.assertRaisesRegex(lsys.LsysError, "longer than 0.2 s"):
            lsys.compile(text=ENDLESS).derive(max_seconds=0.2)
        self.assertLess(time.monotonic() - begin, 10)

    def test_output(self):
        plant = lsys.compile(text="#n = 9; #w : F; #p : F : * : F [+ F] F;").grow()
        with self.assertRaisesRegex(lsys.LsysError, "larger than 1000 bytes"):
            plant.save(self.path("a.obj"), max_output=1000)
        self.assertFalse(os.path.exists(self.path("a.obj")))


if __name__ == "__main__":
    unittest.main()
