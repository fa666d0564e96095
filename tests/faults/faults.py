# SPDX-License-Identifier: MIT
"""Lets single calls of the C library fail while `lsc` runs, and checks what remains.

Each command runs once without a fault, to count its calls and to keep its results. Then it runs once for each chosen
fault: an allocation, open(), read(), write(), rename(), mmap(), fsync(), close(), fstat(), fchmod() or
pthread_create() fails once (failing_calls.cpp). After each run:
- the program ended by itself, with its usual exit status or, with a message, with 2 or 3 (3 where memory ran out);
- with the usual status all output has the usual bytes, else all files are as before, or all are complete;
- no temporary file remains.
A command that was killed by SIGKILL may leave temporary files; the same command, run again, removes them.
Another run records in which order files are written, stored (fsync, syncfs) and renamed. If the power fails, a file may have
its new name and lack what was not stored before, so each file must be stored between its last write and its rename,
and no file may be written under its own name.
Usage: faults.py LSC LIBRARY [--every N] [--seed S] [--kills K] [COMMAND...]
  --every N   inject every Nth fault of each command, beginning with a random one (default 40); 1 is all of them
  --kills K   also end each command that writes by SIGKILL at K random moments (default 4)
"""

import argparse
import errno
import os
import random
import re
import shutil
import signal
import struct
import subprocess
import sys
import tempfile
import time
from concurrent.futures import ThreadPoolExecutor

CALLS = ["malloc", "open", "read", "write", "rename", "mmap", "fsync", "close", "fstat", "fchmod", "thread"]
# The errors with which each call may fail, and "short" for a transfer of one byte.
ERRORS = {
    "malloc": [errno.ENOMEM],
    "open": [errno.EACCES, errno.EMFILE, errno.ENFILE, errno.EIO, errno.ENOMEM],
    "read": [errno.EIO, errno.EINTR, "short"],
    "write": [errno.ENOSPC, errno.EIO, errno.EDQUOT, errno.EFBIG, errno.EINTR, "short"],
    "rename": [errno.EACCES, errno.ENOSPC, errno.EIO, errno.EROFS],
    "mmap": [errno.ENOMEM],
    "fsync": [errno.EIO, errno.ENOSPC],
    "close": [errno.EIO],
    "fstat": [errno.EIO],
    "fchmod": [errno.EPERM],
    "thread": [errno.EAGAIN],
}
MOST_ALLOCATIONS = 8000  # of each command, from its first one
TIME_LIMIT = 120.0  # seconds; a run takes less than one
FAILED = {2, 3}  # exit statuses of a command that reports a fault
NO_MEMORY = b"cannot allocate memory"  # the text of ENOMEM, where a function of the C library needs memory
TEMPORARY = re.compile(r"\.lsys-[a-z0-9]+\.tmp$")  # end of the name of a temporary file; before it, the file's name

TREE = """#n = 6;
#param ratio 0.8 {0.5, 1};
#w : '(0.1) A(1);
#p1 : A(s) : * : F(s) [+(25) A(s * ratio)] [-({20, 30}) A(s * ratio)] / (137.5) F(s / 2);
"""
BROKEN = "#n = 2;\n#w : F;\n#p1  F : * : F F;\n"
UGLY = "#n=2;\n#w:F;\n#p1:F:*:F F;\n"
SENSING = """#n = 3;
#sense light shadow cell 0.5 levels 3;
#w : '(0.1) A(1) ?light(0, 0, 0, 0);
#p1 : A(s) > ?light(e, x, y, z) : * : F(s) [+(25) A(s) ?light(0, 0, 0, 0)] A(s) ?light(0, 0, 0, 0);
"""
SCENE = """key = 1
[terrain]
kind = "noise"
size = 40
height = 2
[placement]
count = 30
[[species]]
name = "tree"
grammar = "tree.lsys"
"""


class Command:
    """A command line of lsc and the files it needs. `is_set`: its files appear together, or none of them. `removed`: names
    of files that a run removes first and writes last."""

    def __init__(self, name, arguments, files, is_set=True, removed=()):
        self.name = name
        self.arguments = arguments
        self.files = files
        self.is_set = is_set
        self.removed = removed


def commands():
    tree = {"tree.lsys": TREE}
    scene = {"tree.lsys": TREE, "scene.toml": SCENE}
    listed = [
        Command("check", ["check", "tree.lsys"], tree),
        Command("fix", ["check", "--fix", "broken.lsys"], {"broken.lsys": BROKEN}),
        Command("fmt", ["fmt", "ugly.lsys"], {"ugly.lsys": UGLY}),
        Command("compile", ["compile", "tree.lsys", "-o", "tree.lsb"], tree),
        Command("word", ["dump", "tree.lsys"], tree),
        Command("word-file", ["dump", "tree.lsys", "-o", "word"], tree),
        Command("threads", ["dump", "tree.lsys", "-n", "9", "--threads", "3", "-o", "word"], tree),
        Command("stream", ["dump", "tree.lsys", "--stream", "-o", "word"], tree),
        Command("state", ["dump", "tree.lsys", "--steps", "3", "--save-state", "state", "-o", "word"], tree,
                is_set=False),
        Command("sense", ["dump", "sensing.lsys"], {"sensing.lsys": SENSING}),
        Command("stats", ["stats", "tree.lsys"], tree),
        Command("trace", ["trace", "tree.lsys", "-n", "3", "--all", "A"], tree),
        Command("import", ["import", "curve.l", "-o", "curve.lsys"],
                {"curve.l": "Koch { Angle 6\nAxiom F--F--F\nF=F+F--F+F\n}\n"}),
        Command("forest", ["forest", "tree.lsys", "--count", "20", "-o", "forest.glb"], tree),
        Command("forest-usd", ["forest", "tree.lsys", "--count", "20", "-o", "forest.usda"], tree),
        Command("scene", ["forest", "scene.toml", "-o", "scene.glb"], scene),
        Command("tiles", ["tiles", "scene.toml", "--count", "3", "--force", "-o", "tiles"], scene, is_set=False,
                removed=("tiles/tileset.digest",)),
        Command("frames",
                ["export", "tree.lsys", "-n", "2", "-o", "tree.ply", "--frames", "2", "--wind", "5,0,0"], tree,
                is_set=False),
        Command("place", ["place", "scene.toml", "-o", "trees.placed"], scene),
    ]
    for extension in ("obj", "glb", "gltf", "ply", "stl", "svg", "usda"):
        arguments = ["export", "tree.lsys", "-n", "4", "-o", f"tree.{extension}"]
        listed.append(Command(f"export-{extension}", arguments, tree))
    return listed


class Outcome:
    """The exit status of a run or "hang", its output, and the files in its folder by name."""

    def __init__(self, status, out, err, files):
        self.status = status
        self.out = out
        self.err = err
        self.files = files


def files_in(folder):
    found = {}
    for path, _, names in os.walk(folder):
        for name in names:
            whole = os.path.join(path, name)
            with open(whole, "rb") as file:
                found[os.path.relpath(whole, folder)] = file.read()
    return found


class Bench:
    """Runs commands in folders of their own, with the library of failing_calls.cpp."""

    def __init__(self, lsc, library):
        self.lsc = lsc
        self.library = library
        self.root = tempfile.mkdtemp(prefix="faults-")

    def prepare(self, command, old):
        """A new folder with the input of the command, and with files of other content under the names of its output."""
        folder = tempfile.mkdtemp(dir=self.root)
        for name in old:
            os.makedirs(os.path.dirname(os.path.join(folder, name)), exist_ok=True)
            with open(os.path.join(folder, name), "wb") as file:
                file.write(b"old " + name.encode())
        for name, text in command.files.items():
            with open(os.path.join(folder, name), "w", encoding="utf-8") as file:
                file.write(text)
        return folder

    def start(self, command, folder, fault, counts, order=""):
        """Starts a command. `fault`: `call:number:error`; `counts`, `order`: files for numbers and order of calls."""
        environment = {"PATH": os.environ["PATH"], "LD_PRELOAD": self.library}
        if fault:
            environment["LSYS_FAULT"] = fault
        if counts:
            environment["LSYS_FAULT_COUNTS"] = counts
        if order:
            environment["LSYS_FAULT_ORDER"] = order
        return subprocess.Popen([self.lsc, *command.arguments], cwd=folder, env=environment, stdin=subprocess.DEVNULL,
                                stdout=subprocess.PIPE, stderr=subprocess.PIPE)

    def run(self, command, old=(), fault="", counts="", order=""):
        """Returns the files before a run, and its outcome. Arguments: as in prepare() and start()."""
        folder = self.prepare(command, old)
        before = files_in(folder)
        process = self.start(command, folder, fault, counts, order)
        try:
            out, err = process.communicate(timeout=TIME_LIMIT)
            status = process.returncode
        except subprocess.TimeoutExpired:
            process.kill()
            out, err = process.communicate()
            status = "hang"
        outcome = Outcome(status, out, err, files_in(folder))
        shutil.rmtree(folder)
        return before, outcome

    def count(self, command, old):
        """The numbers of calls, by name, and the outcome without a fault."""
        with tempfile.NamedTemporaryFile(dir=self.root) as file:
            file.write(bytes(8 * len(CALLS)))
            file.flush()
            _, outcome = self.run(command, old, counts=file.name)
            with open(file.name, "rb") as read:
                numbers = struct.unpack(f"{len(CALLS)}Q", read.read(8 * len(CALLS)))
        return dict(zip(CALLS, numbers)), outcome

    def order(self, command, old):
        """The calls that write, store and rename files: name of the call, and base names of the files."""
        with tempfile.NamedTemporaryFile(dir=self.root) as file:
            self.run(command, old, order=file.name)
            with open(file.name, encoding="utf-8") as read:
                fields = [line.rstrip("\n").split("\t") for line in read]
        return [(call, os.path.basename(path), os.path.basename(second)) for call, path, second in fields]

    def kill(self, command, old, seconds):
        """The files before a run that SIGKILL ends after `seconds`, its outcome, and the files after a rerun."""
        folder = self.prepare(command, old)
        before = files_in(folder)
        process = self.start(command, folder, "", "")
        time.sleep(seconds)
        process.send_signal(signal.SIGKILL)
        out, err = process.communicate()
        outcome = Outcome(process.returncode, out, err, files_in(folder))
        for name, text in command.files.items():  # a command may have replaced its input
            with open(os.path.join(folder, name), "w", encoding="utf-8") as file:
                file.write(text)
        self.start(command, folder, "", "").communicate()
        after = files_in(folder)
        shutil.rmtree(folder)
        return before, outcome, after


def mistakes_after_fault(command, call, usual, before, outcome):
    """What is wrong with a run in which `call` failed: a list of sentences."""
    wrong = []
    if outcome.status == "hang":
        return ["did not end"]
    if outcome.status == usual.status:
        if outcome.out != usual.out:
            wrong.append("the usual exit status, but other text on standard output")
        if outcome.files != usual.files:
            wrong.append(f"the usual exit status, but other files: {difference(usual.files, outcome.files)}")
    elif outcome.status in FAILED:
        if command.is_set and outcome.files not in (before, usual.files):
            wrong.append(f"exit status {outcome.status}, but files changed: {difference(before, outcome.files)}")
        if not command.is_set:
            wrong += incomplete_files(command, usual, before, outcome)
        if not outcome.err and call != "write":
            wrong.append(f"exit status {outcome.status} without a message")
        if call == "malloc" and outcome.status != 3 and NO_MEMORY not in outcome.err:
            wrong.append(f"exit status {outcome.status} where memory ran out: {first_line(outcome.err)}")
    else:
        wrong.append(f"exit status {outcome.status}: {first_line(outcome.err)}")
    return wrong


def incomplete_files(command, usual, before, outcome, may_remain=lambda name: False):
    """What is wrong: files neither as before nor as usual; other files, except those for which may_remain() is true."""
    wrong = []
    for name in outcome.files.keys() | before.keys():
        content = outcome.files.get(name)
        if name in before or name in usual.files:
            is_removed = content is None and name in command.removed
            if not is_removed and content not in (before.get(name), usual.files.get(name)):
                wrong.append(f"`{name}` is neither as before nor complete")
        elif not may_remain(name):
            wrong.append(f"`{name}` remains")
    return wrong


def mistakes_of_order(calls, files):
    """What may be lost where the power fails: a list of sentences. `files`: names of the files that the command writes."""
    wrong = []
    written, stored = set(), set()
    for call, name, new_name in calls:
        if call == "write":
            written.add(name)
            stored.discard(name)
            if name in files:
                wrong.append(f"`{name}` is written under its own name")
        elif call == "fsync":
            stored.add(name)
        elif call == "syncfs":
            stored |= written
        elif call == "rename" and (name not in written or name not in stored):
            wrong.append(f"`{name}` becomes `{new_name}`, but its last writes are not stored")
    missing = files - {new_name for call, _, new_name in calls if call == "rename"}
    return wrong + [f"`{name}` is not renamed from a temporary file" for name in sorted(missing)]


def is_temporary(name, files):
    """Whether `name` is that of a temporary file of one of `files`."""
    return TEMPORARY.search(name) is not None and TEMPORARY.sub("", name) in files


def difference(expected, found):
    """Names of the files that are missing, new or different."""
    changed = [name for name in sorted(expected.keys() | found.keys()) if expected.get(name) != found.get(name)]
    return ", ".join(changed)


def first_line(text):
    lines = text.decode(errors="replace").splitlines()
    return lines[0][:200] if lines else "no message"


def faults_of(counts, every, generator):
    """The faults to inject: `call:number:error`."""
    listed = []
    for call in CALLS:
        for number in range(1, min(counts[call], MOST_ALLOCATIONS) + 1):
            listed += [(call, f"{call}:{number}:{error}") for error in ERRORS[call]]
    return listed[generator.randrange(every)::every]


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("lsc")
    parser.add_argument("library")
    parser.add_argument("--every", type=int, default=40)
    parser.add_argument("--kills", type=int, default=4)
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("names", nargs="*")
    options = parser.parse_intermixed_args()  # COMMAND may stand behind options
    bench = Bench(os.path.abspath(options.lsc), os.path.abspath(options.library))
    generator = random.Random(options.seed)
    injected = dict.fromkeys([*CALLS, "kill"], 0)
    failures = 0
    left = 0  # temporary files of killed commands
    try:
        with ThreadPoolExecutor(os.cpu_count()) as pool:
            for command in commands():
                if options.names and command.name not in options.names:
                    continue
                _, first = bench.run(command)
                old = [name for name in first.files if name not in command.files]
                writes = old or first.files != {name: text.encode() for name, text in command.files.items()}
                counts, usual = bench.count(command, old)
                if usual.status != 0:
                    print(f"{command.name}: fails without a fault: {first_line(usual.err)}")
                    failures += 1
                    continue
                faults = faults_of(counts, options.every, generator)
                runs = pool.map(lambda fault: (fault, bench.run(command, old, fault[1])), faults)
                for (call, fault), (before, outcome) in runs:
                    injected[call] += 1
                    for mistake in mistakes_after_fault(command, call, usual, before, outcome):
                        print(f"{command.name}: LSYS_FAULT={fault}: {mistake}")
                        failures += 1
                if writes:
                    new = {name for name, content in usual.files.items()
                           if name in old or command.files[name].encode() != content}
                    for mistake in mistakes_of_order(bench.order(command, old), {os.path.basename(name) for name in new}):
                        print(f"{command.name}: {mistake}")
                        failures += 1
                    begin = time.monotonic()
                    bench.run(command, old)
                    length = time.monotonic() - begin
                    for _ in range(options.kills):
                        before, outcome, after = bench.kill(command, old, generator.uniform(0, length))
                        injected["kill"] += 1
                        may_remain = lambda name: is_temporary(name, usual.files)
                        for mistake in incomplete_files(command, usual, before, outcome, may_remain):
                            print(f"{command.name}: killed: {mistake}")
                            failures += 1
                        left += sum(is_temporary(name, usual.files) for name in outcome.files)
                        if after != usual.files:
                            print(f"{command.name}: run again after it was killed: "
                                  f"{difference(usual.files, after)}")
                            failures += 1
    finally:
        shutil.rmtree(bench.root, ignore_errors=True)
    print("injected: " + ", ".join(f"{name} {count}" for name, count in injected.items()) +
          f"; temporary files left by kills: {left}; failures: {failures}")
    return 1 if failures or not sum(injected.values()) else 0


if __name__ == "__main__":
    sys.exit(main())
