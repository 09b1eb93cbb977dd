"""How far a computation is."""

from __future__ import annotations

import sys
from collections.abc import Callable, Iterator
from contextlib import contextmanager

from typing import Any

_WIDTH = 32
#: Lines of a run whose stderr is no terminal.
_LINES = 10


@contextmanager
def reporter(
    progress: bool | Callable[[float], object], title: str
) -> Iterator[Callable[[float], object] | None]:
    """What is called with the fraction that is done: nothing, a function of the user's, or a bar on stderr, which
    is some lines where stderr is a file or a pipe."""
    if callable(progress):
        yield progress
        return
    if not isinstance(progress, bool):
        raise TypeError(f"progress is True, False or a function of the fraction that is done, not {progress!r}")
    stream = sys.stderr
    if not progress or stream is None:
        yield None
    elif _redraws(stream):
        try:
            yield lambda fraction: _draw(stream, fraction, title)
        finally:
            print("\r" + " " * (_WIDTH + 50) + "\r", end="", file=stream, flush=True)
    else:
        yield _Lines(stream, title)


def _redraws(stream: Any) -> bool:
    """Whether a line can be written over: on a terminal and in a notebook."""
    return stream.isatty() or type(stream).__module__.startswith("ipykernel")


def _draw(stream: Any, fraction: float, title: str) -> None:
    done = round(_WIDTH * min(max(fraction, 0.0), 1.0))
    bar = "█" * done + "░" * (_WIDTH - done)
    print(f"\r{bar} {100 * fraction:3.0f} %  {title[:40]}", end="", file=stream, flush=True)


class _Lines:
    """A line a tenth."""

    def __init__(self, stream: Any, title: str) -> None:
        self._stream, self._title, self._told = stream, title, 0

    def __call__(self, fraction: float) -> None:
        tenths = int(_LINES * fraction)
        if tenths > self._told:
            self._told = tenths
            print(f"{self._title}: {100 * tenths // _LINES} %", file=self._stream, flush=True)
