# SPDX-License-Identifier: MIT
"""Compares words and errors of random grammars between `lsc`, the Python module and the WebAssembly module.

Usage: compare_programs.py LSC TARGET --count N [--seed S] [--web]
  LSC      build/release/lsc; the Python module is on PYTHONPATH
  TARGET   build/release/tests/fuzz/fuzz_differences, which makes the random grammars
  --count  number of grammars that must derive a word (default 10000); about four times as many have an error
  --web    compare with web/lsys (made by scripts/web) instead of the Python module

Each grammar is derived for 4 generations with at most MAX_MODULES modules. The words must be equal, or both programs must
refuse the grammar with the same codes of errors, or both must reach the limit. Exit status 1 if any differs; the grammar
is kept in build/differing-grammars.
"""

import argparse
import concurrent.futures
import glob
import json
import os
import shutil
import subprocess
import sys
import tempfile
import warnings

ROOT = os.path.abspath(os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", ".."))
MAX_MODULES = 20000
BATCH = 5000  # random grammars at a time


def seeds():
    """Small grammars that are changed at random."""
    for pattern in ("samples/*/*.lsys", "tests/ui/*/*.lsys"):
        for path in sorted(glob.glob(os.path.join(ROOT, pattern))):
            if os.path.isfile(path) and os.path.getsize(path) < 4000:
                yield path


def result_of_lsc(program, path):
    """("word", text), ("errors", sorted codes) or ("limit",)."""
    run = subprocess.run(
        [program, "dump", "-q", "-n", "4", "--seed", "7", "--max-modules", str(MAX_MODULES), "--untrusted",
         "--message-format", "json", path], capture_output=True, stdin=subprocess.DEVNULL, check=False)
    if run.returncode == 0:
        return ("word", run.stdout.decode(errors="surrogateescape")[:-1])
    if run.returncode == 3:
        return ("limit",)
    codes = [json.loads(line) for line in run.stderr.decode(errors="replace").splitlines() if line.startswith("{")]
    return ("errors", sorted(each.get("code") or "" for each in codes if each.get("severity") == "error"))


def result_of_module(path):
    """The same from the Python module."""
    import lsys
    try:
        grammar = lsys.compile(path, untrusted=True)
        return ("word", str(grammar.derive(4, 7, max_modules=MAX_MODULES)))
    except lsys.LimitError:
        return ("limit",)
    except lsys.GrammarError as error:
        return ("errors", sorted(each.code or "" for each in error.diagnostics if each.severity == "error"))
    except lsys.LsysError:  # a file
        return ("errors", [""])


def results_of_web(paths):
    """The same from the WebAssembly module, which one process of Node.js runs."""
    script = os.path.join(ROOT, "web", "test", "results.mjs")
    run = subprocess.run(["node", script, str(MAX_MODULES)], input="\n".join(paths).encode(), stdout=subprocess.PIPE,
                         check=True)
    return [tuple(json.loads(line)) for line in run.stdout.decode().splitlines()]


def are_equal(wanted, found):
    """Whether two results are equal. An environment without an answer may hide a limit, or be hidden by it."""
    return wanted == found or (wanted == ("errors", ["sense-failed"]) and found == ("limit",))


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("lsc", type=os.path.abspath)
    parser.add_argument("target", type=os.path.abspath)
    parser.add_argument("--count", type=int, default=10000)
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--web", action="store_true")
    options = parser.parse_args()
    warnings.simplefilter("ignore")  # warnings of grammars
    kept = os.path.join(ROOT, "build", "differing-grammars")
    counts = {"word": 0, "errors": 0, "limit": 0}
    different = 0
    seed = options.seed
    while counts["word"] < options.count:
        with tempfile.TemporaryDirectory() as folder:
            subprocess.run([options.target, "--write", folder, "--count", str(BATCH), "--seed", str(seed), *seeds()],
                           check=True)
            paths = [os.path.join(folder, f"{i}.lsys") for i in range(BATCH)]
            with concurrent.futures.ThreadPoolExecutor(os.cpu_count()) as pool:
                expected = list(pool.map(lambda path: result_of_lsc(options.lsc, path), paths))
            found = results_of_web(paths) if options.web else map(result_of_module, paths)
            for path, wanted, result in zip(paths, expected, found):
                counts[wanted[0]] += 1
                if not are_equal(wanted, result):
                    different += 1
                    os.makedirs(kept, exist_ok=True)
                    name = f"{seed}-{os.path.basename(path)}"
                    shutil.copy(path, os.path.join(kept, name))
                    print(f"{name}: lsc {str(wanted)[:200]}, the module {str(result)[:200]}", flush=True)
        seed += 1
    print(f"{counts['word']} words, {counts['errors']} grammars with errors, {counts['limit']} limits; "
          f"{different} differ")
    sys.exit(1 if different else 0)


main()
