"""Runs lsc; needs no Blender."""
import json
import os
import shlex
import shutil
import subprocess
import tempfile


class CompilerError(Exception):
    """lsc is missing or failed; the text has the reason."""


def find_lsc(named=""):
    """Path of lsc: `named`, or else the first in PATH. CompilerError: there is none."""
    if named:
        if os.path.isfile(named) and os.access(named, os.X_OK):
            return named
        raise CompilerError(f"{named} is no program: see the path of lsc in the preferences of the add-on")
    found = shutil.which("lsc")
    if found is None:
        raise CompilerError("lsc is not in PATH: name its path in the preferences of the add-on")
    return found


def run_lsc(lsc, arguments, seconds):
    """Standard output and the messages of a run. CompilerError: the run failed; the text has its messages."""
    try:
        done = subprocess.run([lsc, *arguments], capture_output=True, text=True, encoding="utf-8",
                              errors="replace", stdin=subprocess.DEVNULL, timeout=seconds, check=False)
    except subprocess.TimeoutExpired as error:
        raise CompilerError(f"lsc was stopped after {seconds:g} s: the limit is in the preferences of the "
                            "add-on") from error
    except OSError as error:
        raise CompilerError(f"{lsc}: {error.strerror}") from error
    messages = done.stderr.strip()
    if done.returncode != 0:
        raise CompilerError(messages or f"lsc ended with status {done.returncode}")
    return done.stdout, messages


def split_options(text):
    try:
        return shlex.split(text)
    except ValueError as error:
        raise CompilerError(f"options: {error}") from error


def read_parameters(lsc, file, seconds):
    """The output of `lsc stats --parameters` for a grammar: generations, seed, parameters."""
    try:
        output, _ = run_lsc(lsc, ["stats", "--parameters", "--message-format", "json", "--quiet", "--", file], seconds)
        return json.loads(output)
    except CompilerError:
        # The messages of the error are JSON; `lsc check` raises the same error with readable messages.
        run_lsc(lsc, ["check", "--color", "never", "--", file], seconds)
        raise
    except ValueError as error:
        raise CompilerError(f"{lsc} is too old: it has no `stats --parameters`") from error


class TemporaryGlb:
    """Context manager: runs lsc to write a GLB in a temporary folder, which is removed at the end of the `with`."""

    def __init__(self, lsc, arguments, seconds):
        self.lsc, self.arguments, self.seconds = lsc, arguments, seconds
        self.folder = None

    def __enter__(self):
        self.folder = tempfile.TemporaryDirectory(prefix="lsys_plants_")
        path = os.path.join(self.folder.name, "plant.glb")
        try:
            _, messages = run_lsc(self.lsc, [*self.arguments, "-o", path, "--color", "never"], self.seconds)
            if not os.path.isfile(path):
                raise CompilerError("lsc wrote a series of files, not one: leave out --grow, and --frames of a forest")
        except BaseException:
            self.folder.cleanup()
            raise
        return path, messages

    def __exit__(self, *_):
        self.folder.cleanup()
