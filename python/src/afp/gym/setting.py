"""What an environment is set to, alone or as one of many: what is seen, what it is worth, how episodes begin."""

from __future__ import annotations

import math
import os
from collections.abc import Callable, Iterable, Mapping, Sequence
from dataclasses import dataclass, replace
from typing import Any

import numpy as np

from .._afp import Courses, World
from ..tables import need
from ..units import moment
from .tasks import Task, task_of

gymnasium = need("gymnasium")

__all__ = ["PIXELS", "RANGE", "SPEED", "STEP", "TURN", "Faults", "Setting"]

SPEED = 0.5
"""The speed of a full action, m/s."""
TURN = 2.0
"""The turn rate of a full action, rad/s."""
RANGE = 2.5
"""What silence of the range sensor is observed as, metres."""
STEP = 0.1
"""How long an action lasts, seconds."""
PIXELS = 256
"""The edge of the picture from above."""

FOREVER = 2**63
OPTIONS = ("world", "pose", "goal", "faults")

Fault = tuple[str, str] | tuple[str, str, Mapping[str, float]]
Faults = Iterable[Fault] | Callable[[np.random.Generator], Iterable[Fault]]
Given = World | str | os.PathLike[str] | None
Start = tuple[
    World | None,
    int,
    int,
    tuple[float, float, float] | None,
    tuple[float, float] | None,
    list[tuple[str, str, float | None, float | None, float | None, float | None]],
]


@dataclass(frozen=True)
class Setting:
    """What an environment is set to."""

    task: Task
    world: World | None
    faults: Faults
    point: bool
    steps: int

    @classmethod
    def of(
        cls,
        world: Given,
        task: Task | str,
        observe: Sequence[str] | None,
        reward: Mapping[str, float] | None,
        ends: Sequence[str] | None,
        faults: Faults,
        point: bool,
        steps: int | None,
    ) -> Setting:
        """Reads what an environment is given."""
        changed = {"observe": observe and tuple(observe), "reward": reward, "ends": None if ends is None else tuple(ends)}
        given = {name: value for name, value in changed.items() if value is not None}
        if isinstance(observe, str) or isinstance(ends, str):
            raise TypeError("observe and ends are lists of names, not one text")
        task = replace(task_of(task), **given)  # type: ignore[arg-type]
        if not callable(faults):
            faults = tuple(faults)
        return cls(task, world_of(world), faults, point, FOREVER if steps is None or steps < 0 else max(1, steps))

    def courses(self, count: int) -> Courses:
        """So many episodes."""
        task = self.task
        fan = (list(task.fan), self.point)
        return Courses(count, list(task.observe), fan, list(task.reward.items()), list(task.ends), task.reach, self.steps)

    def spaces(self, courses: Courses) -> tuple[Any, Any]:
        """The spaces of one action and one observation."""
        low, high = courses.bounds
        box = gymnasium.spaces.Box
        return box(-1.0, 1.0, (courses.commands,), np.float32), box(low, high, dtype=np.float32)

    def start(self, rng: np.random.Generator, options: Mapping[str, Any] | None) -> Start:
        """How the next episode begins."""
        options = options or {}
        unknown = [name for name in options if name not in OPTIONS]
        if unknown:
            raise ValueError(f"no option '{unknown[0]}' of reset; there are: {', '.join(OPTIONS)}")
        room, noise = (int(number) for number in rng.integers(0, 2**32, 2))
        faults = options.get("faults", self.faults)
        broken = [_fault(fault) for fault in (faults(rng) if callable(faults) else faults)]
        world = world_of(options["world"]) if options.get("world") is not None else self.world
        return world, room, noise, _numbers("pose", options, 3), _numbers("goal", options, 2), broken

    def world_at(self, start: Start) -> World:
        """The room in which an episode takes place."""
        return start[0] if start[0] is not None else World.random(start[1])


def world_of(world: Given) -> World | None:
    """A world, or that of a file."""
    return world if world is None or isinstance(world, World) else World.load(world)


def steps_of(time_limit: float | None) -> int | None:
    """How many steps a time has."""
    return None if time_limit is None else max(1, math.ceil(time_limit / STEP - 1e-9))


def _numbers(name: str, options: Mapping[str, Any], count: int) -> Any:
    given = options.get(name)
    if given is None:
        return None
    numbers = tuple(float(number) for number in given)
    if len(numbers) != count:
        raise ValueError(f"'{name}' has {count} numbers, not {len(numbers)}")
    return numbers


def _fault(fault: Fault) -> tuple[str, str, float | None, float | None, float | None, float | None]:
    if isinstance(fault, str) or len(fault) not in (2, 3):
        raise ValueError(f"a fault is a device, a kind and perhaps a mapping, such as ('wheels', 'slip', {{'share': 0.5}}), not {fault!r}")
    device, kind = fault[0], fault[1]
    more = dict(fault[2]) if len(fault) == 3 else {}
    known = {name: more.pop(name, None) for name in ("delay", "share", "at", "lasting")}
    if more:
        raise ValueError(f"a fault has no '{next(iter(more))}'; it has: {', '.join(known)}")
    share = None if known["share"] is None else float(known["share"])
    return device, kind, moment("delay", known["delay"]), share, moment("at", known["at"]), moment("lasting", known["lasting"])
