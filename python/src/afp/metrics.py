"""Metrics of interruptions, for `metrics` of a sweep: reaction and recovery.

>>> import afp
>>> afp.metrics.recovery("go").__name__
'recovery'
"""

from __future__ import annotations

from collections.abc import Callable

from .result import Result

__all__ = ["reaction", "recovery"]


def reaction(result: Result) -> float | None:
    """The time from the first stimulus to the next interruption, in seconds; `None` without one."""
    begin = next((event.time for event in result.events if event.kind == "requested"), None)
    if begin is None:
        return None
    return next((event.time - begin for event in result.events if event.kind == "interrupted" and event.time >= begin), None)


def recovery(element: str) -> Callable[[Result], float | None]:
    """A metric: the time from the first interruption of an element after a stimulus to its next
    start, in seconds; `None` if it is not interrupted or does not start again.
    """

    def recovery(result: Result) -> float | None:
        stimulus = next((event.time for event in result.events if event.kind == "requested"), None)
        if stimulus is None:
            return None
        own = [event for event in result.events if event.component == element and event.time >= stimulus]
        begin = next((event.time for event in own if event.kind == "interrupted"), None)
        if begin is None:
            return None
        return next((event.time - begin for event in own if event.kind in {"started", "resumed"} and event.time >= begin), None)

    return recovery
