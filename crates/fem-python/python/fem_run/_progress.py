"""Progress of a computation."""

from __future__ import annotations

import sys
from collections.abc import Callable, Iterator
from contextlib import contextmanager

from typing import Any

_WIDTH = 32
#: Lines that are printed for a run if stderr is no terminal.
_LINES = 10


@contextmanager
def reporter(
    progress: bool | Callable[[float], object], title: str
) -> Iterator[Callable[[float], object] | None]:
    """Yields the function that is called with the completed fraction: none, the user's, or one that draws a bar on
    stderr. In a file or a pipe the bar becomes a few lines."""
    if callable(progress):
        yield progress
        return
    if not isinstance(progress, bool):
        raise TypeError(f"progress is True, False or a function of the completed fraction, not {progress!r}")
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
    """Returns whether a line can be overwritten, as on a terminal and in a notebook."""
    return stream.isatty() or type(stream).__module__.startswith("ipykernel")


def _draw(stream: Any, fraction: float, title: str) -> None:
    done = round(_WIDTH * min(max(fraction, 0.0), 1.0))
    bar = "█" * done + "░" * (_WIDTH - done)
    print(f"\r{bar} {100 * fraction:3.0f} %  {title[:40]}", end="", file=stream, flush=True)


class _Lines:
    """Prints a line for each tenth of the progress."""

    def __init__(self, stream: Any, title: str) -> None:
        self._stream, self._title, self._printed = stream, title, 0

    def __call__(self, fraction: float) -> None:
        tenths = int(_LINES * fraction)
        if tenths > self._printed:
            self._printed = tenths
            print(f"{self._title}: {100 * tenths // _LINES} %", file=self._stream, flush=True)
