"""What is wrong, in the words of the command."""

from __future__ import annotations

from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from ._result import Result
    from ._sweep import Table

_Place = tuple[str | None, int | None, int | None, str | None]


class Error(Exception):
    """Anything that fem-run refuses or fails at. ``str()`` is all of it, as the command prints it.

    Attributes:
        help: what is allowed, or what to do.
        file: the case as it was named, or the override, ``--set body.0.approach_speed=…``.
        line, column: of the culprit's first character, from 1.
        key: the dotted path of the key at fault.
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
    """Bad input; nothing was computed."""


class RunError(Error, RuntimeError):
    """A run that failed; ``result`` is what was computed so far, marked incomplete. Of a sweep whose executor broke
    it is the table of the members that are done."""

    result: Result | Table | None = None


class Interrupted(Error, KeyboardInterrupt):
    """A run or a sweep that Ctrl-C ended; ``result`` is what was computed so far: a result that is marked
    incomplete, or the table of the members that are done."""

    result: Result | Table | None = None


def bad_input(message: str, help: str) -> InputError:
    """What is wrong and what is right, as the command words it."""
    return InputError(f"{message}\n  help: {help}\n", help)


def shown(value: object) -> str:
    """A value in a few words, for messages."""
    text = repr(value)
    return text if len(text) <= 40 else f"a {type(value).__name__}"
