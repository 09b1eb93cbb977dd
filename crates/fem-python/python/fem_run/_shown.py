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


def quantity(value: float | None, bar: float, is_whole: bool, unit: str) -> str:
    """Returns ``62.36 ± 0.47 µs``: digits as the error bar allows, which has two; ``bar`` is a lower bound unless
    ``is_whole``."""
    if value is None or not math.isfinite(value):
        return "none"
    factor, unit = scale_of(value, unit)
    value, bar = factor * value, factor * bar
    if not bar:
        return f"{value:.6g} {unit}".strip()
    digits = min(max(1 - math.floor(math.log10(bar)), 0), 9)
    number, error = f"{value:.{digits}f}", f"{bar:.{digits}f}"
    if is_whole:
        return f"{number} ± {error} {unit}".strip()
    return f"{number} {unit}".strip() + f" (error at least {error})"


def value_range(low: float, high: float, unit: str) -> str:
    """Returns ``29 to 49 µs``: both ends with two digits, in one unit; one number if they are alike."""
    factor, unit = scale_of(high, unit)
    ends = [_two_digits(factor * end) for end in (low, high)]
    return (ends[1] if ends[0] == ends[1] else " to ".join(ends)) + f" {unit}".rstrip()


def _two_digits(value: float) -> str:
    return f"{float(f'{value:.1e}'):g}"


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
