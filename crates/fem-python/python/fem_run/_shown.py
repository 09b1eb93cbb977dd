"""Numbers with units and error bars, and plots of them."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from matplotlib.axes import Axes

_PREFIXES = {-12: "p", -9: "n", -6: "µ", -3: "m", 0: "", 3: "k", 6: "M", 9: "G", 12: "T"}


def scale_of(value: float, unit: str) -> tuple[float, str]:
    """Returns the factor to a unit with a prefix that leaves one to three digits before the point, and that unit."""
    if not unit.isalpha() or not value or not math.isfinite(value):
        return 1.0, unit
    power = min(max(3 * math.floor(math.log10(abs(value)) / 3), -12), 12)
    return 10.0**-power, _PREFIXES[power] + unit


def quantity(value: float | None, bar: float | None, bound: str | None, unit: str) -> str:
    """Returns ``62.36 ± 0.47 µs``: digits as the error bar allows, which has two; of a bound ``at most 0.9999``, and
    ``0.993 ± ?`` if a part of the error is not known."""
    if value is None or not math.isfinite(value):
        return "none"
    factor, unit = scale_of(value, unit)
    value = factor * value
    if not bar:
        number = f"{value:.4f}" if bound and not unit else f"{value:.6g}"
        before, after = (f"{bound} ", "") if bound else ("", " ± ?" if bar is None else "")
        return f"{before}{number}{after} {unit}".strip()
    bar *= factor
    digits = min(max(1 - math.floor(math.log10(bar)), 0), 9)
    return f"{value:.{digits}f} ± {bar:.{digits}f} {unit}".strip()


def axes_or_new(axes: Axes | None) -> Axes:
    """Returns the axes to draw on.

    Raises:
        ImportError: matplotlib is not installed.
    """
    if axes is not None:
        return axes
    try:
        from matplotlib import pyplot
    except ImportError as error:
        raise ImportError("plots need matplotlib: pip install 'fem-run[plot]'") from error
    return pyplot.subplots(figsize=(5, 3.2), layout="constrained")[1]


def label(column: str) -> str:
    """Returns the name of a column in words, with its unit in brackets."""
    units: dict[str, str] = {"_m_s": "m/s", "_pa": "Pa", "_s": "s", "_n": "N", "_m": "m", "_j": "J"}
    for ending, unit in units.items():
        if column.endswith(ending):
            return f"{_words(column.removesuffix(ending))} [{unit}]"
    return _words(column)


def _words(column: str) -> str:
    return column.rsplit(".", 1)[-1].replace("_", " ")


def restitutions(
    axes: Axes | None, x: str, data: tuple[Any, Any, Any], lines: list[tuple[str, Any, Any]]
) -> Axes:
    """Draws restitutions over a column: points with uncertainties, of which some or all may be ``None``, and named curves.

    Raises:
        ImportError: matplotlib is not installed.
    """
    import numpy as np

    axes = axes_or_new(axes)
    places, values, errors = data
    bars = None if errors is None else np.nan_to_num(np.array(errors, dtype=float))
    axes.errorbar(places, values, yerr=bars, fmt=".", capsize=3, label="data")
    for name, at, curve in lines:
        axes.plot(at, np.array(curve, dtype=float), label=name)
    axes.set_xscale("log")
    axes.set(xlabel=label(x), ylabel="restitution")
    axes.legend(fontsize="small")
    return axes


def errors_of(table: Any, column: str) -> Any:
    """Returns the error bars of a column of a table, with the parts that are known; ``None`` if it has none."""
    import numpy as np

    parts = [f"uncertainty_{part}_{column}" for part in ("discretisation", "model", "input")]
    there = [table[name] for name in parts if name in table and table[name].dtype.kind == "f"]
    return sum(np.nan_to_num(part) for part in there) if there else None
