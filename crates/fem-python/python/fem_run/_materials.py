"""The library of materials, which a case names as ``"lib:NAME"``."""

from __future__ import annotations

import json
from collections.abc import Iterator, Mapping
from functools import cached_property
from typing import Any

from . import _native


def _plain(name: str) -> str:
    return name.removeprefix("lib:").lower().replace(" ", "-").replace("_", "-")


class Materials(Mapping[str, "dict[str, Any]"]):
    """Materials by name: ``title``, ``source`` and ``range`` as text, other ``names``, ``table`` as in a case, SI, and ``measured``.

    ``measured`` has a dict for each published measurement of restitutions: ``name``, ``source``, ``bodies``, ``size``,
    ``temperature``, ``scatter`` (standard deviation), and the columns ``speed_m_s`` and ``restitution``, which
    :func:`fem_run.fit` takes as data.
    """

    @cached_property
    def _all(self) -> dict[str, dict[str, Any]]:
        return json.loads(_native.materials())

    @cached_property
    def _names(self) -> dict[str, str]:
        return {_plain(name): known for known, entry in self._all.items() for name in (known, *entry["names"])}

    def __getitem__(self, name: str) -> dict[str, Any]:
        known = self._names.get(_plain(name), name)
        if known not in self._all:
            # Raises the error of the command, which suggests the nearest name.
            _native.material_toml(known)
        return self._all[known]

    def __iter__(self) -> Iterator[str]:
        return iter(self._all)

    def __len__(self) -> int:
        return len(self._all)

    def __contains__(self, name: object) -> bool:
        return isinstance(name, str) and _plain(name) in self._names

    def toml(self, name: str) -> str:
        """Returns a material as a table to copy into a case file."""
        return _native.material_toml(name)

    def __repr__(self) -> str:
        return f"<fem_run.materials: {', '.join(self._all)}>"


materials = Materials()
