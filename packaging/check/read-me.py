#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Runs the sessions of "Five minutes" of README.md with installed programs and compares their output.

Skips commands of programs that are not named, and commands that open windows. Usage: read-me.py README.md PROGRAM...
"""
import os
import re
import shlex
import subprocess
import sys
import tempfile


def sessions(text):
    """Yields pairs: a command, the lines that it must print."""
    part = text.split("\n## Five minutes\n", 1)[1].split("\n## ", 1)[0]
    for block in re.findall(r"^```console\n(.*?)^```$", part, re.M | re.S):
        command, lines = None, []
        for line in block.replace("\\\n", " ").splitlines():
            if line.startswith("$ "):
                if command:
                    yield command, lines
                command, lines = line[2:], []
            else:
                lines.append(line)
        yield command, lines


def matches(expected, printed):
    """Whether the lines are equal; `...` stands for any lines."""
    pattern = "".join(r"(?:.*\n)*" if line == "..." else re.escape(line) + r"\n" for line in expected)
    return re.fullmatch(pattern, "".join(line + "\n" for line in printed)) is not None


def main():
    path, *programs = sys.argv[1:]
    with open(path, encoding="utf-8") as file:
        steps = list(sessions(file.read()))
    folder = tempfile.mkdtemp()
    os.chdir(folder)
    os.symlink("/usr/share/lsc/samples", "samples")
    count = 0
    for command, expected in steps:
        words = shlex.split(command)
        if words[0] == "cat":
            with open(words[1], "w", encoding="utf-8") as file:
                file.write("".join(line + "\n" for line in expected))
            continue
        if words[0] not in programs or (words[0] == "lsview" and "--screenshot" not in words):
            continue
        run = subprocess.run(words, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True, check=False)
        # Output of lsview is not compared, because drivers of OpenGL may print warnings.
        is_equal = words[0] == "lsview" or matches(expected, run.stdout.splitlines())
        if run.returncode != 0 or not is_equal:
            sys.exit(f"$ {command}\nexit status {run.returncode}, prints\n{run.stdout}instead of\n" + "\n".join(expected))
        if words[0] == "lsview" and "--frames" not in words:
            picture = words[words.index("--screenshot") + 1]
            with open(picture, "rb") as file:
                assert file.read(8) == b"\x89PNG\r\n\x1a\n", picture
        count += 1
    if count < 5:
        sys.exit(f"only {count} commands were found")
    print(f"{count} commands of README.md print what it says")


main()
