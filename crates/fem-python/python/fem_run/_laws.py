"""Contact laws, calibration and experiments: the results of the commands of these names, without their files.

Keyword arguments are the options of the command: ``contact_time=True`` for ``--contact-time``, lists for options that
may be repeated, ``columns={"speed": "v"}`` for the names of columns. Data are the path of a CSV file, a
:class:`fem_run.Table`, a data frame, or a dict of columns with the names of docs/fits.md: ``speed_m_s``,
``restitution``.
"""

from __future__ import annotations

import json
import os
from collections.abc import Mapping
from typing import Any

import numpy as np

from . import _native
from ._case import Case
from ._errors import bad_input, shown
from ._sweep import Table, _array

#: Options that take a list in one word; others are repeated.
_LISTED = {"free", "diameters", "masses"}


def fit(case: Case, data: Any, **options: Any) -> dict[str, Any]:
    """Fits parameters of a contact law to restitutions over speed: ``fit(case, table, law="ting")``.

    Options: ``law``, ``free``, ``param``, ``end``, ``bounds``, ``profile``, ``compare``, ``contact_time``,
    ``confidence``. Returns the keys of ``fit.json``, SI.

    Raises:
        InputError: the options or the data are invalid.
    """
    return json.loads(_native.fit(_native_of(case), _data(data), _words(options)))


def invert(case: Case, restitution: float, **options: Any) -> dict[str, Any]:
    """Finds the parameter of a law that gives a restitution at one speed.

    Options: ``law``, ``find``, ``param``, ``end``, ``speed``. Returns ``solutions``, each with ``law``,
    ``parameter``, ``value`` and ``contact_time_s``, SI, and ``unsolved``: laws with the reason.
    """
    words = _words({"restitution": restitution, **options})
    return json.loads(_native.invert(_native_of(case), None, words))


def export(case: Case, data: Any = None, **options: Any) -> dict[str, Any]:
    """Writes input for DEM codes and robotics that reproduces the restitutions.

    For LAMMPS, LIGGGHTS, YADE, MercuryDPM, Lethe, MFIX-DEM, Drake and MuJoCo. Options: ``speeds``,
    ``tolerance``, and ``materials`` and ``diameters`` for a table of all pairs. Returns the keys of
    ``export.json``, and ``texts``: the files by name.
    """
    return json.loads(_native.export(_native_of(case), _data(data), _words(options)))


def calibrate(case: Case, data: Any, **options: Any) -> dict[str, Any]:
    """Finds a Prony series from measured restitutions, and what they leave undetermined.

    Options: ``terms``, ``times``, ``acts_on``, ``material``, ``regularisation``, ``uncertainty``, ``model``,
    ``confidence``. Returns the keys of ``calibrate.json``, and ``relaxation_toml`` to paste into a case.
    """
    return json.loads(_native.calibrate(_native_of(case), _data(data), _words(options)))


def cradle(data: Any = None, **options: Any) -> Any:
    """Computes the restitution from the angles of a Newton's cradle: ``cradle(length="20 cm", diameters=["22.2 mm", "15.9
    mm"], alpha="20 deg", beta="24 deg")``.

    Options: ``length``, ``diameters`` or ``masses``, ``alpha``, ``beta``, ``angle_uncertainty``, ``gravity``.
    Returns speed, restitution and velocities with their uncertainties, SI; for data, columns with one row per trial.
    """
    found = json.loads(_native.cradle(_data(data), _words(options)))
    if isinstance(found, dict):
        return found
    names = found[0] if found else {}
    return {name: _array([row[name] for row in found]) for name in names}


def check(case: Case) -> str:
    """Returns the text of ``fem-run check --resolved``: the case with all defaults, and a description of the expected run."""
    _native_of(case)
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


def _native_of(case: Any) -> _native.Case:
    if not isinstance(case, Case):
        raise TypeError(f"case must be a fem_run.Case, not {shown(case)}; fem_run.Case.load(path) reads one")
    return case._native


def _data(data: Any) -> tuple[str, bytes] | None:
    """Returns the name of the data and their bytes."""
    if data is None:
        return None
    if isinstance(data, (str, os.PathLike)):
        return _file(os.fspath(data))
    if isinstance(data, Table):
        return "<table>", data.to_csv().encode()
    if hasattr(data, "to_dict") and hasattr(data, "columns"):
        data = {name: data[name].to_numpy() for name in data.columns}
    if not isinstance(data, Mapping):
        raise TypeError(f"data are the path of a CSV file, a table, a data frame or a dict of columns, not {shown(data)}")
    columns = {str(name): _column(str(name), values) for name, values in data.items()}
    lengths = {name: len(values) for name, values in columns.items()}
    if len(set(lengths.values())) > 1:
        lengths_text = ", ".join(f"{name} has {n}" for name, n in lengths.items())
        raise bad_input(f"<data>: the columns differ in length: {lengths_text}", "each row has one value per column")
    return "<data>", Table(columns, []).to_csv().encode()


def _file(path: str) -> tuple[str, bytes]:
    try:
        with open(path, "rb") as file:
            return path, file.read()
    except FileNotFoundError as error:
        raise bad_input(f"{path}: there is no such file", "data are the path of a CSV file, a table, a data frame or a dict of columns") from error
    except OSError as error:
        raise bad_input(f"{path}: {error.strerror}", "name a file that can be read") from error


def _column(name: str, values: Any) -> np.ndarray[Any, Any]:
    if isinstance(values, (str, bytes)) or not hasattr(values, "__iter__") or getattr(values, "ndim", 1) != 1:
        shape = getattr(values, "shape", None)
        found = f"an array of shape {shape}" if shape is not None else shown(values)
        raise bad_input(f"<data>: {name} is {found}", "a column is a list or an array of shape (n,)")
    return _array(list(values))
