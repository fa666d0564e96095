# SPDX-License-Identifier: MIT
"""Exceptions of the package."""


def restored(restorer, *members):
    """The message, or part of a message, that `pickle` copies. `restorer`: a function of `_lsys`."""
    from . import _lsys

    return getattr(_lsys, restorer)(*members)


class LsysError(Exception):
    """A call has failed: a file cannot be read, an option is invalid.

    The text of the exception is the text of all messages; `diagnostics` holds the messages as data.
    """

    def __init__(self, text="", diagnostics=()):
        super().__init__(text)
        self.diagnostics = list(diagnostics)


class GrammarError(LsysError):
    """Mistakes in a grammar. The text shows them with the lines of the source."""


class LimitError(LsysError):
    """`max_modules`, `max_bytes` or the memory of the machine is used up."""


class Cancelled(LsysError):
    """A callback has ended the call."""


class GrammarWarning(UserWarning):
    """A grammar compiles, but may not do what its author intends."""
