"""One case with many values, here or on any executor."""

from __future__ import annotations

import itertools
import json
from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from concurrent.futures import Executor, as_completed
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from . import _native
from ._case import Case
from ._errors import Interrupted
from ._progress import reporter

if TYPE_CHECKING:
    import pandas

#: Tasks that an executor is given at most, each a share of the members.
_MOST_TASKS = 1000


class Table(Mapping[str, "NDArray[Any]"]):
    """A row a member, columns by name as in ``sweep.csv``: arrays of shape (n,).

    First the varied keys as they were given, then those that are quantities in SI, the unit in the name
    (``body.0.approach_speed_m_s``), then the summary's numbers, ``member`` last. Numbers that a member does not have are NaN.
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

    def to_pandas(self) -> pandas.DataFrame:
        """The same as a data frame of pandas, which has to be installed."""
        import pandas

        return pandas.DataFrame(self._columns)

    def to_csv(self) -> str:
        """The same as text; :func:`fit` and its like take the table itself."""
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

    def _repr_html_(self) -> str:
        return self.to_pandas().to_html(max_rows=20)


def sweep(
    case: Case,
    vary: Mapping[str | tuple[str, ...], Iterable[Any]],
    *,
    executor: Executor | None = None,
    threads: int | None = None,
    progress: bool | Callable[[float], object] = False,
) -> Table:
    """Computes a case for every combination of values, the last key running fastest.

    Args:
        case: what all members share.
        vary: values of dotted keys, ``{"body.0.approach_speed": np.geomspace(0.05, 2, 40)}``. A tuple of keys is
            linked: each value is that of all of them, or a tuple with one for each.
        executor: what computes: any ``concurrent.futures.Executor``, such as Dask's ``client.get_executor()``;
            without one, threads of this process.
        threads: how many of those; one a processor if ``None``.
        progress: a bar on stderr, or a function that is called with the fraction that is done.

    Returns:
        a table in the order of the combinations; the same bits whatever computes it. A member whose run fails
        has ``complete`` false.

    Raises:
        InputError: the first member that is no valid case, before any is computed.
        Interrupted: Ctrl-C.
    """
    keys = [key if isinstance(key, tuple) else (key,) for key in vary]
    values = [list(of_key) for of_key in vary.values()]
    changes = [_changes(keys, chosen) for chosen in itertools.product(*values)]
    cases = [case.with_(change) for change in changes]
    with reporter(progress, f"{len(cases)} members") as report:
        if executor is None:
            found, error = _native.run_members([one._native for one in cases], threads or 0, report)
            if error is not None:
                raise error
            if any(text is None for _, text in found):
                raise Interrupted("interrupted")
        else:
            found = _on(executor, cases, report)
    return _table(cases, [key for linked in keys for key in linked], changes, found)


def _changes(keys: Sequence[tuple[str, ...]], chosen: Sequence[Any]) -> dict[str, Any]:
    changes: dict[str, Any] = {}
    for linked, value in zip(keys, chosen):
        each = value if isinstance(value, tuple) and len(linked) > 1 else (value,) * len(linked)
        changes.update(zip(linked, each, strict=True))
    return changes


def _share(cases: list[Case]) -> list[tuple[str, str | None]]:
    """What a worker does."""
    found, error = _native.run_members([case._native for case in cases], 1, None)
    if error is not None:
        raise error
    return found


def _on(
    executor: Executor, cases: list[Case], report: Callable[[float], object] | None
) -> list[tuple[str, str | None]]:
    size = -(-len(cases) // _MOST_TASKS)
    starts = range(0, len(cases), size or 1)
    futures = {executor.submit(_share, cases[start : start + size]): start for start in starts}
    shares: dict[int, list[tuple[str, str | None]]] = {}
    try:
        for future in _as_completed(futures):
            shares[futures[future]] = future.result()
            if report is not None:
                report(len(shares) / len(futures))
    finally:
        for future in futures:
            future.cancel()
    return [member for start in starts for member in shares[start]]


def _as_completed(futures: Mapping[Any, int]) -> Iterable[Any]:
    """In the order of ending, where the futures are those of the standard library."""
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
    """Numbers as numbers, ``None`` among them as NaN; all else as it is."""
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
