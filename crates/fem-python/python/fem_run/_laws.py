"""Contact laws, materials and experiments: what the commands of these names compute, without their files.

Keyword arguments are the options of the command, ``contact_time=True`` for ``--contact-time``, lists for what
may be repeated or listed, ``columns={"speed": "v"}`` for what columns are called. Data are a CSV file's path, a :class:`fem_run.Table`, a data frame, or a dict of
columns, named as docs/fits.md says: ``speed_m_s``, ``restitution``.
"""

from __future__ import annotations

import json
import os
from collections.abc import Mapping
from typing import Any

from . import _native
from ._case import Case
from ._sweep import Table, _array

#: Options that take a list in one word; others are repeated.
_LISTED = {"free", "diameters", "masses"}


def fit(case: Case, data: Any, **options: Any) -> dict[str, Any]:
    """Parameters of a contact law from restitutions over speeds: ``fit(case, table, law="ting")``.

    Options: ``law``, ``free``, ``param``, ``end``, ``bounds``, ``profile``, ``compare``, ``contact_time``,
    ``confidence``. Returns the keys of ``fit.json``, SI.

    Raises:
        InputError: options or data that do not fit.
    """
    return json.loads(_native.fit(case._native, _data(data), _words(options)))


def invert(case: Case, restitution: float, **options: Any) -> dict[str, Any]:
    """The parameter of a law that gives a restitution at one speed.

    Options: ``law``, ``find``, ``param``, ``end``, ``speed``. Returns ``solutions``, each with ``law``,
    ``parameter``, ``value`` and ``contact_time_s``, SI, and ``unsolved``, laws and why.
    """
    words = _words({"restitution": restitution, **options})
    return json.loads(_native.invert(case._native, None, words))


def export(case: Case, data: Any = None, **options: Any) -> dict[str, Any]:
    """Input of DEM codes and of robotics that makes the same restitutions.

    For LAMMPS, LIGGGHTS, YADE, MercuryDPM, Lethe, MFIX-DEM, Drake and MuJoCo. Options: ``speeds``,
    ``tolerance``, and ``materials`` and ``diameters`` for a table of all pairs. Returns the keys of
    ``export.json``, and ``texts``: the files by name.
    """
    return json.loads(_native.export(case._native, _data(data), _words(options)))


def calibrate(case: Case, data: Any, **options: Any) -> dict[str, Any]:
    """A Prony series from measured restitutions, and what they leave open.

    Options: ``terms``, ``times``, ``acts_on``, ``material``, ``regularisation``, ``uncertainty``, ``model``,
    ``confidence``. Returns the keys of ``calibrate.json``, and ``relaxation_toml`` to paste into a case.
    """
    return json.loads(_native.calibrate(case._native, _data(data), _words(options)))


def cradle(data: Any = None, **options: Any) -> Any:
    """Restitution from the angles of a Newton's cradle: ``cradle(length="20 cm", diameters=["22.2 mm", "15.9
    mm"], alpha="20 deg", beta="24 deg")``.

    Options: ``length``, ``diameters`` or ``masses``, ``alpha``, ``beta``, ``angle_uncertainty``, ``gravity``.
    Returns speed, restitution and velocities with their uncertainties, SI; of data, columns of a row a trial.
    """
    found = json.loads(_native.cradle(_data(data), _words(options)))
    if isinstance(found, dict):
        return found
    names = found[0] if found else {}
    return {name: _array([row[name] for row in found]) for name in names}


def check(case: Case) -> str:
    """What ``fem-run check`` prints: the case with all defaults, and what to expect of a run."""
    return case.check()


def _words(options: Mapping[str, Any]) -> list[str]:
    words: list[str] = []
    for name, value in options.items():
        option = "--" + name.replace("_", "-")
        if value is None or value is False:
            continue
        if value is True:
            words.append(option)
        elif isinstance(value, Mapping):
            words += [f"{option}={key}={_text(inner)}" for key, inner in value.items()]
        elif isinstance(value, (list, tuple)) and name in _LISTED:
            words.append(f"{option}={','.join(map(_text, value))}")
        elif isinstance(value, tuple):
            words.append(f"{option}={'..'.join(map(_text, value))}")
        elif isinstance(value, list):
            words += [f"{option}={_text(inner)}" for inner in value]
        else:
            words.append(f"{option}={_text(value)}")
    return words


def _text(value: Any) -> str:
    return repr(float(value)) if isinstance(value, float) else str(value)


def _data(data: Any) -> tuple[str, bytes] | None:
    """Name and bytes of data."""
    if data is None:
        return None
    if isinstance(data, (str, os.PathLike)):
        with open(data, "rb") as file:
            return os.fspath(data), file.read()
    if isinstance(data, Table):
        return "<table>", data.to_csv().encode()
    if hasattr(data, "to_dict") and hasattr(data, "columns"):
        data = {name: data[name].to_numpy() for name in data.columns}
    columns = {str(name): _array(list(values)) for name, values in data.items()}
    return "<data>", Table(columns, []).to_csv().encode()
