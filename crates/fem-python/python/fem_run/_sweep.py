"""Sweeps: one case with many values, in this process or on any executor."""

from __future__ import annotations

import itertools
import json
from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from concurrent.futures import Executor, as_completed
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from . import _native, _toml
from ._case import Case
from ._errors import Error, Interrupted, RunError, bad_input, shown
from ._progress import reporter
from ._result import same_arrays
from ._shown import axes_or_new, errors_of, label

if TYPE_CHECKING:
    import pandas
    from matplotlib.axes import Axes

#: Identity of each member, and its summary as JSON if it was computed.
_Found = list[tuple[str, "str | None"]]

#: Most tasks for an executor; each computes a part of the members.
_MOST_TASKS = 1000


class Table(Mapping[str, "NDArray[Any]"]):
    """The results of a sweep, one row per member, with columns by name as in ``sweep.csv``: arrays of shape (n,).

    First come the varied keys as given, then the same quantities in SI with the unit in the name
    (``body.0.approach_speed_m_s``), then the numbers of the summary, and ``member`` last. Missing numbers are NaN.
    """

    def __init__(self, columns: dict[str, NDArray[Any]], summaries: list[dict[str, Any]]) -> None:
        self._columns = columns
        #: The summary of each member.
        self.summaries = summaries

    def __getitem__(self, name: str) -> NDArray[Any]:
        return self._columns[name]

    def __iter__(self) -> Iterator[str]:
        return iter(self._columns)

    def __len__(self) -> int:
        return len(self._columns)

    def __eq__(self, other: object) -> bool:
        return same_arrays(self, other) if isinstance(other, Table) else NotImplemented

    __hash__ = None  # type: ignore[assignment]

    def to_pandas(self) -> pandas.DataFrame:
        """Returns a data frame of pandas, which must be installed."""
        import pandas

        return pandas.DataFrame(self._columns)

    def plot(self, y: str = "restitution", x: str | None = None, axes: Axes | None = None) -> Axes:
        """Draws a column over another one with error bars by matplotlib, ``pip install fem-run[plot]``.

        Args:
            y: the column to draw.
            x: the column below it; by default the first varied key in SI.
            axes: the axes to draw on; new ones if ``None``.

        Raises:
            KeyError: the table has no such column.
            ImportError: matplotlib is not installed.
        """
        numbers = [name for name, column in self._columns.items() if column.dtype.kind in "fi"]
        if x is None:
            keys = [name for name in numbers if "." in name]
            x = next((name for name in keys if any(name.startswith(f"{key}_") for key in self._columns)), [*keys, *numbers][0])
        for name in (x, y):
            if name not in numbers:
                raise KeyError(f"{name!r} is no column of numbers; there are: {', '.join(numbers)}")
        axes = axes_or_new(axes)
        axes.errorbar(self[x], self[y], yerr=errors_of(self, y), fmt=".", capsize=3)
        values = self[x][np.isfinite(self[x])]
        if len(values) and values.min() > 0 and values.max() > 10 * values.min():
            axes.set_xscale("log")
        axes.set(xlabel=label(x), ylabel=label(y))
        return axes

    def to_csv(self) -> str:
        """Returns the table as CSV text; :func:`fit` and others also accept the table itself."""
        import csv
        import io

        text = io.StringIO()
        writer = csv.writer(text, lineterminator="\n")
        writer.writerow(self._columns)
        for row in zip(*(column.tolist() for column in self._columns.values())):
            writer.writerow(map(_cell, row))
        return text.getvalue()

    def __repr__(self) -> str:
        return f"<fem_run.Table of {len(self.summaries)} members, columns {', '.join(self._columns)}>"

    def _repr_html_(self) -> str | None:
        """Returns an HTML table, or ``None`` without pandas; a notebook then shows the text."""
        try:
            return self.to_pandas().to_html(max_rows=20)
        except ImportError:
            return None


def sweep(
    case: Case,
    vary: Mapping[str | tuple[str, ...], Iterable[Any]],
    *,
    executor: Executor | None = None,
    threads: int | None = None,
    progress: bool | Callable[[float], object] = False,
) -> Table:
    """Computes a case for every combination of values; the last key varies fastest.

    Args:
        case: the common case.
        vary: values of dotted keys, ``{"body.0.approach_speed": np.geomspace(0.05, 2, 40)}``. A tuple of keys is
            linked: each value applies to all of them, or is a tuple with one value for each.
        executor: any ``concurrent.futures.Executor``, such as Dask's ``client.get_executor()``; by default,
            threads of this process.
        threads: number of these threads; one per processor if ``None``.
        progress: True for a bar on stderr, or a function that is called with the completed fraction.

    Returns:
        A table in the order of the combinations, with the same bits for any executor. A member whose run failed
        has ``complete`` false.

    Raises:
        InputError: a member is no valid case; nothing was computed.
        RunError: the executor broke, for example because a process was killed; ``result`` is the table of the
            members that are done.
        Interrupted: Ctrl-C ended the sweep; ``result`` is the table of the members that are done.
    """
    axes = _axes(case, vary)
    if executor is not None and not callable(getattr(executor, "submit", None)):
        raise TypeError(f"executor is a concurrent.futures.Executor, such as client.get_executor() of Dask, not {shown(executor)}")
    n_threads = _n_threads(threads)
    keys = [key for linked, _ in axes for key in linked]
    changes = [_changes(axes, chosen) for chosen in itertools.product(*(values for _, values in axes))]
    cases: list[Case] = []
    found: _Found = []
    try:
        cases += (case.with_(change) for change in changes)
        with reporter(progress, f"{len(cases)} members") as report:
            if executor is not None:
                error = _on(executor, cases, report, found)
            else:
                native = [one._native for one in cases]
                some, error = _native.run_members(native, n_threads, report)
                found += some
    except KeyboardInterrupt as interrupt:
        error = interrupt
    if isinstance(error, KeyboardInterrupt):
        raise _ended(Interrupted, "interrupted", keys, cases, changes, found)
    if isinstance(error, _Broken):
        raise _ended(RunError, str(error), keys, cases, changes, found) from error.__cause__
    if error is not None:
        raise error
    return _table(cases, keys, changes, found)


def _axes(case: Case, vary: Mapping[str | tuple[str, ...], Iterable[Any]]) -> list[tuple[tuple[str, ...], list[Any]]]:
    """Returns keys and values of each axis, checked like a sweep file."""
    if not isinstance(case, Case):
        raise TypeError(f"case must be a fem_run.Case, not {shown(case)}; fem_run.Case.load(path) reads one")
    example = '{"body.0.approach_speed": [0.1, 1.0]}'
    if not isinstance(vary, Mapping):
        raise TypeError(f"vary is a dict of keys and lists of values, such as {example}, not {shown(vary)}")
    if not vary:
        raise bad_input("the sweep varies no key", f"vary={example}")
    axes = []
    known: list[tuple[str, list[str]]] = []
    for key, of_key in vary.items():
        linked = key if isinstance(key, tuple) else (key,)
        if not linked or not all(isinstance(one, str) for one in linked):
            raise TypeError(f"a key of vary is a dotted path or a tuple of dotted paths, not {shown(key)}")
        name = ", ".join(linked)
        if isinstance(of_key, (str, bytes, Mapping)) or not isinstance(of_key, Iterable) or _is_scalar(of_key):
            raise bad_input(f"{name} is not a list: {shown(of_key)}", f"put the values in brackets: [{shown(of_key)}]")
        if isinstance(of_key, (set, frozenset)):
            raise bad_input(f"{name}: a set has no order", "give a list")
        values = list(of_key)
        if not values:
            raise bad_input(f"{name}: no values", "give at least one value")
        for value in values:
            if isinstance(value, tuple) and len(linked) > 1 and len(value) != len(linked):
                raise bad_input(f"{name}: {shown(value)} has {len(value)} values", f"a tuple has one for each of the {len(linked)} keys")
        for one in linked:
            parts = _toml.parts(one)
            for other, path in known:
                n = min(len(parts), len(path))
                if parts[:n] == path[:n]:
                    twice = f"{one} is varied twice" if len(parts) == len(path) else f"one of {one} and {other} is part of the other"
                    raise bad_input(twice, "vary each of them alone, or only the outer one with whole tables as values")
            known.append((one, parts))
        axes.append((linked, values))
    return axes


def _is_scalar(found: Any) -> bool:
    """Returns whether the value is an array without dimensions, which looks like a list until it is read."""
    return isinstance(found, np.ndarray) and found.ndim == 0


def _n_threads(threads: int | None) -> int:
    if threads is None:
        return 0
    if isinstance(threads, bool) or not isinstance(threads, (int, np.integer)):
        raise TypeError(f"threads is a whole number or None, not {shown(threads)}")
    if threads < 1:
        raise bad_input(f"threads is {threads}", "give at least one thread; None uses one per processor")
    return int(threads)


def _changes(axes: Sequence[tuple[tuple[str, ...], list[Any]]], chosen: Sequence[Any]) -> dict[str, Any]:
    changes: dict[str, Any] = {}
    for (linked, _), value in zip(axes, chosen):
        each = value if isinstance(value, tuple) and len(linked) > 1 else (value,) * len(linked)
        changes.update(zip(linked, each, strict=True))
    return changes


class _Broken(Exception):
    """An executor that failed; the cause says why."""


def _ended(
    kind: type[Interrupted] | type[RunError],
    why: str,
    keys: list[str],
    cases: list[Case],
    changes: list[dict[str, Any]],
    found: _Found,
) -> Interrupted | RunError:
    """Creates an error with a table of the members that are done."""
    done = [k for k, (_, text) in enumerate(found) if text is not None]
    help = "the result of the exception is the table of these members"
    error = kind(f"{why}: {len(done)} of {len(changes)} members are done\n  help: {help}\n", help)
    error.result = _table([cases[k] for k in done], keys, [changes[k] for k in done], [found[k] for k in done])
    return error


def _share(cases: list[Case]) -> _Found:
    """Computes the members of one task in a worker."""
    found, error = _native.run_members([case._native for case in cases], 1, None)
    if error is not None:
        raise error
    return found


def _on(
    executor: Executor, cases: list[Case], report: Callable[[float], object] | None, found: _Found
) -> BaseException | None:
    """Fills `found`; returns the exception that ended the computation early."""
    size = -(-len(cases) // _MOST_TASKS)
    starts = range(0, len(cases), size)
    futures: dict[Any, int] = {}
    shares: dict[int, _Found] = {}
    error: BaseException | None = None
    try:
        for start in starts:
            futures[executor.submit(_share, cases[start : start + size])] = start
        for future in _as_completed(futures):
            shares[futures[future]] = _result(future)
            if report is not None:
                report(len(shares) / len(starts))
    except BaseException as raised:  # noqa: BLE001 - Ctrl-C, too: it is raised with the results so far
        error = raised
    finally:
        for future in futures:
            future.cancel()
    for future, start in futures.items():
        if hasattr(future, "_condition") and future.done() and not future.cancelled() and future.exception() is None:
            shares[start] = future.result()
    for start in starts:
        none: _Found = [("", None)] * len(cases[start : start + size])
        found += shares.get(start, none)
    return error


def _result(future: Any) -> _Found:
    try:
        return future.result()
    except (Error, KeyboardInterrupt):
        raise
    except Exception as cause:
        name = type(cause).__name__
        raise _Broken(f"the executor broke, {name}: {cause}") from cause


def _as_completed(futures: Mapping[Any, int]) -> Iterable[Any]:
    """Returns futures as they complete, if they are those of the standard library."""
    if all(hasattr(future, "_condition") for future in futures):
        try:
            return as_completed(futures)
        except Exception:  # noqa: BLE001 - another library's futures, taken in order
            return list(futures)
    return list(futures)


def _table(
    cases: list[Case],
    keys: list[str],
    changes: list[dict[str, Any]],
    found: list[tuple[str, str | None]],
) -> Table:
    texts = [text or "{}" for _, text in found]
    columns: dict[str, NDArray[Any]] = {}
    for key in keys:
        columns[key] = _array([change[key] for change in changes])
    for key in keys:
        numbers = [case.number(key) for case in cases]
        unit = next((number[1] for number in numbers if number is not None), "")
        if unit:
            si = [number[0] if number is not None else None for number in numbers]
            columns[_native.key_column(key, unit)] = _array(si)
    for name, values in json.loads(_native.table_columns(texts)):
        columns[name] = _array(values)
    columns["member"] = np.array([identity for identity, _ in found], dtype=object)
    return Table(columns, [json.loads(text) for text in texts])


def _array(values: list[Any]) -> NDArray[Any]:
    """Returns an array: numbers as numbers, with NaN for ``None``; other values as objects."""
    plain = [value.item() if isinstance(value, np.generic) else value for value in values]
    kinds = {type(value) for value in plain}
    if kinds and kinds <= {int, float, type(None)} and kinds != {type(None)}:
        if kinds == {int}:
            return np.array(plain)
        return np.array([np.nan if value is None else value for value in plain], dtype=float)
    if kinds == {bool}:
        return np.array(plain)
    array = np.empty(len(plain), dtype=object)
    array[:] = plain
    return array


def _cell(value: Any) -> str:
    if value is None or (isinstance(value, float) and value != value):
        return ""
    if isinstance(value, bool):
        return "true" if value else "false"
    return repr(value) if isinstance(value, float) else str(value)
