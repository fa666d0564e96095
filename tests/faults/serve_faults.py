# SPDX-License-Identifier: MIT
"""Lets single calls of the C library fail while `lsc serve` starts and answers, and checks what it does.

One run without a fault counts the calls, and keeps the answers. Then the server runs once for each chosen fault:
- it starts, or ends with status 2 or 3 and a message;
- each answer has the usual bytes, or status 500 or 503, or the connection is closed;
- after at most MOST_FAILED of the requests have failed, all answers are the usual ones again;
- SIGTERM ends it with the usual status.
Or the server ends with status 3 because memory ran out in a function of a library that must not throw.
Usage: serve_faults.py LSC LIBRARY [--every N] [--seed S]
  --every N   inject every Nth fault, beginning with a random one (default 60); 1 is all of them
"""

import argparse
import errno
import http.client
import os
import random
import re
import signal
import struct
import subprocess
import sys
import tempfile

CALLS = ["malloc", "open", "read", "write", "rename", "mmap", "fsync", "close", "fstat", "fchmod", "thread"]
ERRORS = {
    "malloc": [errno.ENOMEM],
    "open": [errno.EMFILE, errno.EACCES],
    "read": [errno.EIO, "short"],
    "write": [errno.EIO],
    "mmap": [errno.ENOMEM],
    "close": [errno.EIO],
    "fstat": [errno.EIO],
    "thread": [errno.EAGAIN],
}
MOST_FAULTS = 5_000  # of each kind with --every 1, evenly among the calls of a run
MOST_FAILED = 2  # requests; a fault of the pool of threads may lose two connections
FAILED = {2, 3}  # exit statuses of a server that does not start
PATIENCE = 60  # seconds for each answer, and for the start

TREE = "#n = 3; #set angle 25; #w : !(0.2) F(2) X;\n#p : X : * : !(0.08) F({0.5, 0.8}) [ + X ] /(120) [ & X ];\n"
ARGUMENTS = ["serve", "tree.lsys", "--placement", "jittered", "--spacing", "10", "--size", "200", "--heroes", "2",
             "--triangles", "20000", "--cache", "1M", "--threads", "2", "--listen", "0"]
PATHS = ["/tileset.json", "/0/0/0.glb", "/none", "/tileset.json", "/0/0/0.glb"] * 3


class Run:
    """Exit status or "hang", messages, and the answers: status and body, None for a closed connection."""

    def __init__(self):
        self.status = None
        self.messages = ""
        self.answers = []
        self.started = False


def ask(port, path):
    try:
        connection = http.client.HTTPConnection("127.0.0.1", port, timeout=PATIENCE)
        connection.request("GET", path)
        answer = connection.getresponse()
        found = answer.status, answer.read()
        connection.close()
        return found
    except TimeoutError:
        return "hang"
    except (http.client.HTTPException, OSError):
        return None


def run(lsc, library, folder, fault="", counts=""):
    environment = {"PATH": os.environ["PATH"], "LD_PRELOAD": library}
    if fault:
        environment["LSYS_FAULT"] = fault
    if counts:
        environment["LSYS_FAULT_COUNTS"] = counts
    done = Run()
    with tempfile.TemporaryFile() as errors, subprocess.Popen([lsc, *ARGUMENTS], cwd=folder, env=environment,
                                                              stdout=subprocess.PIPE, stderr=errors) as server:
        try:
            match = re.match(rb"serving http://127\.0\.0\.1:(\d+)/", server.stdout.readline())
            done.started = match is not None
            if match:
                done.answers = [ask(int(match.group(1)), path) for path in PATHS]
                server.send_signal(signal.SIGTERM)
            done.status = server.wait(PATIENCE)
        except subprocess.TimeoutExpired:
            server.kill()
            done.status = "hang"
        errors.seek(0)
        done.messages = errors.read().decode(errors="replace")
    return done


def mistakes_of(usual, done):
    """What is wrong with a run: a list of sentences."""
    if done.status == "hang" or "hang" in done.answers:
        return ["does not end, or does not answer"]
    if not done.started:
        known = done.status in FAILED and done.messages
        return [] if known else [f"does not start, exit status {done.status}: {done.messages[:200]!r}"]
    if done.status == 3 and "out of memory" in done.messages:
        return []
    wrong = [] if done.status == usual.status else [f"exit status {done.status}: {done.messages[:200]!r}"]
    lost = 0
    for path, expected, found in zip(PATHS, usual.answers, done.answers):
        if found != expected:
            lost += 1
            if found is not None and found[0] not in (500, 503):
                wrong.append(f"`{path}`: status {found[0]} and {len(found[1])} bytes, not {expected[0]} and {len(expected[1])}")
    if lost > MOST_FAILED:
        wrong.append(f"{lost} requests have failed")
    return wrong


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("lsc")
    parser.add_argument("library")
    parser.add_argument("--every", type=int, default=60)
    parser.add_argument("--seed", type=int, default=1)
    options = parser.parse_args()
    lsc, library = os.path.abspath(options.lsc), os.path.abspath(options.library)
    with tempfile.TemporaryDirectory(prefix="faults-") as folder:
        with open(os.path.join(folder, "tree.lsys"), "w", encoding="utf-8") as file:
            file.write(TREE)
        counts = os.path.join(folder, "counts")
        with open(counts, "wb") as file:
            file.write(bytes(8 * len(CALLS)))
        usual = run(lsc, library, folder, counts=counts)
        if not usual.started or [answer and answer[0] for answer in usual.answers[:5]] != [200, 200, 404, 200, 200]:
            print(f"fails without a fault: {usual.messages} {[answer and answer[0] for answer in usual.answers]}")
            return 1
        with open(counts, "rb") as file:
            numbers = dict(zip(CALLS, struct.unpack(f"{len(CALLS)}Q", file.read(8 * len(CALLS)))))
        faults = [(call, f"{call}:{number}:{error}") for call, errors in ERRORS.items()
                  for number in range(1, numbers[call] + 1, numbers[call] // MOST_FAULTS + 1) for error in errors]
        injected = dict.fromkeys(ERRORS, 0)
        unstarted = ended = failures = 0
        for call, fault in faults[random.Random(options.seed).randrange(options.every)::options.every]:
            done = run(lsc, library, folder, fault)
            injected[call] += 1
            unstarted += not done.started
            ended += done.started and done.status == 3
            for mistake in mistakes_of(usual, done):
                print(f"LSYS_FAULT={fault}: {mistake}", flush=True)
                failures += 1
    print("injected: " + ", ".join(f"{call} {count}" for call, count in injected.items()) +
          f"; did not start: {unstarted}; ended without memory: {ended}; failures: {failures}")
    return 1 if failures or not sum(injected.values()) else 0


if __name__ == "__main__":
    sys.exit(main())
