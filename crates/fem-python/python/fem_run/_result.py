"""Results of a collision."""

from __future__ import annotations

import html
import json
import os
from collections.abc import Mapping
from functools import cached_property
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from ._errors import bad_input
from ._shown import axes_or_new, quantity, scale_of

if TYPE_CHECKING:
    import pyvista
    from matplotlib.axes import Axes

    from . import _native

#: Keys of the summary that :class:`Result` shows, also in a notebook, and their names.
_SHOWN = {
    "restitution": ("restitution", ""),
    "contact_time_s": ("contact time", "s"),
    "peak_force_n": ("peak force", "N"),
    "max_approach_m": ("largest approach", "m"),
    "max_contact_radius_m": ("largest contact radius", "m"),
    "peak_pressure_pa": ("peak pressure", "Pa"),
}


class Result:
    """A computed collision. The keys of :attr:`summary` are also attributes: ``result.restitution``.

    Results are equal if their numbers are, whatever their runs cost. They can be copied, pickled and hashed; a pickled
    one keeps summary, history and snapshots, but :meth:`save` belongs to the process that computed it.
    """

    restitution: float | None
    contact_time_s: float | None
    peak_force_n: float | None
    max_approach_m: float | None
    max_contact_radius_m: float | None
    peak_pressure_pa: float | None
    status: dict[str, str]
    peak_force_raw_n: float | None
    radius_and_pressure: str
    elastic_null: dict[str, Any] | None
    stress_error: dict[str, float] | None
    contact_episodes: int
    hertz: dict[str, Any]
    energy: dict[str, Any]
    momentum_residual_relative: float | None
    bounces: list[dict[str, Any]] | None
    adhesion: dict[str, Any] | None
    tangential_restitution: float | None
    contact_patch_rebound_deg: float | None
    impulse_ratio: float | None
    psi_before: float | None
    psi_after: float | None
    plate: dict[str, Any] | None
    relaxation_coverage: dict[str, Any] | None
    dent: list[dict[str, Any]] | None
    rest: dict[str, Any] | None
    bodies: list[dict[str, Any]]
    time_step_s: float | None
    steps: int | None
    element_updates: int | None
    cost: dict[str, Any]
    effects: list[dict[str, Any]]
    coarser_meshes: list[dict[str, Any]] | None
    models_considered: list[dict[str, Any]] | None
    warnings: list[str]
    complete: bool
    stopped_because: str | None
    program: str
    version: str
    numerics: str
    measured_restitution: list[dict[str, Any]]
    made_from: str
    source: str | None
    files: list[str]
    case: dict[str, Any]

    def __init__(self, outcome: _native.Outcome | _Pickled, stem: str) -> None:
        self._outcome = outcome
        self._stem = stem

    @cached_property
    def summary(self) -> dict[str, Any]:
        """The keys of ``summary.json``: numbers in SI, ``None`` if they have no meaning."""
        return json.loads(self._outcome.summary())

    @cached_property
    def history(self) -> dict[str, NDArray[np.float64]]:
        """The columns of ``history.csv``, arrays of shape (n,) in SI: ``time_s``, ``contact_force_n``, …"""
        return dict(self._outcome.history())

    @cached_property
    def snapshots(self) -> list[Snapshot]:
        """The fields at the instants that the case requests, in time order."""
        return [Snapshot(*parts) for parts in self._outcome.snapshots()]

    def snapshot(self, label: str) -> Snapshot:
        """Returns the snapshot with a label: ``mid-compression``, ``maximum``, ``mid-separation``, ``last-contact``
        or, of bodies that flowed, ``after-separation``.

        Raises:
            KeyError: there is no snapshot with this label.
        """
        for snapshot in self.snapshots:
            if snapshot.label == label:
                return snapshot
        there = ", ".join(snapshot.label for snapshot in self.snapshots) or "none"
        raise KeyError(f"no snapshot {label!r}; there are: {there}")

    def save(self, folder: str | os.PathLike[str] | None = None, *, force: bool = False) -> str:
        """Writes the result folder, as ``fem-run CASE --out FOLDER`` does, and returns its path.

        Without ``folder`` it is ``runs/`` with the case's :attr:`~Case.folder_name`. ``force`` replaces another case's
        result.

        Raises:
            InputError: the folder holds something else.
        """
        if folder is None:
            folder = os.path.join("runs", self._outcome.folder_name(self._stem))
        self._outcome.save(os.fspath(folder), self._stem, force)
        return os.fspath(folder)

    def uncertainty(self, key: str) -> float | None:
        """Returns the error bar of a quantity, such as ``restitution``: discretisation error plus neglected effects, SI.

        ``None`` for a bound (:attr:`status`), and if one part is not known; ``summary["uncertainty"]`` has the others.

        Raises:
            KeyError: the quantity has no error bar.
        """
        if key not in self.summary["uncertainty"]:
            there = ", ".join(self.summary["uncertainty"])
            raise KeyError(f"{key!r} has no error bar; there are: {there}")
        parts = self.summary["uncertainty"][key]
        if None in (parts["discretisation"], parts["model"]):
            return None
        return parts["discretisation"] + parts["model"] + (parts["input"] or 0.0)

    if not TYPE_CHECKING:

        def __getattr__(self, name: str) -> Any:
            if name.startswith("_"):
                raise AttributeError(name)
            if name in self.summary:
                return self.summary[name]
            raise AttributeError(f"a result has no {name!r}; its summary has {', '.join(self.summary)}")

    def __eq__(self, other: object) -> bool:
        if not isinstance(other, Result):
            return NotImplemented
        return self._numbers() == other._numbers() and same_arrays(self.history, other.history)

    def __hash__(self) -> int:
        return hash((self.summary["made_from"], self.summary["restitution"], self.summary["complete"]))

    def __copy__(self) -> Result:
        return Result(self._outcome, self._stem)

    def __deepcopy__(self, _: dict[int, Any]) -> Result:
        return Result(self._outcome, self._stem)

    def __reduce__(self) -> tuple[object, ...]:
        one = self._outcome
        return _unpickled, (one.summary(), one.history(), one.snapshots(), one.folder_name(self._stem), self._stem)

    def _numbers(self) -> dict[str, Any]:
        """Returns the summary without what differs between runs."""
        return {key: value for key, value in self.summary.items() if key not in ("cost", "files")}

    def __dir__(self) -> list[str]:
        return sorted({*super().__dir__(), *self.summary})

    def plot(self, axes: Axes | None = None) -> Axes:
        """Draws the contact force over time with matplotlib, ``pip install fem-run[plot]``, and returns the axes.

        Raises:
            ImportError: matplotlib is not installed.
            InputError: the model computes no history.
        """
        if "contact_force_n" not in self.history or not len(self.history["time_s"]):
            raise bad_input("this result has no history to plot", "the models fem, condensed and law compute one")
        axes = axes_or_new(axes)
        scales = []
        for name, unit in (("time_s", "s"), ("contact_force_n", "N")):
            values = self.history[name]
            scales.append((values, *scale_of(float(np.nanmax(np.abs(values))), unit)))
        (times, per_s, s), (forces, per_n, n) = scales
        axes.plot(per_s * times, per_n * forces)
        axes.set(xlabel=f"time [{s}]", ylabel=f"contact force [{n}]")
        title = self.summary["case"].get("title") or ""
        # A case of a dict has no name.
        axes.set_title(title.removeprefix("<dict>").removeprefix(", "), fontsize="medium", wrap=True)
        return axes

    def _shown(self, key: str, unit: str) -> str:
        return quantity(self.summary[key], self.uncertainty(key), self.summary["uncertainty"][key].get("bound"), unit)

    def __repr__(self) -> str:
        shown = [f"{name} {self._shown(key, unit)}" for key, (name, unit) in _SHOWN.items()]
        shown += [] if self.summary["complete"] else ["complete=False"]
        return f"<fem_run.Result {', '.join(shown)}>"

    def _repr_html_(self) -> str:
        names = _SHOWN.items()
        rows = "".join(f"<tr><td>{name}</td><td>{self._shown(key, unit)}</td></tr>" for key, (name, unit) in names)
        title = html.escape(self.summary["case"].get("title") or "")
        warnings = "".join(f"<li>{html.escape(text)}</li>" for text in self.summary["warnings"])
        warnings_text = f"Warnings:<ul>{warnings}</ul>" if warnings else ""
        return f"<table><caption>{title}</caption>{rows}</table>{warnings_text}"


class _Pickled:
    """The numbers of a result from another process, in the form of ``_native.Outcome``."""

    def __init__(self, summary: str, history: Any, snapshots: Any, folder: str) -> None:
        self._parts = summary, history, snapshots, folder

    def summary(self) -> str:
        return self._parts[0]

    def history(self) -> list[tuple[str, NDArray[np.float64]]]:
        return self._parts[1]

    def snapshots(self) -> list[Any]:
        return self._parts[2]

    def folder_name(self, _: str) -> str:
        return self._parts[3]

    def failure(self) -> None:
        return None

    def save(self, folder: str, stem: str, force: bool) -> None:
        raise bad_input(
            f"{folder}: a result that was pickled cannot be saved",
            "save it in the process that computed it, or run its case again",
        )


def _unpickled(summary: str, history: Any, snapshots: Any, folder: str, stem: str) -> Result:
    return Result(_Pickled(summary, history, snapshots, folder), stem)


def same_arrays(one: Mapping[str, NDArray[Any]], other: Mapping[str, NDArray[Any]]) -> bool:
    """Returns whether columns have the same names and values; missing numbers are equal."""
    return list(one) == list(other) and all(_same(one[name], other[name]) for name in one)


def _same(one: NDArray[Any], other: NDArray[Any]) -> bool:
    return np.array_equal(one, other, equal_nan=one.dtype.kind == other.dtype.kind == "f")


class Snapshot:
    """Both bodies at an instant; arrays as in the VTK file of the result folder.

    Attributes:
        label: label of the instant.
        time: time, s.
        points: reference positions (r, y, 0), shape (n, 3), m.
        quads: corners of the cells, indices of points, shape (m, 4).
        point_data: ``displacement`` (n, 3) m, ``velocity`` (n, 3) m/s, and smooth stresses (n,) Pa, by name.
        cell_data: ``sigma_rr``, ``sigma_yy``, ``sigma_tt``, ``sigma_ry``, ``pressure``, ``von_mises`` (m,) Pa;
            ``body`` (m,), 0 or 1.
    """

    def __init__(
        self,
        label: str,
        time: float,
        grid: dict[str, NDArray[Any]],
        point_data: dict[str, NDArray[Any]],
        cell_data: dict[str, NDArray[Any]],
    ) -> None:
        self.label = label
        self.time = time
        self.points: NDArray[np.float64] = grid["points"]
        self.quads: NDArray[np.int64] = grid["quads"]
        self.point_data = {name: _flat(array) for name, array in point_data.items()}
        self.cell_data = {name: _flat(array) for name, array in cell_data.items()}

    def to_pyvista(self) -> pyvista.UnstructuredGrid:
        """Returns a grid of PyVista, which must be installed."""
        import pyvista

        grid = pyvista.UnstructuredGrid({pyvista.CellType.QUAD: self.quads}, self.points)
        grid.point_data.update(self.point_data)
        grid.cell_data.update(self.cell_data)
        grid.field_data["TimeValue"] = [self.time]
        return grid

    def __repr__(self) -> str:
        return f"<fem_run.Snapshot {self.label!r} at {self.time:.4g} s, {len(self.quads)} cells>"


def _flat(array: NDArray[Any]) -> NDArray[Any]:
    """Removes the second axis of an array with one value per point or cell."""
    return array[:, 0] if array.ndim == 2 and array.shape[1] == 1 else array
