"""The progress of a sweep: on a terminal, in a notebook, or for a callback."""

from __future__ import annotations

import math
import sys
import time
from collections.abc import Callable
from typing import Any

from . import notebook

__all__ = ["Bar", "teller"]


def teller(progress: bool | Callable[[int, int], Any], total: int) -> Callable[[int, int], Any]:
    """A function that receives the number of finished runs, and -1 at the end."""
    if callable(progress):
        return lambda done, all: progress(done, all) if done >= 0 else None
    if progress and notebook.is_here():
        cell = notebook.Cell()
        return Bar(lambda line, last: cell.show({"text/plain": line}))
    return Bar(_on_terminal) if progress and sys.stderr.isatty() else lambda done, all: None


class Bar:
    """Shows the number of finished runs, at most ten times a second, and at the end."""

    EVERY = 0.1
    WIDTH = 30

    def __init__(self, show: Callable[[str, bool], None], clock: Callable[[], float] = time.monotonic) -> None:
        self._show = show
        self._clock = clock
        self._next = -math.inf
        self._line = ""

    def __call__(self, done: int, total: int) -> None:
        if done >= 0:
            full = self.WIDTH * done // max(total, 1)
            self._line = f"{'█' * full}{'░' * (self.WIDTH - full)} {done} of {total} runs"
        if done < 0 or self._clock() >= self._next:
            self._next = self._clock() + self.EVERY
            self._show(self._line, done < 0)


def _on_terminal(line: str, last: bool) -> None:
    print(f"\r{line}", end="\n" if last else "", file=sys.stderr, flush=True)
