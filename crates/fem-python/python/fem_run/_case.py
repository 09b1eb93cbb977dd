"""A case."""

from __future__ import annotations

import html
import os
from collections.abc import Callable, Mapping
from typing import Any

from . import _native, _toml
from ._errors import shown
from ._progress import reporter
from ._result import Result


class Case:
    """A valid case: two bodies, how they meet, and what computes them.

    Made by :meth:`load` or :meth:`from_dict`; it does not change, :meth:`with_` gives another one. Cases can be
    pickled.
    """

    __slots__ = ("_native",)

    def __init__(self, native: _native.Case) -> None:
        self._native = native

    @classmethod
    def load(cls, path: str | os.PathLike[str], **overrides: Any) -> Case:
        """Reads a case file, TOML.

        Raises:
            InputError: the first thing that is wrong with it, with file, line, column and key.
        """
        return cls(_native.Case.load(os.fspath(path), _overrides(overrides)))

    @classmethod
    def from_toml(cls, text: str, name: str = "<text>") -> Case:
        """Reads the text of a case; ``name`` stands for it in messages. Mesh files are looked for here."""
        if not isinstance(text, str):
            raise TypeError(f"the text of a case is a str, not {shown(text)}")
        return cls(_native.Case.parse(name, text, ".", []))

    @classmethod
    def from_dict(cls, tables: Mapping[str, Any]) -> Case:
        """A case of the tables that a case file has: ``{"material": {…}, "body": [{…}, {…}]}``.

        Numbers are SI, strings have a unit; keys whose value is ``None`` are left out.

        Raises:
            InputError: the first thing that is wrong with it, with its key.
        """
        if not isinstance(tables, Mapping):
            raise TypeError(f"a case is a dict of tables, as a case file has them, not {shown(tables)}")
        return cls(_native.Case.parse("<dict>", _toml.document(tables), ".", []))

    def with_(self, changes: Mapping[str, Any]) -> Case:
        """The same case with other values: ``{"body.0.approach_speed": "1 m/s", "model": {"ting": {}}}``.

        Keys are dotted paths, arrays count from 0; a value may be a whole table. Keys and tables that the case
        lacks are added.

        Raises:
            InputError: a key that is none, a value that does not fit.
        """
        return Case(self._native.overridden(_overrides(changes)))

    def run(
        self,
        *,
        progress: bool | Callable[[float], object] = False,
        snapshots: bool = True,
    ) -> Result:
        """Computes the collision, to the bits of the command. Other Python threads go on meanwhile.

        Args:
            progress: a bar on stderr, or a function that is called with the fraction that is done.
            snapshots: whether the fields that the case asks for are computed.

        Raises:
            InputError: what the model refuses.
            RunError: a run that failed; its ``result`` is what there is.
            Interrupted: Ctrl-C; its ``result`` is what there is.
        """
        with reporter(progress, self.title) as report:
            outcome, error = self._native.run(report, snapshots)
        result = Result(outcome, self.stem)
        failure = outcome.failure()
        if error is not None and not isinstance(error, KeyboardInterrupt):
            raise error
        if failure is not None:
            failure.result = result
            raise failure
        return result

    def check(self) -> str:
        """What ``fem-run check`` prints: the case with all defaults, and what to expect of a run."""
        return self._native.check()

    def to_toml(self) -> str:
        """The case as a file, numbers in SI."""
        return self._native.to_toml()

    def number(self, key: str) -> tuple[float, str] | None:
        """The number at a dotted key in SI and its unit; ``None`` where the case gives none."""
        if not isinstance(key, str):
            raise TypeError(f"a key is a dotted path, such as 'body.0.approach_speed', not {shown(key)}")
        return self._native.number_at(_toml.parts(key))

    @property
    def title(self) -> str:
        """What it is, in words."""
        return self._native.title

    @property
    def stem(self) -> str:
        """What results are named after."""
        name = os.path.splitext(os.path.basename(self._native.name))[0]
        kept = (c if c.isascii() and (c.isalnum() or c in "-_.") else "_" for c in name)
        return "".join(kept).strip("_") or "case"

    @property
    def identity(self) -> str:
        """What its result by this build is known by: the name of a sweep's member."""
        return self._native.identity()

    def __reduce__(self) -> tuple[object, ...]:
        return _unpickled, self._native.parts()

    def __repr__(self) -> str:
        return f"<fem_run.Case {self.title!r}>"

    def _repr_html_(self) -> str:
        return f"<details><summary>{html.escape(self.title)}</summary><pre>{html.escape(self.to_toml())}</pre></details>"


def _overrides(changes: Mapping[str, Any]) -> list[str]:
    if not isinstance(changes, Mapping):
        raise TypeError(f"changes are a dict of dotted keys and values, not {shown(changes)}")
    for key in changes:
        if not isinstance(key, str):
            raise TypeError(f"a key is a dotted path, such as 'body.0.approach_speed', not {shown(key)}")
    return [f"{key}={_toml.value(value)}" for key, value in changes.items()]


def _unpickled(name: str, text: str, folder: str, overrides: list[str]) -> Case:
    return Case(_native.Case.parse(name, text, folder, overrides))
