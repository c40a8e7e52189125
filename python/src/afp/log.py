"""Logs: the contents of a run's MCAP file."""

from __future__ import annotations

import os
from collections.abc import Sequence
from typing import Any

import numpy as np
from numpy.typing import NDArray

from . import plots, tables
from ._afp import Event, PlanError, Toolbox, draw_log, pixels, read_log, read_recipe
from .picture import Picture
from .plan import Plan
from .simulation import Simulation
from .units import seconds

__all__ = ["Log"]

_NO_TOOLBOX = "E0238"
"""The code of the error for an unknown toolbox."""


class Log(tables.Events):
    """A log in memory; an incomplete file gives its readable part."""

    facts: dict[str, str]
    """The description of the run: plan, world, seed, ..."""
    attachments: dict[str, str]
    """The files in the log: the world, perhaps the plan."""
    events: list[Event]
    """The events, including polls without an event."""
    configurations: list[tuple[float, dict[str, Any]]]
    """The values of the entries at the start and after each commit, with its time."""
    entries: dict[str, Any]
    """The values of the entries at the end."""
    channels: dict[str, tuple[str, int]]
    """Schema and number of messages of each topic."""
    signals: list[str]
    """The names of the robot's signals in the log, by device and name: `ultrasonic.echo`."""
    path: NDArray[np.float64]
    """The robot's poses: rows of time, x, y, heading."""
    cut_short: str | None
    """The reason if the log is incomplete, or its missing parts."""

    def __init__(self, file: str | os.PathLike[str]) -> None:
        self.file = os.fspath(file)
        told = read_log(file)
        self.facts = told["facts"]
        self.attachments = told["attachments"]
        self.events = told["events"]
        self.configurations = told["entries"]
        self.entries = self.configurations[-1][1] if self.configurations else {}
        self.channels = told["channels"]
        self._signals: dict[str, tuple[NDArray[np.float64], list[Any]]] = told["signals"]
        self._frames: list[tuple[float, bytes]] = told["frames"]
        self.signals = list(self._signals)
        self.path = told["path"]
        self.cut_short = told["cut_short"]

    def entry(self, name: str) -> tuple[NDArray[np.float64], list[Any]]:
        """The times and values of an entry: its first value and all changes."""
        known = sorted({name for _, values in self.configurations for name in values})
        if name not in known:
            others = f"there are: {', '.join(known)}" if known else "it has no entries"
            raise KeyError(f"the log has no entry '{name}'; {others}")
        rows: list[tuple[float, Any]] = []
        for time, values in self.configurations:
            value = values.get(name)
            if value is not None and (not rows or rows[-1][1] != value):
                rows.append((time, value))
        return np.array([time for time, _ in rows]), [value for _, value in rows]

    def signal(self, name: str) -> tuple[NDArray[np.float64], NDArray[Any]]:
        """The times and values of a signal: `log.signal("ultrasonic.echo")`.

        A signal keeps a value until the next one. Numbers are an array of floats in SI units,
        infinite for a range sensor without an echo, and not a number while the device is silent.
        Truth values are an array of booleans, other values one of objects.
        """
        if name not in self._signals:
            known = f"there are: {', '.join(self.signals)}" if self.signals else "it has none at all"
            raise KeyError(f"the log has no signal '{name}'; {known}")
        times, values = self._signals[name]
        kinds = {type(value) for value in values}
        if kinds <= {int, float, type(None)}:
            return times.copy(), np.array([np.nan if value is None else value for value in values], np.float64)
        return times.copy(), np.array([*values, None], object)[:-1] if kinds != {bool} else np.array(values)

    def frames(self) -> tuple[NDArray[np.float64], NDArray[np.uint8]]:
        """The times and the pictures of the camera: an array of pictures x rows x columns x 3; for
        logs of `Simulation(..., log=..., camera=True)`.
        """
        pictures = [pixels(file) for _, file in self._frames]
        if not pictures:
            raise ValueError("the log has no pictures of the camera: log a run with Simulation(..., log=..., camera=True)")
        return np.array([time for time, _ in self._frames]), np.stack([picture for picture in pictures if picture is not None])

    def simulation(self, at: float = 0.0, *, toolboxes: Sequence[Toolbox] = ()) -> Simulation:
        """Repeat the run up to a moment, from only the log. It continues like the original unless
        you change something.

        All stimuli are repeated, also after that moment. Components in Python come from
        `toolboxes`.

        Raises:
            ValueError: a toolbox of the plan is neither linked nor among `toolboxes`.
        """
        at = seconds("at", at)
        files, name, world, seed = read_recipe(self.file)
        path, text = files[0]
        plan = Plan(text, path, name=name, toolboxes=toolboxes)
        plan._set_others(dict(files[1:]))
        try:
            simulation = Simulation(plan, world, seed=seed)
        except PlanError as error:
            missing = self._missing(toolboxes)
            if not missing or all(diagnostic.code != _NO_TOOLBOX for diagnostic in error.diagnostics):
                raise
            names = ", ".join(f"'{name}'" for name in missing)
            hint = f"log.simulation(toolboxes=[{', '.join([*(toolbox.name for toolbox in toolboxes), *missing])}])"
            raise ValueError(f"the log has the declarations of {names} but not the components: write {hint}") from error
        simulation._runner.repeat(self.file)
        if at != 0:
            simulation.run_to(at)
        return simulation

    def _missing(self, toolboxes: Sequence[Toolbox]) -> list[str]:
        """The log's own toolboxes, which are not built in, without the given ones."""
        carried = [name.removeprefix("toolbox/") for name in self.attachments if name.startswith("toolbox/")]
        given = {toolbox.name for toolbox in toolboxes}
        return [name for name in carried if name not in given]

    def picture(self) -> Picture:
        """The path of the run in its world, as drawn by `afpc log --svg`."""
        return Picture(draw_log(self.file, "path"))

    def sonar(self) -> Picture:
        """The echoes of the range sensor over the true walls, as drawn by `afpc log --sonar`."""
        return Picture(draw_log(self.file, "sonar"))

    def film(self) -> Picture:
        """The camera's pictures, as drawn by `afpc log --film`; for logs of `Simulation(...,
        log=..., camera=True)`.
        """
        return Picture(draw_log(self.file, "film"))

    def plot_timeline(self, ax: Any = None) -> Any:
        """Draw the activity over time; needs matplotlib."""
        end = max((event.time for event in self.events), default=0.0)
        return plots.timeline(self.events, end, self.facts.get("plan", self.file), ax)

    def __repr__(self) -> str:
        return f"<Log {self.file}, {len(self.events)} events>"
