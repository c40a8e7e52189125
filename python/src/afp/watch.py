"""A live view of a run in a notebook: the robot in its world, the plan, the entries."""

from __future__ import annotations

import html
import time
from typing import TYPE_CHECKING

from . import notebook
from .picture import address

if TYPE_CHECKING:
    from .simulation import Simulation

__all__ = ["watch"]

EVERY = 0.1
"""Seconds between two pictures."""
ACTIVE = "stroke:#e8590c!important;stroke-width:5!important"
"""The style of the active element's box."""
KINDS = ".actor,.subplan,.computation"
"""The boxes of elements, without their supervisors."""


def watch(simulation: Simulation, until: float, speed: float) -> None:
    """Drive a simulation to its end or to `until` at `speed` times real time, and show it."""
    if not notebook.is_here():
        raise RuntimeError("watch() needs a notebook cell; call run() instead")
    if not speed > 0:
        raise ValueError(f"speed is {speed}; give a multiple of real time, such as 1 or 5")
    cell, first, begin = notebook.Cell(), simulation.time, time.monotonic()
    view = _View(simulation)
    going, shown = True, begin
    while going and simulation.time < until:
        cell.show(view.bundle())
        shown += EVERY
        time.sleep(max(0.0, shown - time.monotonic()))
        # A late frame is skipped, since drawing may take longer than the interval.
        shown = max(shown, time.monotonic() - EVERY)
        going = simulation.run_to(min(until, first + (time.monotonic() - begin) * speed))
    cell.show(view.bundle())


class _View:
    """The view of a simulation."""

    def __init__(self, simulation: Simulation) -> None:
        self._simulation = simulation
        self._plan = simulation.plan.svg(theme="light")

    def bundle(self) -> dict[str, str]:
        """The current view as data by media types."""
        simulation = self._simulation
        active = simulation.active
        words = f"{simulation.plan.name}, {simulation.time:.1f} s, {active or simulation.ending}"
        world, plan = address(simulation.picture().svg), address(self._marked(active))
        rows = "".join(
            f"<tr><th>{html.escape(name)}</th><td>{html.escape(_shown(value))}</td></tr>"
            for name, value in simulation.entries.items()
        )
        page = (
            f'<div><b>{html.escape(words)}</b><div style="display:flex;flex-wrap:wrap;gap:12px;align-items:flex-start">'
            f'<img alt="the robot in its world" style="width:420px" src="{world}">'
            f'<img alt="the plan" style="width:420px" src="{plan}"><table>{rows}</table></div></div>'
        )
        return {"text/html": page, "text/plain": words}

    def _marked(self, active: str | None) -> str:
        """The drawing of the plan with the active element marked."""
        if active is None:
            return self._plan
        item = f"{self._simulation.plan.name}.{active}"
        rule = f'<style>.element[data-item="{html.escape(item)}"]>.box:is({KINDS}){{{ACTIVE}}}</style>'
        head, end, tail = self._plan.rpartition("</svg>")
        return f"{head}{rule}{end}{tail}"


def _shown(value: object) -> str:
    return "" if value is None else f"{value:.4g}" if isinstance(value, float) else str(value)
