# SPDX-License-Identifier: MIT
"""Long runs of one process: memory, threads and open handles stay flat after a warm-up.

Three runs, each of a process that never ends in practice:
  python   derivations, plants and mistakes in one Python process
  serve    requests to `lsc serve` over connections that stay open; its cache is smaller than the tiles
  lsview   edits of the grammar that a window shows, on a virtual display (Xvfb); every tenth has a mistake
The first tenth of the steps is the warm-up. Then resident memory (VmRSS), threads and open handles are sampled a
hundred times. A run fails if the mean memory of the last quarter of the samples exceeds that of the first quarter by
more than MOST_GROWTH, or if more threads or handles are open at the end than at any time in the first quarter.

Usage: long_runs.py BUILD [--steps N] [RUN...]     BUILD: a build folder with lsc, lsview and python/
  --steps N   steps of each run (default 100,000 derivations, 100,000 requests, 3,000 edits)
"""

import argparse
import http.client
import json
import os
import pathlib
import posixpath
import random
import re
import signal
import subprocess
import sys
import tempfile
import time

STEPS = {"python": 100_000, "serve": 100_000, "lsview": 3_000}
SAMPLES = 100
MOST_GROWTH = 4 << 20  # bytes of resident memory between the first and the last quarter of the samples
PATIENCE = 120  # seconds for one answer or one loading

TREE = ("#n = 4; #param ratio 0.6 {0, 1}; #set angle 25; #w : !(0.3) F(3 * ratio) X;\n"
        "#p : X : * : !(0.08) F({0.5, 0.8}) [ + X ] /(120) [ & X ] /(120) [ ^ X ];\n")
MISTAKE = "#n = 1;\n#w : F(lengt;\n"


class Failure(Exception):
    pass


class Usage:
    """Memory, threads and handles of a process, sampled during a run."""

    def __init__(self, name, process, steps):
        self.name = name
        self.folder = pathlib.Path(f"/proc/{process}")
        self.warm_up = steps // 10
        self.interval = max((steps - self.warm_up) // SAMPLES, 1)
        self.memory, self.threads, self.handles = [], [], []
        self.begin = time.monotonic()

    def after_step(self, step):
        """Call after each step, counted from 1."""
        if step <= self.warm_up or (step - self.warm_up) % self.interval != 0:
            return
        status = (self.folder / "status").read_text(encoding="ascii", errors="replace")
        self.memory.append(int(re.search(r"VmRSS:\s+(\d+) kB", status).group(1)) << 10)
        self.threads.append(int(re.search(r"Threads:\s+(\d+)", status).group(1)))
        self.handles.append(len(os.listdir(self.folder / "fd")))

    def finish(self, steps):
        """Prints the figures; returns whether they are flat."""
        quarter = max(len(self.memory) // 4, 1)
        first = sum(self.memory[:quarter]) / quarter
        last = sum(self.memory[-quarter:]) / quarter
        mistakes = []
        if last - first > MOST_GROWTH:
            mistakes.append("memory grows")
        if self.threads[-1] > max(self.threads[:quarter]):
            mistakes.append("threads remain")
        if self.handles[-1] > max(self.handles[:quarter]):
            mistakes.append("handles remain open")
        print(f"{self.name}: {steps:,} steps in {time.monotonic() - self.begin:.0f} s, memory {first / (1 << 20):.1f} to "
              f"{last / (1 << 20):.1f} MiB (max {max(self.memory) / (1 << 20):.1f}), {self.threads[-1]} threads, "
              f"{self.handles[-1]} handles: {', '.join(mistakes) or 'flat'}", flush=True)
        return not mistakes


def run_python(build, folder, steps):
    """Derivations in this process."""
    del folder
    sys.path.insert(0, str(build / "python"))
    import lsys  # the module of the build folder

    grammar = lsys.compile(text=TREE)
    usage = Usage("python", os.getpid(), steps)
    length = None
    for step in range(1, steps + 1):
        word = grammar.derive(4, seed=step)
        length = length or len(word)
        if len(word) != length:  # each seed draws other lengths of segments only
            raise Failure(f"derivation {step} has {len(word)} modules, not {length}")
        if step % 50 == 0:
            grammar = lsys.compile(text=TREE, defines={"ratio": step % 100 / 100})
            grammar.grow(3, seed=step).mesh()
            try:
                lsys.compile(text=MISTAKE)
            except lsys.GrammarError:
                pass
            else:
                raise Failure("a mistake is not reported")
        usage.after_step(step)
    return usage.finish(steps)


def ask(connection, path):
    """The status of the answer; None if the server has closed the connection, which it does after 10 s without use."""
    try:
        connection.request("GET", path)
        answer = connection.getresponse()
        answer.read()
        return answer.status
    except (http.client.RemoteDisconnected, ConnectionError):
        connection.close()  # the next request opens it again
        return None


def tiles_of(connection, most):
    """Paths of tiles, by the tilesets that name them."""
    found, left = [], ["tileset.json"]
    while left and len(found) < most:
        path = left.pop(0)
        connection.request("GET", f"/{path}")
        nodes = [json.loads(connection.getresponse().read())["root"]]
        while nodes:
            node = nodes.pop()
            nodes += node.get("children", [])
            name = posixpath.normpath(posixpath.join(posixpath.dirname(path), node.get("content", {}).get("uri", "")))
            if name.endswith(".json"):
                left.append(name)
            elif name.endswith(".glb"):
                found.append(f"/{name}")
    return found[:most]


def run_serve(build, folder, steps):
    """Requests over four connections; each makes 1,000 requests before the next one replaces it."""
    (folder / "tree.lsys").write_text(TREE)
    with subprocess.Popen([build / "lsc", "serve", folder / "tree.lsys", "--placement", "jittered", "--spacing", "10",
                           "--size", "2000", "--heroes", "2", "--triangles", "20000", "--error", "0", "--cache", "1M",
                           "--listen", "0"], stdout=subprocess.PIPE, text=True) as server:
        try:
            line = server.stdout.readline()
            match = re.match(r"serving http://127\.0\.0\.1:(\d+)/tileset\.json", line)
            if not match:
                raise Failure(f"the server did not start: {line!r}")
            connect = lambda: http.client.HTTPConnection("127.0.0.1", int(match.group(1)), timeout=PATIENCE)
            connections = [connect() for _ in range(4)]
            tiles = tiles_of(connections[0], 500)
            generator = random.Random(1)
            usage = Usage("serve", server.pid, steps)
            found, closed = 0, 0
            for step in range(1, steps + 1):
                number = step % len(connections)
                if step % 1000 < len(connections):
                    connections[number].close()
                    connections[number] = connect()
                path = generator.choice(["/tileset.json", "/none", *([generator.choice(tiles)] * 6)])
                status = ask(connections[number], path)
                if status is None:
                    closed += 1
                elif status not in (200, 404):
                    raise Failure(f"{path}: status {status}")
                found += status == 200
                usage.after_step(step)
            if found < steps * 3 // 4 or closed > steps // 1000:
                raise Failure(f"{found} of {steps} requests found a file, {closed} found their connection closed")
            return usage.finish(steps)
        finally:
            server.send_signal(signal.SIGTERM)


def run_lsview(build, folder, steps):
    """Edits of the file that a window shows, one after another."""
    plant, log = folder / "plant.lsys", folder / "log"
    write = lambda text: ((folder / "new").write_text(text), os.replace(folder / "new", plant))
    write(TREE)
    display = subprocess.Popen(["Xvfb", "-displayfd", "1", "-screen", "0", "400x300x24", "-nolisten", "tcp"],
                               stdout=subprocess.PIPE, stderr=subprocess.DEVNULL, text=True)
    viewer = None
    try:
        number = display.stdout.readline().strip()
        with open(log, "wb") as errors:
            viewer = subprocess.Popen([build / "lsview", plant, "-v", "--size", "320x240", "--samples", "1", "--no-ground",
                                       "--no-shadows"], stderr=errors,
                                      env=dict(os.environ, DISPLAY=f":{number}", XDG_CACHE_HOME=folder,
                                               XDG_CONFIG_HOME=folder, XDG_STATE_HOME=folder, XDG_DATA_HOME=folder))
        read = open(log, encoding="utf-8", errors="replace")

        def wait_for(text):
            end = time.monotonic() + PATIENCE
            while True:
                line = read.readline()
                if text in line:
                    return
                if not line:
                    if viewer.poll() is not None:
                        raise Failure(f"lsview has ended with status {viewer.returncode}")
                    if time.monotonic() > end:
                        raise Failure(f"lsview has not printed `{text}`")
                    time.sleep(0.002)

        with read:
            wait_for("loaded ")
            usage = Usage("lsview", viewer.pid, steps)
            for step in range(1, steps + 1):
                if step % 10 == 0:
                    write(MISTAKE + f"// {step}\n")
                    wait_for("error")
                else:
                    write(TREE.replace("#n = 4", f"#n = {1 + step % 4}") + f"// {step}\n")
                    wait_for("loaded ")
                usage.after_step(step)
        return usage.finish(steps)
    finally:
        for process in filter(None, (viewer, display)):
            process.terminate()
            process.wait()


RUNS = {"python": run_python, "serve": run_serve, "lsview": run_lsview}


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("build", type=pathlib.Path)
    parser.add_argument("--steps", type=int)
    parser.add_argument("runs", nargs="*", metavar="RUN", help=", ".join(RUNS))
    options = parser.parse_intermixed_args()  # RUN may stand behind options
    build = options.build.resolve()
    failures = 0
    for name in options.runs or RUNS:
        with tempfile.TemporaryDirectory(prefix="long-") as scratch:
            try:
                failures += not RUNS[name](build, pathlib.Path(scratch), options.steps or STEPS[name])
            except Failure as failure:
                print(f"{name}: {failure}")
                failures += 1
    return 1 if failures else 0


if __name__ == "__main__":
    sys.exit(main())
