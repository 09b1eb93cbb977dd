"""Results of a collision."""

from __future__ import annotations

import html
import json
import os
from functools import cached_property
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

if TYPE_CHECKING:
    import pyvista

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
    """A computed collision. The keys of :attr:`summary` are also attributes: ``result.restitution``."""

    def __init__(self, outcome: _native.Outcome, stem: str) -> None:
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
        """Returns the snapshot with a label: ``mid-compression``, ``maximum``, ``mid-separation`` or ``last-contact``.

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

        ``None`` if one part is not known; ``summary["uncertainty"]`` has the other one.

        Raises:
            KeyError: the quantity has no error bar.
        """
        if key not in self.summary["uncertainty"]:
            there = ", ".join(self.summary["uncertainty"])
            raise KeyError(f"{key!r} has no error bar; there are: {there}")
        known, is_whole = self._error_bar(key)
        return known if is_whole else None

    def _error_bar(self, key: str) -> tuple[float, bool]:
        """Returns the sum of the known parts, and whether all are known."""
        parts = self.summary["uncertainty"][key]
        known = sum(part for part in parts.values() if part is not None)
        return known, None not in (parts["discretisation"], parts["model"])

    def __getattr__(self, name: str) -> Any:
        if not name.startswith("_") and name in self.summary:
            return self.summary[name]
        raise AttributeError(f"a result has no {name!r}; its summary has {', '.join(self.summary)}")

    def __dir__(self) -> list[str]:
        return sorted({*super().__dir__(), *self.summary})

    def __repr__(self) -> str:
        shown = [f"{key}={self.summary[key]!r}" for key in _SHOWN]
        shown += [] if self.summary["complete"] else ["complete=False"]
        return f"<fem_run.Result {', '.join(shown)}>"

    def _repr_html_(self) -> str:
        def row(key: str, name: str, unit: str) -> str:
            value, (bar, is_whole) = self.summary[key], self._error_bar(key)
            shown = "–" if value is None else f"{value:.6g}"
            sign = "±" if is_whole else "error at least"
            error = "" if value is None or not bar else f"{sign} {bar:.1g}"
            return f"<tr><td>{name}</td><td>{shown}</td><td>{error}</td><td>{unit}</td></tr>"

        rows = "".join(row(key, *names) for key, names in _SHOWN.items())
        title = html.escape(self.summary["case"].get("title") or "")
        warnings = "".join(f"<li>{html.escape(text)}</li>" for text in self.summary["warnings"])
        warnings_text = f"Warnings:<ul>{warnings}</ul>" if warnings else ""
        return f"<table><caption>{title}</caption>{rows}</table>{warnings_text}"


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
