"""Errors, with the messages of the command."""

from __future__ import annotations

from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from ._result import Result
    from ._sweep import Table

_Place = tuple[str | None, int | None, int | None, str | None]


class Error(Exception):
    """An error of fem-run. ``str()`` returns the whole text, as the command prints it.

    Attributes:
        help: what is allowed, or what to do.
        file: name of the case, or the override, ``--set body.0.approach_speed=…``.
        line, column: position of the error in the file, from 1.
        key: dotted path of the key.
    """

    def __init__(
        self,
        text: str,
        help: str | None = None,
        place: _Place = (None, None, None, None),
    ) -> None:
        super().__init__(text)
        self.help = help
        self.place = place
        self.file, self.line, self.column, self.key = place

    def __reduce__(self) -> tuple[object, ...]:
        return type(self), (str(self), self.help, self.place)


class InputError(Error, ValueError):
    """Invalid input; nothing was computed."""


class RunError(Error, RuntimeError):
    """A failed run; ``result`` contains what was computed, marked incomplete. For a sweep whose executor broke,
    ``result`` is the table of the members that are done."""

    result: Result | Table | None = None


class Interrupted(Error, KeyboardInterrupt):
    """A run or a sweep that Ctrl-C ended; ``result`` contains what was computed: a result marked incomplete, or the
    table of the members that are done."""

    result: Result | Table | None = None


def bad_input(message: str, help: str) -> InputError:
    """Creates an error with a suggested fix, in the form of the command."""
    return InputError(f"{message}\n  help: {help}\n", help)


def shown(value: object) -> str:
    """Returns a short form of a value for messages."""
    text = repr(value)
    return text if len(text) <= 40 else f"a {type(value).__name__}"
