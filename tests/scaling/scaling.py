# SPDX-License-Identifier: MIT
"""Counts the instructions of `lsc` on inputs of three sizes, and checks that the work grows as the input does.

Each case is a command with a generated input of n, 2n and 4n pieces. The instructions beyond those of an empty input are
counted by valgrind, not timed, so the result is the same on a busy machine. Doubling the input may multiply the
instructions of the added pieces by LIMIT: linear work gives 2, n log n some percent more, quadratic work 4. A case with
less growth has reached a limit of its work. Left out is work that grows by nature with a product: passes of
`#decompose` times modules, generations of leftmost rewriting times modules, a context times the word, rounds of
--settle times branches. Checks of conditions have a limit of work, which tests/scale covers;
suggestions for misspelt names compare at most 4 million pairs of names.

Usage: scaling.py LSC [--list] [--part I/N] [CASE...]
  --part I/N   every Nth case from the Ith on, from 0: tests run side by side
"""

import argparse
import os
import re
import subprocess
import sys
import tempfile

LIMIT = 2.8
LEAST = 1_000_000  # instructions between n and 2n; fewer say nothing
MOST = 4_000_000_000  # instructions at 4n; a case with more is too large for a test


def lines(text, count):
    """`text` for each number below `count`, with the number in place of `%d`."""
    return "".join(text.replace("%d", str(i)) for i in range(count))


GRAMMAR = "#n = 1;\n#w : A(1);\n"
SCENE = """key = 1
[terrain]
kind = "flat"
size = 400
[placement]
method = "uniform"
count = %d
[[species]]
grammar = "tree.lsys"
"""
TREE = "#n = 4;\n#w : '(0.1) A(1);\n#p : A(s) : * : F(s) [+ A(s * 0.7)] [- A(s * 0.7)];\n"


def grammar(text, command=("check",), name="a.lsys"):
    """A case with one file, which may depend on n; `FILE` is its name in the command."""
    return lambda n: ({name: text(n) if callable(text) else text}, [*command, name])


# Names of the cases: what grows. Each makes, from n, the files and the arguments of the command.
CASES = {
    # statements and expressions
    "check: productions": (500, grammar(lambda n: GRAMMAR + lines("#p%d : A%d(x) : x > 1 : A%d(x - 1) F;\n", n))),
    "check: stochastic productions of one symbol": (250, grammar(
        lambda n: "#n = 1;\n#set weights any;\n#w : A;\n" + lines("#p%d : A : ~ 1 : F;\n", n))),
    "check: successor": (2000, grammar(lambda n: GRAMMAR + "#p : A(x) : * : " + "F(x) " * n + ";\n")),
    "check: different modules of a successor": (
        500, grammar(lambda n: GRAMMAR + "#p : A(x) : * : " + lines("B%d(x) ", n) + ";\n")),
    "check: sum": (1000, grammar(lambda n: GRAMMAR + "#p : A(x) : * : F(x" + " + x" * n + ");\n")),
    "check: brackets": (1000, grammar(lambda n: GRAMMAR + "#p : A(x) : * : " + "[" * n + "F" + "]" * n + ";\n")),
    "check: definitions": (1000, grammar(lambda n: GRAMMAR + lines("#define c%d %d;\n", n))),
    "check: definitions of definitions": (
        500, grammar(lambda n: GRAMMAR + "#define c0 1;\n" + "".join(f"#define c{i + 1} c{i} + 1;\n" for i in range(n)))),
    "check: parameters": (500, grammar(lambda n: GRAMMAR + lines("#param c%d 1 {0, 2};\n", n))),
    "check: comments": (2000, grammar(lambda n: GRAMMAR + lines("// comment %d\n", n))),
    "check: curves": (300, grammar(lambda n: GRAMMAR + lines("#curve c%d 0 0, 1 1, 2 0;\n", n))),
    "check: context": (500, grammar(lambda n: GRAMMAR + "#p : " + "B " * n + "< A(x) : * : F;\n")),
    "check: decompositions": (500, grammar(lambda n: GRAMMAR + lines("#decompose d%d : A%d : * : B%d F;\n", n))),
    "check: included files": (100, lambda n: (
        {"a.lsys": GRAMMAR + lines('#include "b%d.lsys";\n', n)} | {f"b{i}.lsys": f"#define c{i} 1;\n" for i in range(n)},
        ["check", "a.lsys"])),
    "check: files": (100, lambda n: ({f"a{i}.lsys": GRAMMAR for i in range(n)},
                                     ["check", *(f"a{i}.lsys" for i in range(n))])),
    "check: errors": (500, grammar(lambda n: GRAMMAR + lines("#p%d  A : * : F;\n", n))),
    "check: warnings": (500, grammar(lambda n: GRAMMAR + lines("#p%d : A%d : * : F;\n", n))),
    "check --fix": (500, grammar(lambda n: GRAMMAR + lines("#p%d  A%d : * : F;\n", n), ("check", "--fix"))),
    "fmt: productions": (500, grammar(lambda n: GRAMMAR + lines("#p%d:A%d(x):x>1:A%d(x-1)F;\n", n), ("fmt",))),
    "fmt: successor": (2000, grammar(lambda n: GRAMMAR + "#p : A(x) : * : " + "F(x) " * n + ";\n", ("fmt",))),
    "fmt: condition": (500, grammar(
        lambda n: GRAMMAR + "#p : A(x) : x > 0" + lines(" && x > -%d", n) + " : F;\n", ("fmt",))),
    "compile": (500, grammar(
        lambda n: GRAMMAR + lines("#p%d : A%d(x) : x > 1 : A%d(x - 1) F;\n", n), ("compile", "-o", "a.lsb"))),
    "stats": (500, grammar(lambda n: GRAMMAR + lines("#p%d : A%d : * : B%d A%d;\n", n), ("stats", "-n", "10"))),
    # derivations
    "dump: modules": (20000, grammar(lambda n: GRAMMAR + "#p : A(x) : * : " + "F(x) " * n + ";\n", ("dump", "--count"))),
    "dump: generations": (2000, lambda n: (
        {"a.lsys": "#w : A;\n#p : A : * : A;\n"}, ["dump", "-n", str(n), "a.lsys"])),
    "dump: choices": (5000, grammar(lambda n: "#n = 1;\n#w : " + "A " * n + ";\n#a : A : ~ 0.5 : F;\n#b : A : ~ 0.5 : G;\n",
                                    ("dump", "--count"))),
    "dump: context of one module": (3000, grammar(
        lambda n: "#n = 3;\n#w : B " + "A " * n + ";\n#p : B < A : * : B;\n", ("dump", "--count"))),
    "dump: branch contexts": (2000, grammar(
        lambda n: "#n = 2;\n#w : B " + "[ A ] " * n + ";\n#p : B < A : * : F;\n", ("dump", "--count"))),
    "dump: right contexts over branches": (500, grammar(
        lambda n: "#n = 1;\n#w : " + "A [ C ] " * n + "B;\n#p : A > B : * : F;\n", ("dump", "--count"))),
    "dump: decomposition": (2000, grammar(
        lambda n: "#n = 1;\n#w : " + "A " * n + ";\n#decompose d : A : * : B B;\n", ("dump", "--count"))),
    "dump: leftmost": (4800, grammar(
        lambda n: "#n = 20;\n#set rewriting leftmost;\n#w : " + "A B " * (n // 2) + ";\n#p : A B : * : B A;\n"
        "#q : B A : * : A B;\n", ("dump", "--count"))),
    "dump: word": (5000, grammar(lambda n: "#n = 0;\n#w : " + "F(1.25) " * n + ";\n", ("dump",))),
    "dump: sensing": (100, grammar(
        lambda n: "#n = 1;\n#sense light shadow cell 0.5 levels 3;\n#w : " + "F ?light(0, 0, 0, 0) " * n + ";\n",
        ("dump", "--count"))),
    "dump: crowd": (100, grammar(
        lambda n: "#n = 1;\n#sense near crowd radius 2;\n#w : " + "F(1) ?near(0, 0, 0, 0) " * n + ";\n",
        ("dump", "--count"))),
    "dump: sweep": (1000, grammar(
        lambda n: "#n = 1;\n#w : " + "A(1) " * n + "B(1);\n#up u : A(x) < A(y) : * : A(x + y);\n", ("dump", "--count"))),
    "trace": (500, grammar(lambda n: "#n = 1;\n#w : " + "A " * n + ";\n#p : A : * : F F;\n", ("trace", "-n", "0", "--all", "A"))),
    # plants
    **{f"export {ending}": (300, grammar(lambda n: "#n = 0;\n#w : " + "F(1) +(3) " * n + ";\n",
                                         ("export", "-o", f"a.{ending}")))
       for ending in ("obj", "glb", "gltf", "ply", "stl", "off", "svg", "usda", "usdz")},
    **{f"export {method}": (60, grammar(lambda n: "#n = 0;\n#w : " + "F(1) [ +(30) F(1) ] " * n + ";\n",
                                        ("export", "-o", "a.stl", "--method", method)))
       for method in ("tubes", "cylinders", "boxes")},
    "export: forks of one joint": (100, grammar(
        lambda n: "#n = 0;\n#w : F " + "[ +(10) F ] " * n + ";\n", ("export", "-o", "a.stl"))),
    "export: polygons": (300, grammar(lambda n: "#n = 0;\n#w : " + "{ F + F + F } f " * n + ";\n", ("export", "-o", "a.stl"))),
    "export: corners of a polygon": (300, grammar(
        lambda n: "#n = 0;\n#w : { " + "F +(0.1) " * n + "};\n", ("export", "-o", "a.stl"))),
    "export: depth of brackets": (300, grammar(
        lambda n: "#n = 0;\n#w : " + "F [ " * n + "]" * n + ";\n", ("export", "-o", "a.stl"))),
    # forests
    "forest: trees": (100, lambda n: ({"tree.lsys": TREE, "a.toml": SCENE % n}, ["forest", "a.toml", "-o", "a.glb"])),
    "forest: whole trees": (1000, lambda n: (
        {"tree.lsys": TREE, "a.toml": SCENE % n}, ["forest", "a.toml", "-o", "a.glb", "--instances", "trees"])),
    "place": (1000, lambda n: ({"tree.lsys": TREE, "a.toml": SCENE % n}, ["place", "a.toml", "-o", "a.trees"])),
    "place: domination": (200, lambda n: (
        {"tree.lsys": TREE}, ["place", "tree.lsys", "--placement", "domination", "--years", "5", "--count", str(n),
                              "--size", str(10 * n ** 0.5), "-o", "a.trees"])),
    "tiles": (100, lambda n: ({"tree.lsys": TREE, "a.toml": SCENE % n},
                              ["tiles", "a.toml", "-o", "tiles", "--heroes", "1", "-n", "2"])),
    # other languages
    "abop: productions": (300, grammar(
        lambda n: "n = 1\nω : A0\n" + lines("p%d : A%d -> F [ + A%d ] F\n", n), ("check",), "a.ls")),
    "abop: successor": (1000, grammar(lambda n: "n = 1\nω : A\np1 : A -> " + "F[+A]" * n + "\n", ("check",), "a.ls")),
    "carey: successor": (300, grammar(
        lambda n: "axiom: A\ngenerations: 1\n" + lines("A=FA:0.5\n", 1) + "B=" + "F[A]" * n + "\n",
        ("check",), "a.rules")),
    "cpfg: productions": (300, grammar(
        lambda n: "Lsystem: 1\nderivation length: 1\nAxiom: A(1)\n" + lines("A(x) : x == %d --> F(x)[+A(x - 1)]\n", n) +
        "endlsystem\n", ("check",), "a.l")),
    "cpfg: macros": (300, grammar(
        lambda n: lines("#define M%d %d\n", n) + "Lsystem: 1\nderivation length: 1\nAxiom: A(M0)\n" +
        lines("A(x) : x == M%d --> F\n", n) + "endlsystem\n", ("check",), "a.l")),
    "fractint: systems": (200, grammar(
        lambda n: lines("S%d {\n  Angle 6\n  Axiom F--F\n  F=F+F\n}\n", n), ("check", "--system", "S0"), "a.l")),
    "fractint: successor": (2000, grammar(
        lambda n: "S {\n  Angle 6\n  Axiom F--F\n  F=" + "F+F-" * n + "\n}\n", ("check",), "a.l")),
    "houdini: productions": (300, grammar(
        lambda n: "Generations: 1\nA(1)\n" + lines("A(x):x==%d=F(x)[+A(x-1)]\n", n), ("check",), "a.hlsys")),
    "l3d: rules": (300, grammar(
        lambda n: "6 24 6\nA\n" + "".join(f"{chr(65 + i % 26)}=f[+A]f{'f' * (i % 5)}\n" for i in range(n)) + "@\n",
        ("check",), "a.l3d")),
    "l3d: successor": (2000, grammar(lambda n: "6 24 6\nA\nA=" + "f[+A]" * n + "\n@\n", ("check",), "a.l3d")),
    "lparser: successor": (2000, grammar(lambda n: "4\n24\n9\nA\nA=" + "F[+A]" * n + "\n@\n", ("check",), "a.ls")),
    "lpy: productions": (300, grammar(
        lambda n: "module A(x)\nAxiom: A(1)\nderivation length: 1\nproduction:\n" +
        lines("A(x) : x == %d --> F(x)[+A(x - 1)]\n", n) + "endlsystem\n", ("check",), "a.lpy")),
    "sys: successor": (2000, grammar(lambda n: "LSYSTEM\n1\nF\nF " + "F[>F]" * n + " 1\n", ("check",), "a.sys")),
    **{f"import {name.split('.')[-1]}": (300, grammar(text, ("import",), name)) for name, text in {
        "a.l": lambda n: "Lsystem: 1\nderivation length: 1\nAxiom: A(1)\n" + lines("A(x) : x == %d --> F(x)\n", n) + "endlsystem\n",
        "a.hlsys": lambda n: "Generations: 1\nA(1)\n" + lines("A(x):x==%d=F(x)[+A(x-1)]\n", n),
        "a.lpy": lambda n: "module A(x)\nAxiom: A(1)\nderivation length: 1\nproduction:\n" +
        lines("A(x) : x == %d --> F(x)\n", n) + "endlsystem\n",
    }.items()},
}


class Refused(Exception):
    """A case that says nothing about the growth."""


def instructions(lsc, files, arguments):
    """The instructions of a command, the first time that it reads its files."""
    with tempfile.TemporaryDirectory() as folder:
        for name, text in files.items():
            with open(os.path.join(folder, name), "w", encoding="utf-8") as file:
                file.write(text)
        threads = [] if arguments[0] in ("check", "fmt", "compile", "import", "stats", "trace") else ["--threads", "1"]
        run = subprocess.run(
            ["valgrind", "--tool=cachegrind", "--cache-sim=no", "--cachegrind-out-file=/dev/null", "--log-file=log",
             lsc, *arguments, *threads], cwd=folder, capture_output=True, text=True, check=False)
        if run.returncode != 0 and not (run.returncode == 1 and arguments[0] == "check"):
            raise Refused(f"exit status {run.returncode}: {run.stderr[-500:]}")
        with open(os.path.join(folder, "log"), encoding="utf-8", errors="replace") as log:
            return int(re.search(r"I\s+refs:\s+([\d,]+)", log.read()).group(1).replace(",", ""))


def growth(lsc, size, make):
    """How many times the instructions of the pieces from 2n to 4n are those from n to 2n, and the counts."""
    for _ in range(6):
        counts = [instructions(lsc, *make(n)) for n in (size, 2 * size, 4 * size)]
        if counts[2] > MOST:
            raise Refused(f"{counts[2]} instructions for {4 * size} pieces")
        if counts[1] - counts[0] >= LEAST:
            return (counts[2] - counts[1]) / (counts[1] - counts[0]), size, counts
        size *= 4
    raise Refused(f"{counts[2] - counts[0]} instructions for {size} pieces")


def main():
    parser = argparse.ArgumentParser(usage=__doc__)
    parser.add_argument("lsc")
    parser.add_argument("--list", action="store_true")
    parser.add_argument("--part", default="0/1")
    parser.add_argument("cases", nargs="*")
    options = parser.parse_args()
    part, parts = map(int, options.part.split("/"))
    names = [name for name in CASES if not options.cases or name in options.cases][part::parts]
    lsc = os.path.abspath(options.lsc)
    failed = 0
    for name in names:
        if options.list:
            print(name)
            continue
        try:
            ratio, size, counts = growth(lsc, *CASES[name])
            bad = ratio > LIMIT
            print(f"{'FAILED' if bad else 'passed':7} {ratio:5.2f}  {name}: {size} pieces {counts[0]:,}, "
                  f"{2 * size} {counts[1]:,}, {4 * size} {counts[2]:,} instructions", flush=True)
        except Refused as reason:
            bad = True
            print(f"FAILED        {name}: {reason}", flush=True)
        failed += bad
    sys.exit(f"{failed} cases failed" if failed else 0)


main()
