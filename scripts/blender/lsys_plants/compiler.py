# SPDX-License-Identifier: MIT
"""Grows plants with the program lsc or the Python module lsys; needs no Blender."""
import json
import os
import shlex
import shutil
import subprocess
import tempfile
import time
import warnings

try:
    import lsys
except ImportError:
    lsys = None


class CompilerError(Exception):
    """No compiler was found, or it failed; the text says why."""


def find_compiler(named=""):
    """The program at the path `named`; else the module lsys; else the program lsc of PATH."""
    if named:
        if os.path.isfile(named) and os.access(named, os.X_OK):
            return Program(named)
        raise CompilerError(f"{named} is no program: see the path of lsc in the preferences of the add-on")
    if lsys is not None:
        return Module()
    found = shutil.which("lsc")
    if found is None:
        raise CompilerError("there is no Python module lsys, and lsc is not in PATH: name its path in the "
                            "preferences of the add-on")
    return Program(found)


def split_options(text):
    """The words of a text, with quotes as in a shell."""
    try:
        return shlex.split(text)
    except ValueError as error:
        raise CompilerError(f"options: {error}") from error


class Program:
    """The program lsc."""

    def __init__(self, path):
        self.path = path

    def run(self, arguments, seconds):
        """Returns standard output and the messages of a run. Raises CompilerError with the messages if it fails."""
        try:
            done = subprocess.run([self.path, *arguments], capture_output=True, text=True, encoding="utf-8",
                                  errors="replace", stdin=subprocess.DEVNULL, timeout=seconds, check=False)
        except subprocess.TimeoutExpired as error:
            raise CompilerError(f"lsc was stopped after {seconds:g} s: the limit is in the preferences of the "
                                "add-on") from error
        except OSError as error:
            raise CompilerError(f"{self.path}: {error.strerror}") from error
        messages = done.stderr.strip()
        if done.returncode != 0:
            raise CompilerError(messages or f"lsc ended with status {done.returncode}")
        return done.stdout, messages

    def read_parameters(self, file, seconds):
        """Generations, seed and parameters of a grammar, as `lsc stats --parameters` writes them."""
        try:
            output, _ = self.run(["stats", "--parameters", "--message-format", "json", "--quiet", "--", file], seconds)
            return json.loads(output)
        except CompilerError:
            # The messages of the error are JSON; `lsc check` raises the same error with readable messages.
            self.run(["check", "--color", "never", "--", file], seconds)
            raise
        except ValueError as error:
            raise CompilerError(f"{self.path} is too old: it has no `stats --parameters`") from error

    def write(self, arguments, path, seconds):
        """Writes the file of `lsc export` or `lsc forest`. Returns the messages."""
        return self.run([*arguments, "-o", path, "--color", "never"], seconds)[1]


class Module:
    """The Python module lsys."""

    #: Options of lsc that lsys.compile() takes as text arguments of the same name.
    COMPILE = ("dialect", "system")

    def attempt(self, work, seconds):
        """Returns the value of work(limit) and its warnings as text. `limit`: keyword arguments that set the time limit."""
        end = time.monotonic() + seconds
        limit = {"progress": lambda *_: time.monotonic() < end}
        try:
            with warnings.catch_warnings(record=True) as caught:
                warnings.simplefilter("always")
                value = work(limit)
        except lsys.Cancelled as error:
            raise CompilerError(f"the plant was stopped after {seconds:g} s: the limit is in the preferences of "
                                "the add-on") from error
        except (lsys.LsysError, TypeError, ValueError) as error:
            raise CompilerError(str(error)) from error
        return value, "\n".join(str(each.message) for each in caught)

    def read_parameters(self, file, seconds):
        """The same as Program.read_parameters."""
        grammar, _ = self.attempt(lambda limit: lsys.compile(file, **limit), seconds)
        parameters = []
        for constant in grammar.constants:
            one = {"name": constant.name}
            if constant.value is not None:
                one["value"] = constant.value
            if constant.bounds is not None:
                one["min"], one["max"] = constant.bounds
            parameters.append(one)
        return {"generations": grammar.generations or 0, "seed": grammar.seed, "parameters": parameters}

    def write(self, arguments, path, seconds):
        """The same as Program.write, with the same arguments."""
        command, file, *rest = arguments
        compile_arguments, options = split_arguments(rest, command)
        return self.attempt(lambda limit: WRITERS[command](file, compile_arguments, options, path, limit), seconds)[1]


def split_arguments(arguments, command):
    """Splits arguments of lsc into arguments of compile() and a dictionary of the other options."""
    known = lsys.options("plant") if command == "export" else {**lsys.options("scene"), **lsys.options("forest")}
    compile_arguments = {"defines": {}, "settings": {}}
    options = {}
    left = list(arguments)
    while left:
        name, equals, value = left.pop(0).partition("=")
        name = {"-n": "--generations", "-D": "--define", "-s": "--seed"}.get(name, name)
        if not name.startswith("--"):
            raise CompilerError(f"options: `{name}` is not an option")
        name = name[2:]
        is_flag = name == "bug-compatible" or known.get(name, ("VALUE",))[0] == ""
        if not equals and not is_flag:
            if not left:
                raise CompilerError(f"options: --{name} has no value")
            value = left.pop(0)
        if name in ("define", "set"):
            key, equals, value = value.partition("=")
            if not equals:
                raise CompilerError(f"options: `{key}` has no value")
            compile_arguments["defines" if name == "define" else "settings"][key] = (
                number(value, float) if name == "define" else value)
        elif name == "generations":
            compile_arguments["generations"] = number(value, int)
        elif name == "threads":
            options["threads"] = number(value, int)
        elif name == "bug-compatible":
            compile_arguments["bug_compatible"] = True
        elif name in Module.COMPILE:
            compile_arguments[name] = value
        else:
            options[name] = True if is_flag and not equals else value
    return compile_arguments, options


def number(text, kind):
    """Converts the value of an option. `kind`: int or float."""
    try:
        return kind(text)
    except ValueError as error:
        raise CompilerError(f"options: `{text}` is no number") from error


def write_plant(file, compile_arguments, options, path, limit):
    """Writes the file of `lsc export` by the module. `limit`: as in Module.attempt()."""
    threads = {"threads": options.pop("threads")} if "threads" in options else {}
    seed = number(options.pop("seed"), int) if "seed" in options else None
    height = number(options.pop("height"), float) if "height" in options else None
    grammar = lsys.compile(file, **compile_arguments, **limit, **threads)
    plant = grammar.grow(seed=seed, height=height, **limit, **threads)
    plant.save(path, **options, **limit, **threads)


def write_forest(file, compile_arguments, options, path, limit):
    """Writes the file of `lsc forest` by the module. `limit`: as in Module.attempt()."""
    threads = {"threads": options.pop("threads")} if "threads" in options else {}
    names = lsys.options("forest")
    save_options = {name: options.pop(name) for name in list(options) if name in names}
    lsys.Forest(file, **compile_arguments, **options, **limit, **threads).save(path, **save_options, **limit, **threads)


WRITERS = {"export": write_plant, "forest": write_forest}


class TemporaryGlb:
    """Context manager: writes a GLB in a temporary folder, which is removed at the end of the `with`."""

    def __init__(self, compiler, arguments, seconds):
        self.compiler, self.arguments, self.seconds = compiler, arguments, seconds
        self.folder = None

    def __enter__(self):
        self.folder = tempfile.TemporaryDirectory(prefix="lsys_plants_")
        path = os.path.join(self.folder.name, "plant.glb")
        try:
            messages = self.compiler.write(self.arguments, path, self.seconds)
            if not os.path.isfile(path):
                raise CompilerError("lsc wrote a series of files, not one: leave out --grow, and --frames of a forest")
        except BaseException:
            self.folder.cleanup()
            raise
        return path, messages

    def __exit__(self, *_):
        self.folder.cleanup()
