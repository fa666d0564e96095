# SPDX-License-Identifier: MIT
"""Lets single calls of the C library fail while the Python module works, and checks what the calls of the module do.

Each work runs once without a fault, to count its calls of the C library. Then it runs once for each chosen fault, all in
one process. Each run returns the usual result, or raises one of EXPECTED; it leaves no file that is incomplete, and
no temporary file. After all faults the work has its usual result again.
Usage: python_faults.py MODULE LIBRARY [--every N] [WORK...]     MODULE: the folder of the package `lsys`
  --every N   inject every Nth fault of each work (default 7); 1 is all of them
"""

import argparse
import ctypes
import errno
import gc
import os
import signal
import subprocess
import sys
import tempfile

ERRORS = {
    "malloc": [errno.ENOMEM],
    "mmap": [errno.ENOMEM],
    "open": [errno.EACCES, errno.EMFILE],
    "read": [errno.EIO, errno.EINTR],
    "write": [errno.ENOSPC, errno.EINTR],
    "rename": [errno.EACCES],
    "fsync": [errno.EIO],
    "close": [errno.EIO],
    "fstat": [errno.EIO],
    "thread": [errno.EAGAIN],
}
# Beginnings of the texts of other exceptions, by which others report a lack of memory: SystemError of compile() of
# CPython 3.11, which numpy calls for types such as "(3,)f4"; RuntimeError of pybind11.
OF_OTHERS = ("error return without exception set", "Could not allocate ")
MOST_CALLS = 3000  # of each kind in a work, from its first one

TREE = ("#n = 4; #param ratio 0.6 {0, 1}; #set angle 25; #w : !(0.3) F(3 * ratio) X;\n"
        "#p : X : * : !(0.08) F({0.5, 0.8}) [ + X ] /(120) [ & X ];\n")


def works(lsys):
    """The works by name: functions without parameters that return comparable values, or a function that makes one
    without faults."""
    grammar = lsys.compile(text=TREE)
    plant = grammar.grow()
    mesh = plant.mesh()
    scratch = os.getcwd()

    def read():
        return str(lsys.compile("tree.lsys").derive(2))

    def mistake():
        try:
            lsys.compile(text="#n = 1;\n#w : F(lengt;\n")
        except lsys.GrammarError as error:
            return str(error)
        return "no mistake is reported"

    def save(name, **options):
        paths = plant.save(name, **options)
        return lambda: {os.path.basename(path): bytes_of(path) for path in paths}

    def forest():
        made = lsys.Forest("tree.lsys", count=20, heroes=2)
        return made.instances.array.tobytes()

    return scratch, {
        "compile": lambda: lsys.compile(text=TREE).generations,
        "read": read,
        "mistake": mistake,
        "derive": lambda: str(grammar.derive(5)),
        "threads": lambda: len(grammar.derive(12, threads=2)),
        "grow": lambda: plant.segments.tobytes() == grammar.grow().segments.tobytes(),
        "mesh": lambda: plant.mesh().positions.tobytes() == mesh.positions.tobytes(),
        "svg": lambda: plant.svg(),
        "save-glb": lambda: save("tree.glb"),
        "save-obj": lambda: save("tree.obj"),
        "save-levels": lambda: save("levels.glb", lods=2),
        "forest": forest,
    }


def bytes_of(path):
    with open(path, "rb") as file:
        return file.read()


def files_in(folder):
    return {name: bytes_of(os.path.join(folder, name)) for name in sorted(os.listdir(folder))}


def value_of(result):
    return result() if callable(result) else result


def inject(options):
    """Runs in a process that has loaded the library. Prints each mistake; returns their number."""
    library = ctypes.CDLL(options.library)
    library.lsys_count_calls.restype = ctypes.c_uint64
    sys.path.insert(0, options.module)
    import lsys  # after the library has been loaded

    expected = (MemoryError, OSError, lsys.LsysError)
    scratch, listed = works(lsys)
    injected = dict.fromkeys(ERRORS, 0)
    raised = {}
    failures = 0
    for name, work in listed.items():
        if options.names and name not in options.names:
            continue
        usual = value_of(work())
        before = files_in(scratch)
        library.lsys_set_fault(None)
        work()
        counts = {call: library.lsys_count_calls(call.encode()) for call in ERRORS}
        faults = [f"{call}:{number}:{error}" for call, errors in ERRORS.items()
                  for number in range(1, min(counts[call], MOST_CALLS) + 1) for error in errors]
        for fault in faults[::options.every]:
            print(f"{name} {fault}", file=options.log, flush=True)
            text = fault.encode()
            mistake = None
            gc.collect()
            library.lsys_set_fault(text)
            try:
                result = work()
                library.lsys_set_fault(None)
                if value_of(result) != usual:
                    mistake = "the result is another one"
            except expected as error:
                library.lsys_set_fault(None)
                raised[type(error).__name__] = raised.get(type(error).__name__, 0) + 1
            except BaseException as error:  # every other exception is a mistake
                library.lsys_set_fault(None)
                if not str(error).startswith(OF_OTHERS):
                    mistake = f"raises {type(error).__name__}: {error}"
            injected[fault.split(":")[0]] += 1
            if mistake is None and files_in(scratch) != before:
                mistake = "files have changed"
            if mistake is not None:
                print(f"{name}: {fault}: {mistake}", flush=True)
                failures += 1
        if value_of(work()) != usual:
            print(f"{name}: after the faults the result is another one")
            failures += 1
    print("injected: " + ", ".join(f"{call} {count}" for call, count in injected.items()) + "; raised: " +
          ", ".join(f"{name} {count}" for name, count in sorted(raised.items())) + f"; failures: {failures}")
    return int(failures != 0 or not sum(injected.values()))


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("module")
    parser.add_argument("library")
    parser.add_argument("--every", type=int, default=7)
    parser.add_argument("--log", type=argparse.FileType("w"), help="of the process that injects faults")
    parser.add_argument("names", nargs="*")
    options = parser.parse_intermixed_args()  # WORK may stand behind options
    options.module, options.library = os.path.abspath(options.module), os.path.abspath(options.library)
    if options.log is not None:
        return inject(options)
    with tempfile.TemporaryDirectory(prefix="faults-") as folder, tempfile.NamedTemporaryFile("r") as log:
        with open(os.path.join(folder, "tree.lsys"), "w", encoding="utf-8") as file:
            file.write(TREE)
        run = subprocess.run([sys.executable, os.path.abspath(__file__), options.module, options.library, "--every",
                              str(options.every), "--log", log.name, *options.names], cwd=folder,
                             env=dict(os.environ, LD_PRELOAD=options.library, PYTHONDONTWRITEBYTECODE="1"))
        if run.returncode not in (0, 1):
            last = log.read().splitlines()[-1:]
            ended = signal.Signals(-run.returncode).name if run.returncode < 0 else f"status {run.returncode}"
            print(f"{' '.join(last)}: the process ended: {ended}")
            return 1
        return run.returncode


if __name__ == "__main__":
    sys.exit(main())
