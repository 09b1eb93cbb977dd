"""How far a computation is."""

from __future__ import annotations

import sys
from collections.abc import Callable, Iterator
from contextlib import contextmanager

_WIDTH = 32


@contextmanager
def reporter(
    progress: bool | Callable[[float], object], title: str
) -> Iterator[Callable[[float], object] | None]:
    """What is called with the fraction that is done: nothing, a function of the user's, or a bar on stderr."""
    if not isinstance(progress, bool):
        yield progress
        return
    if not progress:
        yield None
        return

    def show(fraction: float) -> None:
        done = round(_WIDTH * min(max(fraction, 0.0), 1.0))
        bar = "█" * done + "░" * (_WIDTH - done)
        print(f"\r{bar} {100 * fraction:3.0f} %  {title[:40]}", end="", file=sys.stderr, flush=True)

    yield show
    print("\r" + " " * (_WIDTH + 50) + "\r", end="", file=sys.stderr, flush=True)
