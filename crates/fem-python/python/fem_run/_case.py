"""A case."""

from __future__ import annotations

import html
import json
import os
from collections.abc import Callable, Mapping
from typing import Any

from . import _native, _toml
from ._errors import shown
from ._progress import reporter
from ._result import Result


class Case:
    """A valid case: two bodies, their collision, and the model that computes it.

    Created by :meth:`load` or :meth:`from_dict`. A case does not change; :meth:`with_` returns another one. Cases
    can be pickled and copied, and be keys of a dict. They are equal if their tables are the same.
    """

    __slots__ = ("_native",)

    def __init__(self, native: _native.Case) -> None:
        self._native = native

    @classmethod
    def load(cls, path: str | os.PathLike[str], **overrides: Any) -> Case:
        """Reads a TOML case file.

        Raises:
            InputError: the case is invalid; the error has file, line, column and key.
        """
        return cls(_native.Case.load(os.fspath(path), _overrides(overrides)))

    @classmethod
    def from_toml(cls, text: str, name: str = "<text>") -> Case:
        """Reads the text of a case; ``name`` is its name in messages. Mesh files are looked up in the current folder."""
        if not isinstance(text, str):
            raise TypeError(f"the text of a case must be a str, not {shown(text)}")
        return cls(_native.Case.parse(name, text, ".", []))

    @classmethod
    def from_dict(cls, tables: Mapping[str, Any]) -> Case:
        """Creates a case from the tables of a case file: ``{"material": {…}, "body": [{…}, {…}]}``.

        Numbers are SI, strings have a unit; keys with the value ``None`` are left out.

        Raises:
            InputError: the case is invalid; the error has the key.
        """
        if not isinstance(tables, Mapping):
            raise TypeError(f"a case must be a dict of tables, as in a case file, not {shown(tables)}")
        return cls(_native.Case.parse("<dict>", _toml.document(tables), ".", []))

    def with_(self, changes: Mapping[str, Any]) -> Case:
        """Returns the case with other values: ``{"body.0.approach_speed": "1 m/s", "model": {"ting": {}}}``.

        Values that change the scene are appended to the title. Keys are dotted paths, and arrays count from 0; a value may be a whole table. Keys and tables that the case
        lacks are added.

        Raises:
            InputError: a key is unknown, or a value is invalid.
        """
        return Case(self._native.overridden(_overrides(changes)))

    def run(
        self,
        *,
        progress: bool | Callable[[float], object] = False,
        snapshots: bool = True,
    ) -> Result:
        """Computes the collision with the same bits as the command. Other Python threads continue meanwhile.

        Args:
            progress: True for a bar on stderr, or a function that is called with the completed fraction.
            snapshots: whether the requested snapshots are computed.

        Raises:
            InputError: the model rejects the case.
            RunError: the run failed; ``result`` contains what was computed.
            Interrupted: Ctrl-C ended the run; ``result`` contains what was computed.
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
        """Returns the text of ``fem-run check --resolved``: the case with all defaults, and a description of the expected run."""
        return self._native.check()

    def to_toml(self) -> str:
        """Returns the text of a case file, with numbers in SI."""
        return self._native.to_toml()

    def to_dict(self) -> dict[str, Any]:
        """Returns the tables of the case with numbers in SI, from which :meth:`from_dict` makes an equal case."""
        return json.loads(self._native.to_json())

    def number(self, key: str) -> tuple[float, str] | None:
        """Returns the number at a dotted key in SI and its unit; ``None`` if the case does not give it."""
        if not isinstance(key, str):
            raise TypeError(f"a key must be a dotted path, such as 'body.0.approach_speed', not {shown(key)}")
        return self._native.number_at(_toml.parts(key))

    @property
    def title(self) -> str:
        """The title of the case."""
        return self._native.title

    @property
    def stem(self) -> str:
        """The name after which results are named."""
        name = os.path.splitext(os.path.basename(self._native.name))[0]
        kept = (c if c.isascii() and (c.isalnum() or c in "-_.") else "_" for c in name)
        return "".join(kept).strip("_") or "case"

    @property
    def folder_name(self) -> str:
        """The name of the default result folder: the stem and the values of ``with_`` that change the scene."""
        return self._native.folder_name(self.stem)

    @property
    def identity(self) -> str:
        """The identity of the result with this build, which is also the name of a sweep's member."""
        return self._native.identity()

    def __eq__(self, other: object) -> bool:
        return self.to_toml() == other.to_toml() if isinstance(other, Case) else NotImplemented

    def __hash__(self) -> int:
        return hash(self.to_toml())

    def __copy__(self) -> Case:
        return self

    def __deepcopy__(self, _: dict[int, Any]) -> Case:
        return self

    def __reduce__(self) -> tuple[object, ...]:
        return _unpickled, self._native.parts()

    def __repr__(self) -> str:
        return f"<fem_run.Case {self.title!r}>"

    def _repr_html_(self) -> str:
        return f"<details><summary>{html.escape(self.title)}</summary><pre>{html.escape(self.to_toml())}</pre></details>"


def _overrides(changes: Mapping[str, Any]) -> list[str]:
    if not isinstance(changes, Mapping):
        raise TypeError(f"changes must be a dict of dotted keys and values, not {shown(changes)}")
    for key in changes:
        if not isinstance(key, str):
            raise TypeError(f"a key must be a dotted path, such as 'body.0.approach_speed', not {shown(key)}")
    return [f"{key}={_toml.value(value)}" for key, value in changes.items()]


def _unpickled(name: str, text: str, folder: str, overrides: list[str]) -> Case:
    return Case(_native.Case.parse(name, text, folder, overrides))
