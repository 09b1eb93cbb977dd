"""Errors, with the messages of the command in Python's words."""

from __future__ import annotations

from typing import TYPE_CHECKING

from ._words import in_python

if TYPE_CHECKING:
    from ._result import Result
    from ._sweep import Table

_Place = tuple[str | None, int | None, int | None, str | None]


class Error(Exception):
    """An error of fem-run. ``str()`` returns the whole text: what the command prints, in Python's words.

    Attributes:
        help: what is allowed, or what to do.
        file: name of the case, or the change, ``{"body.0.approach_speed": …}``.
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


def from_command(kind: str, text: str, help: str | None, place: _Place) -> Error:
    """Creates the exception of a failure of the command; ``kind`` is the name of its class."""
    kinds: dict[str, type[Error]] = {"InputError": InputError, "RunError": RunError, "Interrupted": Interrupted}
    file, line, column, key = place
    name = None if file is None else in_python(file)
    return kinds[kind](in_python(text), None if help is None else in_python(help), (name, line, column, key))


def bad_input(message: str, help: str) -> InputError:
    """Creates an error with a suggested fix, in the form of the command."""
    return InputError(f"{message}\n  help: {help}\n", help)


def shown(value: object) -> str:
    """Returns a short form of a value for messages."""
    text = repr(value)
    return text if len(text) <= 40 else f"a {type(value).__name__}"
