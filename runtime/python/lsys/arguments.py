# SPDX-License-Identifier: MIT
"""Keyword arguments as options of `lsc export` and `lsc forest`."""

import os

CALL_OPTIONS = (
    "threads",
    "max_modules",
    "max_bytes",
    "untrusted",
    "root",
    "max_seconds",
    "max_output",
    "progress",
    "read_file",
    "environment",
)


def split(arguments):
    """Returns the options of calls, and all other options as pairs (name, text).

    `lod_files=True` becomes ("lod-files", ""). True sets a flag, False clears the flag of a preset,
    None omits the option. A sequence becomes numbers separated by commas.
    """
    calls = {}
    options = []
    for name, value in arguments.items():
        if name in CALL_OPTIONS:
            calls[name] = value
        elif value is not None:
            options.append((name.replace("_", "-"), text_of(value)))
    return calls, options


def text_of(value):
    """The text of a value on a command line."""
    if value is True:
        return ""
    if value is False:
        return "false"
    if isinstance(value, (str, os.PathLike)):
        return os.fspath(value)
    if isinstance(value, (list, tuple)) or hasattr(value, "tolist") and getattr(value, "ndim", 0):
        return ",".join(text_of(part) for part in value)
    return repr(value.item()) if hasattr(value, "item") else repr(value)
