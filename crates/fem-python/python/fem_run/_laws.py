"""Contact laws, calibration and experiments: the results of the commands of these names, without their files.

Keyword arguments are the options of the command: ``contact_time=True`` for ``--contact-time``, lists and dicts for
options that may be repeated, a pair for a range. ``columns={"speed": "v"}`` names columns of the data. Quantities are
numbers in SI or strings with a unit. Data are the path of a CSV file, a :class:`fem_run.Table`, a data frame, a
measurement of the materials library, ``"lib:ice"``, or a dict of columns with the names of docs/fits.md:
``speed_m_s``, ``restitution``.
"""

from __future__ import annotations

import html
import json
import os
import tempfile
from collections.abc import Mapping, Sequence
from typing import TYPE_CHECKING, Any, Literal

import numpy as np

from . import _native
from ._case import Case
from ._errors import bad_input, shown
from ._shown import quantity, restitutions, scale_of
from ._sweep import Table, _array
from ._words import in_python

if TYPE_CHECKING:
    from matplotlib.axes import Axes

#: A contact law.
Law = Literal[
    "linear",
    "power",
    "hertz",
    "kuwabara_kono",
    "hunt_crossley",
    "tsuji",
    "zhang_whiten",
    "falcon",
    "hertz_dashpot",
    "mishra_murty",
    "schwager_poeschel",
    "morgado_oppenheim",
    "bordbar_hyppanen",
    "thornton",
    "johnson",
    "jackson_green",
    "brake",
    "mean_pressure",
    "walton_braun",
    "luding",
    "mdr",
    "ting",
]
#: A code of the discrete element method.
Code = Literal["lammps", "liggghts", "yade", "mercurydpm", "lethe", "mfix-dem", "drake", "mujoco", "newton"]
#: When a contact ends: at zero force, or at zero overlap.
End = Literal["zero_force", "zero_overlap"]
#: A number in SI, or a text with a unit.
Quantity = float | str
#: Names of columns by their meaning.
Columns = Mapping[str, str]

#: Options that take a list in one word; others are repeated.
_LISTED = {"free", "diameters", "masses"}


def _listed(warnings: Sequence[str]) -> str:
    """Returns warnings as a list of HTML."""
    items = "".join(f"<li>{html.escape(text)}</li>" for text in warnings)
    return f"Warnings:<ul>{items}</ul>" if items else ""


class Fit(dict[str, Any]):
    """The keys of ``fit.json``, SI; shown as the values of the parameters with their standard errors."""

    def _values(self) -> dict[str, str]:
        return {
            one["key"]: quantity(one["value"], one["standard_error"] or 0.0, None, one["unit"] or "")
            for one in self["parameters"]
        }

    def __repr__(self) -> str:
        values = ", ".join(f"{key} = {value}" for key, value in self._values().items())
        return f"<fem_run.Fit {self['law']}: {values}; rms error {self['rms']:.3g} of {self['points']} points>"

    def _repr_html_(self) -> str:
        rows = "".join(f"<tr><td>{html.escape(key)}</td><td>{value}</td></tr>" for key, value in self._values().items())
        rows += f"<tr><td>rms error</td><td>{self['rms']:.3g}, {self['points']} points</td></tr>"
        return f"<table><caption>{html.escape(self['law'])}</caption>{rows}</table>{_listed(self['warnings'])}"

    def plot(self, axes: Axes | None = None) -> Axes:
        """Draws the data and the restitution of each law over the speed with matplotlib, ``pip install fem-run[plot]``.

        Args:
            axes: the axes to draw on; new ones if ``None``.

        Raises:
            ImportError: matplotlib is not installed.
        """
        if "curves" not in self:
            raise bad_input("a fit of the friction has no curves to plot", "its rows are in fit[\"measured\"]")
        curves, measured = self["curves"], self["measured"]
        lines = [(law["law"], curves["speed_m_s"], law["restitution"]) for law in curves["laws"]]
        errors = measured["restitution_uncertainty"]
        return restitutions(axes, "speed_m_s", (measured["speed_m_s"], measured["restitution"], errors), lines)


class Calibration(dict[str, Any]):
    """The keys of ``calibrate.json``, SI, and ``relaxation_toml``; shown as the terms with their ranges."""

    def _times(self) -> list[str]:
        scales = [(one["relaxation_time_s"], *scale_of(one["relaxation_time_s"], "s")) for one in self["terms"]]
        return [f"{factor * time:.3g} {unit}" for time, factor, unit in scales]

    def __repr__(self) -> str:
        terms = ", ".join(f"{one['weight']:.3g} at {time}" for one, time in zip(self["terms"], self._times()))
        return f"<fem_run.Calibration of {self['material']}: weights {terms}; rms error {self['rms']:.3g} of {self['points']} points>"

    def _repr_html_(self) -> str:
        rows = "".join(
            f"<tr><td>{time}</td><td>{one['weight']:.3g}</td>"
            f"<td>{one['range'][0]:.3g} to {one['range'][1]:.3g}</td></tr>"
            for one, time in zip(self["terms"], self._times())
        )
        head = f"<tr><th>relaxation time</th><th>weight</th><th>{100 * self['confidence']:.3g} % range</th></tr>"
        rows += f"<tr><td>rms error</td><td>{self['rms']:.3g}</td><td>{self['points']} points</td></tr>"
        return f"<table><caption>{html.escape(self['material'])}</caption>{head}{rows}</table>{_listed(self['warnings'])}"

    def plot(self, axes: Axes | None = None) -> Axes:
        """Draws the data, the best series and a single Maxwell term with matplotlib, ``pip install fem-run[plot]``.

        Args:
            axes: the axes to draw on; new ones if ``None``.

        Raises:
            ImportError: matplotlib is not installed.
            InputError: the collisions of the curves cannot be computed.
        """
        curves = self["curves"]
        if curves is None:
            raise bad_input("this calibration has no curves to plot", "see its warnings")
        x = curves["over"]
        names = (("best", "best series"), ("maxwell", "single Maxwell term"))
        lines = [(name, curves[key][x], curves[key]["restitution"]) for key, name in names]
        return restitutions(axes, x, (curves["data"][x], curves["data"]["restitution"], None), lines)


def fit(
    case: Case,
    data: Any,
    *,
    law: Law | Literal["all"] | None = None,
    code: Code | None = None,
    free: str | Sequence[str] | None = None,
    param: Mapping[str, Quantity] | None = None,
    end: End | None = None,
    bounds: Mapping[str, tuple[Quantity, Quantity]] | None = None,
    profile: str | None = None,
    compare: Law | Sequence[Law] | None = None,
    contact_time: bool = False,
    robust: bool = False,
    as_elastic: bool = False,
    confidence: float | None = None,
    columns: Columns | None = None,
) -> Fit:
    """Fits parameters of a contact law to restitutions over speed: ``fit(case, table, law="ting")``.

    Args:
        case: the two bodies.
        data: restitutions, and their uncertainties if there are any; or rebounds over the impact angle, which give the
            coefficient of friction: ``{"impact_angle_deg": [20, 40], "rebound_angle_deg": [12, 33]}``.
        law: the law; by default that of the case's model, or ``"all"``: the one that explains the data best.
        code: the code that must have the law, ``"lammps"``; then the best of its laws is found.
        free: parameters to fit; by default the damping.
        param: values of other parameters, and starts of the free ones.
        end: when a contact ends.
        bounds: range of each free parameter, ``{"n": (0.3, 1.5)}``.
        profile: parameter over which the error is computed with all others fitted again.
        compare: laws that are fitted too.
        contact_time: whether the column ``contact_time_s`` is fitted too.
        robust: whether points far from the curve count little; their weights are in ``fit["measured"]["weight"]``.
        as_elastic: whether restitutions that are upper bounds are taken as they are.
        confidence: level of the intervals, 0.95 by default.
        columns: names of the columns by their meaning.

    Returns:
        The keys of ``fit.json``, SI; ``plot()`` draws them.

    Raises:
        InputError: the options or the data are invalid.
    """
    return Fit(_found(_native.numbers_of("fit", _native_of(case), _data(data), _words(locals()))))


def invert(
    case: Case,
    restitution: Quantity | None = None,
    *,
    rebound_angle: str | None = None,
    contact_patch_rebound: str | None = None,
    spin_after: Quantity | None = None,
    tangential_velocity_after: Quantity | None = None,
    impact_angle: str | None = None,
    law: Law | None = None,
    find: str | None = None,
    param: Mapping[str, Quantity] | None = None,
    end: End | None = None,
    speed: Quantity | None = None,
) -> dict[str, Any]:
    """Finds the parameter of a law that gives a restitution at one speed, or the friction that gives a rebound.

    Args:
        case: the two bodies.
        restitution: between 0 and 1; with an uncertainty, ``"0.92 ± 0.01"``, so has the parameter.
        rebound_angle: angle of the rebounding ball against the axis, ``"12 ± 0.5 deg"``: the result is then that of
            ``fit`` to rebounds, with ``friction`` in ``parameters``.
        contact_patch_rebound: the angle of its contact patch.
        spin_after: its spin.
        tangential_velocity_after: its tangential velocity.
        impact_angle: the angle before; by default that of the case.
        law: the law; by default that of the case's model, or else all.
        find: the parameter; by default the damping.
        param: values of other parameters.
        end: when a contact ends.
        speed: the approach speed; by default that of the case.

    Returns:
        ``solutions``, each with ``law``, ``parameter``, ``value``, ``standard_error`` by the restitution and uncertain
        inputs of the case (else None), ``inputs``, its parts, ``range_by_law`` within the law's own error, ``at_least`` if any stronger body has
        this restitution too (else None), and ``contact_time_s``, SI, and ``unsolved``: laws with the reason. A ``yield_strength`` is at the strain rate of the contact: if a material has ``flow.rate``, its
        ``strength_at_reference_rate_pa`` is the key ``flow.yield_strength`` of the case (else None).
    """
    return _found(_native.numbers_of("invert", _native_of(case), None, _words(locals())))


def export(
    case: Case,
    data: Any = None,
    *,
    fit: str | os.PathLike[str] | Fit | None = None,
    speeds: tuple[Quantity, Quantity] | str | None = None,
    materials: str | Sequence[str] | None = None,
    diameters: Quantity | Sequence[Quantity] | None = None,
    law: bool = False,
    tolerance: float | None = None,
    as_elastic: bool = False,
    columns: Columns | None = None,
) -> dict[str, Any]:
    """Writes input for DEM codes and robotics that reproduces the restitutions.

    For LAMMPS, LIGGGHTS, YADE, MercuryDPM, Lethe, MFIX-DEM, Drake, MuJoCo and Newton.

    Args:
        case: the two bodies.
        data: restitutions; by default they are computed.
        fit: the result of :func:`fit`, the folder of one or its ``fit.json``; the fitted law then gives the restitutions.
        speeds: range of the computed restitutions; by default a decade about the speed of the case, or the speeds of
            the fit.
        materials: names of materials for a table of all pairs, of the case or ``"lib:NAME"``.
        diameters: diameters of spheres for a table of all pairs.
        law: whether the computed pair is written as a contact law in one C header, ``pair_case.h``.
        tolerance: largest error of the restitution at which a snippet counts as valid; by default 0.01 or, if that is
            larger, the scatter of the data.
        as_elastic: whether restitutions that are upper bounds are taken as they are.
        columns: names of the columns by their meaning.

    Returns:
        The keys of ``export.json``, and ``texts``: the files by name.
    """
    words = _words({**locals(), "fit": None})
    if fit is None:
        return _found(_native.numbers_of("export", _native_of(case), _data(data), words))
    with tempfile.TemporaryDirectory() as folder:
        if isinstance(fit, Mapping):
            path = os.path.join(folder, "fit.json")
            with open(path, "w", encoding="utf-8") as file:
                json.dump(fit, file)
        else:
            path = os.fspath(fit)
        return _found(_native.numbers_of("export", _native_of(case), _data(data), [*words, f"--fit={path}"]))


def calibrate(
    case: Case,
    data: Any,
    *,
    terms: int | None = None,
    times: tuple[Quantity, Quantity] | None = None,
    acts_on: Literal["all", "shear"] | None = None,
    material: str | None = None,
    regularisation: float | None = None,
    uncertainty: float | None = None,
    model: Literal["condensed", "ting"] | None = None,
    robust: bool = False,
    as_elastic: bool = False,
    prior: bool = False,
    confidence: float | None = None,
    columns: Columns | None = None,
) -> Calibration:
    """Finds a Prony series from measured restitutions, and what they leave undetermined.

    Args:
        case: the bodies and their instantaneous moduli.
        data: restitutions, of several pairs if they have the columns ``diameter_1_mm`` and ``diameter_2_mm``.
        terms: number of terms, 4 by default.
        times: relaxation times of the first and the last term.
        acts_on: the moduli that relax.
        material: the material to calibrate if the bodies differ.
        regularisation: the error of a restitution that costs as much as a weight of 1.
        uncertainty: standard uncertainty of the restitutions if the data have none.
        model: the model that computes the collisions, by default ``"condensed"``, or ``"ting"`` for a plate that bends.
        robust: whether points far from the curve count little; their weights are in ``curves["data"]["weight"]``.
        as_elastic: whether restitutions that are upper bounds are taken as they are.
        prior: whether the measured relaxation of the case is prior knowledge, whose weights move within their uncertainties.
        confidence: level of the ranges, 0.95 by default.
        columns: names of the columns by their meaning.

    Returns:
        The keys of ``calibrate.json``, and ``relaxation_toml`` to paste into a case; ``plot()`` draws them.
    """
    return Calibration(_found(_native.numbers_of("calibrate", _native_of(case), _data(data), _words(locals()))))


def cradle(
    data: Any = None,
    *,
    length: Quantity | None = None,
    diameters: Sequence[Quantity] | None = None,
    masses: Sequence[Quantity] | None = None,
    alpha: Quantity | None = None,
    beta: Quantity | None = None,
    angle_uncertainty: Quantity | None = None,
    gravity: Quantity | None = None,
    columns: Columns | None = None,
) -> Any:
    """Computes the restitution from the angles of a Newton's cradle: ``cradle(length="20 cm", diameters=["22.2 mm", "15.9
    mm"], alpha="20 deg", beta="24 deg")``.

    Args:
        data: trials with the columns ``alpha_deg`` and ``beta_deg``; without them ``alpha`` and ``beta`` are one.
        length: distance from the pivot to a ball's centre; ``"20 cm ± 1 mm"`` has a standard uncertainty.
        diameters: those of the first and the second ball, of the same material.
        masses: those of the first and the second ball.
        alpha: angle from which the first ball is released.
        beta: angle to which the second ball rises.
        angle_uncertainty: uncertainty of angles without one.
        gravity: acceleration of free fall, 9.80665 m/s² by default.
        columns: names of the columns by their meaning.

    Returns:
        Speed, restitution and velocities with their uncertainties, SI; for data, columns with one row per trial.
    """
    found = _found(_native.numbers_of("cradle", None, _data(data), _words(locals())))
    if isinstance(found, dict):
        return found
    names = found[0] if found else {}
    return {name: _array([row[name] for row in found]) for name in names}


class Measurement(dict[str, Any]):
    """The keys of ``measure.json``, SI, and ``svg``, the picture; shown as the picture, or as the range of the restitutions.

    It is data for :func:`fit` and :func:`calibrate`: ``fit(case, measure("drop.csv").table())``.
    """

    def table(self) -> dict[str, np.ndarray[Any, Any]]:
        """Returns the columns of ``measure.csv``, one row per impact; ``nan`` for what is not known."""
        names = list(dict.fromkeys(name for impact in self["impacts"] for name in impact))
        rows = [[float("nan") if row[name] is None else row[name] for row in self["impacts"]] for name in names]
        columns = {name: _array(values) for name, values in zip(names, rows)}
        return {name: values for name, values in columns.items() if not np.isnan(values).all()}

    def __repr__(self) -> str:
        values = [impact["restitution"] for impact in self["impacts"]]
        return f"<fem_run.Measurement of {self['kind']}: {len(values)} restitutions from {min(values):.4g} to {max(values):.4g}>"

    def _repr_html_(self) -> str:
        return f"{self['svg']}{_listed(self['warnings'])}"

    def plot(self, axes: Axes | None = None) -> Axes:
        """Draws the restitutions over the speed with matplotlib, ``pip install fem-run[plot]``.

        Args:
            axes: the axes to draw on; new ones if ``None``.

        Raises:
            ImportError: matplotlib is not installed.
        """
        table = self.table()
        errors = table.get("restitution_uncertainty")
        return restitutions(axes, "speed_m_s", (table["speed_m_s"], table["restitution"], errors), [])


def measure(
    data: Any,
    *,
    kind: Literal["bounces", "track", "force", "sound"] | None = None,
    gravity: Quantity | None = None,
    height: Quantity | None = None,
    diameter: Quantity | None = None,
    density: Quantity | None = None,
    contact_time: Quantity | None = None,
    time_uncertainty: Quantity | None = None,
    rest: Quantity | None = None,
    mass: Quantity | None = None,
    sensor_mass: Quantity | None = None,
    speed: Quantity | None = None,
    force_uncertainty: Quantity | None = None,
    frame_rate: Quantity | None = None,
    scale: Quantity | None = None,
    columns: Columns | None = None,
) -> Measurement:
    """Turns a record of a bouncing ball into restitutions over speed: ``measure("drop.csv", height="50 cm ± 1 mm")``.

    Args:
        data: the record: instants of bounces, a track of heights, a force over time, or a sound (the path of a WAV file).
        kind: the kind of the record; by default its columns decide.
        gravity: acceleration of free fall, 9.80665 m/s² by default; that of a track is fitted.
        height: height of the drop, from the ball's lowest point to the plate.
        diameter: diameter of the ball; with ``density`` it gives the air drag.
        density: density of the ball.
        contact_time: contact time of a bounce, 0 by default.
        time_uncertainty: standard uncertainty of an instant; by default it comes from the scatter of the flights.
        rest: instant at which the ball comes to rest.
        mass: mass of the moving body, for a force.
        sensor_mass: mass between the sensor and the contact, for a force that the moving body measures.
        speed: approach speed of the first impact, for a force.
        force_uncertainty: relative standard uncertainty of the force.
        frame_rate: frames per second of a track with a column of frames.
        scale: length of a pixel of a track in pixels; by default gravity gives it.
        columns: names of the columns by their meaning: ``{"time": "t_ms"}``.

    Returns:
        The keys of ``measure.json``; ``table()`` has the columns that :func:`fit` reads, ``plot()`` draws them.

    Raises:
        InputError: the options are invalid, or the record does not support a restitution.
    """
    return Measurement(_found(_native.numbers_of("measure", None, _data({} if data is None else data), _words(locals()))))


def check(case: Case) -> str:
    """Returns the text of ``fem-run check --resolved``: the case with all defaults, and a description of the expected run."""
    _native_of(case)
    return case.check()


def _found(text: str) -> Any:
    """Returns the numbers of a job; its warnings and reasons are in Python's words."""
    found = json.loads(text)
    if isinstance(found, dict):
        if "warnings" in found:
            found["warnings"] = [in_python(warning) for warning in found["warnings"]]
        if "unsolved" in found:
            found["unsolved"] = {law: in_python(reason) for law, reason in found["unsolved"].items()}
    return found


def _words(arguments: Mapping[str, Any]) -> list[str]:
    """Returns the arguments of a function, but for case and data, as options of the command."""
    words: list[str] = []
    for name, value in arguments.items():
        option = "--" + ("for" if name == "code" else name.replace("_", "-"))
        if name in ("case", "data") or value is None or value is False:
            continue
        if value is True:
            words.append(option)
        elif isinstance(value, Mapping):
            words += [f"{option}={key}={_text(inner)}" for key, inner in value.items()]
        elif name in _LISTED and _is_list(value):
            words.append(f"{option}={','.join(map(_text, value))}")
        elif isinstance(value, tuple):
            words.append(f"{option}={_text(value)}")
        elif _is_list(value):
            words += [f"{option}={_text(inner)}" for inner in value]
        else:
            words.append(f"{option}={_text(value)}")
    return words


def _is_list(value: Any) -> bool:
    return isinstance(value, (Sequence, np.ndarray)) and not isinstance(value, (str, bytes))


def _text(value: Any) -> str:
    """Returns a value as a word of the command; a pair is a range."""
    if isinstance(value, tuple):
        return "..".join(map(_text, value))
    return repr(float(value)) if isinstance(value, float) else str(value)


def _native_of(case: Any) -> _native.Case:
    if not isinstance(case, Case):
        raise TypeError(f"case must be a fem_run.Case, not {shown(case)}; fem_run.Case.load(path) reads one")
    return case._native


def _data(data: Any) -> tuple[str, bytes] | None:
    """Returns the name of the data and their bytes."""
    if data is None:
        return None
    if isinstance(data, str) and data.startswith("lib:"):
        return data, b""
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


class Relaxation(dict[str, Any]):
    """The keys of ``relaxation.json``, SI; ``svg``, the picture; ``relaxation_toml`` and ``material_toml``, the tables of a case."""

    def __repr__(self) -> str:
        return f"<fem_run.Relaxation of {self['data']}: {len(self['terms'])} terms, rms {100 * self['rms']:.2g} %>"

    def _repr_html_(self) -> str:
        return f"{self['svg']}{_listed(self['warnings'])}"


def relaxation(
    data: Any,
    *,
    modulus: Literal["young", "shear"] | None = None,
    bulk_modulus: Quantity | None = None,
    terms_per_decade: Quantity | None = None,
    reference_temperature: str | None = None,
    vertical_shift: bool = False,
    density: Quantity | None = None,
    poissons_ratio: Quantity | None = None,
    columns: Columns | None = None,
) -> Relaxation:
    """Turns moduli over frequency or time into the Prony series of a material: ``relaxation("dma.csv")``.

    Args:
        data: frequency with storage and loss modulus or tan delta, or time with the modulus of a relaxation test.
        modulus: the modulus that was measured; by default the columns decide.
        bulk_modulus: elastic bulk modulus, so that only the shear modulus relaxes; by default Poisson's ratio is constant.
        terms_per_decade: number of terms per decade of time; by default the data decide.
        reference_temperature: temperature to which the moduli of other temperatures are shifted, ``"23 degC"``; by default
            that in the middle.
        vertical_shift: scale the moduli of each temperature too.
        density: density of the material, for its table.
        poissons_ratio: Poisson's ratio of the material, for its table.
        columns: names of the columns by their meaning: ``{"storage_modulus": "E1"}``.

    Returns:
        The keys of ``relaxation.json``, the picture, and the tables to paste into a case.

    Raises:
        InputError: the options are invalid, or the data determine no relaxation.
    """
    return Relaxation(_found(_native.numbers_of("relaxation", None, _data({} if data is None else data), _words(locals()))))
