"""The result of a run: numbers, events, path, tables, plots."""

from __future__ import annotations

import html
import pickle
from collections.abc import Sequence
from dataclasses import dataclass, field
from types import TracebackType
from typing import Any, Literal

import numpy as np
from numpy.typing import NDArray

from . import plots, tables
from ._afp import AfpError, Event, Names, Runner, World
from .picture import Picture, address

__all__ = ["ComponentError", "Collision", "Ending", "Result"]

Ending = Literal["running", "ok", "interrupted", "time_limit", "error", "not_started", "panicked"]
"""How a run ended, here and in `Runs`: by the plan, by a stop, by `until`, by a fault, before its start, or by a panic of
the engine."""


@dataclass(frozen=True)
class ComponentError:
    """An exception of a component written in Python."""

    time: float
    """The time in seconds since the start."""
    element: str
    """The element or supervisor, by its path in the plan; empty while the plan runs."""
    template: str
    """Its template."""
    error: BaseException
    """The exception."""
    traceback: str
    """Its traceback."""
    _frames: TracebackType | None = field(default=None, repr=False, compare=False)

    def __reduce__(self) -> tuple[Any, ...]:
        try:
            error = pickle.loads(pickle.dumps(self.error))
        except Exception:
            # Some exceptions cannot be pickled, but their texts can.
            error = RuntimeError(f"{type(self.error).__name__}: {self.error}")
        return ComponentError, (self.time, self.element, self.template, error, self.traceback)


@dataclass(frozen=True)
class Collision:
    """A time span in which the robot touched an obstacle."""

    obstacle: str
    begin: float
    end: float


class Result(tables.Events):
    """The result of a run; it does not change if the simulation continues."""

    plan: str
    """The name of the plan."""
    world: str
    """The name of the world."""
    seed: int
    """The seed."""
    ending: Ending
    """How the plan ended, or `running`."""
    fault: str | None
    """The code of the fault that ended the plan."""
    fault_text: str | None
    """The fault in words."""
    stopped_by: str | None
    """`until` or `stop` when the plan did not end by itself."""
    time: float
    """The duration of the run, in seconds."""
    trace_hash: str
    """The hash of the trace, as in `afpc run`; equal runs have equal hashes."""
    deadline_misses: int
    """Deadlines missed, skipped releases included."""
    collisions: list[Collision]
    """The robot's collisions."""
    entries: dict[str, Any]
    """The values of the plan's entries at the end."""
    events: list[Event]
    """The events."""
    path: NDArray[np.float64]
    """The robot's pose every 20 ms: rows of time, x, y, heading."""
    errors: list[ComponentError]
    """The exceptions of components written in Python."""
    timeline: list[str]
    """The timeline as `afpc run` prints it."""

    def __init__(
        self, runner: Runner, plan: str, world: World, seed: int, errors: Sequence[ComponentError] = ()
    ) -> None:
        self._world = world
        self._names: Names | None = runner.names
        self._things = runner.things()
        self.plan = plan
        self.world = world.name
        self.seed = seed
        self.ending = runner.ending  # type: ignore[assignment]
        self.fault, self.fault_text = runner.fault or (None, None)
        self.stopped_by = runner.stopped_by
        self.time = runner.time
        self.trace_hash = runner.trace_hash
        self.deadline_misses = runner.deadline_misses
        self.collisions = [Collision(*collision) for collision in runner.collisions]
        self.entries = runner.entries()
        self.events = runner.events(0)
        self.path = runner.path()
        self.errors = list(errors)
        self.timeline = runner.timeline

    @property
    def ok(self) -> bool:
        """Whether the plan did not end in `Error`."""
        return self.ending != "error"

    @property
    def distance(self) -> float:
        """The distance driven, in metres."""
        steps = np.diff(self.path[:, 1:3], axis=0)
        return float(np.hypot(steps[:, 0], steps[:, 1]).sum())

    def check(self) -> Result:
        """Raise the reason for an end in `Error`: the component's exception, or `AfpError` for
        another fault.

        Otherwise return the result.
        """
        if self.fault == "python-exception" and self.errors:
            last = self.errors[-1]
            # Each raise adds frames at the front.
            raise last.error.with_traceback(last._frames)
        if self.fault is not None:
            raise AfpError(f"the plan ended in Error after {self.time:.3f} s: {self.fault_text} ({self.fault})")
        return self

    def picture(self) -> Picture:
        """The path in its world, as drawn by `afpc log --svg`; notebooks show it with the result.

        A pickled or copied result has no picture; use `plot_path` instead.
        """
        if self._names is None:
            raise AfpError("a result that was pickled has no names for a picture; plot_path() draws it without")
        run = (self.plan, self._world, self.seed, self.time, self.path, self.events, self._things)
        return Picture(self._names.draw(*run))

    def __getstate__(self) -> dict[str, Any]:
        return {**self.__dict__, "_names": None}

    def plot_path(self, ax: Any = None) -> Any:
        """Draw the robot's path in its world; needs matplotlib."""
        return plots.path(self.path, self._world.outlines(), self.events, self._title(), ax)

    def plot_timeline(self, ax: Any = None) -> Any:
        """Draw the activity over time; needs matplotlib."""
        return plots.timeline(self.events, self.time, self._title(), ax)

    def _title(self) -> str:
        return f"{self.plan} in {self.world}, seed {self.seed}"

    def _key(self) -> tuple[Any, ...]:
        """The part that is equal for two results of the same run."""
        return self.plan, self._world, self.seed, self.ending, self.stopped_by, self.time, self.trace_hash

    def __eq__(self, other: object) -> bool:
        return isinstance(other, Result) and self._key() == other._key()

    def __hash__(self) -> int:
        return hash(self._key())

    def __repr__(self) -> str:
        why = f" ({self.fault})" if self.fault else ""
        return f"<Result {self.ending}{why} after {self.time:.3f} s, {len(self.events)} events>"

    def _repr_html_(self) -> str:
        why = self.fault or self.stopped_by
        rows = {
            "plan": self.plan,
            "world": f"{self.world}, seed {self.seed}",
            "ended": self.ending + (f" ({why})" if why else ""),
            "why": self.fault_text,
            "time": f"{self.time:.3f} s",
            "distance": f"{self.distance:.2f} m",
            "collisions": str(len(self.collisions)),
            "deadline misses": str(self.deadline_misses),
        }
        known = {key: value for key, value in rows.items() if value is not None}
        cells = "".join(f"<tr><th>{key}</th><td>{html.escape(value)}</td></tr>" for key, value in known.items())
        return f"<table>{cells}</table>{self._image()}"

    def _image(self) -> str:
        """The picture as an HTML element, if there is one."""
        if self._names is None or not len(self.path):
            return ""
        return f'<img alt="the path in its world" style="width:560px;max-width:100%" src="{address(self.picture().svg)}">'
