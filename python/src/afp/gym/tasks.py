"""Tasks for learning: observation, reward and end."""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import dataclass, fields
from types import MappingProxyType
from typing import Any

__all__ = ["FIND_INFRARED", "REACH_GOAL", "ROAM", "TASKS", "WALL_FOLLOW", "Task", "task_of"]

FAN = tuple(math.radians(bearing) for bearing in (-90.0, -45.0, 0.0))
"""The bearings of the range sensor, in turn, for tasks with a wall at the right, in radians."""
AROUND = tuple(math.radians(bearing) for bearing in (-60.0, 0.0, 60.0))
"""Its bearings, in turn, for tasks with obstacles ahead."""


@dataclass(frozen=True)
class Task:
    """A task. `reward`, `ends` and `observe` have the names of `afp.gym`."""

    name: str
    """Its name."""
    reward: Mapping[str, float]
    """The weight of each term."""
    ends: tuple[str, ...] = ("crash",)
    """The terms that end an episode."""
    observe: tuple[str, ...] = ("distance", "odometry", "bumper")
    """The observed parts."""
    reach: str | None = None
    """The target: `light`, `goal`, or none."""
    fan: tuple[float, ...] = FAN
    """The bearings of the range sensor, in turn, if the fan is observed, in radians to the left."""
    seconds: float = 60.0
    """The longest duration of an episode."""
    plan: str | None = None
    """The plan written by hand for it, a file of the package."""

    def _facts(self) -> dict[str, Any]:
        """The arguments that make it, as JSON can store them."""
        facts = {field.name: getattr(self, field.name) for field in fields(self)}
        return {name: list(fact) if isinstance(fact, tuple) else fact for name, fact in facts.items()} | {"reward": dict(self.reward)}

    def __reduce__(self) -> tuple[object, ...]:
        # A read-only mapping cannot be pickled.
        return task_of, (self._facts(),)

    def __hash__(self) -> int:
        return hash((self.name, tuple(sorted(self.reward.items())), self.ends, self.observe, self.reach, self.fan, self.seconds))

    def __repr__(self) -> str:
        return f"<Task {self.name}: {dict(self.reward)}, ends with {', '.join(self.ends) or 'time'}, sees {', '.join(self.observe)}>"

    def __post_init__(self) -> None:
        object.__setattr__(self, "reward", MappingProxyType(dict(self.reward)))
        for name in ("ends", "observe", "fan"):
            object.__setattr__(self, name, tuple(getattr(self, name)))


ROAM = Task("Roam", {"ahead": 1.0, "crash": -10.0})
"""Get as far as possible through a room without running into anything."""

WALL_FOLLOW = Task(
    "WallFollow",
    {"wall": 1.0, "crash": -1.0},
    ends=(),
    observe=("fan", "motion", "bumper"),
    plan="wall_following.afp",
)
"""Get ahead along a wall, 30 cm to the left of it; a touch costs as much as a metre is worth."""

FIND_INFRARED = Task(
    "FindInfrared",
    {"nearer": 1.0, "reached": 10.0, "crash": -1.0},
    ends=("reached",),
    observe=("glow", "fan", "motion", "bumper"),
    reach="light",
    fan=AROUND,
    plan="find_infrared.afp",
)
"""Find the infrared beacon and get to within half a metre of it."""

REACH_GOAL = Task(
    "ReachGoal",
    {"nearer": 1.0, "reached": 10.0, "crash": -1.0},
    ends=("reached",),
    observe=("target", "fan", "motion", "bumper"),
    reach="goal",
    fan=AROUND,
    plan="reach_goal.afp",
)
"""Drive by odometry to within 30 cm of a known place."""

TASKS: Mapping[str, Task] = MappingProxyType(
    {
        "afp/Carbot-v0": ROAM,
        "afp/CarbotWallFollow-v0": WALL_FOLLOW,
        "afp/CarbotFindInfrared-v0": FIND_INFRARED,
        "afp/CarbotReachGoal-v0": REACH_GOAL,
    }
)
"""The tasks by the names of their environments."""


def task_of(task: Task | str | Mapping[str, Any]) -> Task:
    """A task, the task with that name, or one made from its facts."""
    if isinstance(task, Mapping):
        return Task(**task)
    if isinstance(task, Task):
        return task
    names = {known.name: known for known in TASKS.values()}
    if task not in names:
        raise ValueError(f"no task '{task}'; there are: {', '.join(names)}")
    return names[task]
